#include "runner/judge/repeats.h"

#include "runner/findings/extent_keys.h"
#include "runner/findings/moment_columns.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_file_bytes = std::size_t{1} << 30;

/// Without what is compared by itself and what only the first play has: accuracy, contact sheets.
PlayedCell comparable(const PlayedCell& played) {
    PlayedCell plain = played;
    plain.error = {};
    plain.contact_sheet = {};
    plain.more_sheets.clear();
    plain.shadows = nullptr;
    plain.verdicts.clear();
    plain.repeats = {};
    return plain;
}

std::string shown(const Json& value) { return printable(value.dump(-1, ' ', false, Json::error_handler_t::replace), 80); }

std::string difference(const Json& first, const Json& again, const std::string& place) {
    if (first == again)
        return {};
    if (first.type() == again.type() && first.is_object() && first.size() == again.size())
        for (const auto& [key, value] : first.items()) {
            if (!again.contains(key))
                break;
            if (std::string found = difference(value, again.at(key), place.empty() ? key : place + "." + key); !found.empty())
                return found;
        }
    if (first.is_array() && again.is_array() && first.size() == again.size())
        for (std::size_t i = 0; i < first.size(); ++i)
            if (std::string found = difference(first[i], again[i], fmt::format("{}[{}]", place, i)); !found.empty())
                return found;
    return fmt::format("{}: {}, at first {}", place, shown(again), shown(first));
}

/// Equal to the bit: -0 is not 0.
bool same(const Value& a, const Value& b) {
    return a.kind() == b.kind() &&
           (!a.measured() || std::bit_cast<std::uint64_t>(*a.figure()) == std::bit_cast<std::uint64_t>(*b.figure()));
}

std::string value_text(const Reading& reading) {
    const Value& value = reading.value;
    return value.measured() ? with_bound(value, fmt::format("{} {}", *value.figure(), reading.unit())) : "not measured: " + value.reason();
}

std::string label_of(const Reading& reading) {
    return reading.name() + (reading.tick < 0 ? "" : fmt::format(" at frame {}", reading.tick));
}

/// Where two files differ first; "" where they are the same.
std::string file_difference(const std::filesystem::path& first, const std::filesystem::path& again) {
    FilesRead opened;
    try {
        const std::string a = read_file(first, opened, max_file_bytes), b = read_file(again, opened, max_file_bytes);
        if (a == b)
            return {};
        const auto [at, ignored] =
            std::mismatch(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(std::min(a.size(), b.size())), b.begin());
        return fmt::format("byte {} on, of {}, at first {}", at - a.begin(), b.size(), a.size());
    } catch (const InputError& error) {
        return error.what();
    }
}

/// The first difference and how many more there are of its kind.
struct Counted {
    std::string first;
    std::size_t count = 0;

    void add(const std::string& text) {
        if (count++ == 0)
            first = text;
    }
    void take_to(std::vector<std::string>& all, int play, const char* things) const {
        if (count > 0)
            all.push_back(fmt::format("play {}: {}{}", play, first, count > 1 ? fmt::format(" ({} {} in all)", count, things) : ""));
    }
};

Counted files_that_differ(const PlayedCell& first, const std::filesystem::path& first_folder, const PlayedCell& again,
                          const std::filesystem::path& folder) {
    Counted files;
    for (std::size_t i = 0; i < std::min(first.frames.size(), again.frames.size()); ++i)
        for (std::string StoredFrame::*const path : {&StoredFrame::exr, &StoredFrame::png})
            if (const std::string& a = first.frames[i].*path, &b = again.frames[i].*path; !a.empty() && !b.empty())
                if (const std::string found = file_difference(first_folder / a, folder / b); !found.empty())
                    files.add(fmt::format("{} from {}", a, found));
    return files;
}

Counted maps_that_differ(const PlayedCell& first, const PlayedCell& again) {
    Counted maps;
    if (first.maps.size() != again.maps.size())
        maps.add(fmt::format("{} lux maps, at first {}", again.maps.size(), first.maps.size()));
    for (std::size_t i = 0; i < std::min(first.maps.size(), again.maps.size()); ++i) {
        const Image<float>&a = first.maps[i].lx, &b = again.maps[i].lx;
        if (a.size() != b.size() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) != 0)
            maps.add(fmt::format("lux map of frame {}", first.maps[i].tick));
    }
    return maps;
}

