#include "scenarios/roads/mesh/mesh_surface.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

namespace fernlicht {

namespace {

constexpr double shortest_stretch_m = 0.02;
constexpr double same_station_m = 0.005; ///< nearer ones (two records of one place, differently rounded) are one
/// Long straight stretches are cut as well: terrain is fitted to its neighbours stretch by stretch.
constexpr double longest_stretch_m = 15.0;
/// Bounds for roads of absurd length: what is built does not grow with a number in a file.
constexpr double max_chunks = 20'000.0;
constexpr double max_even_stretches = 100'000.0;
constexpr double kerb_ramp_m = 0.5;
constexpr double longest_in_junction_m = 2.5;

double distance_to_chord(const glm::dvec3& point, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 chord = b - a;
    const double length2 = glm::dot(chord, chord);
    const double f = length2 > 0.0 ? std::clamp(glm::dot(point - a, chord) / length2, 0.0, 1.0) : 0.0;
    return glm::length(point - (a + f * chord));
}

/// The greatest distance between a stretch's surface and flat strips over it.
struct ChordError {
    const RoadNetwork& network;
    const Road& road;
    const SectionProfile& profile;
    const std::vector<double>& crown;

    struct Line {
        glm::dvec3 point;
        glm::dvec3 up;
    };

    /// Along each border between strips and each crown line, and along both diagonals of each strip: which of them the triangles take
    /// is decided later, and on a twisted surface one lies above and the other below.
    double of(double from_s, double to_s) const {
        const double layout = 0.5 * (from_s + to_s);
        const std::vector<Line> lines_from = lines(layout, from_s);
        const std::vector<Line> lines_to = lines(layout, to_s);
        double worst = 0.0;
        for (const double f : {0.25, 0.5, 0.75}) {
            const std::vector<Line> between = lines(layout, from_s + f * (to_s - from_s));
            for (std::size_t i = 0; i < between.size(); ++i)
                worst = std::max(worst, distance_to_chord(between[i].point, lines_from[i].point, lines_to[i].point));
            worst = std::max(worst, twist(lines_from, between, lines_to, f));
        }
        return worst;
    }

    std::vector<Line> lines(double layout_s, double s) const {
        std::vector<Line> out;
        const auto add = [&](double t) {
            const Pose pose = surface_pose(network, road, s, t);
            out.push_back({pose.position_m, pose.up()});
        };
        double last_t = 0.0;
        for (const Strip& strip : profile.strips(layout_s, s)) {
            if (out.empty())
                add(strip.right_t_m);
            if (!strip.kerb_face)
                add(strip.left_t_m);
            last_t = strip.left_t_m;
        }
        if (out.empty())
            return out;
        const double first_t = profile.rightmost_t(s);
        for (const double t : crown) // clamped, so that there are as many at each s
            add(std::clamp(t, std::min(first_t, last_t), std::max(first_t, last_t)));
        return out;
    }

