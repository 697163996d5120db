#include "renderer/reference/scattering.h"

#include "renderer/reference/surface_response.h"
#include "scenarios/light/fog_light.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht::reference {
namespace {

constexpr double nearest_pass_m = 1e-3; // as fog_light.cpp has it

/// The part of a ray that lies before the lamp: the only one that it lights.
struct LitPart {
    double begin_m = 0.0, end_m = 0.0;
};
LitPart before_lamp(const LitLamp& lamp, const glm::dvec3& lamp_m, const Ray& ray, double way_m) {
    const glm::dvec3 forward = lamp.pose.forward();
    const double at = glm::dot(ray.origin_m - lamp_m, forward), slope = glm::dot(ray.direction, forward);
    const double crossing = slope != 0.0 ? -at / slope : -1.0;
    if (at > 0.0)
        return {0.0, slope < 0.0 ? std::min(way_m, crossing) : way_m};
    return slope > 0.0 ? LitPart{crossing, way_m} : LitPart{};
}

} // namespace

double left_on_way_to_eye(const Shot& shot, const glm::dvec3& point_m) {
    if (!is_in_air(shot) || shot.camera.is_map)
        return 1.0;
    return air_transmittance(shot.moment.weather, glm::length(shot.to_eye(point_m)));
}

glm::dvec3 airlight(const Shot& shot, const glm::dvec3& eye_m, const glm::dvec3& end_m) {
    glm::dvec3 sum(0.0);
    const glm::dvec3& origin_m = shot.embree.origin_m();
    for (const LitLamp& lamp : shot.moment.lamps)
        sum += lamp.colour.linear_srgb * airlight_cdm2(lamp, shot.moment.weather, origin_m + eye_m, origin_m + end_m);
    return sum;
}

glm::dvec3 through_air(const Shot& shot, const Ray& ray, const glm::dvec3& end_m, const glm::dvec3& light) {
    const Weather& weather = shot.moment.weather;
    if (!is_in_air(shot) || shot.camera.is_map)
        return light;
    const double way = glm::length(end_m - ray.origin_m);
    const glm::dvec3 behind = light * air_transmittance(weather, way) + sky_airlight_cdm2(shot.moment.daylight, weather, way);
    return shot.settings.integrator == Integrator::path ? behind : behind + airlight(shot, ray.origin_m, end_m);
}

glm::dvec3 lamps_in_air(const Shot& shot, const Ray& ray, double way_m, const SamplePoint& point, std::size_t pair, std::uint64_t& rays) {
    const Weather& weather = shot.moment.weather;
    glm::dvec3 sum(0.0);
    for (const LitLamp& lamp : shot.moment.lamps) {
        const double choice = point.pair(pair).x;
        const glm::dvec3 lamp_m = lamp_point_m(shot, lamp, point, pair + 1);
        pair += 2;
        const LitPart lit = before_lamp(lamp, lamp_m, ray, way_m);
        if (lit.end_m <= lit.begin_m)
            continue;
        const double nearest_m = glm::dot(lamp_m - ray.origin_m, ray.direction),
                     apart_m = std::max(glm::length(ray.origin_m + nearest_m * ray.direction - lamp_m), nearest_pass_m),
                     first = std::atan((lit.begin_m - nearest_m) / apart_m), last = std::atan((lit.end_m - nearest_m) / apart_m),
                     beyond_m = apart_m * std::tan(first + choice * (last - first)),
                     at_m = std::clamp(nearest_m + beyond_m, lit.begin_m, lit.end_m);
        const glm::dvec3 place_m = ray.origin_m + at_m * ray.direction, from_lamp = place_m - lamp_m;
        const double e = facing_lx(lamp, lamp_m, place_m), d2 = glm::dot(from_lamp, from_lamp);
        if (!(e > 0.0) || !(d2 > 0.0))
            continue;
        if (shot.settings.shadows) {
            ++rays;
            if (!shot.embree.visible(place_m, lamp_m))
                continue;
        }
        // E dt = I / d^2 dt = I / apart d(angle); within a millimetre of the lamp as if that far away.
        const double cd = e * d2, d = std::sqrt(d2);
        sum += lamp.colour.linear_srgb * (weather.extinction_per_m * weather.scattering_albedo * (last - first) / apart_m * cd *
                                          photometry::henyey_greenstein(-glm::dot(from_lamp, ray.direction) / d, weather.asymmetry) *
                                          air_transmittance(weather, d + at_m));
    }
    return sum;
}

glm::dvec3 sample_henyey_greenstein(const glm::dvec3& along, double g, const glm::dvec2& square) {
    double cosine = 1.0 - 2.0 * square.x;
    if (std::abs(g) > 1e-3) {
        const double s = (1.0 - g * g) / (1.0 + g - 2.0 * g * square.x);
        cosine = std::clamp((1.0 + g * g - s * s) / (2.0 * g), -1.0, 1.0);
    }
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine)), turn = 2.0 * pi * square.y;
    const auto [u, v] = across(along);
    return glm::normalize(along * cosine + (u * std::cos(turn) + v * std::sin(turn)) * sine);
}

} // namespace fernlicht::reference
