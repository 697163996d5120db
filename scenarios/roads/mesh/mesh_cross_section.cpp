#include "scenarios/roads/mesh/mesh_cross_section.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

/// Straight between the records: a kerb goes down as a ramp, and the surface has no hole where a record begins.
Lane::Height heights_at(const Lane& lane, double ds) {
    const auto& all = lane.heights;
    if (all.empty())
        return {};
    const auto next = std::ranges::find_if(all, [ds](const Lane::Height& h) { return h.s_m > ds; });
    if (next == all.begin())
        return *next;
    const Lane::Height& a = *(next - 1);
    if (next == all.end())
        return a;
    const double f = (ds - a.s_m) / (next->s_m - a.s_m);
    return {ds, a.inner_m + f * (next->inner_m - a.inner_m), a.outer_m + f * (next->outer_m - a.outer_m)};
}

/// Joins neighbours of one material. Only where no lane has heights: there are neither kinks nor kerbs between them then.
std::vector<Strip> joined(const std::vector<Strip>& strips) {
    std::vector<Strip> out;
    for (const Strip& strip : strips) {
        if (!out.empty() && out.back().material == strip.material && out.back().paved == strip.paved)
            out.back().left_t_m = strip.left_t_m;
        else
            out.push_back(strip);
    }
    return out;
}

/// Closes the steps between lanes of different heights.
std::vector<Strip> with_kerb_faces(const std::vector<Strip>& strips) {
    std::vector<Strip> out;
    for (const Strip& strip : strips) {
        if (!out.empty())
            out.push_back({strip.right_t_m, strip.right_t_m, out.back().left_h_m, strip.right_h_m, RoadMaterial::kerb, true, false});
        out.push_back(strip);
    }
    return out;
}

// German guide lines outside towns (RMS-1): 4 m dash, 8 m gap [M].
constexpr double dash_of_broken_m = 4.0;
constexpr double gap_of_broken_m = 8.0;
constexpr double shortest_period_m = 0.2;
constexpr double max_dashes = 20'000.0; ///< of one mark: 240 km of guide line
constexpr double default_width_m = 0.12;

using Explicit = RoadMark::Stripe;

/// Left line first: OpenDRIVE names the lines of a double mark from the inside of the road outwards, so they swap on the right side.
std::vector<Explicit> stripes_by_kind(MarkKind kind, double width, bool left_side) {
    const auto line = [width](bool broken, double t) {
        return Explicit{width, broken ? dash_of_broken_m : 0.0, broken ? gap_of_broken_m : 0.0, t, 0.0};
    };
    const double inner = left_side ? -width : width;
    using enum MarkKind;
    if (kind == solid || kind == broken)
        return {line(kind == broken, 0.0)};
    if (kind == solid_solid || kind == solid_broken || kind == broken_solid || kind == broken_broken)
        return {line(kind == broken_solid || kind == broken_broken, inner), line(kind == solid_broken || kind == broken_broken, -inner)};
    return {};
}

Stripe placed(const Explicit& line, const RoadMark& mark, double from_s, double to_s) {
    const double width = line.width_m > 0.0 ? line.width_m : mark.width_m > 0.0 ? mark.width_m : default_width_m;
    const double period = line.gap_m > 0.0 ? line.dash_m + line.gap_m : 0.0;
    const bool solid = period < shortest_period_m || (to_s - from_s) / period > max_dashes;
    return {from_s, to_s, line.t_m, width, from_s + line.start_m, line.dash_m, solid ? 0.0 : period, marking_material(mark.colour)};
}

/// The stripes of a lane's marks. Kinds without explicit lines: broken lines have 4 m dashes and 8 m gaps; the two lines of a double
/// mark stand one line's width apart. Kerbs, botts' dots and marks without paint give none. Dashes with a period below 0.2 m
/// are drawn solid, as are marks of more than 20 000 dashes: each would cost a row of vertices.
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

} // namespace

