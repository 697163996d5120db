#include "runner/experiments/accuracy/picture_errors.h"

#include "metrics/statistics/statistics.h"
#include "scenarios/drives/play/camera.h"
#include "scenarios/light/light.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

std::string reason(const Technique& technique, const char* what) {
    return fmt::format("technique {} does not compute {}", technique.name, what);
}

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

Draw drawn_by(const Reference& reference, const ReferenceSettings& settings, const std::function<void(const ReferenceImage&)>& seen,
              const StopAsked& stop) {
    return [&reference, settings, seen, stop](const Moment& at, const View& view, const FrameOutputs& outputs) {
        ReferenceImage image = reference.render(at, view, outputs, settings, {}, {}, stop);
        seen(image);
        Frame frame;
        frame.illuminance_lx = std::move(image.illuminance_lx.mean);
        frame.target_lx = std::move(image.target_lx.mean);
        return [frame] { return frame; };
    };
}

void add_pixels(PixelErrorFold& fold, const Image<float>& tested, const Estimate& reference, const Image<float>* road_m2, int picture,
                const PixelBox& box) {
    for (int y = box.y; y < std::min(box.y + box.height, tested.height()); ++y)
        for (int x = box.x; x < std::min(box.x + box.width, tested.width()); ++x) {
            const std::optional<double> m2 = road_m2 ? std::optional(static_cast<double>(road_m2->at(x, y))) : std::nullopt;
            if (!m2 || *m2 >= 0.0)
                fold.add({static_cast<double>(tested.at(x, y)), static_cast<double>(reference.mean.at(x, y)),
                          static_cast<double>(reference.standard_error.at(x, y)), m2, picture, x, y});
        }
}

void add_pixels(PixelErrorFold& fold, const Image<float>& tested, const Estimate& reference, const Image<float>* road_m2, int picture) {
    add_pixels(fold, tested, reference, road_m2, picture, {0, 0, tested.width(), tested.height()});
}

ReferencePictures::ReferencePictures(const Stage& stage, const Drive& drive, Device& device, const std::vector<Moment>& moments,
                                     const ReferenceSettings& settings)
    : stage_(stage), moments_(moments), settings_(settings), reference_(stage.scene), geometry_(device, stage.scene, {}),
      fold_(drive, stage.route) {}

void ReferencePictures::count(const ReferenceImage& image) {
    cost_.seconds += image.seconds;
    cost_.rays += image.rays;
    std::vector<double> samples(image.samples.pixels().begin(), image.samples.pixels().end());
    if (const auto spread = spread_of(std::move(samples))) {
        samples_.push_back(spread->median);
        cost_.max_samples = std::max(cost_.max_samples, spread->maximum);
    }
}

ReferenceCost ReferencePictures::cost() const {
    ReferenceCost cost = cost_;
    if (const auto spread = spread_of(samples_))
        cost.median_samples = spread->median;
    return cost;
}

bool ReferencePictures::add_driver(std::size_t moment, const View& view, const StopAsked& stop) {
    ReferenceShot shot{view, {}, {}, {}};
    shot.reference =
        reference_.render(moments_[moment], view, {.illuminance = true, .target = true, .luminance = true}, settings_, {}, {}, stop);
    count(shot.reference);
    if (!shot.reference.complete)
        return false;
    shot.geometry = geometry_.draw(moments_[moment], view, {.depth = true, .ids = true});
    shot.road_m2 = road_areas_m2(stage_.scene, moments_[moment], view, shot.geometry);
    shots_.emplace(std::tuple(moment, view.width_px, view.height_px), std::move(shot));
    return true;
}

bool ReferencePictures::add_map(std::size_t moment, const StopAsked& stop) {
    bool complete = true;
    const auto seen = [&](const ReferenceImage& image) {
        complete = complete && image.complete;
        count(image);
    };
    ExtentDrawing drawing = fold_.draw(moments_[moment], drawn_by(reference_, settings_, seen, stop));
    if (!complete)
        return false;
    std::vector<LaneExtent> extents = fold_.rendered(drawing);
    maps_.emplace(moment, std::pair(std::move(drawing), std::move(extents)));
    return true;
}

const ReferenceShot& ReferencePictures::driver(std::size_t moment, const View& view) const {
    return shots_.at({moment, view.width_px, view.height_px});
}

ConfigurationErrors::ConfigurationErrors(const ReferencePictures& references, const Technique& technique,
                                         const Configuration& configuration, const View& view, double map_scale)
    : references_(&references), illuminance_(technique.illuminance), target_(technique.illuminance && technique.target),
      luminance_(technique.illuminance && technique.luminance), view_(view), map_scale_(map_scale),
      road_(ErrorRule{references.settings().floor_lx}), whole_(road_), target_errors_(road_),
      bright_(ErrorRule{references.settings().floor_cdm2}) {
    so_far_.configuration = configuration;
    so_far_.no_illuminance = technique.illuminance ? "" : reason(technique, "an illuminance");
    so_far_.no_target = technique.target ? "" : reason(technique, "the illuminance of targets");
    so_far_.no_luminance = technique.luminance ? "" : reason(technique, "a luminance");
}

