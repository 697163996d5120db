#include "runner/experiments/run/page_parts.h"

#include "runner/files/clean_text.h"
#include "runner/findings/extent_keys.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace fernlicht {

using kainjow::mustache::data;
using List = data::type;

std::vector<ComparedDrive> compared_drives(const Report& report) {
    std::vector<ComparedDrive> drives;
    for (const PlayedVariant& played : report.played) {
        const auto same = [&](const ComparedDrive& drive) { return drive.name == played.drive; };
        auto found = std::find_if(drives.begin(), drives.end(), same);
        if (found == drives.end())
            found = drives.insert(drives.end(), ComparedDrive{played.drive, {}});
        found->variants.push_back(&played);
    }
    return drives;
}

/// What turned a run red that failed.
const char* failure_word(const Report& report) {
    bool limits = false, references = false;
    for (const PlayedVariant& played : report.played)
        for (const Verdict& verdict : played.verdicts)
            if (is_red(verdict) && verdict.kind == VerdictKind::fail)
                (verdict.name.starts_with("reference") ? references : limits) = true;
    return limits ? "Limits exceeded" : references ? "Differs from the references" : "The list of known failures is out of date";
}

data verdict_part(const Report& report) {
    data part;
    data failures{List::list}, flakes{List::list}, gaps{List::list}, known{List::list}, passes{List::list};
    std::map<const data*, std::string> last_rerun; // by list: the same command once
    const auto add = [&](const Verdict& verdict, const std::string& drive, const std::string& variant) {
        data row;
        row.set("name", clean_text(verdict.name));
        row.set("text", clean_text(verdict.known.empty() ? verdict.text : verdict.text + "; " + verdict.known));
        row.set("drive", clean_text(drive));
        row.set("variant", clean_text(variant));
        data& list = !is_red(verdict)                            ? (verdict.kind == VerdictKind::pass ? passes : known)
                     : verdict.kind == VerdictKind::flaky        ? flakes
                     : verdict.kind == VerdictKind::not_measured ? gaps
                                                                 : failures;
        const bool as_above = !verdict.rerun.empty() && std::exchange(last_rerun[&list], verdict.rerun) == verdict.rerun;
        row.set("rerun", clean_text(verdict.rerun));
        row.set("has_rerun", !verdict.rerun.empty() && !as_above);
        row.set("as_above", as_above);
        list.push_back(row);
    };
    for (const PlayedVariant& played : report.played)
        for (const Verdict& verdict : played.verdicts)
            add(verdict, played.drive, played.variant);
    for (const Verdict& verdict : report.listed)
        add(verdict, "list of known failures", "");
    const VerdictCounts counts = count_verdicts(report);
    const VerdictKind verdict = overall(report);
    const bool none = counts.all() == 0 && report.complete;
    const char* const word = verdict == VerdictKind::fail           ? failure_word(report)
                             : verdict == VerdictKind::flaky        ? "Flaky"
                             : !report.complete                     ? "Incomplete"
                             : verdict == VerdictKind::not_measured ? "Not everything was measured"
                             : none                                 ? "No limits were set"
                                                                    : "Within limits";
    part.set("word", word);
    part.set("class", none ? "none" : verdict_name(verdict));
    part.set("mark", none                            ? "\u2013"
                     : verdict == VerdictKind::fail  ? "\u2717"
                     : verdict == VerdictKind::flaky ? "\u2260"
                     : verdict == VerdictKind::pass  ? "\u2713"
                                                     : "?");
    part.set("has_limits", counts.all() > 0);
    part.set("passed", fmt::format("{}", counts.pass));
    part.set("limits", fmt::format("{}", counts.all()));
    part.set("incomplete", !report.complete);
    part.set("interrupted", clean_text(report.interrupted));
    for (const auto& [name, list] : {std::pair("failures", &failures), std::pair("flakes", &flakes), std::pair("gaps", &gaps),
                                     std::pair("known", &known), std::pair("passes", &passes)}) {
        part.set(std::string("has_") + name, !list->is_empty_list());
        part.set(name, *list);
    }
    data warnings{List::list};
    for (const std::string& warning : report.warnings)
        warnings.push_back(clean_text(warning));
    part.set("has_warnings", !report.warnings.empty());
    part.set("warnings", warnings);
    return part;
}

data timing_table(const ComparedDrive& drive) {
    data rows{List::list};
    for (std::size_t i = 0; i < drive.variants.size(); ++i)
        for (const PassTime& pass : drive.variants[i]->passes) {
            const std::optional<Spread> spread = spread_of(pass.seconds);
            if (!spread)
                continue;
            data row;
            row.set("lamp", short_text(drive.variants[i]->variant, 40));
            row.set("colour", variant_colour(i));
            row.set("pass", short_text(pass.name, 40));
            row.set("count", fmt::format("{}", spread->count));
            const bool by_picture = pass.name.starts_with("display: "); // each stored one, none of them dropped
            row.set("dropped", fmt::format("{}", by_picture ? 0 : drive.variants[i]->warm_up_dropped));
            for (const auto& [name, seconds] :
                 {std::pair("median", spread->median), std::pair("p05", spread->p05), std::pair("p95", spread->p95),
                  std::pair("minimum", spread->minimum), std::pair("maximum", spread->maximum)})
                row.set(name, figure(1e3 * seconds, 2));
            rows.push_back(row);
        }
    return rows;
}

data throughput_table(const ComparedDrive& drive) {
    data rows{List::list};
    for (std::size_t i = 0; i < drive.variants.size(); ++i) {
        const Throughput& t = drive.variants[i]->throughput;
        if (!t.moments_per_s())
            continue;
        data row;
        const auto rate = [&](const char* name, const std::optional<double>& alone_s) {
            row.set(name, alone_s ? figure(1.0 / *alone_s, 1) : "not measured");
            row.set(std::string(name) + "_share", alone_s ? figure(100.0 * *t.share_of(alone_s), 0) + " %" : "not measured");
        };
        row.set("lamp", short_text(drive.variants[i]->variant, 40));
        row.set("colour", variant_colour(i));
        row.set("moments", fmt::format("{}", t.moments));
        row.set("per_s", figure(*t.moments_per_s(), 1));
        rate("drawing", t.drawing_s);
        rate("view", t.view_s);
        row.set("memory", figure(t.peak_memory_mib, 0));
        rows.push_back(row);
    }
    return rows;
}

} // namespace fernlicht
