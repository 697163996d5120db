#include "runner/experiments/accuracy/drive_error.h"

#include "renderer/reference/reference.h"
#include "renderer/technique.h"
#include "runner/experiments/accuracy/picture_errors.h"
#include "runner/experiments/bench/bench_run.h"
#include "runner/play/extent_fold.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr int max_moments = 3, max_width_px = 192, max_height_px = 144, max_samples = 64, fewer_samples = 32;

/// In the same shape, with at most so many pixels each way.
View small_enough(const View& view) {
    const double factor =
        std::min({1.0, static_cast<double>(max_width_px) / view.width_px, static_cast<double>(max_height_px) / view.height_px});
    const auto fewer = [&](int pixels) { return std::max(1, static_cast<int>(std::lround(pixels * factor))); };
    return at_size(view, fewer(view.width_px), fewer(view.height_px));
}

ReferenceSettings settings_for(const Drive& drive) {
    ReferenceSettings settings;
    settings.max_samples = max_samples;
    settings.shadows = drive.shadows.objects_cast;
    settings.lamp_radius_m = lamp_disc_radius_m(drive);
    settings.seed = drive.seed;
    if (drive.extent)
        settings.target_height_m = drive.extent->target_height_m;
    return settings;
}

/// In the middle moment alone, with half the samples, as each costs rays of its own. Pixels of another size would be off by other errors.
void add_target_and_luminance(const Stage& stage, const std::vector<Moment>& moments, const View& view, const Reference& reference,
                              Renderer& renderer, DriveError& error) {
    const Technique& technique = renderer.technique();
    error.no_target = technique.target ? "" : fmt::format("technique {} does not compute the illuminance of targets", technique.name);
    error.no_luminance = technique.luminance ? "" : fmt::format("technique {} does not compute a luminance", technique.name);
    const FrameOutputs outputs{.target = technique.target, .luminance = technique.luminance};
    if (!outputs.target && !outputs.luminance)
        return;
    ReferenceSettings settings = settings_for(stage.drive);
    settings.max_samples = fewer_samples;
    const std::size_t middle = moments.size() / 2;
    FrameOutputs drawn = outputs;
    drawn.depth = drawn.ids = true;
    const Frame frame = renderer.draw(moments[middle], view, drawn);
    const ReferenceImage image = reference.render(moments[middle], view, outputs, settings);
    const Image<float> areas = road_areas_m2(stage.scene, moments[middle], view, frame);
    PixelErrorFold target(ErrorRule{settings.floor_lx}), luminance(ErrorRule{settings.floor_cdm2});
    if (outputs.target)
        add_pixels(target, frame.target_lx, image.target_lx, &areas, static_cast<int>(middle));
    if (outputs.luminance)
        add_pixels(luminance, frame.luminance_cdm2, image.luminance_cdm2, nullptr, static_cast<int>(middle));
    error.target = target.finish();
    error.luminance = luminance.finish();
    error.rays += image.rays;
}

/// What the run measured of these moments against a map of the reference's, one ray a pixel: a lux map has no noise then, and its pixels of
/// a quarter of a metre are their centres to some millimetres of reach. Lamps are points: discs would bring noise and 16 times the rays.
std::vector<ReachError> errors_of_reach(const Stage& stage, const PlayedCell& played, const std::vector<Moment>& moments,
                                        const Reference& reference, DriveError& error) {
    ReferenceSettings settings = settings_for(stage.drive);
    settings.footprint = Footprint::centre;
    settings.lamp_radius_m = 0.0;
    const Draw draw = drawn_by(reference, settings, [&](const ReferenceImage& image) { error.rays += image.rays; });
    const ExtentFold fold(stage.drive, stage.route);
    std::vector<std::vector<LaneExtent>> tested, truth;
    for (const Moment& moment : moments)
        if (const auto row = std::ranges::find(played.extents, moment.tick, &ExtentRow::tick); row != played.extents.end()) {
            tested.push_back(row->rendered);
            truth.push_back(fold.rendered(fold.draw(moment, draw)));
        }
    return reach_errors(tested, truth, stage.drive.extent->thresholds_lx, played.no_road_lx, played.no_target_lx);
}

} // namespace

std::string no_drive_error(const Drive& drive, const PlayedCell& played) {
    if (!technique_named(drive.technique).illuminance)
        return fmt::format("technique {} does not compute an illuminance", drive.technique);
    if (!driver_view(drive))
        return "the drive has only maps";
    return played.ticks_done > 0 ? "" : "nothing was played";
}

DriveError measure_drive_error(const Stage& stage, const LampSet& lamp_set, const PlayedCell& played, int first_tick, Renderer& renderer) {
    const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    const View view = small_enough(*driver_view(stage.drive));
    DriveError error;
    error.width_px = view.width_px;
    error.height_px = view.height_px;
    error.lamp_radius_m = lamp_disc_radius_m(stage.drive);
    for (const int tick : ticks_over(played.ticks_done, std::min(max_moments, played.ticks_done)))
        error.ticks.push_back(first_tick + tick);
    const ReferenceSettings settings = settings_for(stage.drive);
    const Reference reference(stage.scene);
    const std::vector<Moment> moments = moments_at(error.ticks, stage, lamp_set);
    PixelErrorFold road(ErrorRule{settings.floor_lx}), whole(road);
    for (std::size_t m = 0; m < moments.size(); ++m) {
        const Frame frame = renderer.draw(moments[m], view, {.illuminance = true, .depth = true, .ids = true});
        const ReferenceImage image = reference.render(moments[m], view, {.illuminance = true}, settings);
        const Image<float> areas = road_areas_m2(stage.scene, moments[m], view, frame);
        const auto picture = static_cast<int>(m);
        PixelErrorFold here(ErrorRule{settings.floor_lx});
        for (PixelErrorFold* const fold : {&road, &here})
            add_pixels(*fold, frame.illuminance_lx, image.illuminance_lx, &areas, picture);
        add_pixels(whole, frame.illuminance_lx, image.illuminance_lx, nullptr, picture);
        if (const auto errors = here.finish(); errors && errors->pixels > 0)
            error.road_p95.push_back(errors->error.p95);
        error.rays += image.rays;
    }
    error.road = road.finish();
    error.whole = whole.finish();
    add_target_and_luminance(stage, moments, view, reference, renderer, error);
    if (stage.drive.extent)
        error.reach = errors_of_reach(stage, played, moments, reference, error);
    error.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return error;
}

double lamp_disc_radius_m(const Drive& drive) {
    const Technique& technique = technique_named(drive.technique, drive.file);
    const bool draws_it = technique.kind == TechniqueKind::ours && technique.name != "photometric-naive";
    return draws_it && drive.shadows.method == ShadowMethod::soft_map ? drive.shadows.lamp_radius_m : 0.0;
}

} // namespace fernlicht
