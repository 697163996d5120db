#include "runner/experiments/shadows/scene_study.h"

#include "metrics/statistics/statistics.h"
#include "renderer/renderer.h"
#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/experiments/bench/bench_run.h"
#include "runner/experiments/shadows/moment_sheet.h"
#include "runner/play/lux_map.h"
#include "runner/play/shadows/shadow_truth.h"
#include "scenarios/drives/play/camera.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <fmt/format.h>
#include <map>

namespace fernlicht {
namespace {

RendererSettings settings_with(const ShadowScene& scene, const SceneStudyOptions& options, ShadowMethod method) {
    RendererSettings settings = scene.light;
    settings.shadows.method = method;
    settings.shadows.width = options.width;
    settings.shadows.height = options.height;
    if (options.lamp_radius_m > 0.0) // soft methods draw the discs that they are held against
        settings.shadows.lamp_radius_m = options.lamp_radius_m;
    return settings;
}

/// Of the car's frame: the first lamp that shines, else the origin.
double lamp_ahead_m(const Moment& moment) {
    const auto shining = std::ranges::find_if(moment.lamps, [](const LitLamp& lamp) { return lamp.intensity_factor > 0.0; });
    return shining == moment.lamps.end() ? 0.0 : to_local(moment.ego, shining->pose.position_m).x;
}

View ground_view(double lamp_m) {
    return map_of("ground", lamp_m, lamp_m + ground_ahead_m, ground_beside_m,
                  static_cast<int>(std::lround(2.0 * ground_beside_m / ground_across_m)),
                  static_cast<int>(std::lround(ground_ahead_m / ground_along_m)));
}

/// A row of pixels across the car's way.
View section_view(double lamp_m, double ahead_m) {
    const double x = lamp_m + ahead_m;
    return map_of("ground", x - 0.5 * edge_pixel_m, x + 0.5 * edge_pixel_m, section_half_m,
                  static_cast<int>(std::lround(2.0 * section_half_m / edge_pixel_m)), 1);
}

/// Of a section only what the eye sees counts: how high the ground lies there is as good as nothing beside how far away it is.
void leave_out_unseen(ShadowImages& images, const Moment& moment, const View& section, const View& eye) {
    const Camera above = camera_of(moment, section), seen = camera_of(moment, eye);
    for (int y = 0; y < section.height_px; ++y)
        for (int x = 0; x < section.width_px; ++x) {
            const Ray ray = pixel_ray(above, section, x + 0.5, y + 0.5);
            const glm::dvec3 ground =
                ray.origin_m - ray.direction * (glm::dot(ray.origin_m, moment.ego.up()) / glm::dot(ray.direction, moment.ego.up()));
            const glm::dvec4 clip = seen.clip_from_ego * glm::dvec4(ground, 1.0);
            if (clip.w <= 0.0 || std::abs(clip.x) > clip.w)
                images.counts.at(x, y) = 0;
        }
}

EdgeMatch seen_edges(ShadowTruth& truth, Renderer& renderer, const std::vector<Moment>& moments, std::size_t moment, const View& eye) {
    ShadowImages images = truth.images(renderer, moment);
    leave_out_unseen(images, moments[moment], truth.view(), eye);
    return section_edges(images, 0, edge_pixel_m);
}

View width_view(const View& view, int width_px) {
    const double ratio = static_cast<double>(view.height_px) / view.width_px;
    return at_size(view, width_px, std::max(1, static_cast<int>(std::lround(width_px * ratio))));
}

/// The part of a picture that is shown.
struct ShownPart {
    int left = 0, top = 0, width = 0, height = 0;
    template <class T> Image<T> of(const Image<T>& picture) const { return part_of(picture, left, top, width, height); }
};

/// Half of the picture each way, about the middle of all shadow; `degree` below 0 where none counts.
ShownPart part_with_shadow(const Image<float>& degree) {
    double sum = 0.0, sum_x = 0.0, sum_y = 0.0;
    for (int y = 0; y < degree.height(); ++y)
        for (int x = 0; x < degree.width(); ++x) {
            const double weight = std::max(0.0, static_cast<double>(degree.at(x, y)));
            sum += weight;
            sum_x += weight * x;
            sum_y += weight * y;
        }
    ShownPart part{0, 0, degree.width() / 2, degree.height() / 2};
    const auto from = [&](double middle, int size, int all) {
        return std::clamp(static_cast<int>(std::lround(middle)) - size / 2, 0, all - size);
    };
    part.left = from(sum > 0.0 ? sum_x / sum : 0.5 * degree.width(), part.width, degree.width());
    part.top = from(sum > 0.0 ? sum_y / sum : 0.5 * degree.height(), part.height, degree.height());
    return part;
}

/// The truths that all methods of a scene share.
struct SceneTruth {
    Reference rays;
    Renderer unshadowed;
    std::vector<Moment> alone, steps; ///< of the first lamp: of each moment; the one shown, moved ahead step by step
    /// Where edges are measured: one moment alone would say how they happen to lie among a map's texels.
    const std::vector<Moment>& edge_moments() const { return alone.size() > 1 ? alone : steps; }
    std::size_t shown;
    ShadowTruth ground, view, discs, picture;
    ShownPart part; ///< of the picture
    std::vector<ShadowTruth> sections;
    ShadowTruth crawl;

