#include "runner/experiments/study/study_document.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

constexpr std::size_t max_zones = 3; ///< that are told; lamps of two makes differ in dozens

/// "8.2 to 2.9 degrees left", "1.0 degrees left to 2.0 degrees right".
std::string span(double from_deg, double to_deg, const char* less, const char* more) {
    if (from_deg < 0.0 && to_deg > 0.0)
        return fmt::format("{:.1f} degrees {} to {:.1f} degrees {}", -from_deg, less, to_deg, more);
    return fmt::format("{:.1f} to {:.1f} degrees {}", std::abs(from_deg), std::abs(to_deg), to_deg <= 0.0 ? less : more);
}

std::string share_text(double share) { return fmt::format("{:.1f} % {}", 100.0 * std::abs(share), share < 0.0 ? "dimmer" : "brighter"); }

std::string zone_text(const BeamZone& zone) {
    return fmt::format("{} at {} and {}", share_text(zone.share), span(zone.h_from_deg, zone.h_to_deg, "left", "right"),
                       span(zone.v_from_deg, zone.v_to_deg, "down", "up"));
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
    if (d.aim_up_deg)
        found.push_back(aim_text(d));
    if (d.cut_off_up_deg)
        found.push_back(fmt::format("the cut-off is {:.2f} degrees {}, the light below it is not moved", std::abs(d.cut_off_up_deg->value),
                                    d.cut_off_up_deg->value < 0.0 ? "lower" : "higher"));
    if (d.level)
        found.push_back(share_text(d.level->value) + " all over");
    for (std::size_t i = 0; i < std::min(max_zones, d.zones.size()); ++i)
        found.push_back(zone_text(d.zones[i]));
    if (d.zones.size() > max_zones)
        found.push_back(fmt::format("and {} more zones", d.zones.size() - max_zones));
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
        text += " " + d.undecided + ".";
    if (lamps.is_turned_later)
        text += " So the files; the drives have beams turned by `aim: auto`.";
    return text;
}

} // namespace fernlicht
