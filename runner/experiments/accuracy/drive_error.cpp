#include "runner/experiments/accuracy/drive_error.h"

#include "metrics/images/tile_sample.h"
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

constexpr int max_moments = 3, max_width_px = 192, max_height_px = 144, max_samples = 64;
/// Small tiles tell more for as many pixels, as what one pixel is off by its neighbours are too.
constexpr int tile_px = 4, first_rounds = 8, most_of_it = 3; // at most a third of all tiles

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

/// Moments as the technique draws them beside the reference's tiles of them.
class ComparedTiles {
  public:
    ComparedTiles(const Stage& stage, const std::vector<Moment>& moments, const View& view, const Reference& reference, Renderer& renderer)
        : moments_(moments), view_(view), reference_(reference), settings_(settings_for(stage.drive)), across_(tiles_along(view.width_px)),
          down_(tiles_along(view.height_px)), order_(sampling_order(static_cast<int>(moments.size()), across_, down_, stage.drive.seed)) {
        const Technique& technique = renderer.technique();
        outputs_ = {.illuminance = true, .target = technique.target, .luminance = technique.luminance};
        FrameOutputs drawn = outputs_;
        drawn.depth = drawn.ids = true;
        for (const Moment& moment : moments) {
            frames_.push_back(renderer.draw(moment, view, drawn));
            areas_.push_back(road_areas_m2(stage.scene, moment, view, frames_.back()));
        }
        images_.resize(moments.size());
    }

    int rounds() const { return across_ * static_cast<int>(moments_.size()); }

    /// The errors of so many rounds of tiles.
    void compare(int rounds, DriveError& error) {
        const auto count = static_cast<std::size_t>(rounds * down_);
        draw(count);
        PixelErrorFold road(ErrorRule{settings_.floor_lx}), whole(road), target(road), luminance(ErrorRule{settings_.floor_cdm2});
        std::vector<PixelErrorFold> of_moment(moments_.size(), road);
        for (std::size_t t = 0; t < count; ++t) {
            const SampledTile& tile = order_[t];
            const auto m = static_cast<std::size_t>(tile.picture);
            const PixelBox box{tile.column * tile_px, tile.row * tile_px, tile_px, tile_px};
            const Frame& frame = frames_[m];
            const ReferenceImage& image = images_[m];
            for (PixelErrorFold* const fold : {&road, &whole, &target, &luminance})
                fold->begin_tile(tile.row);
            for (PixelErrorFold* const fold : {&road, &of_moment[m]})
                add_pixels(*fold, frame.illuminance_lx, image.illuminance_lx, &areas_[m], tile.picture, box);
            add_pixels(whole, frame.illuminance_lx, image.illuminance_lx, nullptr, tile.picture, box);
            if (outputs_.target)
                add_pixels(target, frame.target_lx, image.target_lx, &areas_[m], tile.picture, box);
            if (outputs_.luminance)
                add_pixels(luminance, frame.luminance_cdm2, image.luminance_cdm2, nullptr, tile.picture, box);
        }
        const auto of_row = static_cast<std::size_t>(this->rounds());
        error.road = road.finish(of_row);
        error.whole = whole.finish(of_row);
        error.target = target.finish(of_row);
        error.luminance = luminance.finish(of_row);
        error.road_p95.clear();
        for (const PixelErrorFold& fold : of_moment)
            if (const auto errors = fold.finish(); errors && errors->pixels > 0)
                error.road_p95.push_back(errors->error.p95);
        error.tiles = static_cast<int>(count);
        error.tiles_of = static_cast<int>(order_.size());
        error.rays = 0;
        for (const ReferenceImage& image : images_)
            error.rays += image.rays;
    }

  private:
    static int tiles_along(int pixels) { return (pixels + tile_px - 1) / tile_px; }

    void draw(std::size_t count) {
        std::vector<std::vector<int>> numbers(moments_.size());
        for (std::size_t t = 0; t < count; ++t)
            numbers[static_cast<std::size_t>(order_[t].picture)].push_back(order_[t].row * across_ + order_[t].column);
        for (std::size_t m = 0; m < moments_.size(); ++m)
            if (!numbers[m].empty())
                images_[m] =
                    reference_.render(moments_[m], view_, outputs_, settings_, {}, std::move(images_[m]), {}, {tile_px, numbers[m]});
    }

    const std::vector<Moment>& moments_;
    View view_;
    const Reference& reference_;
    ReferenceSettings settings_;
    int across_, down_;
    std::vector<SampledTile> order_;
    FrameOutputs outputs_;
    std::vector<Frame> frames_;
    std::vector<Image<float>> areas_;
    std::vector<ReferenceImage> images_;
};

int rounds_for_all(const DriveError& error, int rounds, int all) {
    int wanted = rounds;
    for (const std::optional<PixelErrors>* const errors : {&error.road, &error.target, &error.luminance})
        if (*errors)
            wanted = std::max(wanted, rounds_wanted(**errors, error_precision, rounds, all));
    return wanted;
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
    const Reference reference(stage.scene);
    const std::vector<Moment> moments = without_faces(moments_at(error.ticks, stage, lamp_set));
    const Technique& technique = renderer.technique();
    error.no_target = technique.target ? "" : fmt::format("technique {} does not compute the illuminance of targets", technique.name);
    error.no_luminance = technique.luminance ? "" : fmt::format("technique {} does not compute a luminance", technique.name);
    renderer.keep_programs_of(moments);
    ComparedTiles tiles(stage, moments, view, reference, renderer);
    const int most = std::max(std::min(first_rounds, tiles.rounds()), tiles.rounds() / most_of_it);
    for (int rounds = 0, wanted = std::min(first_rounds, most); wanted > rounds;
         wanted = std::min(most, rounds_for_all(error, rounds, tiles.rounds()))) {
        rounds = wanted;
        tiles.compare(rounds, error);
    }
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
