#include "runner/judge/known_failures.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/glob.h"
#include "scenarios/values/refusals.h"
#include "scenarios/yaml/yaml_entry.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t max_entries = 10000;
constexpr std::size_t max_list_bytes = std::size_t{4} << 20;

/// The part before the first slash.
std::string drive_of(const std::string& id) { return id.substr(0, id.find('/')); }

KnownFailure read_entry(const YamlEntry& entry) {
    const YamlMap map = entry.map({"id", "kind", "reason", "expires"});
    KnownFailure known;
    known.line = entry.value().line;
    EachRead each;
    each([&] {
        const YamlEntry id = map.require("id");
        known.id = id.text();
        if (known.id.find('/') == std::string::npos)
            id.refuse("DRIVE/LAMP SET/TECHNIQUE/NAME, with * for any text");
    });
    each([&] { known.kind = map.require("kind").choice({"fails", "flaky"}) == 0 ? VerdictKind::fail : VerdictKind::flaky; });
    each([&] { known.reason = map.require("reason").text(); });
    each([&] {
        const YamlEntry expires = map.require("expires");
        known.expires = expires.text();
        if (!is_date(known.expires))
            expires.refuse("a date, e.g. 2026-12-31: the last day that the entry holds");
    });
    each.end();
    return known;
}

std::string entry_text(const KnownFailures& known, const KnownFailure& entry) {
    return fmt::format("{}:{}: {}", known.file.filename().string(), entry.line, entry.reason);
}

void mark(Verdict& verdict, const KnownFailures& known, const KnownFailure& entry, bool expired) {
    const char* const how = entry.kind == VerdictKind::fail ? "to fail" : "to be flaky";
    if (verdict.kind == VerdictKind::pass && entry.kind == VerdictKind::fail) {
        verdict.expectation = Expectation::unexpected_pass;
        verdict.known = fmt::format("passes, but is listed as failing: take the entry out ({})", entry_text(known, entry));
    } else if (verdict.kind == entry.kind) {
        verdict.expectation = expired ? Expectation::expired : Expectation::known;
        verdict.known = expired ? fmt::format("was known {} until {} ({})", how, entry.expires, entry_text(known, entry))
                                : fmt::format("known {} until {} ({})", how, entry.expires, entry_text(known, entry));
    } else if (verdict.kind != VerdictKind::pass)
        verdict.known = fmt::format("listed as {}, which this is not ({})", entry.kind == VerdictKind::fail ? "failing" : "flaky",
                                    entry_text(known, entry));
}

/// Marks what the entry names and no earlier entry did. Returns whether it names anything.
bool mark_all(Report& report, const KnownFailures& known, const KnownFailure& entry, bool expired) {
    bool names = false;
    for (PlayedCell& played : report.played)
        for (Verdict& verdict : played.verdicts)
            if (matches(entry.id, verdict_id(played, verdict))) {
                names = true;
                if (verdict.expectation == Expectation::none && verdict.known.empty())
                    mark(verdict, known, entry, expired);
            }
    return names;
}

std::string nearest_id(const Report& report, const std::string& id) {
    std::vector<std::string> ids;
    for (const bool red : {true, false}) // what is green needs no entry
        for (const PlayedCell& played : report.played)
            for (const Verdict& verdict : played.verdicts)
                if (is_red(verdict) == red && (red || ids.empty()))
                    ids.push_back(verdict_id(played, verdict));
    const std::string nearest = nearest_name(id, ids);
    return printable(!nearest.empty() ? nearest : ids.empty() ? "none" : ids.front(), 200);
}

/// Whether what the entry names is gone because all is green there: of a baseline that agrees nothing is told one by one.
bool is_mended(const Report& report, const KnownFailure& entry) {
    const std::string place = entry.id.substr(0, entry.id.rfind('/') + 1);
    bool found = false;
    for (const PlayedCell& played : report.played)
        if (matches(place, verdict_id(played, {}))) {
            found = true;
            if (std::ranges::any_of(played.verdicts, is_red))
                return false;
        }
    return found;
}

bool names_a_drive(const Report& report, const KnownFailure& entry) {
    return std::ranges::any_of(report.played, [&](const PlayedCell& played) { return matches(drive_of(entry.id), played.drive); });
}

} // namespace

bool is_date(const std::string& text) {
    constexpr std::string_view form = "0000-00-00";
    if (text.size() != form.size())
        return false;
    for (std::size_t i = 0; i < form.size(); ++i)
        if (form[i] == '-' ? text[i] != '-' : text[i] < '0' || text[i] > '9')
            return false;
    const auto number = [&](std::size_t from, std::size_t count) {
        unsigned value = 0;
        std::from_chars(text.data() + from, text.data() + from + count, value);
        return value;
    };
    using namespace std::chrono;
    return year_month_day(year(static_cast<int>(number(0, 4))), month(number(5, 2)), day(number(8, 2))).ok();
}

std::string verdict_id(const PlayedCell& played, const Verdict& verdict) {
    return fmt::format("{}/{}/{}/{}", played.drive, played.lamp_set, played.technique, verdict.name);
}

KnownFailures read_known_failures(const std::filesystem::path& file) {
    KnownFailures known;
    known.file = file;
    const YamlValue tree = parse_yaml(read_file(file, known.opened, max_list_bytes), file);
    const YamlEntry root(tree, file, "");
    const YamlMap map = root.map({"known"});
    const YamlEntry entries = map.require("known");
    EachRead each;
    const auto read = [&](const YamlEntry& item) {
        KnownFailure entry = read_entry(item);
        const auto earlier = std::ranges::find(known.entries, entry.id, &KnownFailure::id);
        if (earlier != known.entries.end())
            item.refuse("'" + printable(entry.id, 200) + "' again",
                        fmt::format("each id once; the first stands in line {}", earlier->line));
        known.entries.push_back(std::move(entry));
    };
    for (const YamlEntry& item : entries.list(0, max_entries))
        each([&] { read(item); });
    each.end();
    return known;
}

void apply_known_failures(Report& report, const KnownFailures& known, const std::string& today) {
    for (const KnownFailure& entry : known.entries) {
        const bool expired = entry.expires < today; // dates of one form are ordered as their texts are
        const bool names = mark_all(report, known, entry, expired);
        if (!names_a_drive(report, entry))
            report.warnings.push_back(fmt::format("{} is listed as a known failure, but no drive of this run is called so ({})",
                                                  printable(entry.id, 200), entry_text(known, entry)));
        else if (expired)
            report.listed.push_back({VerdictKind::fail, entry.id,
                                     fmt::format("the entry held until {}: mend what it names, or give it a new date and reason ({})",
                                                 entry.expires, entry_text(known, entry)),
                                     ""});
        else if (!names && report.complete)
            report.listed.push_back({VerdictKind::fail, entry.id,
                                     is_mended(report, entry)
                                         ? fmt::format("all is green there: take the entry out ({})", entry_text(known, entry))
                                         : fmt::format("names no verdict of this run, as {} would: mend it or take it out ({})",
                                                       nearest_id(report, entry.id), entry_text(known, entry)),
                                     ""});
    }
}

} // namespace fernlicht
