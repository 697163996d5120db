#include "metrics/beam/intake.h"
#include "metrics/beam/lamp_difference.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

constexpr std::size_t max_named = 6; ///< places of one zone

std::string share_text(double share) { return fmt::format("{:.1f} % {}", 100.0 * std::abs(share), share < 0.0 ? "dimmer" : "brighter"); }

/// "between 20.1 and 64.7 % brighter", "between 1.2 % dimmer and 4.0 % brighter".
std::string shares_text(double from, double to) {
    return (from < 0.0) == (to < 0.0) ? fmt::format("between {:.1f} and {}", 100.0 * std::abs(from), share_text(to))
                                      : fmt::format("between {} and {}", share_text(from), share_text(to));
}

/// "8.2 to 2.9 degrees left", "1.0 degrees left to 2.0 degrees right".
std::string span_text(double from_deg, double to_deg, const char* less, const char* more) {
    if (from_deg < 0.0 && to_deg > 0.0)
        return fmt::format("{:.1f} degrees {} to {:.1f} degrees {}", -from_deg, less, to_deg, more);
    return fmt::format("{:.1f} to {:.1f} degrees {}", std::abs(from_deg), std::abs(to_deg), to_deg <= 0.0 ? less : more);
}

std::string named_text(const BeamZone& zone) {
    const std::string where = zone_where(zone);
    const double near = zone.share < 0.0 ? zone.share_high : zone.share_low, far = zone.share < 0.0 ? zone.share_low : zone.share_high;
    return (where.empty() ? "" : where + " ") + share_text(zone.share) +
           (zone.share_high > zone.share_low ? fmt::format(" on average, nine tenths of it {}", shares_text(near, far)) : "");
}

/// "75R, 50R and 50V".
std::string list_text(const std::vector<std::string>& all) {
    std::vector<std::string> names(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(max_named, all.size())));
    if (all.size() > max_named)
        names.push_back(fmt::format("{} more", all.size() - max_named));
    const std::string last = names.back();
    names.pop_back();
    return names.empty() ? last : fmt::format("{} and {}", fmt::join(names, ", "), last);
}

std::string error_text(double deg) { return deg < 0.0005 ? "within 0.001" : fmt::format("±{:.3f}", deg); }

std::string coordinates_text(const BeamZone& zone) {
    return span_text(zone.h_from_deg, zone.h_to_deg, "left", "right") + ", " + span_text(zone.v_from_deg, zone.v_to_deg, "down", "up");
}

} // namespace

std::string uncertainty_text(double share) {
    constexpr double digits = 5e-5; // rounding to 0.1 cd is this of 2000 cd
    return share < digits ? "within the digits of the tables" : fmt::format("±{:.2g} %", 100.0 * share);
}

std::string zone_where(const BeamZone& zone) {
    if (zone.extent == ZoneExtent::all)
        return "all light";
    if (zone.extent == ZoneExtent::below_cut_off || zone.extent == ZoneExtent::above_cut_off)
        return zone.extent == ZoneExtent::below_cut_off ? "all light below the cut-off" : "all light above the cut-off";
    if (!zone.holds.empty())
        return (zone.extent == ZoneExtent::wide ? "a wide zone with " : "") + list_text(zone.holds);
    return zone.part_of.empty() ? "" : "part of " + zone.part_of;
}

bool is_of_other_function(const LampDifference& difference) {
    return difference.function != BeamFunction::other && difference.function_against != BeamFunction::other &&
           difference.function != difference.function_against;
}

std::string other_function_text(const LampDifference& difference) {
    return fmt::format("a {} beam by its light, the other lamp a {} beam: they do not stand for one another", name_of(difference.function),
                       name_of(difference.function_against));
}

bool is_for_other_side(const LampDifference& difference) {
    return difference.side != TrafficSide::unknown && difference.side_against != TrafficSide::unknown &&
           difference.side != difference.side_against;
}

std::string other_side_text(const LampDifference& difference) {
    return fmt::format("made for {}-hand traffic, the other lamp for {}-hand traffic: mirror one of them first",
                       traffic_side_name(difference.side), traffic_side_name(difference.side_against));
}

std::string zone_text(const BeamZone& zone) { return fmt::format("{} ({})", named_text(zone), coordinates_text(zone)); }

std::string place_text(const PlaceChange& change) {
    return change.place.name + " " + (change.change() ? share_text(*change.change()) : change.not_measured);
}

std::vector<std::string> sentences_of(const LampDifference& difference) {
    std::vector<std::string> out;
    if (is_of_other_function(difference))
        out.push_back(other_function_text(difference));
    if (is_for_other_side(difference))
        out.push_back(other_side_text(difference));
    const auto turned = [](double deg, const char* more, const char* less, const char* not_at_all = "") {
        return std::abs(deg) < 0.0005 ? std::string(not_at_all) : fmt::format("{:.3f} degrees {}", std::abs(deg), deg < 0.0 ? less : more);
    };
    if (difference.aim_up_deg)
        out.push_back(fmt::format("aimed {} and {}: the whole beam ({} and {})",
                                  turned(difference.aim_up_deg->value, "higher", "lower", "neither higher nor lower"),
                                  turned(difference.aim_right_deg->value, "to the right", "to the left", "not aside"),
                                  error_text(difference.aim_up_deg->uncertainty), error_text(difference.aim_right_deg->uncertainty)));
    if (difference.cut_off_up_deg)
        out.push_back(fmt::format("cut-off {} ({}), over the light below it", turned(difference.cut_off_up_deg->value, "higher", "lower"),
                                  error_text(difference.cut_off_up_deg->uncertainty)));
    if (difference.level)
        out.push_back(fmt::format("{:.2f} % {} all over ({})", 100.0 * std::abs(difference.level->value),
                                  difference.level->value < 0.0 ? "dimmer" : "brighter", uncertainty_text(difference.level->uncertainty)));
    if (!difference.undecided.empty())
        out.push_back(difference.undecided);
    for (const BeamZone& zone : difference.zones)
        out.push_back(fmt::format("{} ({}; {}, {} direction{})", named_text(zone), coordinates_text(zone),
                                  uncertainty_text(zone.uncertainty), zone.samples, zone.samples == 1 ? "" : "s"));
    if (!difference.is_explained())
        for (const PlaceChange& change : difference.places)
            if (change.is_beyond_noise)
                out.push_back(fmt::format("{} ({})", place_text(change), uncertainty_text(change.uncertainty.value_or(0.0))));
    if (out.empty())
        out.push_back("no difference beyond noise");
    return out;
}

} // namespace fernlicht
