#include "scenarios/roads/mesh/mesh_terrain.h"
#include "scenarios/roads/mesh/road_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <map>
#include <string_view>

namespace fernlicht {
namespace {

glm::dvec3 at(const Pose& foot, double x, double y, double z) { return to_parent(foot, {x, y, z}); }

/// A band of a cone or cylinder between two heights, smooth round the axis.
void append_band(MeshBuilder& builder, RoadMaterial material, const Pose& foot, int sides, double low, double low_radius, double high,
                 double high_radius) {
    const double slope = (low_radius - high_radius) / (high - low);
    struct Spoke {
        glm::dvec3 low, high, normal;
    };
    const auto spoke = [&](int i) {
        const double angle = 2.0 * pi * (i % sides) / sides;
        const double c = std::cos(angle), s = std::sin(angle);
        return Spoke{at(foot, low_radius * c, low_radius * s, low), at(foot, high_radius * c, high_radius * s, high),
                     foot.axes * glm::normalize(glm::dvec3(c, s, slope))};
    };
    for (int i = 0; i < sides; ++i) {
        const Spoke a = spoke(i), b = spoke(i + 1);
        const std::uint32_t a_low = builder.vertex(a.low, a.normal), b_low = builder.vertex(b.low, b.normal);
        const std::uint32_t a_high = builder.vertex(a.high, a.normal), b_high = builder.vertex(b.high, b.normal);
        if (low_radius > 0.0)
            builder.triangle(index_of(material), a_low, b_low, b_high);
        if (high_radius > 0.0)
            builder.triangle(index_of(material), a_low, b_high, a_high);
        else
            builder.triangle(index_of(material), a_low, b_low, a_high);
    }
}

/// A corner of an outline in the pose's frame: where its wall stands, and how high it is.
struct Corner {
    glm::dvec3 base_m{0.0};
    double height_m = 0.0;
};

double cross(const glm::dvec3& o, const glm::dvec3& a, const glm::dvec3& b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

double signed_area(const std::vector<Corner>& outline) {
    double twice = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec3& a = outline[i].base_m;
        const glm::dvec3& b = outline[(i + 1) % outline.size()].base_m;
        twice += a.x * b.y - b.x * a.y;
    }
    return 0.5 * twice;
}

bool same_place(const Corner& a, const Corner& b) { return glm::length(a.base_m - b.base_m) <= 1e-3; }

/// Without corners that repeat their predecessor (a closing corner that repeats the first), counter-clockwise.
std::vector<Corner> tidy(const std::vector<Corner>& outline, bool closed) {
    std::vector<Corner> out;
    for (const Corner& corner : outline)
        if (out.empty() || !same_place(corner, out.back()))
            out.push_back(corner);
    if (closed && out.size() > 1 && same_place(out.front(), out.back()))
        out.pop_back();
    if (closed && signed_area(out) < 0.0)
        std::reverse(out.begin(), out.end());
    return out;
}

/// A cylinder of 12 sides about the pose's up axis from its position upwards, with a lid.
void append_post(MeshBuilder& builder, RoadMaterial material, const Pose& foot, double radius_m, double height_m) {
    constexpr int sides = 12;
    append_band(builder, material, foot, sides, 0.0, radius_m, height_m, radius_m);
    std::vector<std::uint32_t> rim;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2.0 * pi * i / sides;
        rim.push_back(builder.vertex(at(foot, radius_m * std::cos(angle), radius_m * std::sin(angle), height_m), foot.up()));
    }
    for (std::size_t i = 1; i + 1 < rim.size(); ++i)
        builder.triangle(index_of(material), rim[0], rim[i], rim[i + 1]);
}

/// Length along the pose's x, width along y, the pose in the middle of the bottom face. Materials may differ on the face towards +x.
void append_box(MeshBuilder& builder, const Pose& foot, const glm::dvec3& size_m, RoadMaterial material, RoadMaterial front) {
    const double x = 0.5 * size_m.x, y = 0.5 * size_m.y, z = size_m.z;
    const auto p = [&](double fx, double fy, double height) { return at(foot, fx * x, fy * y, height); };
    const std::uint32_t m = index_of(material);
    builder.quad(index_of(front), {p(1, -1, 0), p(1, 1, 0), p(1, 1, z), p(1, -1, z)});
    builder.quad(m, {p(-1, 1, 0), p(-1, -1, 0), p(-1, -1, z), p(-1, 1, z)});
    builder.quad(m, {p(1, 1, 0), p(-1, 1, 0), p(-1, 1, z), p(1, 1, z)});
    builder.quad(m, {p(-1, -1, 0), p(1, -1, 0), p(1, -1, z), p(-1, -1, z)});
    builder.quad(m, {p(-1, -1, z), p(1, -1, z), p(1, 1, z), p(-1, 1, z)});
    builder.quad(m, {p(-1, 1, 0), p(1, 1, 0), p(1, -1, 0), p(-1, -1, 0)});
}

/// Walls between the corners, and a roof over them if the outline is closed. Open outlines are walls seen from both sides. Outlines
/// that cross themselves or have more than 2000 corners get no roof.
void append_extrusion(MeshBuilder& builder, RoadMaterial material, const Pose& foot, const std::vector<Corner>& outline, bool closed) {
    const std::vector<Corner> corners = tidy(outline, closed);
    if (corners.size() < 2)
        return;
    std::vector<glm::dvec3> roof;
    for (const Corner& corner : corners)
        roof.push_back(corner.base_m + glm::dvec3(0.0, 0.0, corner.height_m));
    const std::size_t walls = closed ? corners.size() : corners.size() - 1;
    for (std::size_t i = 0; i < walls; ++i) {
        const std::size_t k = (i + 1) % corners.size();
        const std::array<glm::dvec3, 4> wall{to_parent(foot, corners[i].base_m), to_parent(foot, corners[k].base_m),
                                             to_parent(foot, roof[k]), to_parent(foot, roof[i])};
        builder.quad(index_of(material), wall);
        if (!closed)
            builder.quad(index_of(material), {wall[1], wall[0], wall[3], wall[2]});
    }
    if (!closed || corners.size() > 2000) // ears cost the square of the corners and more
        return;
    for (const auto& ear : triangulated(roof)) {
        const glm::dvec3 a = to_parent(foot, roof[ear[0]]), b = to_parent(foot, roof[ear[1]]), c = to_parent(foot, roof[ear[2]]);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        builder.triangle(index_of(material), builder.vertex(a, normal), builder.vertex(b, normal), builder.vertex(c, normal));
    }
}

/// A trunk and a crown of two eight-sided cones, base to base: 0.25 of the height free below the crown (a bush: none).
void append_tree(MeshBuilder& builder, const Pose& foot, double height_m, double crown_radius_m, bool bush) {
    constexpr int sides = 8;
    const double free = bush ? 0.0 : 0.25 * height_m;
    const double widest = free + 0.3 * (height_m - free);
    if (!bush)
        append_band(builder, RoadMaterial::trunk, foot, 6, 0.0, 0.025 * height_m, free + 0.1 * height_m, 0.02 * height_m);
    append_band(builder, RoadMaterial::leaves, foot, sides, free, 0.0, widest, crown_radius_m);
    append_band(builder, RoadMaterial::leaves, foot, sides, widest, crown_radius_m, height_m, 0.0);
}

/// A delineator post as beside German roads: 0.12 m wide, 1 m high, reflecting bands from 0.68 to 0.86 m on both faces along x.
void append_delineator(MeshBuilder& builder, const Pose& foot, double height_m) {
    constexpr double half_x = 0.05, half_y = 0.06;
    const double band_low = 0.68 * height_m, band_high = 0.86 * height_m;
    const auto faces = [&](double low, double high, RoadMaterial face) {
        const auto p = [&](double fx, double fy, double z) { return at(foot, fx * half_x, fy * half_y, z); };
        builder.quad(index_of(face), {p(1, -1, low), p(1, 1, low), p(1, 1, high), p(1, -1, high)});
        builder.quad(index_of(face), {p(-1, 1, low), p(-1, -1, low), p(-1, -1, high), p(-1, 1, high)});
        builder.quad(index_of(RoadMaterial::delineator), {p(1, 1, low), p(-1, 1, low), p(-1, 1, high), p(1, 1, high)});
        builder.quad(index_of(RoadMaterial::delineator), {p(-1, -1, low), p(1, -1, low), p(1, -1, high), p(-1, -1, high)});
        if (high == height_m)
            builder.quad(index_of(RoadMaterial::delineator), {p(-1, -1, high), p(1, -1, high), p(1, 1, high), p(-1, 1, high)});
    };
    faces(0.0, band_low, RoadMaterial::delineator);
    faces(band_low, band_high, RoadMaterial::board);
    faces(band_high, height_m, RoadMaterial::delineator);
}

enum class Solid { nothing, tree, bush, post, delineator, outline, box };

constexpr double lowest_m = 0.02;

std::string lower_case(std::string text) {
    for (char& c : text)
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
}

bool one_of(const std::string& word, std::initializer_list<std::string_view> words) {
    return std::ranges::find(words, word) != words.end();
}

Solid solid_of(const RoadObject& object) {
    const std::string type = lower_case(object.type), name = lower_case(object.name);
    if (one_of(type, {"crosswalk", "parkingspace", "roadmark", "roadsurface", "patch", "bridge", "tunnel"}))
        return Solid::nothing;
    if (type == "tree")
        return Solid::tree;
    if (type == "vegetation" || type == "bush")
        return object.height_m > 3.0 ? Solid::tree : Solid::bush;
    if (name.find("delineator") != std::string::npos || type == "guide-post")
        return Solid::delineator;
    if (object.outline_m.size() > 1)
        return Solid::outline;
    if (one_of(type, {"pole", "streetlamp", "rail-pole", "guide-post"}))
        return Solid::post;
    if (object.height_m < lowest_m || (object.radius_m <= 0.0 && object.length_m <= 0.0 && object.width_m <= 0.0))
        return Solid::nothing;
    return object.radius_m > 0.0 ? Solid::post : Solid::box;
}

/// Upright at (s, t), heading counted from the road's.
Pose stand_at(const RoadNetwork& network, const Road& road, double s_m, double t_m, double z_m, double heading, double pitch, double roll) {
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
        return standing(network, road, object);
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

std::vector<std::array<std::size_t, 3>> triangulated(const std::vector<glm::dvec3>& polygon) {
    std::vector<std::array<std::size_t, 3>> out;
    std::vector<std::size_t> left(polygon.size());
    for (std::size_t i = 0; i < left.size(); ++i)
        left[i] = i;
    const auto is_ear = [&](std::size_t i) {
        const std::size_t n = left.size();
        const std::size_t a = left[(i + n - 1) % n], b = left[i], c = left[(i + 1) % n];
        if (cross(polygon[a], polygon[b], polygon[c]) <= 0.0)
            return false;
        return std::none_of(left.begin(), left.end(), [&](std::size_t k) {
            if (k == a || k == b || k == c)
                return false;
            const glm::dvec3& q = polygon[k];
            return cross(polygon[a], polygon[b], q) >= 0.0 && cross(polygon[b], polygon[c], q) >= 0.0 &&
                   cross(polygon[c], polygon[a], q) >= 0.0;
        });
    };
    while (left.size() > 3) {
        std::size_t ear = 0;
        while (ear < left.size() && !is_ear(ear))
            ++ear;
        if (ear == left.size())
            return {};
        const std::size_t n = left.size();
        out.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    if (left.size() == 3)
        out.push_back({left[0], left[1], left[2]});
    return out;
}

Pose standing(const RoadNetwork& network, const Road& road, const RoadObject& object) {
    return stand_at(network, road, object.s_m, object.t_m, object.z_offset_m, object.heading_rad, object.pitch_rad, object.roll_rad);
}

void append_objects(Scene& scene, const RoadNetwork& network, const SurfacePlan& plan, const RoadMeshOptions& options) {
    const Road& road = *plan.road;
    const double chunk = std::clamp(options.chunk_length_m, 5.0, 200.0);
    std::map<std::pair<std::string, double>, MeshBuilder> meshes;
    for (const RoadObject& object : road.objects) {
        const Solid solid = solid_of(object);
        if (solid == Solid::nothing || (options.leave_out && options.leave_out(object)))
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
        const Pose ground = stand_at(network, road, signal.s_m, signal.t_m, 0.0, towards + signal.heading_offset_rad, 0.0, 0.0);
        MeshBuilder builder(fmt::format("signal {}", signal.id), ground.position_m);
        append_board(builder, signal, ground, !over_paved(plan, signal.s_m, signal.t_m));
        std::move(builder).add_to(scene);
    }
}

} // namespace fernlicht
