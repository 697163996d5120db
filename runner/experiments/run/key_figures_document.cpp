#include "metrics/readings/quantities.h"
#include "metrics/readings/reading_labels.h"
#include "runner/experiments/run/run_document.h"
#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"
#include "scenarios/studies/study.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace fernlicht {
namespace {

constexpr std::size_t most_key_figures = 3;

const Reading* whole_drive(const PlayedCell& played, const ReadingKey& key) {
    const auto found =
        std::ranges::find_if(played.readings, [&](const Reading& reading) { return reading.tick < 0 && reading.key == key; });
    return found == played.readings.end() || !found->value.measured() ? nullptr : &*found;
}

/// Reach on the road, where nothing that decides was measured.
const std::vector<std::string>& reach_otherwise() {
    static const std::vector<std::string> names{"reach_*lx_target_own_m", "reach_1lx_road_own_m", "reach_*lx_road_own_m"};
    return names;
}

/// Of what a lamp is bought for: first one of each quantity, then more, in the order in which studies decide.
std::vector<ReadingKey> key_readings(const ComparedDrive& drive) {
    std::vector<std::pair<std::size_t, ReadingKey>> all;
    for (const Reading& reading : drive.lamp_sets.front()->readings) {
        if (reading.tick >= 0)
            continue;
        auto place = place_among(reading.key, decides_by_default());
        if (const auto otherwise = place ? std::nullopt : place_among(reading.key, reach_otherwise()))
            place = decides_by_default().size() + *otherwise;
        if (place &&
            std::ranges::all_of(drive.lamp_sets, [&](const PlayedCell* played) { return whole_drive(*played, reading.key) != nullptr; }))
            all.emplace_back(*place, reading.key);
    }
    std::ranges::sort(all);
    std::vector<ReadingKey> chosen;
    std::set<Quantity> seen;
    for (const bool anew : {true, false})
        for (const auto& [place, key] : all)
            if (chosen.size() < most_key_figures && std::ranges::count(chosen, key) == 0 && (!anew || seen.insert(key.quantity).second))
                chosen.push_back(key);
    return chosen;
}

/// What 0.1 degrees of aim move it by, at most; of either lamp set.
std::optional<double> by_aim_of(const Reading& a, const Reading& b) {
    std::optional<double> most;
    for (const Reading* const reading : {&a, &b})
        for (const std::optional<double>& moved : {reading->sensitivity.aim_up, reading->sensitivity.aim_down})
            if (moved)
                most = std::max(most.value_or(0.0), std::abs(*moved));
    return most;
}

std::string key_number(double value) {
    return figure(value, std::abs(value) < 1e-6 ? 0 : std::clamp(2 - static_cast<int>(std::floor(std::log10(std::abs(value)))), 0, 5));
}

std::string worded(const Reading& reading) {
    return with_bound(reading.value, key_number(*reading.value.figure())) + unit_suffix(reading.unit());
}

/// Of the lamp sets behind the first one that which has most of the reading: it reaches farthest, or dazzles most. 0: there are none.
std::size_t told_lamp_set(const ComparedDrive& drive, const ReadingKey& key) {
    std::size_t told = 0;
    const auto figure_of = [&](std::size_t i) { return *whole_drive(*drive.lamp_sets[i], key)->value.figure(); };
    for (std::size_t i = 1; i < drive.lamp_sets.size(); ++i)
        if (told == 0 || figure_of(i) > figure_of(told))
            told = i;
    return told;
}

/// One reading of a lamp set against the first one's.
struct KeyFigure {
    const Reading *first = nullptr, *other = nullptr;
    std::size_t lamp_set;
    Value change;
    std::optional<double> by_aim;

