// The shapes that dressed objects are built of, and the signs.
#include "scenarios/dressing/dressed_object.h"
#include "scenarios/dressing/dressing.h"
#include "scenarios/models/road_user_bodies.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

struct Shape {
    const char* name;
    DressedObject object;
    glm::dvec3 low_m, high_m; ///< of the plain shape
};

std::vector<Shape> shapes(std::uint64_t seed, Detail detail) {
    const Dice dice(seed, "shape");
    return {{"house", dressed_house({12.0, 10.0, 7.0, 0.5, true}, dice, detail), {-6, -5, 0}, {6, 5, 7}},
            {"tall house", dressed_house({16.0, 9.0, 14.0, 0.0, false}, dice, detail), {-8, -4.5, 0}, {8, 4.5, 14}},
            {"tree", dressed_tree(14.0, 2.6, dice, detail), {-2.6, -2.6, 0}, {2.6, 2.6, 14}},
            {"bush", dressed_bush(1.5, 0.8, dice), {-0.8, -0.8, 0}, {0.8, 0.8, 1.5}},
            {"hedge", dressed_hedge(9.0, 0.8, 1.2, 0.4, dice), {-4.5, -0.5, -0.4}, {4.5, 0.5, 1.2}},
            {"fence", dressed_fence(9.0, 1.0, 0.3), {-4.5, -0.05, -0.3}, {4.5, 0.05, 1.0}},
            {"field fence", dressed_field_fence(3.0), {-1.5, -0.05, -0.4}, {1.5, 0.075, 1.15}},
            {"rail", dressed_guard_rail(4.0, 0.08, 0.31, true), {-2, -0.04, 0}, {2, 0.04, 0.31}},
            {"rail", dressed_guard_rail(4.0, 0.08, 0.31, false), {-2, -0.04, 0}, {2, 0.04, 0.31}},
            {"low house", dressed_house({8.0, 6.0, 1.5 + lowest_house_m, 1.5, true}, dice, detail), {-4, -3, 0}, {4, 3, 6}}};
}

std::vector<std::array<SoupVertex, 3>> all_triangles(const DressedObject& object) {
    std::vector<std::array<SoupVertex, 3>> out;
    for (const TriangleSoup* soup : {&object.low, &object.high})
        for (const SoupTriangle& t : soup->triangles)
            out.push_back({soup->vertices.at(t.corners[0]), soup->vertices.at(t.corners[1]), soup->vertices.at(t.corners[2])});
    return out;
}

glm::dvec3 cross_of(const std::array<SoupVertex, 3>& t) {
    return glm::cross(t[1].position_m - t[0].position_m, t[2].position_m - t[0].position_m);
}

TEST(DressedShapes, StayInThePlainShapesBoxAndFaceTheirNormals) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed)
        for (const Detail detail : {Detail::near, Detail::far})
            for (const Shape& shape : shapes(seed, detail)) {
                const auto triangles = all_triangles(shape.object);
                ASSERT_GE(triangles.size(), 10U) << shape.name;
                std::size_t against = 0;
                for (const auto& t : triangles) {
                    ASSERT_GT(glm::length(cross_of(t)), 0.0) << shape.name;
                    for (const SoupVertex& v : t) {
                        for (int axis = 0; axis < 3; ++axis) {
                            ASSERT_GE(v.position_m[axis], shape.low_m[axis] - 1e-9) << shape.name << ", seed " << seed;
                            ASSERT_LE(v.position_m[axis], shape.high_m[axis] + 1e-9) << shape.name << ", seed " << seed;
                        }
                        ASSERT_NEAR(glm::length(v.normal), 1.0, 1e-9) << shape.name;
                        against += glm::dot(v.normal, cross_of(t)) < 0.0 ? 1U : 0U;
                    }
                }
                EXPECT_LE(against, 3 * triangles.size() / 50) << shape.name << ": corners whose normal looks away, of leaves alone";
            }
}

struct Met {
    int hits = 0, backs = 0;
};
/// What rays at places in a box meet first: from far away, not from below, and from a driver's eye, 1.2 m above its foot.
Met met_from_outside(const std::vector<std::array<SoupVertex, 3>>& triangles, const glm::dvec3& low_m, const glm::dvec3& high_m) {
    const glm::dvec3 centre = 0.5 * (low_m + high_m), size = high_m - low_m;
    Met met;
    for (int i = 0; i < 1200; ++i) {
        const double angle = 0.7 + 2.39996 * i, up = 0.02 + 0.6 * (i % 20) / 20.0, far_m = glm::length(size) + 5.0 + 4.0 * (i % 11);
        const glm::dvec3 level(std::cos(angle), std::sin(angle), 0.0),
            from = i % 2 == 0 ? centre + 60.0 * (level + glm::dvec3(0.0, 0.0, up))
                              : glm::dvec3(glm::dvec2(centre + far_m * level), low_m.z + 1.2),
            to = centre + size * glm::dvec3(0.45 * std::sin(7.1 * i), 0.45 * std::sin(3.3 * i), 0.45 * std::sin(5.7 * i)),
            d = glm::normalize(to - from);
        double nearest = 1e9;
        bool back = false;
        for (const auto& t : triangles) {
            const glm::dvec3 &a = t[0].position_m, &b = t[1].position_m, &c = t[2].position_m, n = cross_of(t);
            const double along = glm::dot(n, d), at = glm::dot(a - from, n) / along;
            const glm::dvec3 p = from + at * d;
            if (along != 0.0 && at > 0.0 && at < nearest && glm::dot(glm::cross(b - a, p - a), n) >= 0.0 &&
                glm::dot(glm::cross(c - b, p - b), n) >= 0.0 && glm::dot(glm::cross(a - c, p - c), n) >= 0.0) {
                nearest = at;
                back = along > 0.0;
            }
        }
        met.hits += nearest < 1e8 ? 1 : 0;
        met.backs += nearest < 1e8 && back ? 1 : 0;
    }
    return met;
}

