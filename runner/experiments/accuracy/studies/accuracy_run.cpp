
#include "renderer/renderer.h"
#include "runner/experiments/accuracy/picture_errors.h"
#include "runner/experiments/accuracy/studies/studies.h"
#include "runner/files/output_folder.h"
#include "runner/findings/run_context.h"
#include "runner/play/progress.h"
#include "runner/play/shadows/choose_shadows.h"
#include "scenarios/drives/play/advance.h"

#include <algorithm>
#include <deque>
#include <fmt/format.h>
#include <iterator>
#include <optional>
#include <thread>
#include <unistd.h>

namespace fernlicht {
namespace {

bool asked_for(const AccuracyRequest& request, const char* diagram) {
    return std::ranges::find(request.diagrams, diagram) != request.diagrams.end();
}

void add_sweep(const AccuracyRequest& request, const Stage& stage, const std::optional<ShadowChoice>& choice, Device& device,
               AccuracyResult& result) {
    std::optional<Progress> progress;
    int steps = 0;
    SweepRequest sweep = request.sweep;
    sweep.shadow_methods = asked_for(request, "shadows");
    result.drives.push_back(sweep_techniques(
        stage, device, sweep,
        [&](std::size_t done, std::size_t all, const std::string&) {
            steps = static_cast<int>(all);
            if (!progress)
                progress.emplace("accuracy of " + stage.drive.name, steps, request.quiet, "steps");
            progress->done(static_cast<int>(done));
            return !Interruption::requested();
        },
        Interruption::requested));
    if (result.drives.back().missing.empty())
        progress->done(steps);
    if (choice)
        result.drives.back().shadow_choice = fmt::format("auto chose {}: {}", name(choice->chosen), choice->why);
    std::ranges::move(sweep_diagrams(result.drives.back()), std::back_inserter(result.diagrams));
}

/// Each on the middle or some moments of the drive.
void add_studies(const AccuracyRequest& request, const Stage& stage, Device& device, AccuracyResult& result) {
    const LampSet& lamp_set = lamp_set_of(stage.drive, request.sweep.lamp_set);
    bool ended = false; // whether the study at hand was told to end
    const StudyGoesOn go_on = [&ended] { return !(ended = Interruption::requested()); };
    const auto add_all = [&](const char* name, auto study) {
        if (!asked_for(request, name))
            return;
        const bool begun = go_on();
        if (begun)
            for (WorkPrecision& diagram : study()) {
                diagram.name += "-" + stage.drive.name;
                diagram.title += fmt::format(": {}, {}", stage.drive.name, lamp_set.name);
                result.diagrams.push_back(std::move(diagram));
            }
        if (ended)
            result.missing.push_back(
                fmt::format("diagram {} of {}: {}", name, stage.drive.name, begun ? "ended before its last row" : "not begun"));
    };
    const auto add = [&](const char* name, auto study) { add_all(name, [&] { return std::vector<WorkPrecision>{study()}; }); };
    add_all("reference", [&] { return reference_study(stage, lamp_set, request.sweep.seed, go_on); });
    add("classical", [&] {
        const Moment moment = moments_at({tick_count(stage.drive) / 2}, stage, lamp_set).front();
        ClassicalStudy study;
        study.seed = request.sweep.seed;
        return classical_study(stage.scene, moment, at_size(*driver_view(stage.drive), 64, 48), study, go_on);
    });
    add("extent", [&] { return extent_study(stage, lamp_set, go_on); });
    add("beam", [&] { return beam_study(lamp_set, go_on); });
    add_all("weather", [&] { return weather_study(stage, lamp_set, device, go_on); });
    add("metrics", [&] { return metrics_study(stage, lamp_set, device, go_on); });
    if (!stage.drive.traffic.empty())
        add("traffic", [&] { return traffic_study(stage, lamp_set, device, go_on); });
    if ((!stage.drive.traffic.empty() || !stage.drive.street_lamps.empty()) && stage.drive.shadows.any())
        add("traffic", [&] { return traffic_shadow_study(stage, lamp_set, device, go_on); });
    add("step", [&] { return step_study(stage, lamp_set, go_on); });
}

} // namespace

std::vector<std::string> diagram_names() {
    return {"techniques", "reference", "classical", "solvers", "control", "extent",
            "beam",       "weather",   "metrics",   "step",    "traffic", "shadows"};
}

AccuracyResult run_accuracy(const AccuracyRequest& request) {
    std::deque<Stage> stages; // everything is read and checked before the first frame
    for (const Drive& drive : request.drives) {
        const Stage& stage = stages.emplace_back(drive);
        check_sweep(request.sweep, stage);
    }
    Device device = open_device(request.backend);
    check_sanity(device);
    for (const Stage& stage : stages)
        check_planar_shadows(stage, device);
    OutputFolder folder(request.folder);
    AccuracyResult result;
    result.context = make_context(device.info(), request.command, request.sweep.seed);
    result.cores = std::thread::hardware_concurrency();
    result.rounds = static_cast<std::size_t>(request.sweep.rounds);
    result.target_error = request.sweep.target_error;
    result.max_samples = request.sweep.max_samples;
    const Interruption listening;
    const CpuUse before = cpu_use();
    for (Stage& stage : stages) {
        const std::optional<ShadowChoice> choice = choose_shadows(stage, device, {});
        add_inputs(result.context.inputs, stage.drive.opened);
        add_inputs(result.context.inputs, stage.network.opened);
        if (asked_for(request, "techniques") || asked_for(request, "shadows")) {
            if (!Interruption::requested())
                add_sweep(request, stage, choice, device, result);
            else
                result.missing.push_back(fmt::format("drive {}: not begun", stage.drive.name));
        }
        add_studies(request, stage, device, result);
    }
    if (asked_for(request, "solvers")) {
        if (!Interruption::requested())
            std::ranges::move(solver_diagrams(study_solvers()), std::back_inserter(result.diagrams));
        else
            result.missing.emplace_back("diagram solvers: not begun");
    }
    if (asked_for(request, "control")) {
        result.diagrams.push_back(control_study([] { return !Interruption::requested(); }));
        if (Interruption::requested())
            result.missing.emplace_back("diagram control: ended before its last row");
    }
    for (const DriveAccuracy& drive : result.drives)
        for (const std::string& missing : drive.missing)
            result.missing.push_back(fmt::format("drive {}: {}", drive.drive, missing));
    result.others = other_load(before, cpu_use(), ::getpid());
    if (Interruption::requested())
        result.interrupted = Interruption::words();
    request.write(result);
    if (result.interrupted.empty())
        folder.finish();
    return result;
}

} // namespace fernlicht
