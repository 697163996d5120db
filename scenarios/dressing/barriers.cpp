#include "scenarios/dressing/dressed_object.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace fernlicht {

DressedObject dressed_fence(double length_m, double height_m, double fall_m) {
    DressedObject out;
    out.closed = true;
    const auto box = [&](double x0, double x1, double y0, double y1, double z0, double z1) {
        append_box(out.low, {x0, y0, z0}, {x1, y1, z1}, index_of(Stuff::wood));
    };
    const double half = 0.5 * length_m;
    const int posts = std::max(2, static_cast<int>(length_m / 2.2) + 1), pickets = static_cast<int>(length_m / 0.30);
    for (int i = 0; i < posts; ++i) {
        const double x = -half + 0.05 + (length_m - 0.1) * i / (posts - 1);
        box(x - 0.05, x + 0.05, -0.05, 0.05, -fall_m, height_m);
    }
    for (const double z : {0.25 * height_m, 0.75 * height_m})
        box(-half, half, -0.02, 0.02, z - 0.04, z + 0.04);
    for (int i = 0; i < pickets; ++i) {
        const double x = -half + (i + 0.5) * length_m / pickets;
        box(x - 0.055, x + 0.055, -0.03, -0.01, 0.06 * height_m, 0.96 * height_m);
    }
    return out;
}

DressedObject dressed_field_fence(double length_m) {
    DressedObject out;
    // Faces that something covers, or that look down, are left out.
    const auto bar = [&](const glm::dvec3& low, const glm::dvec3& high, bool ends) {
        const auto p = [&](int x, int y, int z) { return glm::dvec3((x ? high : low).x, (y ? high : low).y, (z ? high : low).z); };
        const auto quad = [&](const std::array<glm::dvec3, 4>& q) {
            out.low.add({q[0], q[1], q[2]}, index_of(Stuff::wood));
            out.low.add({q[0], q[2], q[3]}, index_of(Stuff::wood));
        };
        quad({p(1, 1, 0), p(0, 1, 0), p(0, 1, 1), p(1, 1, 1)});
        quad({p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1)});
        quad({p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1)});
        if (!ends)
            return;
        quad({p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(1, 0, 1)});
        quad({p(0, 1, 0), p(0, 0, 0), p(0, 0, 1), p(0, 1, 1)});
    };
    bar({-0.5 * length_m, -0.05, -0.4}, {-0.5 * length_m + 0.1, 0.05, 1.15}, true);
    for (const double z : {0.5, 0.95})
        bar({-0.5 * length_m, 0.05, z - 0.05}, {0.5 * length_m, 0.075, z + 0.05}, false);
    return out;
}

DressedObject dressed_guard_rail(double length_m, double width_m, double height_m, bool road_left) {
    DressedObject out;
    // The beam's front, from below: two bulges with a valley between, as shares of depth and height.
    static constexpr std::array<std::array<double, 2>, 10> face{
        {{0.2, 0.0}, {0.75, 0.08}, {1.0, 0.16}, {1.0, 0.30}, {0.1, 0.45}, {0.1, 0.55}, {1.0, 0.70}, {1.0, 0.84}, {0.75, 0.92}, {0.2, 1.0}}};
    const double side = road_left ? 1.0 : -1.0;
    const auto at = [&](std::size_t k, double end) {
        return glm::dvec3(0.5 * end * length_m, side * width_m * (face[k][0] - 0.5), height_m * face[k][1]);
    };
    const auto quad = [&](std::array<glm::dvec3, 4> q) {
        if (!road_left)
            std::swap(q[1], q[3]);
        out.low.add({q[0], q[1], q[2]}, index_of(Stuff::zinc));
        out.low.add({q[0], q[2], q[3]}, index_of(Stuff::zinc));
    };
    for (std::size_t k = 0; k + 1 < face.size(); ++k)
        quad({at(k, 1.0), at(k, -1.0), at(k + 1, -1.0), at(k + 1, 1.0)});
    const auto back = [&](double end, double up) { return glm::dvec3(0.5 * end * length_m, -0.5 * side * width_m, height_m * up); };
    quad({back(-1.0, 0.0), back(1.0, 0.0), back(1.0, 1.0), back(-1.0, 1.0)}); // traffic comes on the other side
    smooth(out.low, radians(50.0));
    return out;
}

DressedObject dressed_bollard(double height_m) {
    DressedObject out;
    constexpr int sides = 10;
    constexpr double radius_m = 0.05;
    const auto band = [&](double low, double high, double radius, Stuff stuff) {
        for (int i = 0; i < sides; ++i) {
            const auto at = [&](int k, double z) {
                const double angle = 2.0 * pi * k / sides;
                return glm::dvec3(radius * std::cos(angle), radius * std::sin(angle), z);
            };
            out.low.add({at(i, low), at(i + 1, low), at(i + 1, high)}, index_of(stuff));
            out.low.add({at(i, low), at(i + 1, high), at(i, high)}, index_of(stuff));
            if (high == height_m)
                out.low.add({at(i, high), at(i + 1, high), {0.0, 0.0, high}}, index_of(stuff));
        }
    };
    band(0.0, height_m, radius_m, Stuff::shutter);
    band(0.75 * height_m, 0.87 * height_m, radius_m + 0.002, Stuff::sheet_white);
    smooth(out.low, radians(50.0));
    return out;
}

} // namespace fernlicht
