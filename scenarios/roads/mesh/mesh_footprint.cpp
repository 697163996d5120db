#include "scenarios/roads/mesh/mesh_terrain.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fernlicht {

namespace {

constexpr double tile_m = 16.0;
constexpr double continues_m = 5.0;

struct Bounds {
    glm::dvec2 low, high;
};

Bounds bounds(const PlanQuad& ground) {
    Bounds b{ground.corners_m[0], ground.corners_m[0]};
    for (const glm::dvec2& corner : ground.corners_m) {
        b.low = glm::min(b.low, corner);
        b.high = glm::max(b.high, corner);
    }
    return b;
}

bool meet(const Bounds& a, const Bounds& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

/// Whether a line along one of a's sides has all of b beyond it, or no more than `margin` inside.
bool separated(const PlanQuad& a, const PlanQuad& b, double margin) {
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec2 side = a.corners_m[(i + 1) % 4] - a.corners_m[i];
        const double length = glm::length(side);
        if (length < 1e-9)
            continue;
        const glm::dvec2 across(-side.y / length, side.x / length);
        double a_low = std::numeric_limits<double>::infinity(), a_high = -a_low, b_low = a_low, b_high = a_high;
        for (std::size_t k = 0; k < 4; ++k) {
            a_low = std::min(a_low, glm::dot(across, a.corners_m[k]));
            a_high = std::max(a_high, glm::dot(across, a.corners_m[k]));
            b_low = std::min(b_low, glm::dot(across, b.corners_m[k]));
            b_high = std::max(b_high, glm::dot(across, b.corners_m[k]));
        }
        if (std::min(a_high, b_high) - std::max(a_low, b_low) <= margin)
            return true;
    }
    return false;
}

std::uint64_t tile_key(std::int64_t x, std::int64_t y) {
    return (static_cast<std::uint64_t>(x) << 32) ^ (static_cast<std::uint64_t>(y) & 0xFFFFFFFFULL);
}

template <class Visit> void for_tiles(const Bounds& b, const Visit& visit) {
    const auto tile = [](double v) { return static_cast<std::int64_t>(std::floor(v / tile_m)); };
    for (std::int64_t x = tile(b.low.x); x <= tile(b.high.x); ++x)
        for (std::int64_t y = tile(b.low.y); y <= tile(b.high.y); ++y)
            visit(tile_key(x, y));
}

struct Extent {
    double right_t = 0.0, left_t = 0.0;
};

Extent paved_extent(const std::vector<Strip>& strips) {
    std::optional<Extent> extent;
    for (const Strip& strip : strips)
        if (strip.paved)
            extent = {extent ? extent->right_t : strip.right_t_m, strip.left_t_m};
    return extent.value_or(Extent{});
}

} // namespace

PlanQuad ground_between(const std::array<glm::dvec3, 4>& points) {
    PlanQuad ground;
    ground.lowest_m = ground.highest_m = points[0].z;
    for (std::size_t i = 0; i < 4; ++i) {
        ground.corners_m[i] = glm::dvec2(points[i]);
        ground.lowest_m = std::min(ground.lowest_m, points[i].z);
        ground.highest_m = std::max(ground.highest_m, points[i].z);
    }
    return ground;
}

bool overlap(const PlanQuad& a, const PlanQuad& b, double margin_m) { return !separated(a, b, margin_m) && !separated(b, a, margin_m); }

Footprints::Footprints(const RoadNetwork& network, const std::vector<SurfacePlan>& plans) : joints_(plans.size()) {
    for (std::size_t i = 0; i < plans.size(); ++i) {
        lengths_m_.push_back(plans[i].road->length_m);
        add(network, plans[i], i);
    }
    add_joints(network);
}

void Footprints::add(const RoadNetwork& network, const SurfacePlan& plan, std::size_t road) {
    const auto place = [&](double s, double t) { return surface_pose(network, *plan.road, s, t).position_m; };
    for (const RoadStretch& stretch : plan.stretches) {
        const std::vector<Strip> from = plan.profile(stretch).strips(stretch.layout_s_m(), stretch.from_s_m);
        const std::vector<Strip> to = plan.profile(stretch).strips(stretch.layout_s_m(), stretch.to_s_m);
        if (from.empty())
            continue;
        const auto ground = [&](const Extent& a, const Extent& b) {
            return ground_between({place(stretch.from_s_m, a.right_t), place(stretch.to_s_m, b.right_t), place(stretch.to_s_m, b.left_t),
                                   place(stretch.from_s_m, a.left_t)});
        };
        const RoadFootprint footprint{ground({from.front().right_t_m, from.back().left_t_m}, {to.front().right_t_m, to.back().left_t_m}),
                                      ground(paved_extent(from), paved_extent(to)), road, stretch.from_s_m, stretch.to_s_m};
        const auto index = static_cast<std::uint32_t>(all_.size());
        for_tiles(bounds(footprint.all), [&](std::uint64_t key) { tiles_[key].push_back(index); });
        all_.push_back(footprint);
    }
}

void Footprints::add_joints(const RoadNetwork& network) {
    std::unordered_map<std::string, std::size_t> by_id;
    for (std::size_t i = 0; i < network.roads.size(); ++i)
        by_id.emplace(network.roads[i].id, i);
    const auto join = [&](std::size_t road, bool at_start, const std::optional<RoadLink>& link) {
        if (!link || link->is_junction)
            return;
        const auto other = by_id.find(link->id);
        if (other == by_id.end())
            return;
        joints_[road].push_back({other->second, at_start, link->contact_start});
        joints_[other->second].push_back({road, link->contact_start, at_start});
    };
    for (std::size_t i = 0; i < network.roads.size(); ++i) {
        join(i, true, network.roads[i].predecessor);
        join(i, false, network.roads[i].successor);
    }
}

void Footprints::near(const PlanQuad& ground, const std::function<void(const RoadFootprint&)>& visit) const {
    const Bounds b = bounds(ground);
    std::vector<std::uint32_t> found;
    for_tiles(b, [&](std::uint64_t key) {
        if (const auto tile = tiles_.find(key); tile != tiles_.end())
            found.insert(found.end(), tile->second.begin(), tile->second.end());
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    for (const std::uint32_t index : found)
        if (meet(b, bounds(all_[index].all)))
            visit(all_[index]);
}

bool Footprints::continues(std::size_t road, double from_s_m, double to_s_m, const RoadFootprint& other) const {
    if (other.road == road)
        return std::max(other.from_s_m - to_s_m, from_s_m - other.to_s_m) < continues_m;
    for (const Joint& joint : joints_[road]) {
        if (joint.other != other.road)
            continue;
        const double own = joint.at_start ? from_s_m : lengths_m_[road] - to_s_m;
        const double beyond = joint.other_at_start ? other.from_s_m : lengths_m_[other.road] - other.to_s_m;
        if (own + beyond < continues_m)
            return true;
    }
    return false;
}

} // namespace fernlicht
