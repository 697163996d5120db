#include "runner/experiments/study/study_document.h"
#include "runner/files/clean_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>

namespace fernlicht {
namespace {

constexpr std::size_t max_zones = 3; ///< that are told; lamps of two makes differ in dozens

/// The named places that a shift of the light changed most, of all and of those that it is to keep dark:
/// " (in all: 75R +56.2 %, 50V +53.1 %; glare: BR +5.5 %, zone III +4.5 %)"; "" where it changed none.
std::string most_changed(const LampDifference& d) {
    std::vector<const PlaceChange*> places;
    for (const PlaceChange& found : d.places)
        if (found.is_beyond_noise && found.change())
            places.push_back(&found);
    std::ranges::stable_sort(places, std::greater{}, [](const PlaceChange* found) { return std::abs(std::log1p(*found->change())); });
    std::vector<std::string> texts, glare;
    for (const PlaceChange* found : places) {
        std::vector<std::string>& list = found->place.what.starts_with("glare") ? glare : texts;
        if (list.size() < (&list == &glare ? 2U : 3U))
            list.push_back(fmt::format("{} {:+.1f} %", found->place.name, 100.0 * *found->change()));
    }
    if (texts.empty() && glare.empty())
        return "";
    return fmt::format(" (in all: {}{}{}{})", fmt::join(texts, ", "), texts.empty() || glare.empty() ? "" : "; ",
                       glare.empty() ? "" : "glare: ", fmt::join(glare, ", "));
}

/// Aimed to a side only where that side lies beyond its own uncertainty.
std::string aim_text(const LampDifference& d) {
    std::string text;
    const auto add = [&](const FittedFigure& aim, const char* more, const char* less) {
        if (std::abs(aim.value) > d.z_limit * aim.uncertainty && std::abs(aim.value) >= 0.005)
            text += fmt::format("{}{:.2f} degrees {}", text.empty() ? "" : " and ", std::abs(aim.value), aim.value < 0.0 ? less : more);
    };
    add(*d.aim_up_deg, "higher", "lower");
    add(*d.aim_right_deg, "farther right", "farther left");
    return "the whole beam is aimed " + text;
}

std::vector<std::string> findings(const LampDifference& d) {
    std::vector<std::string> found;
    if (is_of_other_function(d))
        found.push_back(other_function_text(d));
    if (is_for_other_side(d))
        found.push_back(other_side_text(d));
    if (d.aim_up_deg)
        found.push_back(aim_text(d) + (d.cut_off_up_deg ? "" : most_changed(d)));
    if (d.cut_off_up_deg)
        found.push_back(fmt::format("the cut-off is {:.2f} degrees {}, the light below it is not moved{}",
                                    std::abs(d.cut_off_up_deg->value), d.cut_off_up_deg->value < 0.0 ? "lower" : "higher",
                                    most_changed(d)));
    if (d.level)
        found.push_back(
            fmt::format("{:.1f} % {} all over", 100.0 * std::abs(d.level->value), d.level->value < 0.0 ? "dimmer" : "brighter"));
    for (std::size_t i = 0; i < std::min(max_zones, d.zones.size()); ++i)
        found.push_back(zone_text(d.zones[i]));
    if (d.zones.size() > max_zones)
        found.push_back(fmt::format("and {} more zone{}", d.zones.size() - max_zones, d.zones.size() == max_zones + 1 ? "" : "s"));
    if (!d.is_explained())
        for (const PlaceChange& place : d.places)
            if (place.is_beyond_noise)
                found.push_back(place_text(place));
    return found;
}

} // namespace

std::string lamp_verdict(const LampComparison& lamps) {
    const LampDifference& d = lamps.difference;
    const std::string sides = lamps.side == "left and right" ? "" : fmt::format(" ({} lamp)", lamps.side);
    const std::string noise =
        d.noise_relative < 5e-5 ? "the digits of the tables" : fmt::format("the noise of the tables, {:.2g} %", 100.0 * d.noise_relative);
    std::string text = fmt::format("{} against {}{}: ", lamps.tested, lamps.against, sides);
    if (d.any())
        text += fmt::format("{}. Nothing else differs beyond {}.", fmt::join(findings(d), "; "), noise);
    else
        text += fmt::format("the same light; no difference beyond {}.", noise);
    if (!d.undecided.empty())
        text += " " + capitalised(d.undecided) + ".";
    if (lamps.is_turned_later)
        text += " This is of the files; the drives have beams turned by `aim: auto`.";
    return text;
}

} // namespace fernlicht
