// Hulls behind bodies: closed whatever the mesh, with as many walls as its outline has edges.
#include "renderer/gl/shadows/shadow_volumes.h"
#include "renderer/gl/shadows/warped_maps.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <tuple>

namespace fernlicht::gl {
namespace {

using Soup = std::vector<glm::vec3>;

void add(Soup& corners, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) { corners.insert(corners.end(), {a, b, c}); }
void add(Soup& corners, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
    add(corners, a, b, c);
    add(corners, a, c, d);
}

/// From 0 to 1 in x, y, z; normals outwards.
Soup cube() {
    Soup c;
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
int crossed(const Soup& c, const glm::dvec3& lamp, const glm::dvec3& point) {
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
    Soup fin = cube();
    add(fin, {0, 0, 0}, {0, 0, 1}, {-1, -1, 0}); // a third triangle at an edge
    EXPECT_EQ(Silhouettes(fin).closed_bodies(), 0U);
    Soup flipped = cube();
    std::swap(flipped[1], flipped[2]);
    EXPECT_EQ(Silhouettes(flipped).closed_bodies(), 0U);
    Soup open = cube();
    open.resize(open.size() - 6);
    EXPECT_EQ(Silhouettes(open).closed_bodies(), 0U);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> somewhere(-3.0, 3.0);
    for (const Soup& shape : {fin, flipped, open, cube(), Soup{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}})
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 lamp(somewhere(random), somewhere(random), somewhere(random));
            EXPECT_TRUE(is_closed(hulls(Silhouettes(shape), lamp)));
            EXPECT_TRUE(is_closed(hulls(Silhouettes(shape), lamp, Casting::turned_away)));
        }
}

/// Of a closed body fronts alone cast; inside out those are the far sides, and within it light would reach what the near sides hide.
TEST(Silhouettes, BodiesInsideOutCastFromAllTriangles) {
    Soup inside_out = cube();
    for (std::size_t i = 0; i < inside_out.size(); i += 3)
        std::swap(inside_out[i + 1], inside_out[i + 2]);
    EXPECT_EQ(Silhouettes(inside_out).closed_bodies(), 0U);
    EXPECT_EQ(hulls(Silhouettes(inside_out), {-5.0, 0.5, 0.5}).size() / 3, 2U * 12U + 4U * 2U * 2U) << "two layers, each with its walls";
    Soup both = cube(); // and its mirror image at a corner: that one place does not make it one body
    for (const glm::vec3& p : inside_out)
        both.push_back(p + 1.0F);
    EXPECT_EQ(Silhouettes(both).bodies().size(), 2U);
    EXPECT_EQ(Silhouettes(both).closed_bodies(), 1U);
    Soup sheet; // from both sides: no volume, and a front towards every lamp
    add(sheet, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    add(sheet, {0, 0, 0}, {0, 1, 0}, {1, 0, 0});
    EXPECT_EQ(Silhouettes(sheet).closed_bodies(), 1U);
}

TEST(Silhouettes, HullsHoldWhatTheLampDoesNotSeeAndNothingElse) {
    Soup shapes = cube();
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

/// Whatever is wrong with a mesh: its hulls are closed, and hold what is behind its triangles and nothing else.
TEST(Silhouettes, DegenerateBodiesCastFromTheirTriangles) {
    const Soup whole = cube();
    const glm::vec3 a = whole[0], b = whole[1], middle = 0.5F * (a + b);
    const auto with = [](Soup body, const Soup& more) {
        body.insert(body.end(), more.begin(), more.end());
        return body;
    };
    const auto turned = [](Soup body, std::initializer_list<std::size_t> triangles) {
        for (const std::size_t t : triangles)
            std::swap(body[3 * t + 1], body[3 * t + 2]);
        return body;
    };
    const Soup inside_out = turned(whole, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
    Soup cracked = with(whole, {middle, b, whole[2]}), mirrored = whole;
    cracked[1] = middle;
    for (const glm::vec3& p : inside_out)
        mirrored.push_back(p + 1.0F);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> somewhere(-3.0, 5.0);
    for (const auto& [name, body] : {std::pair<const char*, Soup>("a crack without a triangle in it", cracked),
                                     {"a crack filled by a triangle without area", with(cracked, {a, b, middle})},
                                     {"five triangles twice", with(whole, Soup(whole.begin(), whole.begin() + 15))},
                                     {"all triangles twice", with(whole, whole)},
                                     {"from both sides", with(whole, inside_out)},
                                     {"a fin on an edge", with(whole, {a, b, glm::vec3(-0.7F, -0.6F, 1.3F)})},
                                     {"three triangles turned round", turned(whole, {0, 3, 7})},
                                     {"inside out", inside_out},
                                     {"triangles with corners in one place", with(whole, {a, a, a, a, a, whole[2]})},
                                     {"and its mirror image inside out at one corner", mirrored}})
        for (const glm::dvec3& lamp : {glm::dvec3(-4.1, 0.3, 0.65), glm::dvec3(5.2, -2.1, 3.3), glm::dvec3(0.6, 0.7, 0.45)}) {
            SCOPED_TRACE(testing::Message() << name << ", lamp at " << lamp.x);
            const std::vector<glm::vec4> corners = hulls(Silhouettes(body), lamp);
            EXPECT_TRUE(is_closed(corners));
            for (int i = 0; i < 200; ++i) {
                const glm::dvec3 point(somewhere(random), somewhere(random), somewhere(random));
                const double turns = winding(corners, lamp, point);
                EXPECT_EQ(crossed(body, lamp, point) > 0, turns > 0.5) << turns;
                EXPECT_NEAR(turns, std::round(turns), 1e-3);
            }
        }
}

// Warps of a lamp's map in double precision: what is seen, and the homographies against the constructions that they stand for.

Corners box_of(const glm::dvec3& low, const glm::dvec3& high) {
    Corners box;
    for (std::size_t i = 0; i < 8; ++i)
        box[i] = {(i & 1U) != 0U ? high.x : low.x, (i & 2U) != 0U ? high.y : low.y, (i & 4U) != 0U ? high.z : low.z};
    return box;
}

LitLamp lamp_looking(const glm::dvec3& place, double yaw_rad) {
    return {.pose = {place, axes_from_angles(yaw_rad, -0.01, 0.0)}, .intensity_factor = 1.0};
}

Camera camera_at(const glm::dvec3& place, double yaw_rad, double pitch_rad) {
    View view{.position_m = place, .yaw_rad = yaw_rad, .pitch_rad = pitch_rad};
    return camera_of(Moment{}, view);
}

const ShadowWindow wide_window{-0.6, 0.6, -0.25, 0.15};
const std::vector<Corners> road_and_wall{box_of({-5.0, -30.0, 0.0}, {200.0, 30.0, 0.0}), box_of({60.0, 5.0, 0.0}, {61.0, 9.0, 3.0})};

TEST(MapWarp, ABoxIsClippedToTheCornersOfWhatIsLeft) {
    const Corners box = box_of({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
    EXPECT_EQ(clipped_box(box, {{1.0, 0.0, 0.0, 1.0}}).size(), 8U);
    EXPECT_TRUE(clipped_box(box, {{1.0, 0.0, 0.0, -2.0}}).empty());
    // Two cuts: the ends of the line where they meet belong to no face of the box but at its sides.
    const std::vector<glm::dvec3> wedge = clipped_box(box, {{-1.0, 0.0, 0.0, 0.5}, {0.0, -1.0, 0.0, 0.25}});
    const auto has = [&](const glm::dvec3& p) {
        return std::ranges::any_of(wedge, [&](const glm::dvec3& q) { return glm::length(p - q) < 1e-12; });
    };
    for (const double x : {0.0, 0.5})
        for (const double y : {0.0, 0.25})
            for (const double z : {0.0, 1.0})
                EXPECT_TRUE(has({x, y, z})) << x << " " << y << " " << z;
    for (const glm::dvec3& p : wedge)
        EXPECT_TRUE(p.x <= 0.5 + 1e-12 && p.y <= 0.25 + 1e-12);
    // Three planes that meet inside the box: their corner is on none of its faces.
    const double r = 1.0 / std::sqrt(2.0);
    const std::vector<glm::dvec3> pyramid = clipped_box(box, {{r, r, 0.0, -r}, {r, -r, 0.0, 0.0}, {0.0, 0.0, 1.0, -0.5}});
    EXPECT_TRUE(std::ranges::any_of(pyramid, [](const glm::dvec3& p) { return glm::length(p - glm::dvec3(0.5)) < 1e-12; }));
}

/// The paper's construction step by step: into the eye's cube, then from the lamp's place there to the cube's middle.
TEST(MapWarp, PerspectiveWarpIsTheViewOfTheCubeFromTheLampsPlaceInIt) {
    for (const double lamp_x : {2.2, -3.0}) { // before the eye and behind it, which mirrors the map
        const LitLamp lamp = lamp_looking({lamp_x, 0.6, 0.65}, 0.0);
        const Camera camera = camera_at({1.5, 0.35, 1.2}, 0.0, -0.05);
        const auto seen = seen_in_beam(road_and_wall, camera, lamp, lamp.pose.position_m, wide_window, 0.05);
        ASSERT_GT(seen.size(), 8U);
        const auto warp = perspective_warp(seen, camera, lamp, lamp.pose.position_m);
        ASSERT_TRUE(warp);
        double n = 1e9, f = 0.0;
        const auto in_world = [&](const glm::dvec3& p) {
            return lamp.pose.position_m - lamp.pose.left() * p.x + lamp.pose.up() * p.y + lamp.pose.forward() * p.z;
        };
        for (const glm::dvec3& p : seen) {
            const double depth = glm::dot(camera.axis, in_world(p) - camera.eye_m);
            n = std::min(n, depth);
            f = std::max(f, depth);
        }
        const auto in_cube = [&](const glm::dvec3& p) {
            const glm::dvec3 v = p - camera.eye_m;
            const double z = glm::dot(camera.axis, v);
            return glm::dvec3(glm::dot(camera.right, v) / camera.half_extent.x / z, glm::dot(camera.up, v) / camera.half_extent.y / z,
                              (f + n) / (f - n) - 2.0 * f * n / ((f - n) * z));
        };
        const glm::dvec3 from = in_cube(lamp.pose.position_m), look = -glm::normalize(from);
        const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), look)), up = glm::cross(look, right);
        double scale = 0.0;
        for (const glm::dvec3& p : seen) {
            const glm::dvec3 way = in_cube(in_world(p)) - from, q = *warp * p;
            EXPECT_GT(q.z, 0.0);
            const double x = glm::dot(right, way) / glm::dot(look, way), y = glm::dot(up, way) / glm::dot(look, way);
            if (scale == 0.0 && std::abs(y) > 1e-3)
                scale = q.y / q.z / y;
            EXPECT_NEAR(q.x / q.z, (lamp_x > 1.5 ? 1.0 : -1.0) * scale * x, 1e-9 * std::abs(scale) + 1e-9) << lamp_x;
            EXPECT_NEAR(q.y / q.z, scale * y, 1e-9 * std::abs(scale) + 1e-9) << lamp_x;
        }
    }
}

TEST(MapWarp, TheFitPutsAllThatIsSeenIntoTheMapAndNoMore) {
    for (const double yaw : {0.0, 1.2, 3.1}) {
        const LitLamp lamp = lamp_looking({2.2, 0.6, 0.65}, 0.0);
        const Camera camera = camera_at({yaw > 2.0 ? 100.0 : (yaw > 0.0 ? 30.0 : 1.5), yaw > 0.0 ? -10.0 : 0.35, 3.0}, yaw, -0.1);
        const auto seen = seen_in_beam(road_and_wall, camera, lamp, lamp.pose.position_m, wide_window, 0.05);
        ASSERT_FALSE(seen.empty()) << yaw;
        for (const auto& warp : {std::optional(glm::dmat3(1.0)), light_space_warp(seen, camera, lamp, lamp.pose.position_m),
                                 perspective_warp(seen, camera, lamp, lamp.pose.position_m)}) {
            const auto fit = warp ? fitted(*warp, seen, 1024, 512, 0.0) : std::nullopt;
            if (!fit)
                continue; // the methods do without a warp then
            double left = 1.0, right = 0.0, bottom = 1.0, top = 0.0, least = 1e9;
            for (const glm::dvec3& p : seen) {
                const glm::dvec3 q = *fit * p;
                left = std::min(left, q.x / q.z);
                right = std::max(right, q.x / q.z);
                bottom = std::min(bottom, q.y / q.z);
                top = std::max(top, q.y / q.z);
                least = std::min(least, q.z / p.z);
            }
            EXPECT_TRUE(left > 3.5 / 1024.0 && left < 6.0 / 1024.0 && right < 1.0 - 3.5 / 1024.0 && right > 1.0 - 6.0 / 1024.0) << yaw;
            EXPECT_TRUE(bottom > 3.5 / 512.0 && bottom < 6.0 / 512.0 && top < 1.0 - 3.5 / 512.0 && top > 1.0 - 6.0 / 512.0) << yaw;
            EXPECT_NEAR(least, 1.0, 1e-9);
        }
    }
}

TEST(MapWarp, ALampAtTheEyeThatLooksTheSameWayLeavesNothingToWarp) {
    const LitLamp lamp = lamp_looking({1.5, 0.35, 1.2}, 0.0);
    const Camera camera = camera_at({1.5, 0.35, 1.2}, 0.0, -0.01);
    const auto seen = seen_in_beam(road_and_wall, camera, lamp, lamp.pose.position_m, wide_window, 0.05);
    const auto warp = light_space_warp(seen, camera, lamp, lamp.pose.position_m);
    if (warp) {
        for (const glm::dvec3& p : seen)
            EXPECT_NEAR((*warp * p).z / p.z, 1.0, 1e-6); // no perspective
    }
    EXPECT_FALSE(perspective_warp(seen, camera, lamp, lamp.pose.position_m) &&
                 fitted(*perspective_warp(seen, camera, lamp, lamp.pose.position_m), {{0.0, 0.0, -1.0}}, 64, 64, 0.0));
}

/// Moved by what is raised, a point of a plane is nearer to the lamp than the plane in all texels about.
TEST(MapWarp, SpreadIsThePlainMapsForAWindow) {
    const ShadowWindow window{-0.5, 0.5, -0.25, 0.25};
    EXPECT_NEAR(spread_of(window_homography(window, 1024, 512), 1024, 512), 1.5 / 1020.0, 1e-8);
    EXPECT_NEAR(spread_of(window_homography(window, 512, 512), 512, 512), 1.5 / 510.0, 1e-8);
}

TEST(MapWarp, EdgesShiftByWhatALampsPlaceMakesOfThem) {
    MapPlan then, now;
    then.from = now.from = {{0.0, 0.0, 0.65}, glm::dmat3(1.0)};
    now.bodies = {{-0.1, -0.08, -0.02, 0.05, 10.0, false}};
    EXPECT_DOUBLE_EQ(edge_shift(then, now), 0.0);
    now.from.position_m.y = 0.05; // aside: 5 mm a metre at 10 m
    EXPECT_NEAR(edge_shift(then, now), 0.005, 1e-12);
    now.from.position_m.y = 0.0;
    now.from.position_m.x = 0.5; // ahead: (X / (Z - m) - X / Z) at the outer side
    EXPECT_NEAR(edge_shift(then, now), std::hypot(0.1, 0.05) * 0.5 / 9.5, 1e-12);
    now.bodies[0].nearest_m = 0.4; // the lamp has passed where it begins
    EXPECT_TRUE(std::isinf(edge_shift(then, now)));
}

/// A wall along the lamp's axis begins where it enters the window, not beside the lamp.
TEST(MapWarp, BodiesAroundTheLampBeginWhereTheyEnterTheWindow) {
    const ShadowWindow window{-0.5, 0.5, -0.25, 0.25};
    const std::vector<glm::dvec3> wall{{2.0, -1.0, -50.0}, {2.0, -1.0, 80.0}, {2.0, 3.0, 80.0},
                                       {2.0, -1.0, -50.0}, {2.0, 3.0, 80.0},  {2.0, 3.0, -50.0}};
    EXPECT_NEAR(begins_in_window(wall, window), 4.0, 1e-12);
    EXPECT_NEAR(begins_in_window({wall[0], wall[1], {2.0, -0.9, 80.0}}, {-0.5, 0.5, -0.1, 0.1}), 9.542, 1e-3); // low: by its upper edge
    EXPECT_NEAR(begins_in_window({{-5.0, -5.0, 0.0}, {5.0, -5.0, 0.0}, {0.0, 5.0, 0.1}}, window), shadow_near_m, 1e-12);
    EXPECT_TRUE(std::isinf(begins_in_window({{-5.0, -5.0, -1.0}, {5.0, -5.0, -1.0}, {0.0, 5.0, -1.0}}, window)));
}

} // namespace
} // namespace fernlicht::gl
