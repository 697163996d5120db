#include "scenarios/roads/mesh/mesh_solids.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

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

} // namespace

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

void append_tree(MeshBuilder& builder, const Pose& foot, double height_m, double crown_radius_m, bool bush) {
    constexpr int sides = 8;
    const double free = bush ? 0.0 : 0.25 * height_m;
    const double widest = free + 0.3 * (height_m - free);
    if (!bush)
        append_band(builder, RoadMaterial::trunk, foot, 6, 0.0, 0.025 * height_m, free + 0.1 * height_m, 0.02 * height_m);
    append_band(builder, RoadMaterial::leaves, foot, sides, free, 0.0, widest, crown_radius_m);
    append_band(builder, RoadMaterial::leaves, foot, sides, widest, crown_radius_m, height_m, 0.0);
}

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

} // namespace fernlicht
