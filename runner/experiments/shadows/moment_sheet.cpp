#include "runner/experiments/shadows/moment_sheet.h"

#include "renderer/renderer.h"
#include "runner/experiments/shadows/scene_study.h"
#include "runner/experiments/shadows/sheet_picture.h"
#include "runner/play/shadows/shadow_truth.h"

#include <algorithm>

namespace fernlicht {

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
    for (const ShadowMethodName& one : shadow_method_names()) {
        ShadowRow row;
        row.method = one.method;
        const auto refuse = [&](const std::exception& why) {
            row = {};
            row.method = one.method;
            row.why_not = why.what();
        };
        try {
            RendererSettings own = settings;
            own.shadows.method = one.method;
            Renderer renderer(device, stage.scene, own);
            const ShadowImages seen = truth.images(renderer, 0);
            row.view_px = shadow_area(seen);
            row.wrong = shadow_differences(seen);
            row.luminance_cdm2 = renderer.draw(moment, view, {.luminance = true}).luminance_cdm2;
        } catch (const InputError& refused) {
            refuse(refused);
        } catch (const ShadowMemoryError& refused) {
            refuse(refused);
        }
        result.rows.push_back(std::move(row));
    }
    return result;
}

} // namespace fernlicht
