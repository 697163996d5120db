#include "scenarios/roads/mesh/mesh_surface.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace fernlicht {

SurfacePlan plan_surface(const RoadNetwork& network, const Road& road, const RoadMeshOptions& options) {
    SurfacePlan plan;
    plan.road = &road;
    for (const LaneSection& section : road.sections)
        plan.profiles.emplace_back(road, section);
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

namespace {

struct Cut {
    std::vector<Strip> from, to;
};

Cut cut_at(const SurfacePlan& plan, const RoadStretch& stretch) {
    const SectionProfile& profile = plan.profile(stretch);
    return {profile.strips(stretch.layout_s_m(), stretch.from_s_m), profile.strips(stretch.layout_s_m(), stretch.to_s_m)};
}

} // namespace

SurfaceRows append_surface(Scene& scene, const RoadNetwork& network, const SurfacePlan& plan, const Repaint& repaint) {
    SurfaceRows surface;
    const Road& road = *plan.road;
    std::vector<Cut> cuts;
    for (const RoadStretch& stretch : plan.stretches)
        cuts.push_back(cut_at(plan, stretch));
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
