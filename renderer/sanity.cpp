
#include "renderer/renderer.h"
#include "scenarios/drives/play/camera.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

constexpr double intensity = 6250.0, distance_m = 25.0;

Scene wall() {
    Mesh mesh{"wall", {distance_m, 0.0, 0.0}, {}, {0, 1, 2, 0, 2, 3}, {{0, 0, 6}}};
    const glm::vec3 to_lamp{-1.0F, 0.0F, 0.0F};
    mesh.vertices = {{{0.0F, 20.0F, -20.0F}, to_lamp},
                     {{0.0F, 20.0F, 20.0F}, to_lamp},
                     {{0.0F, -20.0F, 20.0F}, to_lamp},
                     {{0.0F, -20.0F, -20.0F}, to_lamp}};
    return {{Material{}}, {mesh}, {}};
}

Moment lit_by_one_lamp() {
    auto file = std::make_shared<LampFile>();
    file->name = "constant intensity";
    file->table = {{-30.0, 30.0}, {-30.0, 30.0}, {intensity, intensity, intensity, intensity}, {}, BetweenSamples::linear_cd};
    Moment moment;
    moment.lamps.push_back({"lamp", file, Pose{}, 1.0, LampColour{}, 0.0});
    return moment;
}

} // namespace

double check_sanity(Device& device) {
    const Scene scene = wall();
    const Moment moment = lit_by_one_lamp();
    RendererSettings settings;
    settings.shadows.width = settings.shadows.height = 64;
    Renderer renderer(device, scene, settings);
    View view;
    view.width_px = 48;
    view.height_px = 32;
    view.vertical_fov_rad = radians(30.0);
    const Frame frame = renderer.draw(moment, view, {.illuminance = true});
    const Camera camera = camera_of(moment, view);
    const auto expected_lx = [&](double x, double y) {
        const double cosine = pixel_ray(camera, view, x, y).direction.x;
        return intensity * cosine * cosine * cosine / (distance_m * distance_m);
    };
    const double place_px = device.info().software ? 0.0 : sanity_place_px;
    double worst = 0.0;
    for (int y = 0; y < view.height_px; ++y)
        for (int x = 0; x < view.width_px; ++x) {
            const double expected = expected_lx(x + 0.5, y + 0.5), found = static_cast<double>(frame.illuminance_lx.at(x, y));
            double low = expected, high = expected; // of what the pixel may show where vertices stand beside their places
            for (const double dx : {-place_px, place_px})
                for (const double dy : {-place_px, place_px}) {
                    low = std::min(low, expected_lx(x + 0.5 + dx, y + 0.5 + dy));
                    high = std::max(high, expected_lx(x + 0.5 + dx, y + 0.5 + dy));
                }
            const double error = std::max(low - found, found - high) / expected;
            if (!(error <= sanity_bound))
                throw DeviceError(fmt::format(
                    "{} computes light wrongly: a wall at 25 m before a lamp of 6250 cd should have {} lx at pixel ({}, {}), it has {}",
                    device.info().gl_renderer, expected, x, y, found));
            worst = std::max(worst, error);
        }
    return worst;
}

} // namespace fernlicht
