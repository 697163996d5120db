#include "runner/experiments/reference/reference_run.h"

#include "renderer/reference/embree_scene.h"
#include "renderer/reference/pixel_estimate.h"
#include "runner/experiments/reference/checkpoint.h"
#include "runner/files/log.h"
#include "runner/files/output_folder.h"
#include "runner/findings/library_versions.h"
#include "runner/findings/run_context.h"
#include "runner/play/preparation.h"
#include "runner/play/progress.h"
#include "runner/play/stage.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/values/errors.h"

#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

/// A crash costs at most about this much work.
constexpr double checkpoint_every_s = 30.0;

/// The one of `all` that is called so; throws InputError with the flag and the names there are.
template <class Named> const Named& named(const std::vector<Named>& all, const std::string& name, const Drive& drive, const char* flag) {
    std::vector<std::string> names;
    for (const Named& one : all) {
        if (one.name == name)
            return one;
        names.push_back(one.name);
    }
    throw InputError({drive.file, 0, 0, flag}, "found '" + printable(name) + "'", fmt::format("one of {}", fmt::join(names, ", ")));
}

const View& view_of(const Drive& drive, const std::string& name) {
    if (!name.empty())
        return named(drive.views, name, drive, "--view");
    const View* const driver = driver_view(drive);
    return driver ? *driver : drive.views.front();
}

/// The moment nearest to a time.
Moment moment_near(const Stage& stage, const LampSet& lamp_set, double time_s) {
    const int count = tick_count(stage.drive);
    const double tick = std::round(time_s / stage.drive.step_s);
    if (!(tick >= 0.0 && tick < count))
        throw InputError({stage.drive.file, 0, 0, "--moment"}, fmt::format("found {} s", time_s),
                         fmt::format("0 to {:.3f} s, the drive's moments", (count - 1) * stage.drive.step_s));
    return moments_at({static_cast<int>(tick)}, stage, lamp_set).front();
}

RunContext context_of(const ReferenceRequest& request, const Stage& stage) {
    RunContext context;
    context.versions = library_versions();
    context.versions.emplace_back("Embree", reference::embree_version());
    context.cpu = fmt::format("{} ({})", cpu_name(), simd_class());
    context.os = os_name();
    context.command = shell_quoted(request.command);
    context.started_utc = utc_now();
    context.seed = request.settings.seed;
    add_inputs(context.inputs, stage.drive.opened);
    add_inputs(context.inputs, stage.network.opened);
    return context;
}

ReferenceResult described(const ReferenceRequest& request, const Stage& stage) {
    const Drive& drive = stage.drive;
    const LampSet& lamp_set =
        request.lamp_set.empty() ? drive.lamp_sets.front() : named(drive.lamp_sets, request.lamp_set, drive, "--lamp-set");
    ReferenceResult result;
    result.context = context_of(request, stage);
    result.drive = drive.name;
    result.title = drive.title;
    result.lamp_set = lamp_set.name;
    result.view = view_of(drive, request.view);
    result.moment = moment_near(stage, lamp_set, request.moment_s);
    const bool is_map = result.view.projection == Projection::map;
    if (is_map && request.resolution_asked)
        throw InputError({drive.file, 0, 0, "--resolution"}, "found the map '" + printable(result.view.name) + "'",
                         "a perspective view: a map's pixels are those of the drive file");
    result.outputs = {.illuminance = true, .target = is_map, .luminance = !is_map};
    result.settings = request.settings;
    result.settings.shadows = drive.shadows.objects_cast;
    result.settings.max_samples = reference::max_samples_used(request.settings);
    if (!drive.shadows.objects_cast &&
        (request.settings.integrator == Integrator::radiosity || request.settings.integrator == Integrator::photon_map))
        throw InputError({drive.file, 0, 0, "--integrator"},
                         "found " + integrator_name(request.settings.integrator) + " for a drive without shadows",
                         "direct, whitted or path: light that is solved has shadows");
    if (const Weather& weather = result.moment.weather;
        !knows_weather(request.settings.integrator) && (weather.extinction_per_m > 0.0 || weather.wetness > 0.0))
        throw InputError({drive.file, 0, 0, "--integrator"},
                         "found " + integrator_name(request.settings.integrator) + " for a drive with fog, rain, snow or wet roads",
                         "direct, whitted or path: solved light goes through clear air between dry surfaces");
    if (drive.extent)
        result.settings.target_height_m = drive.extent->target_height_m;
    result.inputs = checkpoint_inputs(result, drive);
    result.inputs_hash = content_hash(result.inputs.data(), result.inputs.size());
    return result;
}

/// Draws on from `from` until all is drawn or the user asks for the end; a checkpoint stands in the folder whenever it is not all.
void draw(ReferenceResult& result, const Stage& stage, const ReferenceRequest& request, ReferenceImage from) {
    const Interruption listening;
    const Reference reference(stage.scene);
    result.triangles = reference.geometry(result.moment)->triangles();
    if (!request.quiet && (result.settings.integrator == Integrator::radiosity || result.settings.integrator == Integrator::photon_map))
        tell(LogLevel::info,
             fmt::format("solving the light before the picture is computed ({})", integrator_name(result.settings.integrator)));
    Progress progress("reference", result.view.width_px * result.view.height_px, request.quiet, "pixels");
    auto stored = std::chrono::steady_clock::now();
    result.image = reference.render(
        result.moment, result.view, result.outputs, result.settings,
        [&](const ReferenceImage& so_far, std::size_t pixels_done) {
            progress.done(static_cast<int>(pixels_done));
            const bool stop = Interruption::requested();
            const auto now = std::chrono::steady_clock::now();
            if (stop || std::chrono::duration<double>(now - stored).count() > checkpoint_every_s) {
                write_checkpoint(so_far, result.inputs, request.folder);
                stored = now;
            }
            return !stop;
        },
        std::move(from), [] { return Interruption::requested(); });
    if (!result.image.complete)
        result.interrupted = Interruption::words();
}

} // namespace

ReferenceResult run_reference(const ReferenceRequest& request) {
    const Stage stage(request.drive);
    refuse_unfitted_tone_mapper(stage.drive);
    ReferenceResult result = described(request, stage);
    ReferenceImage from;
    if (!request.resume && std::filesystem::exists(checkpoint_file(request.folder)))
        throw InputError({request.folder, 0, 0, "--out"}, "holds a reference that was interrupted",
                         "--resume to go on with it, or a new or an empty folder");
    if (request.resume)
        from = read_checkpoint(result.inputs, result.view, result.outputs, request.folder);
    OutputFolder folder = request.resume ? OutputFolder::left_incomplete(request.folder) : OutputFolder(request.folder);
    draw(result, stage, request, std::move(from));
    write_reference(result, stage.drive.tone_mapper, request.folder);
    request.write(result);
    if (result.image.complete) {
        std::filesystem::remove(checkpoint_file(request.folder));
        folder.finish();
    }
    return result;
}

} // namespace fernlicht
