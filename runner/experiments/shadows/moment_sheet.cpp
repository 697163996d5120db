#include "runner/experiments/shadows/moment_sheet.h"

#include "renderer/renderer.h"
#include "runner/experiments/shadows/scene_study.h"
#include "runner/play/shadows/shadow_truth.h"

#include <algorithm>

namespace fernlicht {
namespace {

bool shows_ground(const Scene& scene, std::uint32_t id) {
    return id > 0 && std::ranges::all_of(scene.meshes.at(id - 1).batches,
                                         [&](const Batch& batch) { return is_ground(scene.materials.at(batch.material).kind); });
}

} // namespace

ShadowSceneResult shadow_moment(const Stage& stage, const LampSet& lamp_set, const Moment& moment, Device& device,
                                const RendererSettings& settings) {
    const View& driver = *driver_view(stage.drive);
    const View view = at_size(driver, tile_px, std::max(1, driver.height_px * tile_px / driver.width_px));
    ShadowSceneResult result;
    result.name = stage.drive.name;
    result.title = stage.drive.title + ", " + lamp_set.name;
    result.of_drive = true;
    result.moments = {{moment.tick, moment.time_s}};
    result.width_px = view.width_px;
    result.height_px = view.height_px;
    const Reference rays(stage.scene);
    Renderer unshadowed(device, stage.scene, without_shadows(settings));
    const std::vector<Moment> moments{moment};
    ShadowTruth truth(rays, unshadowed, moments, view);
    result.whole_view = true;
    result.degree = true_degrees(truth.of(0));
    const Image<float> free = unshadowed.draw(moment, view, {.luminance = true}).luminance_cdm2;
    result.luminance_cdm2 = shaded_by_rays(free, result.degree);
    result.white_cdm2 = white_of_ground(free, truth.of(0).ids, stage.scene);
    for (const ShadowMethodName& one : shadow_method_names())
        result.rows.push_back(row_of_method(one.method, [&](ShadowRow& row) {
            RendererSettings own = settings;
            own.shadows.method = one.method;
            Renderer renderer(device, stage.scene, own);
            const ShadowImages seen = truth.images(renderer, 0);
            row.view_px = shadow_area(seen);
            row.wrong = shadow_differences(seen);
            row.luminance_cdm2 = renderer.draw(moment, view, {.luminance = true}).luminance_cdm2;
        }));
    return result;
}

Image<float> shaded_by_rays(const Image<float>& unshadowed_cdm2, const Image<float>& degree) {
    Image<float> out = unshadowed_cdm2;
    for (std::size_t i = 0; i < out.size(); ++i)
        out.pixels()[i] *= 1.0F - std::clamp(degree.pixels()[i], 0.0F, 1.0F);
    return out;
}

double white_of_ground(const Image<float>& luminance_cdm2, const Image<std::uint32_t>& ids, const Scene& scene) {
    std::vector<float> sorted;
    for (std::size_t i = 0; i < ids.size(); ++i)
        if (shows_ground(scene, ids.pixels()[i]))
            sorted.push_back(luminance_cdm2.pixels()[i]);
    if (sorted.empty())
        sorted = luminance_cdm2.pixels();
    std::ranges::sort(sorted);
    return sorted.empty() ? 1.0 : std::max(1e-3, static_cast<double>(sorted[sorted.size() * 99 / 100]));
}

} // namespace fernlicht