/// A limit that is kept in one play and exceeded in another.
Counted verdicts_that_differ(const PlayedCell& first, const PlayedCell& again) {
    Counted verdicts;
    for (std::size_t i = 0; i < std::min(first.verdicts.size(), again.verdicts.size()); ++i)
        if (first.verdicts[i].kind != again.verdicts[i].kind)
            verdicts.add(fmt::format("{}: {}, at first {}", first.verdicts[i].name, verdict_text(again.verdicts[i].kind),
                                     verdict_text(first.verdicts[i].kind)));
    return verdicts;
}

/// The first figure of a moment that differs; "" where all are the same.
std::string moment_difference(const PlayedCell& first, const PlayedCell& again) {
    const std::vector<MomentColumn> before = moment_columns(first), now = moment_columns(again);
    if (before.size() != now.size())
        return fmt::format("{} columns of moments, at first {}", now.size(), before.size());
    for (std::size_t i = 0; i < now.size(); ++i) {
        const std::vector<std::string>&a = before[i].cells, &b = now[i].cells;
        if (before[i].name != now[i].name || a.size() != b.size())
            return fmt::format("{} of {} moments, at first {} of {}", now[i].name, b.size(), before[i].name, a.size());
        if (const auto [old, found] = std::ranges::mismatch(a, b); old != a.end())
            return fmt::format("{}[{}]: {}, at first {}", now[i].name, found - b.begin(), *found, *old);
    }
    return {};
}

} // namespace

std::string first_difference(const std::string& first, const std::string& again) {
    return difference(Json::parse(first), Json::parse(again), "");
}

RepeatFold::RepeatFold(const PlayedCell& first, std::filesystem::path folder, Told told)
    : first_(&first), folder_(std::move(folder)), told_(std::move(told)) {
    for (std::size_t i = 0; i < first.readings.size(); ++i)
        if (const auto number = first.readings[i].value.number())
            values_[i].push_back(*number);
}

bool RepeatFold::add(const PlayedCell& again, const std::filesystem::path& folder) {
    ++plays_;
    const std::size_t before = differ_.size();
    Counted readings;
    for (std::size_t i = 0; i < std::min(first_->readings.size(), again.readings.size()); ++i) {
        const Reading &a = first_->readings[i], &b = again.readings[i];
        if (const auto number = b.value.number())
            values_[i].push_back(*number);
        if (a.key == b.key && a.tick == b.tick && same(a.value, b.value))
            continue;
        readings.add(fmt::format("{}: {}, at first {}", label_of(b), value_text(b), value_text(a)));
        if (std::ranges::find(varying_, i) == varying_.end())
            varying_.push_back(i);
    }
    if (first_->readings.size() != again.readings.size())
        readings.add(fmt::format("{} readings, at first {}", again.readings.size(), first_->readings.size()));
    readings.take_to(differ_, plays_, "readings");
    verdicts_that_differ(*first_, again).take_to(differ_, plays_, "limits");
    files_that_differ(*first_, folder_, again, folder).take_to(differ_, plays_, "files");
    maps_that_differ(*first_, again).take_to(differ_, plays_, "maps");
    if (const std::string found = moment_difference(*first_, again); !found.empty())
        differ_.push_back(fmt::format("play {}: {}", plays_, found));
    if (const std::string found = difference(told_(comparable(*first_)), told_(comparable(again)), ""); !found.empty())
        differ_.push_back(fmt::format("play {}: {}", plays_, found));
    return differ_.size() == before;
}

void RepeatFold::finish(PlayedCell& first, int asked) const {
    first.repeats = {plays_, differ_, {}};
    for (const std::size_t i : varying_) {
        const auto values = values_.find(i);
        if (values == values_.end())
            continue;
        const std::optional<Spread> spread = spread_of(values->second);
        first.repeats.spread.push_back({first.readings[i].key, first.readings[i].tick, static_cast<int>(spread->count), spread->mean,
                                        spread->standard_deviation * spread->standard_deviation});
    }
    Verdict verdict{VerdictKind::pass, "repeats", "", ""};
    if (differ_.empty() && plays_ < asked) {
        verdict.kind = VerdictKind::not_measured;
        verdict.text = fmt::format("{} of {} plays were made", plays_, asked);
    } else if (differ_.empty())
        verdict.text = fmt::format("{} plays, equal to the byte: {} readings, {} stored frames and all else that is reported", plays_,
                                   first.readings.size(), first.frames.size());
    else {
        verdict.kind = VerdictKind::flaky;
        verdict.text = fmt::format("of {} plays not all are equal: {}", plays_, differ_.front());
        if (differ_.size() > 1)
            verdict.text += fmt::format("; {} further differences in report.json", differ_.size() - 1);
    }
    first.verdicts.push_back(std::move(verdict));
}

} // namespace fernlicht