/// Where fronts alone are drawn a back would be a hole: 2 % are the edges of leaves, 1 cm thick.
TEST(DressedShapes, ShowTheirFrontsFromOutside) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
        for (const Detail detail : {Detail::near, Detail::far})
            for (const Shape& shape : shapes(seed, detail)) {
                const auto [hits, backs] = met_from_outside(all_triangles(shape.object), shape.low_m, shape.high_m);
                EXPECT_GT(hits, 60) << shape.name;
                EXPECT_LE(backs, hits / (shape.object.closed ? 50 : 14)) << shape.name << ", seed " << seed << ": of " << hits;
            }
}

std::vector<std::array<SoupVertex, 3>> all_triangles(const Model& model) {
    std::vector<std::array<SoupVertex, 3>> out;
    for (const Mesh& mesh : model.meshes)
        for (std::size_t k = 0; k + 2 < mesh.indices.size(); k += 3) {
            const auto at = [&](std::size_t i) { return mesh.origin_m + glm::dvec3(mesh.vertices[mesh.indices[k + i]].position_m); };
            out.push_back({SoupVertex{at(0), {}, {}}, SoupVertex{at(1), {}, {}}, SoupVertex{at(2), {}, {}}});
        }
    return out;
}

TEST(DressedShapes, BodiesSignsAndBollardsShowTheirFrontsFromOutside) {
    const auto expect_fronts = [](const std::vector<std::array<SoupVertex, 3>>& triangles, const glm::dvec3& low_m,
                                  const glm::dvec3& high_m, std::string_view name) {
        const auto [hits, backs] = met_from_outside(triangles, low_m, high_m);
        EXPECT_GT(hits, 100) << name;
        EXPECT_LE(backs, hits / 100) << name;
    };
    for (std::uint32_t draw = 0; draw < 6; ++draw)
        for (const Model& body : {car_body({{4.4, 1.8, 1.3}, -0.88, glm::vec3(0.3F), true, draw}),
                                  van_body({{5.4, 2.0, 2.3}, -1.0, glm::vec3(0.3F), true, draw}),
                                  truck_body({{9.4, 2.5, 3.3}, -1.9, glm::vec3(0.3F), true, draw}),
                                  bus_body({{11.4, 2.5, 3.1}, -2.3, glm::vec3(0.3F), true, draw}),
                                  pedestrian_body({{0.5, 0.55, 1.75}, -0.25, glm::vec3(0.3F), true, draw}),
                                  bicycle_body({{1.75, 0.6, 1.75}, -0.4, glm::vec3(0.3F), true, draw})})
            expect_fronts(all_triangles(body), body.low_m, body.high_m, body.name);
    expect_fronts(all_triangles(DressedObject{.low = dressed_sign(0.6, 0.6, {}, Dice(1, "sign"))}), {-0.03, -0.3, -1.5}, {0.0, 0.3, 0.3},
                  "sign");
    expect_fronts(all_triangles(dressed_bollard(0.9)), {-0.05, -0.05, 0.0}, {0.05, 0.05, 0.9}, "bollard");
}

/// Of a point from a triangle.
double distance_m(const glm::dvec3& p, const std::array<SoupVertex, 3>& t) {
    const glm::dvec3 &a = t[0].position_m, &b = t[1].position_m, &c = t[2].position_m, n = glm::normalize(cross_of(t));
    const glm::dvec3 on = p - glm::dot(p - a, n) * n;
    if (glm::dot(glm::cross(b - a, on - a), n) >= 0.0 && glm::dot(glm::cross(c - b, on - b), n) >= 0.0 &&
        glm::dot(glm::cross(a - c, on - c), n) >= 0.0)
        return std::abs(glm::dot(p - a, n));
    double least = 1e9;
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
        const double share = std::clamp(glm::dot(p - from, to - from) / glm::dot(to - from, to - from), 0.0, 1.0);
        least = std::min(least, glm::length(p - from - share * (to - from)));
    }
    return least;
}

