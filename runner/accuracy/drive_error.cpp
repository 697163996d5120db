#include "runner/accuracy/drive_error.h"

#include "renderer/reference/reference.h"
#include "runner/accuracy/picture_errors.h"
#include "runner/bench/bench_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr int most_moments = 3, most_width_px = 192, most_height_px = 144, most_samples = 128;

/// In the same shape, with at most so many pixels each way.
View small_enough(const View& view) {
    const double factor =
        std::min({1.0, static_cast<double>(most_width_px) / view.width_px, static_cast<double>(most_height_px) / view.height_px});
    const auto fewer = [&](int pixels) { return std::max(1, static_cast<int>(std::lround(pixels * factor))); };
    return resized(view, fewer(view.width_px), fewer(view.height_px));
}

} // namespace

std::string no_drive_error(const Drive& drive, const PlayedVariant& played) {
    if (!technique_named(drive.technique).illuminance)
        return fmt::format("technique {} does not compute an illuminance", drive.technique);
    if (!driver_view(drive))
        return "the drive has only maps";
    return played.ticks_done > 0 ? "" : "nothing was played";
}

DriveError measure_drive_error(const Stage& stage, const Variant& variant, const PlayedVariant& played, int first_tick,
                               Renderer& renderer) {
    const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    const View view = small_enough(*driver_view(stage.drive));
    DriveError error;
    error.width_px = view.width_px;
    error.height_px = view.height_px;
    for (const int tick : ticks_over(played.ticks_done, std::min(most_moments, played.ticks_done)))
        error.ticks.push_back(first_tick + tick);
    ReferenceSettings settings;
    settings.most_samples = most_samples;
    settings.shadows = stage.drive.shadows;
    settings.seed = stage.drive.seed;
    const Reference reference(stage.scene);
    PixelErrorFold road(ErrorRule{settings.floor_lx}), whole(ErrorRule{settings.floor_lx});
    const std::vector<Moment> moments = moments_at(error.ticks, stage, variant);
    for (std::size_t m = 0; m < moments.size(); ++m) {
        const Frame frame = renderer.draw(moments[m], view, {.illuminance = true, .depth = true, .ids = true});
        const ReferenceImage image = reference.render(moments[m], view, {.illuminance = true}, settings);
        const Image<float> areas = road_areas_m2(stage.scene, moments[m], view, frame);
        add_pixels(road, frame.illuminance_lx, image.illuminance_lx, &areas, static_cast<int>(m));
        add_pixels(whole, frame.illuminance_lx, image.illuminance_lx, nullptr, static_cast<int>(m));
        error.rays += image.rays;
    }
    error.road = road.finish();
    error.whole = whole.finish();
    error.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return error;
}

} // namespace fernlicht
