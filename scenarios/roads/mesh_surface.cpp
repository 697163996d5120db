#include "scenarios/roads/mesh_surface.h"

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

Cut cut_at(const SurfacePlan& plan, const Stretch& stretch) {
    const SectionProfile& profile = plan.profile(stretch);
    return {profile.strips(stretch.layout_s_m(), stretch.from_s_m), profile.strips(stretch.layout_s_m(), stretch.to_s_m)};
}

} // namespace

std::vector<StretchRows> append_surface(Scene& scene, const RoadNetwork& network, const SurfacePlan& plan, const Repaint& repaint) {
    std::vector<StretchRows> rows;
    if (plan.stretches.empty())
        return rows;
    const Road& road = *plan.road;
    std::optional<MeshBuilder> builder;
    Cut before, here = cut_at(plan, plan.stretches.front());
    for (std::size_t i = 0; i < plan.stretches.size(); ++i) {
        const Stretch& stretch = plan.stretches[i];
        const Cut after = i + 1 < plan.stretches.size() ? cut_at(plan, plan.stretches[i + 1]) : Cut{};
        StretchRows both{&stretch, {}, {}};
        both.from = make_row(network, road, stretch.from_s_m, here.from, common_borders(before.to, here.from, plan.crown));
        both.to = make_row(network, road, stretch.to_s_m, here.to, common_borders(here.to, after.from, plan.crown));
        if (!builder || stretch.chunk != plan.stretches[i - 1].chunk) {
            if (builder)
                std::move(*builder).add_to(scene);
            builder.emplace(chunk_name("road", plan, i), surface_pose(network, road, stretch.from_s_m, 0.0).position_m);
        }
        for (std::size_t k = 0; k < here.from.size(); ++k) {
            const RoadMaterial material = repaint ? repaint(here.from[k], both.from, both.to, k) : here.from[k].material;
            append_strip(*builder, index_of(material), here.from[k], both.from, here.to[k], both.to, k);
        }
        if (!rows.empty())
            append_risers(*builder, rows.back().to, both.from);
        rows.push_back(std::move(both));
        before = std::move(here);
        here = after;
    }
    std::move(*builder).add_to(scene);
    return rows;
}

} // namespace fernlicht