    /// Distance of both diagonals of each strip from the surface, where they pass the part `f` of the stretch.
    static double twist(const std::vector<Line>& from, const std::vector<Line>& between, const std::vector<Line>& to, double f) {
        double worst = 0.0;
        const auto part = [f](const glm::dvec3& a, const glm::dvec3& b) { return a + f * (b - a); };
        for (std::size_t i = 0; i + 1 < between.size(); ++i)
            for (const auto& [a, b] : {std::pair(i, i + 1), std::pair(i + 1, i)}) {
                const glm::dvec3 off = part(from[a].point, to[b].point) - part(between[a].point, between[b].point);
                worst = std::max({worst, std::abs(glm::dot(off, between[a].up)), std::abs(glm::dot(off, between[b].up))});
            }
        return worst;
    }
};

void append_knots(std::vector<double>& stations, const std::vector<Cubic>& cubics) {
    for (const Cubic& cubic : cubics)
        stations.push_back(cubic.s0);
}

/// Chunks of equal length, so that none is a sliver.
std::size_t chunk_count(const Road& road, const RoadMeshOptions& options) {
    const double length = std::clamp(options.chunk_length_m, 5.0, 200.0); // above 200 m positions would leave the lattice, mesh_builder.h
    return static_cast<std::size_t>(std::clamp(std::ceil(road.length_m / length - 0.05), 1.0, max_chunks));
}

std::vector<double> fixed_stations(const Road& road, const std::vector<SectionProfile>& profiles, std::size_t chunks) {
    std::vector<double> stations{0.0, road.length_m};
    for (const PlanElement& element : road.plan)
        stations.push_back(element.s_m);
    append_knots(stations, road.elevation);
    append_knots(stations, road.superelevation);
    append_knots(stations, road.lane_offset);
    for (const ShapeProfile& shape : road.shapes)
        stations.push_back(shape.s_m);
    for (const SectionProfile& profile : profiles)
        profile.append_stations(stations);
    for (std::size_t i = 0; i + 1 < profiles.size(); ++i) { // where a kerb of the next section rises
        const LaneSection& section = profiles[i].section();
        if ((profiles[i].has_heights() || profiles[i + 1].has_heights()) && section.end_m - section.s_m > 2.0 * kerb_ramp_m)
            stations.push_back(section.end_m - kerb_ramp_m);
    }
    for (std::size_t i = 1; i < chunks; ++i)
        stations.push_back(road.length_m * static_cast<double>(i) / static_cast<double>(chunks));
    std::erase_if(stations, [&](double s) { return !(s >= 0.0 && s <= road.length_m); });
    std::sort(stations.begin(), stations.end());
    stations.erase(std::unique(stations.begin(), stations.end(), [](double a, double b) { return b - a < same_station_m; }),
                   stations.end());
    return stations;
}

/// Where the surface itself jumps (a profile with a step), stretches are not cut below 2 cm: the step becomes a steep ramp.
/// Cuts from_s..to_s until each part keeps the error: parts of equal length first, for the error falls with the square of it.
void cut(const ChordError& error, double from_s, double to_s, double allowed, int depth, std::vector<double>& ends) {
    const double length = to_s - from_s;
    const double found = length > shortest_stretch_m && depth < 12 ? error.of(from_s, to_s) : 0.0;
    if (!(found > allowed)) {
        ends.push_back(to_s);
        return;
    }
    const double most = std::max(2.0, std::min(64.0, std::floor(length / shortest_stretch_m)));
    const double parts = std::clamp(std::ceil(std::sqrt(found / allowed)), 2.0, most);
    double a = from_s;
    for (int i = 1; i <= static_cast<int>(parts); ++i) {
        const double b = i == static_cast<int>(parts) ? to_s : from_s + length * i / parts;
        cut(error, a, b, allowed, depth + 1, ends);
        a = b;
    }
}

std::vector<double> crown_lines(const RoadNetwork& network, const Road& road, double chord_error_m) {
    std::vector<double> knots;
    for (const ShapeProfile& shape : road.shapes)
        append_knots(knots, shape.over_t);
    if (knots.empty())
        return knots;
    double right = 0.0, left = 0.0;
    for (const LaneSection& section : road.sections)
        for (const Lane& lane : section.lanes)
            for (const double s : {section.s_m, 0.5 * (section.s_m + section.end_m), section.end_m}) {
                const LaneEdges edges = lane.id == 0 ? LaneEdges{0.0, 0.0} : lane_edges(road, section, lane.id, s);
                right = std::min({right, edges.inner_t_m, edges.outer_t_m});
                left = std::max({left, edges.inner_t_m, edges.outer_t_m});
            }
    std::erase_if(knots, [&](double t) { return !(t > right && t < left); });
    std::sort(knots.begin(), knots.end());
    std::vector<double> lines{right};
    knots.push_back(left);
    // Halved across until every profile keeps the error between neighbouring lines.
    const auto halve = [&](auto&& self, double a, double b, int depth) -> void {
        double worst = 0.0;
        for (const ShapeProfile& shape : road.shapes)
            for (const double f : {0.25, 0.5, 0.75}) {
                const auto at = [&](double t) { return surface_pose(network, road, shape.s_m, t).position_m; };
                worst = std::max(worst, distance_to_chord(at(a + f * (b - a)), at(a), at(b)));
            }
        if (worst > chord_error_m && depth < 8 && b - a > 0.05) {
            self(self, a, 0.5 * (a + b), depth + 1);
            self(self, 0.5 * (a + b), b, depth + 1);
        } else {
            lines.push_back(b);
        }
    };
    double previous = right;
    for (const double knot : knots) {
        if (knot - previous < 1e-4)
            continue;
        halve(halve, previous, knot, 0);
        previous = knot;
    }
    return lines;
}

std::vector<RoadStretch> stretches_of(const RoadNetwork& network, const Road& road, const std::vector<SectionProfile>& profiles,
                                      const std::vector<double>& crown, const RoadMeshOptions& options) {
    std::vector<RoadStretch> out;
    if (profiles.empty())
        return out;
    const std::size_t chunks = chunk_count(road, options);
    const std::vector<double> stations = fixed_stations(road, profiles, chunks);
    const double longest = std::max(road.junction == "-1" ? longest_stretch_m : longest_in_junction_m, road.length_m / max_even_stretches);
    std::size_t profile = 0;
    std::vector<double> ends;
    for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
        const double middle = 0.5 * (stations[i] + stations[i + 1]);
        while (profile + 1 < profiles.size() && profiles[profile + 1].section().s_m <= middle)
            ++profile;
        const ChordError error{network, road, profiles[profile], crown};
        const double parts = std::max(1.0, std::ceil((stations[i + 1] - stations[i]) / longest));
        ends.clear();
        double from = stations[i];
        for (double part = 1.0; part <= parts; part += 1.0) {
            const double to = part == parts ? stations[i + 1] : stations[i] + (stations[i + 1] - stations[i]) * part / parts;
            cut(error, from, to, 0.9 * options.chord_error_m, 0, ends); // a tenth for what lies between the samples
            from = to;
        }
        const auto chunk = std::min(chunks - 1, static_cast<std::size_t>(middle / road.length_m * static_cast<double>(chunks)));
        from = stations[i];
        for (const double to : ends) {
            out.push_back({profile, from, to, chunk});
            from = to;
        }
    }
    return out;
}

} // namespace