void ConfigurationErrors::add(std::size_t m, const Draw& draw) {
    ++so_far_.moments;
    if (!illuminance_)
        return;
    const Moment& moment = references_->moments()[m];
    const ReferenceShot& shot = references_->driver(m, view_);
    const Frame frame = draw(moment, view_, {.illuminance = true, .target = true, .luminance = true})();
    const auto picture = static_cast<int>(m);
    PixelErrorFold here(ErrorRule{references_->settings().floor_lx});
    add_pixels(here, frame.illuminance_lx, shot.reference.illuminance_lx, &shot.road_m2, picture);
    add_pixels(road_, frame.illuminance_lx, shot.reference.illuminance_lx, &shot.road_m2, picture);
    add_pixels(whole_, frame.illuminance_lx, shot.reference.illuminance_lx, nullptr, picture);
    if (target_)
        add_pixels(target_errors_, frame.target_lx, shot.reference.target_lx, &shot.road_m2, picture);
    if (luminance_)
        add_pixels(bright_, frame.luminance_cdm2, shot.reference.luminance_cdm2, nullptr, picture);
    if (const auto errors = here.finish(); errors && errors->pixels > 0)
        so_far_.road_p95.push_back(errors->error.p95);
    ExtentDrawing map = references_->map(m);
    map.view.width_px = std::max(2, static_cast<int>(std::lround(map.view.width_px * map_scale_)));
    map.view.height_px = std::max(2, static_cast<int>(std::lround(map.view.height_px * map_scale_)));
    place_pixels(map);
    map.frame = draw(map.moment, map.view, {.illuminance = true, .target = true})();
    moments_.push_back(m);
    rendered_.push_back(references_->fold().rendered(map));
}

ConfigurationResult ConfigurationErrors::finish() const {
    ConfigurationResult result = so_far_;
    std::vector<std::vector<LaneExtent>> references;
    for (const std::size_t m : moments_)
        references.push_back(references_->extents(m));
    result.road = road_.finish();
    result.whole = whole_.finish();
    result.target = target_errors_.finish();
    result.luminance = bright_.finish();
    result.reach = reach_errors(rendered_, references, measured_thresholds_lx, result.no_illuminance, result.no_target);
    return result;
}

std::vector<Moment> without_faces(std::vector<Moment> moments) {
    for (Moment& moment : moments)
        for (LitLamp& lamp : moment.other_lamps)
            lamp.face_m = {0.0, 0.0};
    return moments;
}

bool is_road(const Scene& scene, std::uint32_t id) {
    if (id == 0)
        return false;
    const Mesh& mesh = scene.meshes.at(id - 1);
    return std::ranges::any_of(mesh.batches, [&](const Batch& batch) {
        const SurfaceKind kind = scene.materials[batch.material].kind;
        return kind == SurfaceKind::road || kind == SurfaceKind::marking;
    });
}

Image<float> road_areas_m2(const Scene& scene, const Moment& moment, const View& view, const Frame& frame) {
    const Camera camera = camera_of(moment, view);
    std::vector<bool> road(scene.meshes.size() + 1);
    for (std::size_t id = 1; id < road.size(); ++id)
        road[id] = is_road(scene, static_cast<std::uint32_t>(id));
    Image<float> areas(view.width_px, view.height_px, -1.0F);
    const auto same = [&](int x, int y, std::uint32_t id) {
        return x >= 0 && y >= 0 && x < view.width_px && y < view.height_px && frame.ids.at(x, y) == id;
    };
    for (int y = 0; y < view.height_px; ++y)
        for (int x = 0; x < view.width_px; ++x) {
            const std::uint32_t id = frame.ids.at(x, y);
            if (!road[id])
                continue;
            // Between the neighbours on both sides, or on one: metres a pixel.
            const auto step = [&](int dx, int dy) {
                const int before = same(x - dx, y - dy, id) ? 1 : 0, after = same(x + dx, y + dy, id) ? 1 : 0;
                if (before + after == 0)
                    return glm::dvec3(0.0);
                const auto shown = [&](int px, int py) { return shown_at(camera, view, px, py, frame.depth_m.at(px, py)); };
                return (shown(x + after * dx, y + after * dy) - shown(x - before * dx, y - before * dy)) /
                       static_cast<double>(before + after);
            };
            areas.at(x, y) = static_cast<float>(glm::length(glm::cross(step(1, 0), step(0, 1))));
        }
    return areas;
}

void TwinAgreementFold::add(const Moment& moment, const View& view, const Frame& frame, const ReferenceImage& twin,
                            const ReferenceImage& edges, int picture) {
    const Camera camera = camera_of(moment, view);
    for (int y = 0; y < view.height_px; ++y)
        for (int x = 0; x < view.width_px; ++x) {
            const double right = static_cast<double>(twin.illuminance_lx.mean.at(x, y)),
                         tested = static_cast<double>(frame.illuminance_lx.at(x, y));
            if (right < min_lx_)
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
