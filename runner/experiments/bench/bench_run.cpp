#include "runner/experiments/bench/bench_run.h"

#include "renderer/gpu_timer.h"
#include "renderer/renderer.h"
#include "runner/experiments/bench/contact_sheet.h"
#include "runner/files/output_folder.h"
#include "runner/findings/run_context.h"
#include "runner/play/preparation.h"
#include "runner/play/progress.h"
#include "runner/play/shadows/choose_shadows.h"
#include "runner/play/stage.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <algorithm>
#include <deque>
#include <fmt/format.h>
#include <thread>
#include <unistd.h>

namespace fernlicht {
namespace {

const View& view_to_time(const Drive& drive) {
    if (const View* const view = driver_view(drive))
        return *view;
    throw InputError({drive.file, 0, 0, "views"}, "found only maps", "a perspective view to time");
}

/// Why the GPU's clock is not used; "" where it can be believed.
std::string clock_refused(Device& device) {
    if (device.info().software)
        return "the driver renders on the CPU";
    const TimerCheck check = check_timer(device);
    return check.agrees()
               ? ""
               : fmt::format("GL_TIME_ELAPSED says {:.2f} ms of a load that takes {:.2f} ms", 1e3 * check.query_s, 1e3 * check.finish_s);
}

BenchResult described(const BenchRequest& request, const Stage& stage, const LampSet& lamp_set, const View& view, Device& device) {
    BenchResult result;
    result.context = make_context(device.info(), request.command, request.seed);
    add_inputs(result.context.inputs, stage.drive.opened);
    add_inputs(result.context.inputs, stage.network.opened);
    result.cores = std::thread::hardware_concurrency();
    result.gl_vendor = device.info().gl_vendor;
    result.drive = stage.drive.name;
    result.title = stage.drive.title;
    result.lamp_set = lamp_set.name;
    result.width_px = view.width_px;
    result.height_px = view.height_px;
    result.rounds_planned = static_cast<std::size_t>(request.rounds);
    return result;
}

/// Each technique with a renderer of its own, compiled for all moments and its work counted.
std::vector<TimedTechnique> take_part(const std::vector<Technique>& rows, LightPass wish, Device& device, const Stage& stage,
                                      const View& view, const std::vector<Moment>& moments, std::deque<Renderer>& renderers,
                                      BenchResult& result) {
    std::vector<TimedTechnique> timed_techniques;
    for (const Technique& row : rows) {
        RendererSettings settings = settings_for(stage.drive, {});
        settings.technique = row.name;
        settings.light_pass = wish;
        BenchedTechnique& benched = result.techniques.emplace_back();
        benched.row = row;
        timed_techniques.push_back(timed_frames(renderers.emplace_back(device, stage.scene, settings), moments, view, benched.work));
    }
    return timed_techniques;
}

/// "the fragment shader".
std::string lit_by(const BenchResult& result, const std::deque<Renderer>& renderers) {
    const auto found = std::ranges::find(result.techniques, "photometric", [](const BenchedTechnique& one) { return one.row.name; });
    if (found == result.techniques.end())
        return "";
    const Renderer::LightPassesUsed used = renderers[static_cast<std::size_t>(found - result.techniques.begin())].light_passes_used();
    const std::string shader = "the fragment shader" + (used.why_shader.empty() ? "" : " (" + used.why_shader + ")");
    return used.shader == 0 ? std::string(lit_by_cpu)
           : used.cpu == 0  ? shader
                            : fmt::format("the CPU, {} of {} pictures by {}", used.shader, used.cpu + used.shader, shader);
}

/// Holds the rounds and puts their samples into the result, with who else used the machine meanwhile.
void time_rounds(const std::vector<TimedTechnique>& timed_techniques, const BenchRequest& request, Device& device, BenchResult& result) {
    TimingClocks clocks = real_clocks();
    GpuTimer timer(device);
    if (result.gpu_not_measured.empty()) {
        clocks.gpu_begin = [&] { timer.begin(); };
        clocks.gpu_end = [&] { timer.end(); };
        clocks.gpu_s = [&] { return timer.seconds(); };
    }
    const Interruption listening;
    std::optional<Progress> progress;
    std::optional<CpuUse> before; // the warm-up is not timed
    TimingOptions options;
    options.moments = result.moments.size();
    options.rounds = result.rounds_planned;
    options.seed = request.seed;
    options.go_on = [&](std::size_t done) {
        if (!before) {
            before = cpu_use();
            progress.emplace("bench", request.rounds, request.quiet, "rounds");
        }
        progress->done(static_cast<int>(done));
        return !Interruption::requested();
    };
    InterleavedTimes timing = time_interleaved(timed_techniques, options, clocks);
    const CpuUse after = cpu_use();
    progress->done(static_cast<int>(timing.orders.size()));
    result.warm_up_plays = options.warm_up_plays;
    result.load_before = before->load_average;
    result.load_after = after.load_average;
    result.others = other_load(*before, after, ::getpid());
    result.orders = std::move(timing.orders);
    if (result.orders.size() < result.rounds_planned)
        result.interrupted = Interruption::words();
    for (std::size_t i = 0; i < timed_techniques.size(); ++i)
        result.techniques[i].samples = std::move(timing.samples[i]);
}

/// Of the moments that were timed, on a renderer of its own. Puts it or why there is none into the result.
void add_roofline(Device& device, const Stage& stage, const View& view, const std::vector<Moment>& moments, BenchResult& result) {
    std::string& why = result.roofline_not_measured;
    if (!result.interrupted.empty())
        why = result.interrupted;
    else if (result.lit_by.empty())
        why = "photometric did not take part";
    else if (!device.info().software)
        why = "a GPU renders, and peaks are the CPU's";
    if (!why.empty())
        return;
    RendererSettings settings = settings_for(stage.drive, {});
    settings.technique = "photometric";
    settings.light_pass = LightPass::cpu;
    Renderer renderer(device, stage.scene, settings);
    std::vector<LightWork> light;
    for (const Moment& moment : moments) {
        const Work work = renderer.count(moment, view, {.colour = true}, true);
        if (!work.light) {
            why = "the CPU does not light " + renderer.light_passes_used().why_shader;
            return;
        }
        light.push_back(*work.light);
    }
    Roofline& roofline = result.roofline.emplace();
    roofline.light = typical_light(light);
    roofline.peaks = measure_peaks(settings.light_level, roofline.light.beam_texels);
}

} // namespace

std::vector<Technique> chosen_techniques(const std::vector<std::string>& names) {
    for (auto name = names.begin(); name != names.end(); ++name) {
        technique_named(*name, {}, "--techniques");
        if (std::find(names.begin(), name, *name) != name)
            throw InputError({{}, 0, 0, "--techniques"}, "found '" + printable(*name) + "' twice", "each technique once");
    }
    std::vector<Technique> rows;
    for (const Technique& row : techniques())
        if (names.empty() || row.name == reference_technique || std::ranges::find(names, row.name) != names.end())
            rows.push_back(row);
    return rows;
}

TimedTechnique timed_frames(Renderer& renderer, const std::vector<Moment>& moments, const View& view, std::vector<Work>& work) {
    static constexpr FrameOutputs outputs{.colour = true};
    renderer.prepare(moments, view, outputs);
    for (const Moment& moment : moments)
        work.push_back(renderer.count(moment, view, outputs));
    return {[&](std::size_t moment) { renderer.render(moments[moment], view, outputs); }, [&] { renderer.finish(); }};
}

std::vector<int> ticks_over(int count, int n) {
    if (n < 1 || n > count)
        throw InputError({{}, 0, 0, "--count"}, fmt::format("found {}", n), fmt::format("1 to {}, the drive's moments", count));
    std::vector<int> ticks;
    for (int i = 0; i < n; ++i)
        ticks.push_back(static_cast<int>((2LL * i + 1) * count / (2LL * n)));
    return ticks;
}

BenchResult run_bench(const BenchRequest& request) {
    const std::vector<Technique> rows = chosen_techniques(request.techniques);
    Stage stage(request.drive);
    const LampSet& lamp_set = lamp_set_of(stage.drive, request.lamp_set);
    const View& view = view_to_time(stage.drive);
    const int ticks = tick_count(stage.drive);
    const std::vector<Moment> moments =
        moments_at(ticks_over(ticks, request.moments.value_or(std::min(default_bench_moments, ticks))), stage, lamp_set);
    Device device = open_device(request.backend);
    check_sanity(device);
    choose_shadows(stage, device, {});
    check_planar_shadows(stage, device, moments);
    OutputFolder folder(request.folder); // only now: bad input or a machine that cannot draw leaves no folder behind
    BenchResult result = described(request, stage, lamp_set, view, device);
    for (const Moment& moment : moments)
        result.moments.emplace_back(moment.tick, moment.time_s);
    result.gpu_not_measured = clock_refused(device);

    std::deque<Renderer> renderers;
    const std::vector<TimedTechnique> timed_techniques =
        take_part(rows, request.light_pass, device, stage, view, moments, renderers, result);
    time_rounds(timed_techniques, request, device, result);
    result.lit_by = lit_by(result, renderers);
    add_roofline(device, stage, view, moments, result);
    request.write(result);
    if (result.interrupted.empty()) {
        ContactSheet sheet = new_sheet(stage, lamp_set, moments[moments.size() / 2]);
        for (Renderer& renderer : renderers)
            add_tile(sheet, renderer);
        request.write_plot(contact_sheet(sheet));
    }
    if (result.interrupted.empty())
        folder.finish();
    return result;
}

} // namespace fernlicht