double Strip::height_at(double t_m) const {
    const double width = left_t_m - right_t_m;
    if (width <= 0.0)
        return right_h_m;
    return right_h_m + (left_h_m - right_h_m) * std::clamp((t_m - right_t_m) / width, 0.0, 1.0);
}

SectionProfile::SectionProfile(const Road& road, const LaneSection& section, bool wheel_tracks)
    : road_(&road), section_(&section), wheel_tracks_(wheel_tracks) {
    const Lane* right_neighbour = nullptr;
    const Lane* centre = nullptr;
    const auto add_edge = [&](const Lane* right, const Lane* left) {
        Edge edge;
        edge.right = right;
        edge.left = left;
        const Lane* owner = left && left->id < 0 ? left : right && right->id > 0 ? right : centre; // an edge is outer to one lane only
        if (owner)
            edge.stripes = stripes_of(section, *owner);
        std::sort(edge.stripes.begin(), edge.stripes.end(), [](const Stripe& a, const Stripe& b) { return a.t_m < b.t_m; });
        keep_on_one_side(edge, owner);
        edges_.push_back(std::move(edge));
    };
    for (const Lane& lane : section.lanes)
        if (lane.id == 0)
            centre = &lane;
    for (auto lane = section.lanes.rbegin(); lane != section.lanes.rend(); ++lane) {
        if (lane->id == 0)
            continue;
        has_heights_ = has_heights_ || !lane->heights.empty();
        add_edge(right_neighbour, &*lane);
        right_neighbour = &*lane;
    }
    if (right_neighbour)
        add_edge(right_neighbour, nullptr);
}

/// At a kerb and at the road's edge a mark lies wholly on its owner's lane: half of it would hang in the air.
void SectionProfile::keep_on_one_side(Edge& edge, const Lane* owner) {
    const bool kerb = edge.left && edge.right && !(edge.left->heights.empty() && edge.right->heights.empty());
    if (edge.left && edge.right && !kerb)
        return;
    edge.only_right = !edge.left || (edge.right && owner == edge.right);
    edge.only_left = !edge.only_right;
    for (const Stripe& stripe : edge.stripes) {
        if (edge.only_right)
            edge.shift_m = std::min(edge.shift_m, -(stripe.t_m + 0.5 * stripe.width_m));
        else
            edge.shift_m = std::max(edge.shift_m, 0.5 * stripe.width_m - stripe.t_m);
    }
}

SectionProfile::Span SectionProfile::span(const Lane& lane, double s_m) const {
    // A station may stand for a border some millimetres away; the section has no widths outside itself.
    const double s = std::clamp(s_m, section_->s_m, std::max(section_->s_m, section_->end_m));
    const LaneEdges edges = lane_edges(*road_, *section_, lane.id, s);
    // A width that is negative for rounding or by mistake counts as none; the inner edge stays where the neighbours put it.
    return lane.id > 0 ? Span{edges.inner_t_m, std::max(edges.inner_t_m, edges.outer_t_m)}
                       : Span{std::min(edges.inner_t_m, edges.outer_t_m), edges.inner_t_m};
}

Strip SectionProfile::whole_lane(const Lane& lane, double s_m) const {
    const Span edges = span(lane, s_m);
    const Lane::Height heights = heights_at(lane, s_m - section_->s_m);
    const bool left = lane.id > 0;
    const RoadMaterial material = lane_material(lane.type);
    return {edges.right_t_m,
            edges.left_t_m,
            left ? heights.inner_m : heights.outer_m,
            left ? heights.outer_m : heights.inner_m,
            material,
            false,
            material == RoadMaterial::asphalt && lane.type != "border"};
}

