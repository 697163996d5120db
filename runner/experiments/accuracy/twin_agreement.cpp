#include "runner/experiments/accuracy/twin_agreement.h"

#include "scenarios/drives/play/camera.h"
#include "scenarios/light/light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

/// What an angle may be off by: Mesa's atan, 2.2e-6 rad, doubled, and a position's 1e-6 of the distance seen from the lamp
/// (renderer/twin.h).
constexpr double angle_error_rad = 6e-6;
/// 24 operations of 6e-8, and the position's 1e-6 in the third power, over a cosine of a tenth; grazing more.
constexpr double rounding = 1.5e-5;
constexpr double steep_per_rad = 50.0;

/// d ln E / d angle by the beams at a point, each lamp's in the measure of its light; the larger of both ways of two directions, summed.
double gradient_per_rad(const Moment& moment, const glm::dvec3& point_m) {
    double weighted = 0.0, all = 0.0;
    for (const LitLamp& lamp : moment.lamps) {
        const glm::dvec3 away = point_m - lamp.pose.position_m;
        const double d = glm::length(away), cd = intensity_towards_cd(lamp, point_m);
        if (cd <= 0.0)
            continue;
        const double step_rad = 1.75e-4, step_m = step_rad * d; // a hundredth of a degree
        const auto change = [&](const glm::dvec3& axis) {
            return std::max(std::abs(intensity_towards_cd(lamp, point_m + axis * step_m) - cd),
                            std::abs(intensity_towards_cd(lamp, point_m - axis * step_m) - cd)) /
                   (cd * step_rad);
        };
        weighted += cd / (d * d) * (change(lamp.pose.left()) + change(lamp.pose.up()));
        all += cd / (d * d);
    }
    return all > 0.0 ? weighted / all : 0.0;
}

} // namespace

void TwinAgreementFold::add(const Moment& moment, const View& view, const Frame& frame, const ReferenceImage& twin,
                            const ReferenceImage& edges, int picture) {
    const Camera camera = camera_of(moment, view);
    for (int y = 0; y < view.height_px; ++y)
        for (int x = 0; x < view.width_px; ++x) {
            const double right = static_cast<double>(twin.illuminance_lx.mean.at(x, y)),
                         tested = static_cast<double>(frame.illuminance_lx.at(x, y));
            if (right < least_lx_)
                continue;
            if (frame.ids.at(x, y) != twin.ids.at(x, y) || (edges.mixed.at(x, y) & several_surfaces) != 0) {
                ++counts_.several_surfaces;
                continue;
            }
            if ((edges.mixed.at(x, y) & shadow_edge) != 0) {
                ++counts_.shadow_edges;
                continue;
            }
            const Ray ray = pixel_ray(camera, view, x + 0.5, y + 0.5);
            const glm::dvec3 point_m = moment.ego.position_m + ray.origin_m +
                                       ray.direction * (static_cast<double>(frame.depth_m.at(x, y)) / glm::dot(ray.direction, camera.axis));
            const double gradient = gradient_per_rad(moment, point_m);
            if (gradient < steep_per_rad) {
                flat_.add({tested, right, 0.0, {}, picture, x, y});
                continue;
            }
            const double allowed = gradient * angle_error_rad + rounding, ratio = std::abs(tested - right) / right / allowed;
            of_bound_.add({1.0 + ratio, 1.0, 0.0, {}, picture, x, y});
            within_ += ratio <= 1.0 ? 1U : 0U;
        }
}

TwinAgreement TwinAgreementFold::finish() const {
    TwinAgreement found = counts_;
    found.flat = flat_.finish();
    found.steep_of_bound = of_bound_.finish();
    found.steep_within = within_;
    return found;
}

} // namespace fernlicht
