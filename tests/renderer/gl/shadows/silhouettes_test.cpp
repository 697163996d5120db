// Hulls behind bodies: closed whatever the mesh, with as many walls as its outline has edges.
#include "renderer/gl/shadows/silhouettes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <tuple>

namespace fernlicht::gl {
namespace {

using Corners = std::vector<glm::vec3>;

void add(Corners& corners, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) { corners.insert(corners.end(), {a, b, c}); }
void add(Corners& corners, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
    add(corners, a, b, c);
    add(corners, a, c, d);
}

/// From 0 to 1 in x, y, z; normals outwards.
Corners cube() {
    Corners c;
    add(c, {0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0});
    add(c, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1});
    add(c, {0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1});
    add(c, {0, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 1, 0});
    add(c, {0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0});
    add(c, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1});
    return c;
}

std::vector<glm::vec4> hulls(const Silhouettes& s, const glm::dvec3& lamp, Casting casting = Casting::fewest) {
    std::vector<glm::vec4> corners;
    s.add_hulls(lamp, casting, std::vector<bool>(s.bodies().size(), true), corners);
    return corners;
}

/// Each directed edge of the hulls' triangles comes as often as its reverse.
bool is_closed(const std::vector<glm::vec4>& corners) {
    using Place = std::tuple<float, float, float, float>;
    std::map<std::pair<Place, Place>, int> uneven;
    const auto place = [](const glm::vec4& p) { return Place(p.x, p.y, p.z, p.w); };
    for (std::size_t i = 0; i < corners.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const Place a = place(corners[i + k]), b = place(corners[i + (k + 1) % 3]);
            a < b ? ++uneven[{a, b}] : --uneven[{b, a}];
        }
    return std::ranges::all_of(uneven, [](const auto& one) { return one.second == 0; });
}

/// How often the hulls turn round a point: by the solid angles of their triangles (A. van Oosterom, J. Strackee 1983), far corners at 1e4
/// times the distance from the lamp.
double winding(const std::vector<glm::vec4>& corners, const glm::dvec3& lamp, const glm::dvec3& point) {
    double sum = 0.0;
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        glm::dvec3 r[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 p(corners[i + k]);
            r[k] = (corners[i + k].w > 0.0F ? p : p + 1e4 * (p - lamp)) - point;
        }
        const double a = glm::length(r[0]), b = glm::length(r[1]), c = glm::length(r[2]);
        sum += 2.0 * std::atan2(glm::dot(r[0], glm::cross(r[1], r[2])),
                                a * b * c + glm::dot(r[0], r[1]) * c + glm::dot(r[1], r[2]) * a + glm::dot(r[2], r[0]) * b);
    }
    return sum / (4.0 * 3.14159265358979323846);
}

/// Triangles that the way from the lamp to a point passes through.
int crossed(const Corners& c, const glm::dvec3& lamp, const glm::dvec3& point) {
    int n = 0;
    for (std::size_t i = 0; i < c.size(); i += 3) {
        const glm::dvec3 a(c[i]), ab = glm::dvec3(c[i + 1]) - a, ac = glm::dvec3(c[i + 2]) - a, d = point - lamp, p = glm::cross(d, ac);
        const double det = glm::dot(ab, p);
        if (det == 0.0)
            continue;
        const glm::dvec3 s = lamp - a, q = glm::cross(s, ab);
        const double u = glm::dot(s, p) / det, v = glm::dot(d, q) / det, t = glm::dot(ac, q) / det;
        n += u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < 1.0 ? 1 : 0;
    }
    return n;
}

TEST(Silhouettes, OfACubeHaveTheWallsOfItsOutline) {
    const Silhouettes s(cube());
    EXPECT_EQ(s.triangles(), 12U);
    EXPECT_EQ(s.bodies().size(), 1U);
    EXPECT_EQ(s.closed_bodies(), 1U);
    // Before a face: 2 triangles near and far, 4 walls of 2. Before a corner: 3 faces, 6 edges of the outline.
    EXPECT_EQ(hulls(s, {-5.0, 0.5, 0.5}).size() / 3, 2U * 2U + 4U * 2U);
    EXPECT_EQ(hulls(s, {-5.0, -5.0, -5.0}).size() / 3, 2U * 6U + 6U * 2U);
    EXPECT_EQ(hulls(s, {0.5, 0.5, 0.6}).size() / 3, 2U * 12U) << "from within light meets backs alone, and there is no outline";
}

