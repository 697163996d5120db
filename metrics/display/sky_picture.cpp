#include "metrics/display/sky_picture.h"

#include "scenarios/drives/play/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

namespace fernlicht {
namespace {

constexpr double darkest_twilight_lx = 0.5; // more than the full moon's

} // namespace

Image<glm::vec3> with_night_sky(const Frame& frame, const Moment& moment, const View& view, const NightSky& sky) {
    Image<glm::vec3> light = frame.light;
    const Daylight& daylight = moment.daylight;
    if (view.projection == Projection::map || daylight.sun.illuminance_lx > 0.0 ||
        daylight.horizontal_illuminance_lx > darkest_twilight_lx || moment.weather.extinction_per_m > 0.0)
        return light;
    const Camera camera = camera_of(moment, view);
    const SkyMoon moon{daylight.moon.towards(), daylight.moon.illuminance_lx};
    const glm::vec3 even_sky(static_cast<float>(sky_luminance_cdm2(daylight))); // as renderers clear their picture
    const double pixel_rad = 2.0 * camera.half_extent.y / view.height_px, disc_cdm2 = moon_disc_cdm2(moon);
    tbb::parallel_for(0, light.height(), [&](int y) {
        for (int x = 0; x < light.width(); ++x) {
            if (frame.ids.at(x, y) != 0)
                continue;
            const glm::dvec3 towards = pixel_ray(camera, view, x + 0.5, y + 0.5).direction;
            double cdm2 = night_sky_cdm2(sky, moon, towards);
            if (disc_cdm2 > 0.0 && towards.z > 0.0) { // an edge one pixel wide, so that the disc has its area
                const double from_centre = std::atan2(glm::length(glm::cross(towards, moon.towards)), glm::dot(towards, moon.towards));
                cdm2 += disc_cdm2 * std::clamp((moon_radius_rad - from_centre) / pixel_rad + 0.5, 0.0, 1.0);
            }
            light.at(x, y) = light.at(x, y) - even_sky + glm::vec3(static_cast<float>(cdm2)); // lamps before it stay
        }
    });
    return light;
}

} // namespace fernlicht
