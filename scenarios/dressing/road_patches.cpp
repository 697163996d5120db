#include "scenarios/dressing/dresser.h"
#include "scenarios/roads/mesh/mesh_builder.h"
#include "scenarios/roads/mesh/mesh_materials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

constexpr double film_m = 0.001; ///< above the asphalt: a pixel's depth tells it apart, and light on the road stays what it was to 0.2 %

using Polygon = std::vector<glm::dvec2>;

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// The part of a convex polygon within another, both counter-clockwise (Sutherland and Hodgman 1974).
Polygon clipped(Polygon polygon, const Polygon& by) {
    for (std::size_t i = 0; i < by.size() && !polygon.empty(); ++i) {
        const glm::dvec2 from = by[i], edge = by[(i + 1) % by.size()] - from;
        Polygon kept;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const glm::dvec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
            const double at_a = cross(edge, a - from), at_b = cross(edge, b - from);
            if (at_a >= 0.0)
                kept.push_back(a);
            if ((at_a > 0.0 && at_b < 0.0) || (at_a < 0.0 && at_b > 0.0))
                kept.push_back(a + (b - a) * (at_a / (at_a - at_b)));
        }
        polygon = std::move(kept);
    }
    return polygon;
}

/// Heading and place on a road, to put shapes into plan.
struct Flat {
    glm::dvec2 at_m, along, left;
    glm::dvec2 of(double x, double y) const { return at_m + x * along + y * left; }
    Polygon rectangle(double length_m, double width_m) const {
        const double x = 0.5 * length_m, y = 0.5 * width_m;
        return {of(-x, -y), of(x, -y), of(x, y), of(-x, y)};
    }
    /// Between two circles; `inner_m` 0: a disc.
    std::vector<Polygon> ring(double inner_m, double outer_m) const {
        constexpr int corners = 14;
        const auto on = [&](double radius_m, int k) {
            const double angle = 2.0 * pi * k / corners;
            return of(radius_m * std::cos(angle), radius_m * std::sin(angle));
        };
        std::vector<Polygon> parts;
        if (inner_m <= 0.0)
            parts.emplace_back();
        for (int k = 0; k < corners; ++k)
            if (inner_m <= 0.0)
                parts.front().push_back(on(outer_m, k));
            else
                parts.push_back({on(inner_m, k), on(outer_m, k), on(outer_m, k + 1), on(inner_m, k + 1)});
        return parts;
    }
};

Flat flat_at(const RoadNetwork& network, const Road& road, double s_m, double t_m, double turned_rad = 0.0) {
    const Pose pose = surface_pose(network, road, s_m, t_m);
    const double yaw = std::atan2(pose.forward().y, pose.forward().x) + turned_rad;
    return {glm::dvec2(pose.position_m), {std::cos(yaw), std::sin(yaw)}, {-std::sin(yaw), std::cos(yaw)}};
}

} // namespace

/// On the asphalt of this road alone: paint, kerbs and what other roads cover stay.
void Dresser::lay(const Road& road, const std::vector<glm::dvec2>& polygon_m, Stuff stuff, TriangleSoup& into) const {
    glm::dvec2 low = polygon_m.front(), high = low;
    for (const glm::dvec2& p : polygon_m)
        low = glm::min(low, p), high = glm::max(high, p);
    const std::string name = fmt::format("road {} s ", road.id);
    for (std::size_t m = 0; m < road_meshes_; ++m) {
        const Mesh& mesh = scene_.meshes[m];
        if (!mesh.name.starts_with(name))
            continue;
        for (const Batch& batch : mesh.batches) {
            if (batch.material != index_of(RoadMaterial::asphalt))
                continue;
            for (std::uint32_t i = batch.first; i + 2 < batch.first + batch.count; i += 3) {
                const std::array<const Vertex*, 3> v{&mesh.vertices[mesh.indices[i]], &mesh.vertices[mesh.indices[i + 1]],
                                                     &mesh.vertices[mesh.indices[i + 2]]};
                const auto at = [&](std::size_t k) { return mesh.origin_m + glm::dvec3(v[k]->position_m); };
                const glm::dvec3 a = at(0), b = at(1), c = at(2);
                if (std::max({a.x, b.x, c.x}) < low.x || std::min({a.x, b.x, c.x}) > high.x || std::max({a.y, b.y, c.y}) < low.y ||
                    std::min({a.y, b.y, c.y}) > high.y)
                    continue;
                const glm::dvec2 ab(b - a), ac(c - a);
                const double twice = cross(ab, ac);
                const Polygon part = twice > 1e-9 ? clipped({glm::dvec2(a), glm::dvec2(b), glm::dvec2(c)}, polygon_m) : Polygon{};
                if (part.size() < 3)
                    continue;
                const auto first = static_cast<std::uint32_t>(into.vertices.size());
                for (const glm::dvec2& p : part) {
                    const glm::dvec2 ap = p - glm::dvec2(a);
                    const double u = cross(ap, ac) / twice, w = cross(ab, ap) / twice;
                    const auto mix = [&](const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z) {
                        return x + u * (y - x) + w * (z - x);
                    };
                    const Vertex shape{{}, glm::vec3(0, 0, 1)};
                    const glm::dvec3 place = mix(a, b, c) + glm::dvec3(0.0, 0.0, film_m);
                    into.vertices.push_back(
                        {place, glm::normalize(mix(v[0]->normal, v[1]->normal, v[2]->normal)), texture_position(place, shape)});
                }
                for (std::uint32_t k = 1; k + 1 < part.size(); ++k)
                    into.triangles.push_back({{first, first + k, first + k + 1}, index_of(stuff)});
            }
        }
    }
}

