#include "scenarios/light/fog_light.h"

#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

constexpr double nearest_pass_m = 1e-3;
constexpr int max_samples = 65'536;

/// A ray past a lamp, in lamp space: angles at the lamp between which it runs before the lamp.
struct Pass {
    glm::dvec3 along{0.0}, nearest{0.0}; ///< unit
    double apart_m = 0.0, nearest_along_m = 0.0, first_rad = 0.0, last_rad = 0.0;
    bool lit = false;
};

Pass pass_of(const LitLamp& lamp, const glm::dvec3& eye_m, const glm::dvec3& point_m) {
    const auto local = [&](const glm::dvec3& m) {
        return photometry::lamp_space(m - lamp.pose.position_m, -lamp.pose.left(), lamp.pose.up(), lamp.pose.forward());
    };
    const glm::dvec3 eye = local(eye_m), ray = local(point_m) - eye;
    const double way = glm::length(ray);
    Pass pass;
    if (!(way > 0.0))
        return pass;
    pass.along = ray / way;
    const double begin = eye.z > 0.0 ? 0.0 : pass.along.z > 0.0 ? -eye.z / pass.along.z : way;
    const double end = pass.along.z < 0.0 ? std::min(way, -eye.z / pass.along.z) : way;
    pass.lit = end > begin;
    pass.nearest_along_m = -glm::dot(eye, pass.along);
    const glm::dvec3 nearest = eye + pass.nearest_along_m * pass.along;
    pass.apart_m = std::max(glm::length(nearest), nearest_pass_m);
    pass.nearest = nearest / pass.apart_m;
    pass.first_rad = std::atan((begin - pass.nearest_along_m) / pass.apart_m);
    pass.last_rad = std::atan((end - pass.nearest_along_m) / pass.apart_m);
    return pass;
}

double sum_of(const LitLamp& lamp, const Weather& weather, const Pass& pass, int samples) {
    const double span = pass.last_rad - pass.first_rad;
    double sum = 0.0;
    for (int k = 0; k < samples; ++k) {
        const double x = 1.0 - (k + 0.5) / samples, angle = pass.last_rad - span * x * std::sqrt(x);
        const double s = std::sin(angle), c = std::max(std::cos(angle), 1e-9);
        const glm::dvec3 direction = pass.nearest * c + pass.along * s;
        if (direction.z <= 0.0)
            continue;
        const glm::dvec2 at = photometry::goniometer_angles(direction);
        const double cd = lamp.intensity_factor * intensity_cd(lamp.file->table, degrees(at.x), degrees(at.y));
        if (cd > 0.0)
            sum += std::sqrt(x) * photometry::scattered_towards_eye(cd, s, c, pass.apart_m, pass.nearest_along_m, weather.extinction_per_m,
                                                                    weather.asymmetry);
    }
    return weather.extinction_per_m * weather.scattering_albedo * sum * 1.5 * span / (samples * pass.apart_m);
}

bool scatters(const LitLamp& lamp, const Weather& weather) {
    return lamp.intensity_factor > 0.0 && weather.extinction_per_m * weather.scattering_albedo > 0.0;
}

} // namespace

double air_transmittance(const Weather& weather, double distance_m) {
    return weather.extinction_per_m > 0.0 ? photometry::transmittance(weather.extinction_per_m, distance_m) : 1.0;
}

double airlight_cdm2(const LitLamp& lamp, const Weather& weather, const glm::dvec3& eye_m, const glm::dvec3& point_m, double relative) {
    if (!scatters(lamp, weather))
        return 0.0;
    const Pass pass = pass_of(lamp, eye_m, point_m);
    if (!pass.lit)
        return 0.0;
    double sum = sum_of(lamp, weather, pass, 256);
    int agreed = 0; // beams have kinks: once may be by chance
    for (int samples = 512; samples <= max_samples && agreed < 2; samples *= 2) {
        const double finer = sum_of(lamp, weather, pass, samples);
        agreed = std::abs(finer - sum) <= relative * finer ? agreed + 1 : 0;
        sum = finer;
    }
    return sum;
}

double airlight_cdm2(const LitLamp& lamp, const Weather& weather, const glm::dvec3& eye_m, const glm::dvec3& point_m, int samples) {
    if (!scatters(lamp, weather))
        return 0.0;
    const Pass pass = pass_of(lamp, eye_m, point_m);
    return pass.lit ? sum_of(lamp, weather, pass, samples) : 0.0;
}

double sky_airlight_cdm2(const Daylight& daylight, const Weather& weather, double distance_m) {
    return sky_luminance_cdm2(daylight) * (1.0 - air_transmittance(weather, distance_m));
}

} // namespace fernlicht