TEST(DressedShapes, FarOnesKeepTheirErrorBound) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const std::vector<Shape> near = shapes(seed, Detail::near), far = shapes(seed, Detail::far);
        for (const std::size_t i : {0U, 1U, 2U}) {
            const double bound_m = i < 2 ? far_house_error_m : far_tree_error * 2.6;
            const auto fine = all_triangles(near[i].object), coarse = all_triangles(far[i].object);
            EXPECT_LT(coarse.size(), fine.size()) << near[i].name;
            double worst_m = 0.0;
            for (const auto& t : fine)
                for (const SoupVertex& v : t) {
                    double least_m = 1e9;
                    for (const auto& other : coarse)
                        if (least_m > 1e-6)
                            least_m = std::min(least_m, distance_m(v.position_m, other));
                    worst_m = std::max(worst_m, least_m);
                }
            EXPECT_LE(worst_m, bound_m) << near[i].name << ", seed " << seed;
        }
    }
}

TEST(DressedSigns, ShowTheirColoursAsSheetingOfClassRA2) {
    const std::vector<Material> all = dressing_materials();
    // EN 12899-1, class RA2, at 20' and 5 degrees.
    for (const auto& [stuff, ra] : {std::pair(Stuff::sheet_white, 180.0F), std::pair(Stuff::sheet_yellow, 120.0F),
                                    std::pair(Stuff::sheet_red, 25.0F), std::pair(Stuff::sheet_blue, 14.0F)}) {
        EXPECT_EQ(all[index_of(stuff)].retro_rl, ra);
        EXPECT_NEAR(all[index_of(stuff)].retro_reference_rad, radians(20.0 / 60.0), 1e-6);
        EXPECT_EQ(all[index_of(stuff)].kind, SurfaceKind::board);
    }
    const auto area = [](const TriangleSoup& soup, Stuff stuff) { // that faces the reader
        double sum = 0.0;
        for (const SoupTriangle& t : soup.triangles) {
            const glm::dvec3 &a = soup.vertices[t.corners[0]].position_m, &b = soup.vertices[t.corners[1]].position_m,
                             &c = soup.vertices[t.corners[2]].position_m;
            if (t.material == index_of(stuff))
                sum += std::max(0.0, 0.5 * glm::cross(b - a, c - a).x);
        }
        return sum;
    };
    const Dice dice(1, "sign");
    struct Case {
        SignalFace face;
        Stuff ground, ink;
    };
    for (const auto& [face, ground, ink] : {Case{{"DE", "274", "62", "120", ""}, Stuff::sheet_white, Stuff::sheet_red},
                                            Case{{"DE", "103", "10", "-1", ""}, Stuff::sheet_white, Stuff::sheet_red},
                                            Case{{"", "306", "", "", ""}, Stuff::sheet_white, Stuff::sheet_yellow},
                                            Case{{"DE", "310", "", "", "Ulm"}, Stuff::sheet_yellow, Stuff::sheet_black},
                                            Case{{"DE", "449", "", "", ""}, Stuff::sheet_blue, Stuff::sheet_white},
                                            Case{{"DE", "206", "", "", ""}, Stuff::sheet_red, Stuff::sheet_white},
                                            Case{{"DE", "625", "20", "", ""}, Stuff::sheet_white, Stuff::sheet_red},
                                            Case{{"US", "R1-1", "", "", ""}, Stuff::sheet_white, Stuff::sheet_black}}) {
        const TriangleSoup sign = dressed_sign(0.9, 0.8, face, dice);
        EXPECT_GT(area(sign, ground), 0.2) << face.type;
        EXPECT_GT(area(sign, ink), 0.01) << face.type;
        for (const SoupVertex& v : sign.vertices) {
            EXPECT_LE(std::abs(v.position_m.y), 0.45 + 1e-9) << face.type;
            EXPECT_LE(std::abs(v.position_m.z), 0.40 + 1e-9) << face.type;
        }
    }
    // A disc of 24 corners, a ring from 0.80 to 0.98 of its radius.
    const double corners = 0.5 * 24.0 * std::sin(2.0 * pi / 24.0) * 0.4 * 0.4;
    const TriangleSoup limit = dressed_sign(0.9, 0.8, {"DE", "274", "50", "", ""}, dice);
    EXPECT_NEAR(area(limit, Stuff::sheet_white), corners, 1e-9);
    EXPECT_NEAR(area(limit, Stuff::sheet_red), corners * (0.98 * 0.98 - 0.80 * 0.80), 1e-9);
    EXPECT_NE(area(limit, Stuff::sheet_black), area(dressed_sign(0.9, 0.8, {"DE", "274", "", "70", ""}, dice), Stuff::sheet_black));
    EXPECT_EQ(area(dressed_sign(0.9, 0.8, {"DE", "274", "62", "-1", ""}, dice), Stuff::sheet_black), 0.0) << "62 is no limit";
}

TEST(DressedShapes, HousesTooLowForARoofStayBoxes) {
    RoadObject house;
    house.type = "building";
    house.length_m = 8.0;
    house.width_m = 6.0;
    house.height_m = 4.6;
    EXPECT_TRUE(is_dressed(house));
    house.height_m = 4.2;
    EXPECT_FALSE(is_dressed(house));
    house.height_m = 5.7;
    house.z_offset_m = -1.5; // sunk: 4.2 m above the ground
    EXPECT_FALSE(is_dressed(house));
}

} // namespace
} // namespace fernlicht
