#include "runner/experiments/shadows/shadow_study.h"

#include "renderer/renderer.h"
#include "runner/experiments/accuracy/technique_sweep.h"
#include "runner/experiments/bench/bench_run.h"
#include "runner/files/output_folder.h"
#include "runner/findings/run_context.h"
#include "runner/play/progress.h"
#include "runner/play/stage.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <fnmatch.h>
#include <iterator>
#include <thread>
#include <unistd.h>

namespace fernlicht {
namespace {

/// Those whose names fit a pattern, in the scenes' order. Throws InputError for a pattern that fits none.
std::vector<ShadowScene> chosen_scenes(std::vector<ShadowScene> all, const std::vector<std::string>& patterns) {
    const auto fits = [](const std::string& pattern, const ShadowScene& scene) {
        return ::fnmatch(pattern.c_str(), scene.name.c_str(), 0) == 0;
    };
    std::vector<std::string> names;
    for (const ShadowScene& scene : all)
        names.push_back(scene.name);
    for (const std::string& pattern : patterns)
        if (pattern != "none" && std::ranges::none_of(all, [&](const ShadowScene& scene) { return fits(pattern, scene); }))
            throw InputError({{}, 0, 0, "--scenes"}, fmt::format("found '{}', which fits no scene", printable(pattern)),
                             fmt::format("none, or some of {}, with * and ?", fmt::join(names, ", ")));
    std::erase_if(all, [&](const ShadowScene& scene) {
        return std::ranges::none_of(patterns, [&](const std::string& pattern) { return fits(pattern, scene); });
    });
    return all;
}

ShadowScene scene_of_drive(const std::shared_ptr<const Stage>& stage, const ShadowRequest& request) {
    const View* const view = driver_view(stage->drive);
    if (!view)
        throw InputError({stage->drive.file, 0, 0, "views"}, "found only maps", "a perspective view");
    if (request.moments > tick_count(stage->drive))
        throw InputError({stage->drive.file, 0, 0, "--count"}, fmt::format("found {}", request.moments),
                         fmt::format("1 to {}, the drive's moments", tick_count(stage->drive)));
    ShadowScene scene;
    scene.name = stage->drive.name;
    scene.title = stage->drive.title;
    scene.of_drive = true;
    scene.scene = {stage, &stage->scene};
    scene.moments = moments_at(ticks_over(tick_count(stage->drive), request.moments), *stage, lamp_set_of(stage->drive, request.lamp_set));
    scene.view = *view;
    scene.light.tone_mapper = stage->drive.tone_mapper;
    scene.light.beams = stage->drive.beams;
    scene.light.shadows = stage->drive.shadows;
    return scene;
}

} // namespace

ShadowResult run_shadow_study(const ShadowRequest& request) {
    std::vector<ShadowScene> scenes; // everything is read and checked before the first frame
    FilesRead opened;
    if (request.scenes != std::vector<std::string>{"none"}) {
        if (!std::filesystem::exists(request.lamp))
            throw InputError({request.lamp, 0, 0, "--scene-lamp"}, "is not there", "a lamp file");
        const auto beam = std::make_shared<const LampFile>(read_lamp(request.lamp, {.recipe = request.recipe}));
        add_inputs(opened, beam->opened);
        scenes = chosen_scenes(stress_scenes(beam, request.vertical_fov_rad), request.scenes);
    }
    for (const Drive& drive : request.drives) {
        const auto stage = std::make_shared<const Stage>(drive);
        scenes.push_back(scene_of_drive(stage, request));
        add_inputs(opened, stage->drive.opened);
        add_inputs(opened, stage->network.opened);
    }
    if (scenes.empty())
        throw InputError({{}, 0, 0, "DRIVE"}, "is missing", "a drive file, or --scenes other than none");
    Device device = open_device(request.backend);
    check_sanity(device);
    OutputFolder folder(request.folder);
    ShadowResult result;
    result.context = make_context(device.info(), request.command, request.options.seed);
    add_inputs(result.context.inputs, opened);
    result.cores = std::thread::hardware_concurrency();
    result.rounds = static_cast<std::size_t>(request.options.rounds);
    result.map_width = request.options.width;
    result.map_height = request.options.height;
    result.lamp_radius_m = request.options.lamp_radius_m;
    result.floor_lx = request.options.floor_lx;
    const Interruption listening;
    const CpuUse before = cpu_use();
    Progress progress("shadows", static_cast<int>(scenes.size() * steps_of(request.options)), request.quiet, "steps");
    int done = 0;
    for (const ShadowScene& scene : scenes) {
        if (Interruption::requested()) {
            result.missing.push_back(fmt::format("scene {}: not begun", scene.name));
            continue;
        }
        result.scenes.push_back(study_scene(
            scene, device, request.options, [&] { progress.done(++done); }, Interruption::requested));
        if (Interruption::requested())
            result.missing.push_back(fmt::format("scene {}: ended after {} of {} methods, before all times were taken", scene.name,
                                                 result.scenes.back().rows.size(), request.options.methods.size()));
    }
    result.others = other_load(before, cpu_use(), ::getpid());
    if (Interruption::requested())
        result.interrupted = Interruption::words();
    request.write(result);
    if (result.interrupted.empty())
        folder.finish();
    return result;
}

} // namespace fernlicht
