#include "scenarios/roads/mesh/mesh_stripes.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {

namespace {

// German guide lines outside towns (RMS-1): 4 m dash, 8 m gap [M].
constexpr double dash_of_broken_m = 4.0;
constexpr double gap_of_broken_m = 8.0;
constexpr double shortest_period_m = 0.2;
constexpr double most_dashes = 20'000.0; ///< of one mark: 240 km of guide line
constexpr double default_width_m = 0.12;

using Explicit = RoadMark::Stripe;

/// Left line first: OpenDRIVE names the lines of a double mark from the inside of the road outwards, so they swap on the right side.
std::vector<Explicit> stripes_by_kind(MarkKind kind, double width, bool left_side) {
    const auto line = [width](bool broken, double t) {
        return Explicit{width, broken ? dash_of_broken_m : 0.0, broken ? gap_of_broken_m : 0.0, t, 0.0};
    };
    const double inner = left_side ? -width : width;
    switch (kind) {
    case MarkKind::solid:
        return {line(false, 0.0)};
    case MarkKind::broken:
        return {line(true, 0.0)};
    case MarkKind::solid_solid:
        return {line(false, inner), line(false, -inner)};
    case MarkKind::solid_broken:
        return {line(false, inner), line(true, -inner)};
    case MarkKind::broken_solid:
        return {line(true, inner), line(false, -inner)};
    case MarkKind::broken_broken:
        return {line(true, inner), line(true, -inner)};
    case MarkKind::none:
    case MarkKind::botts_dots:
    case MarkKind::curb:
    case MarkKind::other:
        return {};
    }
    return {};
}

Stripe placed(const Explicit& line, const RoadMark& mark, double from_s, double to_s) {
    Stripe stripe;
    stripe.from_s_m = from_s;
    stripe.to_s_m = to_s;
    stripe.t_m = line.t_m;
    stripe.width_m = line.width_m > 0.0 ? line.width_m : mark.width_m > 0.0 ? mark.width_m : default_width_m;
    stripe.first_dash_m = from_s + line.start_m;
    stripe.dash_m = line.dash_m;
    stripe.period_m = line.gap_m > 0.0 ? line.dash_m + line.gap_m : 0.0;
    if (stripe.period_m < shortest_period_m || (to_s - from_s) / stripe.period_m > most_dashes)
        stripe.period_m = 0.0;
    stripe.material = marking_material(mark.colour);
    return stripe;
}

} // namespace

bool Stripe::painted_at(double s_m) const {
    if (s_m < from_s_m || s_m > to_s_m || s_m < first_dash_m)
        return false;
    return period_m <= 0.0 || std::fmod(s_m - first_dash_m, period_m) < dash_m;
}

void Stripe::append_ends(std::vector<double>& stations) const {
    stations.push_back(from_s_m);
    stations.push_back(to_s_m);
    if (first_dash_m > from_s_m && first_dash_m < to_s_m)
        stations.push_back(first_dash_m);
    if (period_m <= 0.0 || dash_m <= 0.0)
        return;
    for (std::size_t i = 0;; ++i) { // counted, not summed: a sum would drift
        const double start = first_dash_m + static_cast<double>(i) * period_m;
        if (start >= to_s_m)
            return;
        stations.push_back(start);
        stations.push_back(std::min(start + dash_m, to_s_m));
    }
}

std::vector<Stripe> stripes_of(const LaneSection& section, const Lane& lane) {
    std::vector<Stripe> all;
    for (std::size_t i = 0; i < lane.marks.size(); ++i) {
        const RoadMark& mark = lane.marks[i];
        const double from = section.s_m + mark.s_m;
        const double to = i + 1 < lane.marks.size() ? section.s_m + lane.marks[i + 1].s_m : section.end_m;
        if (mark.kind == MarkKind::none || mark.kind == MarkKind::curb || from >= to)
            continue;
        const auto lines = mark.stripes.empty()
                               ? stripes_by_kind(mark.kind, mark.width_m > 0.0 ? mark.width_m : default_width_m, lane.id > 0)
                               : mark.stripes;
        for (const Explicit& line : lines)
            all.push_back(placed(line, mark, from, std::min(to, section.end_m)));
    }
    return all;
}

} // namespace fernlicht