/// Repairs, seams and, in streets, manholes and gullies; zebra crossings where the road's file has crosswalks.
void Dresser::add_patches(const Road& road) {
    if (road_meshes_ == 0)
        return;
    std::map<long, TriangleSoup> soups;
    const auto put = [&](double s_m, const Polygon& polygon, Stuff stuff) {
        lay(road, polygon, stuff, soups[static_cast<long>(std::floor(s_m / stretch_m))]);
    };
    for (const RoadObject& object : road.objects) {
        if (object.type != "crosswalk")
            continue;
        // Across the road lies its longer side; stripes of 0.5 m run along the road (VzKat 293).
        double length = object.length_m, width = object.width_m;
        if (object.outline_m.size() > 2) {
            glm::dvec3 low = object.outline_m.front(), high = low;
            for (const glm::dvec3& p : object.outline_m)
                low = glm::min(low, p), high = glm::max(high, p);
            length = high.x - low.x, width = high.y - low.y;
        }
        const Flat flat = flat_at(network_, road, object.s_m, object.t_m, object.heading_rad);
        const bool across_x = std::abs(std::sin(object.heading_rad)) > 0.7;
        const double across = std::min(across_x ? length : width, 60.0), along = across_x ? width : length;
        for (double from = -0.5 * across; from + 0.25 < 0.5 * across; from += 1.0) {
            const double middle = from + 0.25, x = across_x ? middle : 0.0, y = across_x ? 0.0 : middle;
            const Flat stripe{flat.of(x, y), flat.along, flat.left};
            put(object.s_m, across_x ? stripe.rectangle(0.5, along) : stripe.rectangle(along, 0.5), Stuff::crossing);
        }
    }
    constexpr double end_m = 6.0; // roads meet there
    if (road.junction == "-1" && road.length_m > 2.0 * end_m) {
        Dice drawn(settings_.seed, fmt::format("patches, road {}", road.id));
        const auto lanes_at = [&](double s) {
            std::vector<LaneEdges> all;
            for (const Lane& lane : section_at(road, s).lanes)
                if (lane.id != 0 && lane.type == "driving")
                    all.push_back(lane_edges(road, section_at(road, s), lane.id, s));
            return all;
        };
        const bool street =
            is_walked(outer_lane(road, 0.5 * road.length_m, true)) || is_walked(outer_lane(road, 0.5 * road.length_m, false));
        for (double s = end_m + drawn.between(0.0, 30.0); s < road.length_m - end_m; s += drawn.between(18.0, street ? 45.0 : 110.0)) {
            Dice here = drawn.fork();
            const std::vector<LaneEdges> lanes = lanes_at(s);
            if (lanes.empty() || route_.nearest_m(surface_pose(network_, road, s, 0.0).position_m) > far_from_route_m)
                continue;
            const LaneEdges lane = lanes[here.of(lanes.size())];
            const double wide = std::abs(lane.outer_t_m - lane.inner_t_m), side = lane.outer_t_m > lane.inner_t_m ? 1.0 : -1.0;
            const double kind = here.share();
            if (street && kind < 0.5) {
                const double t = lane.inner_t_m + side * wide * here.between(0.35, 0.65);
                const Flat flat = flat_at(network_, road, s, t);
                for (const auto& [inner, outer, stuff] :
                     {std::tuple(0.0, 0.26, Stuff::lid), std::tuple(0.26, 0.31, Stuff::iron), std::tuple(0.31, 0.37, Stuff::seam)})
                    for (const Polygon& part : flat.ring(inner, outer))
                        put(s, part, stuff);
            } else if (street && kind < 0.7) { // a gully at the kerb
                const double t = lanes.front().outer_t_m - 0.26 * (lanes.front().outer_t_m > 0.0 ? 1.0 : -1.0);
                const Flat flat = flat_at(network_, road, s, t);
                put(s, flat.rectangle(0.52, 0.42), Stuff::lid);
                for (int bar = 0; bar < 5; ++bar)
                    put(s, Flat{flat.of(0.09 * (bar - 2), 0.0), flat.along, flat.left}.rectangle(0.045, 0.32), Stuff::iron);
            } else {
                const double width = std::min(here.between(0.5, 1.8), 0.8 * wide), length = here.between(0.8, 7.0);
                const double t = lane.inner_t_m + side * (0.5 * width + (wide - width) * here.share());
                const Flat flat = flat_at(network_, road, s, t, radians(here.between(-1.5, 1.5)));
                put(s, flat.rectangle(length, width), here.share() < 0.6 ? Stuff::patch : Stuff::old_patch);
                for (const double edge : {-1.0, 1.0}) {
                    put(s, Flat{flat.of(edge * 0.5 * length, 0.0), flat.along, flat.left}.rectangle(0.05, width), Stuff::seam);
                    put(s, Flat{flat.of(0.0, edge * 0.5 * width), flat.along, flat.left}.rectangle(length, 0.05), Stuff::seam);
                }
            }
        }
    }
    for (auto& [stretch, soup] : soups)
        add_mesh(soup, {}, fmt::format("patches, road {} s {}-{}", road.id, stretch * stretch_m, (stretch + 1) * stretch_m), true, false,
                 false);
}

} // namespace fernlicht
