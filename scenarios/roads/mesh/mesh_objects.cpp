#include "scenarios/roads/mesh/mesh_objects.h"

#include "scenarios/roads/mesh/mesh_solids.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>

namespace fernlicht {

namespace {

enum class Solid { nothing, tree, bush, post, delineator, outline, box };

constexpr double lowest_m = 0.02;

std::string lower_case(std::string text) {
    for (char& c : text)
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
}

template <std::size_t N> bool one_of(const std::string& word, const std::array<std::string_view, N>& words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

Solid solid_of(const RoadObject& object) {
    static constexpr std::array<std::string_view, 7> flat{"crosswalk", "parkingspace", "roadmark", "roadsurface",
                                                          "patch",     "bridge",       "tunnel"};
    static constexpr std::array<std::string_view, 4> posts{"pole", "streetlamp", "rail-pole", "guide-post"};
    const std::string type = lower_case(object.type), name = lower_case(object.name);
    if (one_of(type, flat))
        return Solid::nothing;
    if (type == "tree")
        return Solid::tree;
    if (type == "vegetation" || type == "bush")
        return object.height_m > 3.0 ? Solid::tree : Solid::bush;
    if (name.find("delineator") != std::string::npos || type == "guide-post")
        return Solid::delineator;
    if (object.outline_m.size() > 1)
        return Solid::outline;
    if (one_of(type, posts))
        return Solid::post;
    if (object.height_m < lowest_m || (object.radius_m <= 0.0 && object.length_m <= 0.0 && object.width_m <= 0.0))
        return Solid::nothing;
    return object.radius_m > 0.0 ? Solid::post : Solid::box;
}

/// Upright at (s, t), heading counted from the road's.
Pose standing(const RoadNetwork& network, const Road& road, double s_m, double t_m, double z_m, double heading, double pitch, double roll) {
    const Pose ground = surface_pose(network, road, s_m, t_m);
    const double yaw = std::atan2(ground.forward().y, ground.forward().x) + heading;
    // OpenDRIVE's pitch turns the nose down, ours up.
    return {ground.position_m + glm::dvec3(0.0, 0.0, z_m), axes_from_angles(yaw, -pitch, roll)};
}

double or_default(double value, double otherwise) { return value > 0.0 ? value : otherwise; }

std::vector<Corner> corners(const RoadObject& object) {
    std::vector<Corner> out;
    for (std::size_t i = 0; i < object.outline_m.size(); ++i) {
        const glm::dvec3& corner = object.outline_m[i];
        out.push_back({{corner.x, corner.y, i < object.outline_base_m.size() ? object.outline_base_m[i] : 0.0}, corner.z});
    }
    return out;
}

/// Outlines are given in a frame that lies in the road's surface, all else stands upright.
Pose frame_of(const RoadNetwork& network, const Road& road, const RoadObject& object, Solid solid) {
    if (solid != Solid::outline)
        return standing(network, road, object.s_m, object.t_m, object.z_offset_m, object.heading_rad, object.pitch_rad, object.roll_rad);
    const Pose stand{{0.0, 0.0, object.z_offset_m}, axes_from_angles(object.heading_rad, object.pitch_rad, object.roll_rad)};
    return compose(surface_pose(network, road, object.s_m, object.t_m), stand);
}

void append_object(MeshBuilder& builder, Solid solid, const RoadObject& object, const Pose& foot) {
    const double across = std::max(object.length_m, object.width_m);
    switch (solid) {
    case Solid::nothing:
        return;
    case Solid::tree:
    case Solid::bush: {
        const double height = or_default(object.height_m, solid == Solid::tree ? 8.0 : 1.5);
        const double radius = or_default(object.radius_m, or_default(0.5 * across, (solid == Solid::tree ? 0.22 : 0.5) * height));
        return append_tree(builder, foot, height, radius, solid == Solid::bush);
    }
    case Solid::post:
        return append_post(builder, RoadMaterial::post, foot, or_default(object.radius_m, std::clamp(0.5 * across, 0.04, 0.5)),
                           or_default(object.height_m, 4.0));
    case Solid::delineator:
        return append_delineator(builder, foot, or_default(object.height_m, 1.0));
    case Solid::outline:
        return append_extrusion(builder, RoadMaterial::object, foot, corners(object), object.closed_outline);
    case Solid::box:
        return append_box(builder, foot, {or_default(object.length_m, 0.1), or_default(object.width_m, 0.1), object.height_m},
                          RoadMaterial::object, RoadMaterial::object);
    }
}

/// Kind and name of an object as its mesh is called.
std::string called(const RoadObject& object, Solid solid) {
    if (solid == Solid::tree || solid == Solid::bush)
        return "trees";
    return !object.name.empty() ? object.name : !object.type.empty() ? object.type : "object";
}

bool over_paved(const SurfacePlan& plan, double s_m, double t_m) {
    for (const SectionProfile& profile : plan.profiles) {
        if (s_m < profile.section().s_m || s_m > profile.section().end_m)
            continue;
        for (const Strip& strip : profile.strips(s_m, s_m))
            if (strip.paved && t_m > strip.right_t_m && t_m < strip.left_t_m)
                return true;
    }
    return false;
}

void append_board(MeshBuilder& builder, const RoadSignal& signal, const Pose& ground, bool with_post) {
    constexpr double thick_m = 0.03, post_radius_m = 0.038;
    const double width = or_default(signal.width_m, signal.dynamic ? 0.3 : 0.6);
    const double height = or_default(signal.height_m, signal.dynamic ? 0.9 : 0.6);
    const double depth = signal.dynamic ? 0.2 : thick_m;
    const double bottom = signal.z_offset_m > 0.0 ? signal.z_offset_m : 2.0;
    const Pose board{to_parent(ground, {0.5 * depth + post_radius_m, 0.0, bottom}), ground.axes};
    const RoadMaterial front = signal.dynamic ? RoadMaterial::board_back : RoadMaterial::board;
    append_box(builder, board, {depth, width, height}, RoadMaterial::board_back, front);
    if (with_post)
        append_post(builder, RoadMaterial::post, ground, post_radius_m, bottom + height);
}

} // namespace

void append_objects(Scene& scene, const RoadNetwork& network, const SurfacePlan& plan, const RoadMeshOptions& options) {
    const Road& road = *plan.road;
    const double chunk = std::clamp(options.chunk_length_m, 5.0, 200.0);
    std::map<std::pair<std::string, double>, MeshBuilder> meshes;
    for (const RoadObject& object : road.objects) {
        const Solid solid = solid_of(object);
        if (solid == Solid::nothing)
            continue;
        const Pose foot = frame_of(network, road, object, solid);
        const std::string name = called(object, solid);
        const double at = chunk * std::floor(object.s_m / chunk);
        auto mesh = meshes.find({name, at});
        if (mesh == meshes.end()) {
            const std::string title = fmt::format("{}, road {} s {:.0f}-{:.0f}", name, road.id, at, at + chunk);
            mesh = meshes.emplace(std::pair(name, at), MeshBuilder(title, foot.position_m)).first;
        }
        append_object(mesh->second, solid, object, foot);
    }
    for (auto& [key, builder] : meshes)
        std::move(builder).add_to(scene);
}

void append_signals(Scene& scene, const RoadNetwork& network, const SurfacePlan& plan) {
    const Road& road = *plan.road;
    for (const RoadSignal& signal : road.signals) {
        const double towards = signal.facing_forward ? pi : 0.0;
        const Pose ground = standing(network, road, signal.s_m, signal.t_m, 0.0, towards + signal.heading_offset_rad, 0.0, 0.0);
        MeshBuilder builder(fmt::format("signal {}", signal.id), ground.position_m);
        append_board(builder, signal, ground, !over_paved(plan, signal.s_m, signal.t_m));
        std::move(builder).add_to(scene);
    }
}

} // namespace fernlicht