std::vector<SectionProfile::Paint> SectionProfile::paint(const Edge& edge, double layout_s_m, double s_m) const {
    std::vector<Paint> out;
    if (edge.stripes.empty())
        return out;
    const Span neighbour = span(edge.left ? *edge.left : *edge.right, s_m);
    const double t = edge.left ? neighbour.right_t_m : neighbour.left_t_m;
    const double half_right = edge.right && !edge.only_left ? 0.5 * (t - span(*edge.right, s_m).right_t_m) : 0.0;
    const double half_left = edge.left && !edge.only_right ? 0.5 * (span(*edge.left, s_m).left_t_m - t) : 0.0;
    for (const Stripe& stripe : edge.stripes) {
        if (!stripe.painted_at(layout_s_m))
            continue;
        const double from_edge = stripe.t_m + edge.shift_m, middle = t + from_edge, half = 0.5 * stripe.width_m;
        // Not beyond the middle of a lane, where the other edge's paint begins; and stripes that meet share the border.
        const double from = out.empty() ? t - half_right : out.back().left_t_m;
        const double right = std::clamp(middle - half, from, std::max(from, t + half_left));
        const double left = std::clamp(middle + half, right, std::max(right, t + half_left));
        out.push_back({right, left, stripe.material, from_edge - half<0.0, from_edge + half> 0.0});
    }
    return out;
}

void SectionProfile::append_lane(std::vector<Strip>& out, const Lane& lane, const std::vector<Paint>& right, const std::vector<Paint>& left,
                                 double s_m) const {
    const Strip base = whole_lane(lane, s_m);
    double t = base.right_t_m;
    const bool tracks = wheel_tracks_ && lane.type == "driving";
    const double middle = 0.5 * (base.right_t_m + base.left_t_m);
    const auto add_plain = [&](double to_t, RoadMaterial material) {
        Strip strip = base;
        strip.right_t_m = t;
        strip.left_t_m = std::max(t, to_t);
        strip.right_h_m = base.height_at(strip.right_t_m);
        strip.left_h_m = base.height_at(strip.left_t_m);
        strip.material = material;
        out.push_back(strip);
        t = strip.left_t_m;
    };
    const auto add = [&](double to_t, RoadMaterial material) {
        if (!tracks || material != RoadMaterial::asphalt)
            return add_plain(to_t, material);
        int level = 0; // every border in every row, though of no width, so that both ends of a stretch have the same strips
        for (const TrackBorder& border : track_borders()) {
            add_plain(std::clamp(middle + border.from_middle_m, t, std::max(t, to_t)), track_material(level));
            level = border.level;
        }
        add_plain(to_t, track_material(level));
    };
    const auto add_paint = [&](const Paint& stripe) {
        add(std::clamp(stripe.right_t_m, base.right_t_m, base.left_t_m), base.material);
        add(std::clamp(stripe.left_t_m, base.right_t_m, base.left_t_m), stripe.material);
    };
    for (const Paint& stripe : right)
        if (stripe.reaches_left)
            add_paint(stripe);
    for (const Paint& stripe : left)
        if (stripe.reaches_right)
            add_paint(stripe);
    add(base.left_t_m, base.material);
}

std::vector<Strip> SectionProfile::strips(double layout_s_m, double s_m) const {
    std::vector<Strip> out;
    if (edges_.empty())
        return out;
    std::vector<Paint> right = paint(edges_.front(), layout_s_m, s_m);
    for (std::size_t i = 0; i + 1 < edges_.size(); ++i) {
        std::vector<Paint> left = paint(edges_[i + 1], layout_s_m, s_m);
        append_lane(out, *edges_[i].left, right, left, s_m);
        right = std::move(left);
    }
    return has_heights_ ? with_kerb_faces(out) : joined(out);
}

void SectionProfile::append_stations(std::vector<double>& stations) const {
    stations.push_back(section_->s_m);
    stations.push_back(section_->end_m);
    for (const Lane& lane : section_->lanes) {
        for (const auto* knots : {&lane.widths, &lane.borders})
            for (const Cubic& cubic : *knots)
                stations.push_back(section_->s_m + cubic.s0);
        for (const Lane::Height& height : lane.heights)
            stations.push_back(section_->s_m + height.s_m);
    }
    for (const Edge& edge : edges_)
        for (const Stripe& stripe : edge.stripes)
            stripe.append_ends(stations);
}

double SectionProfile::rightmost_t(double s_m) const { return edges_.empty() ? 0.0 : span(*edges_.front().left, s_m).right_t_m; }

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

} // namespace fernlicht
