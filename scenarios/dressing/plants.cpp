#include "scenarios/dressing/dressed_object.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace fernlicht {
namespace {

constexpr double picture_m = 8.0; ///< one repetition of a picture

glm::vec2 leaf_place(const glm::dvec3& p) { return glm::vec2(glm::dvec2(p.x + 0.6 * p.z, p.y - 0.8 * p.z) / picture_m); }

/// The box that a plant keeps within: a radius about its axis and a height.
struct PlantBox {
    double radius_m, height_m;
    glm::dvec3 kept(glm::dvec3 p) const {
        if (const double r = std::hypot(p.x, p.y); r > radius_m)
            p = {p.x * radius_m / r, p.y * radius_m / r, p.z};
        p.z = std::clamp(p.z, 0.0, height_m);
        return p;
    }
};

/// A tube through rings of their own radius, smooth, open at both ends; bark runs along it.
struct TubeRing {
    glm::dvec3 centre_m;
    double radius_m;
    double lobes = 0.0; ///< share of the radius by which five ribs stand out, as roots do
};
void append_tube(TriangleSoup& soup, const std::vector<TubeRing>& rings, int sides, Stuff stuff) {
    const glm::dvec3 axis = glm::normalize(rings.back().centre_m - rings.front().centre_m);
    const glm::dvec3 across = glm::normalize(glm::cross(axis, std::abs(axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
    const glm::dvec3 third = glm::cross(axis, across);
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    const double times_round = std::max(0.125, std::round(8.0 * 2.0 * pi * rings.front().radius_m / picture_m) / 8.0);
    double along_m = 0.0;
    for (std::size_t i = 0; i < rings.size(); ++i) {
        along_m += i > 0 ? glm::length(rings[i].centre_m - rings[i - 1].centre_m) : 0.0;
        for (int s = 0; s <= sides; ++s) {
            const double angle = 2.0 * pi * (s % sides) / sides;
            const glm::dvec3 out = std::cos(angle) * across + std::sin(angle) * third;
            const double radius = rings[i].radius_m * (1.0 - rings[i].lobes * (0.5 - 0.5 * std::cos(5.0 * angle)));
            soup.vertices.push_back({rings[i].centre_m + radius * out, out, glm::vec2(times_round * s / sides, along_m / picture_m)});
        }
    }
    const auto row = static_cast<std::uint32_t>(sides + 1);
    for (std::uint32_t i = 0; i + 1 < rings.size(); ++i)
        for (std::uint32_t s = 0; s + 1 < row; ++s) {
            const std::uint32_t a = first + i * row + s, b = a + row;
            soup.triangles.push_back({{a, a + 1, b + 1}, index_of(stuff)});
            soup.triangles.push_back({{a, b + 1, b}, index_of(stuff)});
        }
}

/// An octahedron whose edges were halved `times` times: places on the unit sphere, and triangles that face outwards.
struct Ball {
    std::vector<glm::dvec3> places;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};
Ball ball(int times) {
    Ball out{{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, {}};
    for (std::uint32_t i = 0; i < 4; ++i) {
        out.triangles.push_back({i, (i + 1) % 4, 4});
        out.triangles.push_back({(i + 1) % 4, i, 5});
    }
    for (int n = 0; n < times; ++n) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> halves;
        const auto half = [&](std::uint32_t a, std::uint32_t b) {
            const auto [it, fresh] = halves.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(out.places.size()));
            if (fresh)
                out.places.push_back(glm::normalize(out.places[a] + out.places[b]));
            return it->second;
        };
        std::vector<std::array<std::uint32_t, 3>> finer;
        for (const auto& [a, b, c] : out.triangles) {
            const std::uint32_t ab = half(a, b), bc = half(b, c), ca = half(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        out.triangles = std::move(finer);
    }
    return out;
}

/// A lump of leaves about a centre, rough by a fifth of its radius.
void append_clump(TriangleSoup& soup, const glm::dvec3& centre, const glm::dvec3& radii, const PlantBox& bounds, int times, Stuff stuff,
                  Dice& dice) {
    const Ball shape = ball(times);
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    std::vector<glm::dvec3> normals(shape.places.size(), glm::dvec3(0.0));
    for (const glm::dvec3& p : shape.places) {
        const glm::dvec3 at = bounds.kept(centre + radii * p * dice.between(0.72, 1.08));
        soup.vertices.push_back({at, {}, leaf_place(at)});
    }
    for (const auto& [a, b, c] : shape.triangles) {
        const auto at = [&](std::uint32_t i) { return soup.vertices[first + i].position_m; };
        const glm::dvec3 normal = glm::cross(at(b) - at(a), at(c) - at(a));
        for (const std::uint32_t i : {a, b, c})
            normals[i] += normal;
        if (glm::length(normal) > 1e-9)
            soup.triangles.push_back({{first + a, first + b, first + c}, index_of(stuff)});
    }
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const double length = glm::length(normals[i]);
        soup.vertices[first + i].normal = length > 1e-9 ? normals[i] / length : shape.places[i];
    }
}

/// A twig of leaves as a flat triangle with two sides, 1 cm apart.
void append_sprig(TriangleSoup& soup, const glm::dvec3& at, const glm::dvec3& outward, double size_m, const PlantBox& bounds, Stuff stuff,
                  Dice& dice) {
    const double any_z = dice.between(-1, 1), any_y = dice.between(-1, 1), any_x = dice.between(-1, 1);
    const glm::dvec3 any = glm::normalize(glm::dvec3(any_x, any_y, any_z) + 0.01 * outward);
    const glm::dvec3 along = glm::normalize(outward + 0.8 * any), across = glm::normalize(glm::cross(along, any + glm::dvec3(0, 0, 1e-3)));
    const std::array<glm::dvec3, 3> flat{bounds.kept(at - 0.5 * size_m * across), bounds.kept(at + 0.4 * size_m * across),
                                         bounds.kept(at + size_m * along + dice.between(-0.3, 0.3) * size_m * across)};
    const glm::dvec3 normal = glm::cross(flat[1] - flat[0], flat[2] - flat[0]);
    if (glm::length(normal) < 1e-4)
        return;
    const glm::dvec3 half = 0.005 * glm::normalize(normal);
    const std::size_t before = soup.vertices.size();
    soup.add({bounds.kept(flat[0] + half), bounds.kept(flat[1] + half), bounds.kept(flat[2] + half)}, index_of(stuff));
    soup.add({bounds.kept(flat[0] - half), bounds.kept(flat[2] - half), bounds.kept(flat[1] - half)}, index_of(stuff));
    for (std::size_t i = before; i < soup.vertices.size(); ++i)
        soup.vertices[i].uv = leaf_place(soup.vertices[i].position_m);
}

/// Where leaves hang about a clump's rim.
void append_sprigs(TriangleSoup& soup, int count, const glm::dvec3& centre, const glm::dvec3& radii, double size_m, const PlantBox& bounds,
                   Stuff stuff, Dice& dice) {
    for (int i = 0; i < count; ++i) {
        const double z = dice.between(-0.8, 1.0), angle = 2.0 * pi * dice.share(), level = std::sqrt(1.0 - z * z);
        const glm::dvec3 out(level * std::cos(angle), level * std::sin(angle), z);
        const double own_size_m = size_m * dice.between(0.7, 1.3);
        append_sprig(soup, centre + radii * out * dice.between(0.80, 0.98), out, own_size_m, bounds, stuff, dice);
    }
}

/// Skirts of boughs, each a star under the tip of the next lower one.
void append_spruce(DressedObject& out, double height_m, double radius_m, Dice& dice) {
    constexpr int tiers = 6, points = 7;
    const double free_m = 0.25 * height_m, tall = (height_m - free_m) / tiers;
    for (int tier = 0; tier < tiers; ++tier) {
        const double low = free_m + tier * tall, share = 1.0 - tier / (tiers + 0.3), tip = std::min(height_m, low + 2.0 * tall);
        std::vector<glm::dvec3> rim;
        const double turn = 2.0 * pi * dice.share();
        for (int k = 0; k < 2 * points; ++k) {
            const double angle = turn + pi * k / points;
            const double r = radius_m * share * (k % 2 == 0 ? dice.between(0.85, 1.0) : dice.between(0.45, 0.6));
            rim.emplace_back(r * std::cos(angle), r * std::sin(angle), low + (k % 2 == 0 ? 0.0 : 0.25 * tall) + 0.1 * tall * dice.share());
        }
        const glm::dvec3 top(0.0, 0.0, tip), inside(0.0, 0.0, low + 0.45 * tall);
        for (std::size_t k = 0; k < rim.size(); ++k) {
            const glm::dvec3 &a = rim[k], &b = rim[(k + 1) % rim.size()];
            for (const std::array<glm::dvec3, 3>& t : {std::array{a, b, top}, std::array{b, a, inside}}) {
                const std::size_t before = out.high.vertices.size();
                out.high.add(t, index_of(Stuff::needles));
                for (std::size_t i = before; i < out.high.vertices.size(); ++i)
                    out.high.vertices[i].uv = leaf_place(out.high.vertices[i].position_m);
            }
        }
    }
}

} // namespace

DressedObject dressed_tree(double height_m, double radius_m, Dice dice, Detail detail) {
    DressedObject out;
    out.closed = true;
    out.has_places = true;
    const bool near = detail == Detail::near, spruce = dice.share() < 0.25;
    const double free_m = 0.25 * height_m, foot_m = 0.025 * height_m;
    const PlantBox bounds{radius_m, height_m};
    // About as thick as the plain trunk, slightly bent; roots spread at its foot.
    const double bend_y = dice.between(-1, 1), bend_x = dice.between(-1, 1);
    const glm::dvec2 bend = 0.35 * foot_m * glm::dvec2(bend_x, bend_y);
    std::vector<TubeRing> trunk;
    for (const double z_m : {0.0, 0.4, 0.7, 1.2, 2.4})
        if (z_m < free_m - 0.3 && (near || z_m == 0.0 || z_m == 1.2)) {
            const double flare = std::exp(-std::max(0.0, z_m - 0.45) / 0.30), up = z_m / free_m;
            trunk.push_back({{glm::dvec2(std::sin(pi * up)) * bend, z_m},
                             std::min(foot_m * (0.94 - 0.14 * up + 0.5 * flare), radius_m),
                             0.10 + 0.25 * flare});
        }
    trunk.push_back({{0, 0, free_m}, 0.80 * foot_m, 0.10});
    append_tube(out.low, trunk, near ? 10 : 6, Stuff::bark);
    const double lean_x = 0.1 * radius_m * dice.between(-1, 1), lean_y = 0.1 * radius_m * dice.between(-1, 1);
    const glm::dvec3 fork(0, 0, free_m), top(lean_x, lean_y, 0.8 * height_m);
    append_tube(out.high, {{fork, 0.80 * foot_m, 0.10}, {0.5 * (fork + top), 0.55 * foot_m}, {top, 0.2 * foot_m}}, near ? 7 : 5,
                Stuff::bark);
    if (spruce) {
        append_spruce(out, height_m, radius_m, dice);
        return out;
    }
    const Stuff leaves = dice.share() < 0.7 ? Stuff::leaves : Stuff::dry_leaves;
    constexpr int boughs = 6;
    const double turn = 2.0 * pi * dice.share(), sprig_m = std::clamp(0.20 * radius_m, 0.3, 0.6);
    const auto clump = [&](const glm::dvec3& centre, double size) {
        const glm::dvec3 radii(size * radius_m, size * radius_m, std::min(size * radius_m * 1.15, 0.22 * height_m));
        Dice own = dice.fork();
        append_clump(out.high, centre, radii, bounds, 1, leaves, own);
        if (near)
            append_sprigs(out.high, 3, centre, radii, sprig_m, bounds, leaves, own);
    };
    for (int i = 0; i < boughs; ++i) {
        const double angle = turn + 2.0 * pi * i / boughs + dice.between(-0.3, 0.3), up = dice.between(0.0, 1.0);
        const double reach = radius_m * (0.62 - 0.18 * up);
        const glm::dvec3 to(reach * std::cos(angle), reach * std::sin(angle), free_m + (0.22 + 0.38 * up) * (height_m - free_m));
        clump(to, dice.between(0.36, 0.48));
    }
    clump({lean_x, lean_y, height_m - 0.2 * (height_m - free_m)}, 0.5);
    clump({lean_x, lean_y, free_m + 0.52 * (height_m - free_m)}, 0.55);
    return out;
}

DressedObject dressed_bush(double height_m, double radius_m, Dice dice) {
    DressedObject out;
    out.closed = true;
    out.has_places = true;
    const PlantBox bounds{radius_m, height_m};
    const Stuff leaves = dice.share() < 0.7 ? Stuff::hedge : Stuff::dry_leaves;
    for (int i = 0; i < 3; ++i) {
        const double angle = 2.0 * pi * (i / 3.0 + 0.1 * dice.share());
        const glm::dvec3 centre(0.4 * radius_m * std::cos(angle), 0.4 * radius_m * std::sin(angle), height_m * dice.between(0.35, 0.5));
        const glm::dvec3 radii(0.6 * radius_m, 0.6 * radius_m, 0.55 * height_m);
        append_clump(out.low, centre, radii, bounds, 1, leaves, dice);
        append_sprigs(out.low, 4, centre, radii, std::min(0.35, 0.35 * radius_m), bounds, leaves, dice);
    }
    return out;
}

DressedObject dressed_tuft(double height_m, Dice dice) {
    DressedObject out;
    for (int i = 0; i < 5; ++i) {
        // Blades bend towards one way along x or the other: who drives along it sees their faces.
        const double bent = dice.between(-1.1, 1.1), angle = bent + (dice.share() < 0.5 ? pi : 0.0),
                     lean = dice.between(0.1, 0.7) * height_m;
        const glm::dvec3 forward(std::cos(angle), std::sin(angle), 0.0),
            across = dice.between(0.008, 0.020) * glm::dvec3(-forward.y, forward.x, 0.0);
        const double foot_y = 0.3 * (dice.share() - 0.5), foot_x = 0.3 * (dice.share() - 0.5);
        const glm::dvec3 foot(foot_x, foot_y, 0.0), tip = foot + lean * forward + glm::dvec3(0, 0, height_m * dice.between(0.5, 1.0));
        // Its normal is the ground's: with both of its sides it returns light as that does, and the ground before it does not shade it.
        const std::size_t before = out.low.vertices.size();
        out.low.add({foot + across, foot - across, tip}, index_of(Stuff::grass));
        for (std::size_t k = before; k < out.low.vertices.size(); ++k)
            out.low.vertices[k].normal = {0.0, 0.0, 1.0};
    }
    return out;
}

DressedObject dressed_hedge(double length_m, double width_m, double height_m, double fall_m, Dice dice) {
    DressedObject out;
    out.closed = true;
    out.has_places = true;
    const int stations = std::max(2, static_cast<int>(length_m / 0.7) + 1);
    std::vector<Outline> rings;
    for (int i = 0; i < stations; ++i) {
        const double x = length_m * (static_cast<double>(i) / (stations - 1) - 0.5), half = 0.5 * width_m;
        const auto rough = [&](double y, double z) {
            const double own_z = z > 0.0 ? z * dice.between(0.93, 1.0) : z;
            return glm::dvec3(x, y * dice.between(0.86, 1.0), own_z);
        };
        rings.push_back({rough(-half, -fall_m), rough(-half, 0.55 * height_m), rough(-0.8 * half, height_m), rough(0.8 * half, height_m),
                         rough(half, 0.55 * height_m), rough(half, -fall_m)});
    }
    append_loft(out.low, rings, index_of(Stuff::hedge), [](std::size_t, std::size_t) { return index_of(Stuff::hedge); });
    smooth(out.low, radians(50.0));
    for (SoupVertex& v : out.low.vertices)
        v.uv = leaf_place(v.position_m);
    const PlantBox bounds{length_m, height_m};
    for (int i = 0; i < 5 * stations; ++i) { // shoots since it was clipped
        const double x = length_m * dice.between(-0.48, 0.48), side = dice.share();
        const glm::dvec3 at(x,
                            width_m * (side < 0.35  ? -0.42
                                       : side < 0.7 ? 0.42
                                                    : dice.between(-0.4, 0.4)),
                            height_m * (side < 0.7 ? dice.between(0.1, 0.9) : 0.9));
        append_sprig(out.low, at,
                     side < 0.35  ? glm::dvec3(0, -1, 0.3)
                     : side < 0.7 ? glm::dvec3(0, 1, 0.3)
                                  : glm::dvec3(0, 0, 1),
                     0.12, bounds, Stuff::hedge, dice);
    }
    return out;
}

} // namespace fernlicht