    static std::vector<Moment> alone_of(const std::vector<Moment>& moments) {
        std::vector<Moment> alone;
        for (const Moment& moment : moments)
            alone.push_back(first_lamp_alone(moment));
        return alone;
    }
    static std::vector<Moment> steps_from(const Moment& moment) {
        std::vector<Moment> steps;
        for (int i = 0; i < crawl_steps; ++i)
            steps.push_back(moved_ahead(moment, i * crawl_step_m));
        return steps;
    }
    SceneTruth(const ShadowScene& scene, Device& device, const SceneStudyOptions& options)
        : rays(*scene.scene), unshadowed(device, *scene.scene, without_shadows(scene.light)), alone(alone_of(scene.moments)),
          steps(steps_from(alone[scene.moments.size() / 2])), shown(scene.moments.size() / 2),
          ground(rays, unshadowed, scene.moments, ground_view(lamp_ahead_m(scene.moments[shown])), 0.0, options.floor_lx),
          view(rays, unshadowed, scene.moments, width_view(scene.view, tile_px), 0.0, options.floor_lx),
          discs(rays, unshadowed, scene.moments, width_view(scene.view, shadow_error_width_px), options.lamp_radius_m, options.floor_lx),
          picture(rays, unshadowed, scene.moments, width_view(scene.view, 2 * tile_px), 0.0, options.floor_lx),
          part(part_with_shadow(true_degrees(picture.of(shown), options.floor_lx))),
          crawl(rays, unshadowed, steps, section_view(lamp_ahead_m(alone[shown]), crawl_distance_m), 0.0, options.floor_lx) {
        for (const double distance_m : edge_distances_m)
            sections.emplace_back(rays, unshadowed, edge_moments(), section_view(lamp_ahead_m(alone[shown]), distance_m), 0.0,
                                  options.floor_lx);
    }
    SceneTruth(const SceneTruth&) = delete;
    SceneTruth& operator=(const SceneTruth&) = delete;
};

void measure_areas(SceneTruth& truth, const ShadowScene& scene, const SceneStudyOptions& options, Renderer& renderer, ShadowRow& row) {
    for (std::size_t m = 0; m < scene.moments.size(); ++m) {
        const ShadowArea ground = shadow_area(truth.ground.images(renderer, m), ground_along_m * ground_across_m);
        row.ground_m2 += ground;
        row.wrong_by_moment.push_back(ground.wrong_share());
        const ShadowImages seen = truth.view.images(renderer, m);
        row.view_px += shadow_area(seen);
        row.spots += shadow_spots(seen, doubt_px);
    }
    if (options.lamp_radius_m > 0.0)
        for (std::size_t m = 0; m < scene.moments.size(); ++m) {
            const ShadowArea discs = shadow_area(truth.discs.images(renderer, m));
            row.discs_px = row.discs_px ? * row.discs_px += discs : discs;
        }
    row.wrong = truth.part.of(shadow_differences(truth.picture.images(renderer, truth.shown)));
    row.luminance_cdm2 = truth.part.of(renderer.draw(scene.moments[truth.shown], truth.picture.view(), {.luminance = true}).luminance_cdm2);
}

/// Seen from above, by a renderer whose maps are fitted to the scene's view.
void measure_edges(SceneTruth& truth, const View& eye, Renderer& renderer, ShadowRow& row) {
    for (std::size_t d = 0; d < edge_distances_m.size(); ++d) {
        std::vector<EdgeMatch> sections;
        for (std::size_t m = 0; m < truth.edge_moments().size(); ++m)
            sections.push_back(seen_edges(truth.sections[d], renderer, truth.edge_moments(), m, eye));
        row.edges[d] = edge_error(sections);
    }
    std::vector<EdgeMatch> steps;
    for (std::size_t k = 0; k < truth.steps.size(); ++k)
        steps.push_back(seen_edges(truth.crawl, renderer, truth.steps, k, eye));
    row.crawl_cm = shadow_crawl_cm(steps);
    if (!row.crawl_cm)
        row.no_crawl = std::ranges::all_of(steps, [](const EdgeMatch& step) { return step.true_edges() == 0; })
                           ? "no edge of a shadow there"
                           : "no edge is rendered in steps one after the other";
}

/// What is drawn for times: nothing may be left over from the frame before, so the car always moves.
std::vector<Moment> timed_moments(const ShadowScene& scene) {
    std::vector<Moment> moments = scene.moments;
    if (moments.size() == 1)
        moments.push_back(moved_ahead(moments.front(), crawl_step_m));
    return moments;
}

struct TimedMethod {
    ShadowRow* row;
    RendererSettings settings;
};

/// What a method that cannot be drawn after all leaves of its row.
ShadowRow row_without(ShadowMethod method, const std::string& why_not) {
    ShadowRow row;
    row.method = method;
    row.why_not = why_not;
    return row;
}

/// All methods' maps are there at once here: those that find no room beside the others are taken out of `timed`.
void time_frames(std::vector<TimedMethod>& timed, const ShadowScene& scene, Device& device, const SceneStudyOptions& options,
                 const std::vector<Moment>& moments, const View& view, const std::function<bool()>& stop) {
    std::deque<Renderer> renderers;
    std::vector<TimedTechnique> timed_techniques;
    for (const TimedMethod& method : timed) {
        Renderer& renderer = renderers.emplace_back(device, *scene.scene, method.settings);
        try {
            timed_techniques.push_back(timed_frames(renderer, moments, view, method.row->work));
        } catch (const ShadowMemoryError& refused) {
            renderers.pop_back();
            *method.row = row_without(method.row->method, fmt::format("beside the other methods: {}", refused.what()));
        }
    }
    std::erase_if(timed, [](const TimedMethod& method) { return !measured(*method.row); });
    TimingOptions timing;
    timing.moments = moments.size();
    timing.rounds = static_cast<std::size_t>(options.rounds);
    timing.frame_by_frame = false;
    timing.seed = options.seed;
    timing.go_on = [&](std::size_t) { return !stop(); };
    timing.stop = stop;
    InterleavedTimes held = time_interleaved(timed_techniques, timing, real_clocks());
    for (std::size_t i = 0; i < timed.size(); ++i)
        timed[i].row->samples = std::move(held.samples[i]);
}

/// Each pass finished and timed by itself, methods in an order drawn anew for each round.
void time_passes(const std::vector<TimedMethod>& timed, const ShadowScene& scene, Device& device, const SceneStudyOptions& options,
                 const std::vector<Moment>& moments, const View& view, const std::function<bool()>& stop) {
    static constexpr FrameOutputs outputs{.colour = true};
    std::deque<Renderer> renderers;
    for (const TimedMethod& method : timed) {
        RendererSettings settings = method.settings;
        settings.profile = true;
        renderers.emplace_back(device, *scene.scene, settings).prepare(moments, view, outputs);
    }
    std::vector<std::map<std::string, std::vector<double>>> samples(timed.size());
    std::vector<std::vector<std::string>> order(timed.size()); // of passes, as they are drawn
    std::mt19937_64 generator(options.seed);
    for (int round = -1; round < options.rounds && !stop(); ++round) // the first warms up
        for (const std::size_t i : random_order(timed.size(), generator)) {
            std::map<std::string, double> frame;
            for (const Moment& moment : moments)
                for (const auto& [name, seconds] : renderers[i].draw(moment, view, outputs).pass_s) {
                    if (!frame.contains(name) && std::ranges::find(order[i], name) == order[i].end())
                        order[i].push_back(name);
                    frame[name] += seconds / static_cast<double>(moments.size());
                }
            for (const auto& [name, seconds] : frame)
                if (round >= 0)
                    samples[i][name].push_back(seconds);
        }
    for (std::size_t i = 0; i < timed.size(); ++i)
        for (const std::string& name : order[i])
            if (const auto time = time_of(samples[i][name]))
                timed[i].row->pass_s.emplace_back(name, *time);
}

/// Memory beside that of the scene drawn without shadows.
void set_texture_bytes(const ShadowScene& scene, Device& device, const std::vector<Moment>& moments, const View& view,
                       std::vector<ShadowRow>& rows) {
    static constexpr FrameOutputs outputs{.colour = true};
    Renderer none(device, *scene.scene, without_shadows(scene.light));
    std::uint64_t least = 0;
    for (const Moment& moment : moments)
        least = std::max(least, none.count(moment, view, outputs).texture_bytes);
    for (ShadowRow& row : rows)
        if (!row.work.empty()) {
            const std::uint64_t most = std::ranges::max(row.work, {}, &Work::texture_bytes).texture_bytes;
            row.texture_bytes = most > least ? most - least : 0;
        }
}

} // namespace

ShadowRow row_of_method(ShadowMethod method, const std::function<void(ShadowRow&)>& measure) {
    ShadowRow row;
    row.method = method;
    try {
        measure(row);
        return row;
    } catch (const InputError& refused) {
        return row_without(method, refused.what());
    } catch (const ShadowMemoryError& refused) {
        return row_without(method, refused.what());
    }
}

ShadowSceneResult study_scene(const ShadowScene& scene, Device& device, const SceneStudyOptions& options, const std::function<void()>& step,
                              const std::function<bool()>& stop) {
    ShadowSceneResult result;
    result.name = scene.name;
    result.title = scene.title;
    result.of_drive = scene.of_drive;
    result.width_px = options.timed_px.first;
    result.height_px = options.timed_px.second;
    result.vertical_fov_rad = scene.view.vertical_fov_rad;
    for (const Moment& moment : scene.moments)
        result.moments.emplace_back(moment.tick, moment.time_s);
    if (stop())
        return result;
    SceneTruth truth(scene, device, options);
    result.shown = truth.shown;
    const ShadowTruth::Found& rays = truth.picture.of(truth.shown);
    const Image<float> free =
        truth.part.of(truth.unshadowed.draw(scene.moments[truth.shown], truth.picture.view(), {.luminance = true}).luminance_cdm2);
    result.degree = truth.part.of(true_degrees(rays, options.floor_lx));
    result.luminance_cdm2 = shaded_by_rays(free, result.degree);
    result.white_cdm2 = white_of_ground(free, truth.part.of(rays.ids), *scene.scene);
    step();
    for (const ShadowMethod method : options.methods) {
        if (stop())
            return result;
        result.rows.push_back(row_of_method(method, [&](ShadowRow& row) {
            Renderer renderer(device, *scene.scene, settings_with(scene, options, method));
            measure_areas(truth, scene, options, renderer, row);
            RendererSettings from_above = settings_with(scene, options, method);
            from_above.shadow_eye = std::make_shared<const View>(scene.view);
            Renderer above(device, *scene.scene, from_above);
            measure_edges(truth, scene.view, above, row);
            for (const Moment& moment : timed_moments(scene)) // a method may refuse any of them
                renderer.draw(moment, truth.discs.view(), {.colour = true});
        }));
        step();
    }
    std::vector<TimedMethod> timed;
    for (ShadowRow& row : result.rows)
        if (row.why_not.empty())
            timed.push_back({&row, settings_with(scene, options, row.method)});
    const std::vector<Moment> moments = timed_moments(scene);
    const View view = at_size(scene.view, result.width_px, result.height_px);
    time_frames(timed, scene, device, options, moments, view, stop);
    time_passes(timed, scene, device, options, moments, view, stop);
    set_texture_bytes(scene, device, moments, view, result.rows);
    step();
    return result;
}

} // namespace fernlicht