    KeyFigure(const ComparedDrive& drive, const ReadingKey& key, std::size_t told)
        : first(whole_drive(*drive.lamp_sets.front(), key)), lamp_set(told) {
        if (told > 0) {
            other = whole_drive(*drive.lamp_sets[told], key);
            change = difference(other->value, first->value, first->unit());
        }
        by_aim = by_aim_of(*first, other ? *other : *first);
    }
    std::string share() const {
        const double old = first->value.number().value_or(0.0);
        return change.number() && old != 0.0 ? fmt::format("{} %", signed_figure(100.0 * *change.number() / std::abs(old), 0)) : "";
    }
    /// 1: the other one is better; -1: worse; 0: neither, or a bound leaves it open.
    int better() const {
        const int side = change.low() > 0.0 ? 1 : change.high() < 0.0 ? -1 : 0;
        const Better better = row_of(first->key.quantity).better;
        return better == Better::neither ? 0 : better == Better::higher ? side : -side;
    }
    bool is_within_aim() const { return change.measured() && by_aim && std::abs(*change.figure()) <= *by_aim; }
    std::string changed() const {
        return change.measured() ? with_bound(change, (*change.figure() > 0.0 ? "+" : "") + key_number(*change.figure())) : "";
    }
};

} // namespace

Cards key_figures(const ComparedDrive& drive) {
    Cards cards;
    const std::vector<ReadingKey> keys = key_readings(drive);
    const std::size_t told = keys.empty() ? 0 : told_lamp_set(drive, keys.front());
    for (const ReadingKey& key : keys) {
        const KeyFigure found(drive, key, told);
        const std::string unit = unit_label(unit_of(key)),
                          aim =
                              found.by_aim ? fmt::format("±{}{} by 0.1° of aim", key_number(*found.by_aim), unit_suffix(unit_of(key))) : "";
        if (!found.other) {
            cards.push_back({reading_label(key), with_bound(found.first->value, key_number(*found.first->value.figure())), unit, "", aim,
                             lamp_cell(drive, 0)});
            continue;
        }
        const std::string from_to = fmt::format("{} {} → {} {}", short_text(drive.lamp_sets.front()->lamp_set, 24), worded(*found.first),
                                                short_text(drive.lamp_sets[found.lamp_set]->lamp_set, 24), worded(*found.other));
        cards.push_back({reading_label(key), found.changed().empty() ? "?" : found.changed(), unit,
                         found.share().empty() ? "" : "(" + found.share() + ")", from_to + (aim.empty() ? "" : "; " + aim), Cell("")});
    }
    return cards;
}

std::string key_sentence(const ComparedDrive& drive) {
    const std::vector<ReadingKey> keys = key_readings(drive);
    if (keys.empty())
        return "";
    const KeyFigure found(drive, keys.front(), told_lamp_set(drive, keys.front()));
    const PlayedCell &other = *drive.lamp_sets[found.lamp_set], &one = *drive.lamp_sets.front();
    const std::string lamp = short_text(other.lamp_set, 24), first = short_text(one.lamp_set, 24);
    if (!found.other)
        return fmt::format("{}: {} {}", first, reading_label(keys.front()), worded(*found.first));
    std::string text = capitalised(reading_label(keys.front())) + ": ";
    if (const int side = found.better(); side == 0) {
        const std::string now = worded(*found.other), before = worded(*found.first);
        text += fmt::format("{} and {} {}{}", lamp, first, now, now == before ? "" : " and " + before);
    } else
        text += fmt::format("{} is {} than {}{}: {} against {} ({}{})", lamp, side > 0 ? "better" : "worse", first,
                            found.is_within_aim() ? ", but within 0.1° of aim" : "", worded(*found.other), worded(*found.first),
                            found.changed() + unit_suffix(found.first->unit()), found.share().empty() ? "" : ", " + found.share());
    for (std::size_t i = 1; i < keys.size(); ++i)
        if (const KeyFigure more(drive, keys[i], found.lamp_set); found.better() * more.better() < 0 && !more.is_within_aim())
            text += fmt::format("; {} in {}, {}", more.better() > 0 ? "better" : "worse", reading_label(keys[i]),
                                more.share().empty() ? more.changed() + unit_suffix(more.first->unit()) : more.share());
    const auto apart = low_beams_apart(other.aims, one.aims);
    if (const std::string higher = apart ? higher_words(apart->up_deg) : ""; !higher.empty())
        text += fmt::format("; as mounted, the cut-off of {} lies {}", lamp, higher);
    return text;
}

} // namespace fernlicht