SurfacePlan plan_surface(const RoadNetwork& network, const Road& road, const RoadMeshOptions& options) {
    SurfacePlan plan;
    plan.road = &road;
    for (const LaneSection& section : road.sections)
        plan.profiles.emplace_back(road, section, options.surface.wheel_tracks);
    plan.crown = crown_lines(network, road, options.chord_error_m);
    plan.stretches = stretches_of(network, road, plan.profiles, plan.crown, options);
    return plan;
}

std::string chunk_name(const char* what, const SurfacePlan& plan, std::size_t first_stretch) {
    const std::size_t chunk = plan.stretches[first_stretch].chunk;
    std::size_t last = first_stretch;
    while (last + 1 < plan.stretches.size() && plan.stretches[last + 1].chunk == chunk)
        ++last;
    return fmt::format("{} {} s {:.0f}-{:.0f}", what, plan.road->id, plan.stretches[first_stretch].from_s_m, plan.stretches[last].to_s_m);
}

SurfaceRows append_surface(Scene& scene, const RoadNetwork& network, const SurfacePlan& plan, const Repaint& repaint) {
    SurfaceRows surface;
    const Road& road = *plan.road;
    struct Cut {
        std::vector<Strip> from, to;
    };
    std::vector<Cut> cuts;
    for (const RoadStretch& stretch : plan.stretches)
        cuts.push_back({plan.profile(stretch).strips(stretch.layout_s_m(), stretch.from_s_m),
                        plan.profile(stretch).strips(stretch.layout_s_m(), stretch.to_s_m)});
    for (std::size_t i = 0; i <= cuts.size() && !cuts.empty(); ++i) {
        const double s = i < cuts.size() ? plan.stretches[i].from_s_m : plan.stretches.back().to_s_m;
        surface.rows.push_back(make_row(network, road, s, i > 0 ? cuts[i - 1].to : std::vector<Strip>{},
                                        i < cuts.size() ? cuts[i].from : std::vector<Strip>{}, plan.crown));
    }
    std::optional<MeshBuilder> builder;
    for (std::size_t i = 0; i < cuts.size(); ++i) {
        const Row &from = surface.rows[i], &to = surface.rows[i + 1];
        surface.ends.push_back({ranges_in(from, cuts[i].from), ranges_in(to, cuts[i].to)});
        if (!builder || plan.stretches[i].chunk != plan.stretches[i - 1].chunk) {
            if (builder)
                std::move(*builder).add_to(scene);
            builder.emplace(chunk_name("road", plan, i), surface_pose(network, road, from.s_m, 0.0).position_m);
        }
        for (std::size_t k = 0; k < cuts[i].from.size(); ++k) {
            const StripEnd start{cuts[i].from[k], from, surface.ends[i].from[k]}, end{cuts[i].to[k], to, surface.ends[i].to[k]};
            append_strip(*builder, index_of(repaint ? repaint(start, end) : start.strip.material), start, end);
        }
    }
    if (builder)
        std::move(*builder).add_to(scene);
    return surface;
}

} // namespace fernlicht