TEST(Silhouettes, OpenSheetsFinsAndFlippedTrianglesGiveClosedHulls) {
    Corners fin = cube();
    add(fin, {0, 0, 0}, {0, 0, 1}, {-1, -1, 0}); // a third triangle at an edge
    EXPECT_EQ(Silhouettes(fin).closed_bodies(), 0U);
    Corners flipped = cube();
    std::swap(flipped[1], flipped[2]);
    EXPECT_EQ(Silhouettes(flipped).closed_bodies(), 0U);
    Corners open = cube();
    open.resize(open.size() - 6);
    EXPECT_EQ(Silhouettes(open).closed_bodies(), 0U);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> somewhere(-3.0, 3.0);
    for (const Corners& shape : {fin, flipped, open, cube(), Corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}})
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 lamp(somewhere(random), somewhere(random), somewhere(random));
            EXPECT_TRUE(is_closed(hulls(Silhouettes(shape), lamp)));
            EXPECT_TRUE(is_closed(hulls(Silhouettes(shape), lamp, Casting::turned_away)));
        }
}

/// Of a closed body fronts alone cast; inside out those are the far sides, and within it light would reach what the near sides hide.
TEST(Silhouettes, BodiesInsideOutCastFromAllTriangles) {
    Corners inside_out = cube();
    for (std::size_t i = 0; i < inside_out.size(); i += 3)
        std::swap(inside_out[i + 1], inside_out[i + 2]);
    EXPECT_EQ(Silhouettes(inside_out).closed_bodies(), 0U);
    EXPECT_EQ(hulls(Silhouettes(inside_out), {-5.0, 0.5, 0.5}).size() / 3, 2U * 12U + 4U * 2U * 2U) << "two layers, each with its walls";
    Corners both = cube(); // and its mirror image at a corner: that one place does not make it one body
    for (const glm::vec3& p : inside_out)
        both.push_back(p + 1.0F);
    EXPECT_EQ(Silhouettes(both).bodies().size(), 2U);
    EXPECT_EQ(Silhouettes(both).closed_bodies(), 1U);
    Corners sheet; // from both sides: no volume, and a front towards every lamp
    add(sheet, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    add(sheet, {0, 0, 0}, {0, 1, 0}, {1, 0, 0});
    EXPECT_EQ(Silhouettes(sheet).closed_bodies(), 1U);
}

TEST(Silhouettes, HullsHoldWhatTheLampDoesNotSeeAndNothingElse) {
    Corners shapes = cube();
    for (const glm::vec3& p : cube()) // a second cube, half its size, beside
        shapes.push_back(glm::vec3(0.3F, 2.0F, 0.1F) + 0.5F * p);
    add(shapes, {2, -1, 0}, {2, 3, 0}, {2, 3, 2}, {2, -1, 2}); // an open sheet behind both
    const Silhouettes s(shapes);
    EXPECT_EQ(s.bodies().size(), 3U);
    EXPECT_EQ(s.closed_bodies(), 2U);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> somewhere(-3.0, 5.0);
    int hidden = 0, seen = 0;
    for (int l = 0; l < 10; ++l) {
        const glm::dvec3 lamp(-4.0 + 0.05 * somewhere(random), somewhere(random), somewhere(random));
        const std::vector<glm::vec4> of_lamp = hulls(s, lamp), of_all = hulls(s, lamp, Casting::all);
        for (int i = 0; i < 200; ++i) {
            const glm::dvec3 point(somewhere(random), somewhere(random), somewhere(random));
            const int way = crossed(shapes, lamp, point);
            const double turns = winding(of_lamp, lamp, point), all = winding(of_all, lamp, point);
            EXPECT_EQ(way > 0, turns > 0.5) << turns;
            EXPECT_NEAR(turns, std::round(turns), 1e-3);
            EXPECT_NEAR(all, way, 1e-3) << "each triangle on the way counts once";
            (way > 0 ? hidden : seen) += 1;
        }
    }
    EXPECT_GT(hidden, 100);
    EXPECT_GT(seen, 100);
}

} // namespace
} // namespace fernlicht::gl
