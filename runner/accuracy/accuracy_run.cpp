#include "runner/accuracy/accuracy_run.h"

#include "renderer/sanity.h"
#include "runner/accuracy/classical_study.h"
#include "runner/accuracy/reference_shots.h"
#include "runner/accuracy/solver_diagrams.h"
#include "runner/accuracy/studies.h"
#include "runner/interruption.h"
#include "runner/output_folder.h"
#include "runner/progress.h"
#include "runner/run_context.h"
#include "scenarios/drives/advance.h"

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

void add_sweep(const AccuracyRequest& request, const Stage& stage, Device& device, AccuracyResult& result) {
    std::optional<Progress> progress;
    result.drives.push_back(sweep_techniques(stage, device, request.sweep, [&](std::size_t done, std::size_t all, const std::string&) {
        if (!progress)
            progress.emplace("accuracy of " + stage.drive.name, static_cast<int>(all), request.quiet, "steps");
        progress->done(static_cast<int>(done));
        return !Interruption::asked();
    }));
    std::ranges::move(sweep_diagrams(result.drives.back()), std::back_inserter(result.diagrams));
}

/// Each on the middle or some moments of the drive.
void add_studies(const AccuracyRequest& request, const Stage& stage, Device& device, AccuracyResult& result) {
    const Variant& variant = variant_of(stage.drive, request.sweep.variant);
    const StudyGoesOn go_on = [] { return !Interruption::asked(); };
    const auto add = [&](const char* name, auto study) {
        if (asked_for(request, name) && go_on())
            result.diagrams.push_back(study());
    };
    if (asked_for(request, "reference") && go_on())
        std::ranges::move(reference_study(stage, variant, request.sweep.seed, go_on), std::back_inserter(result.diagrams));
    add("classical", [&] {
        const Moment moment = moments_at({tick_count(stage.drive) / 2}, stage, variant).front();
        ClassicalStudy study;
        study.seed = request.sweep.seed;
        WorkPrecision diagram = classical_study(stage.scene, moment, resized(*driver_view(stage.drive), 64, 48), study, go_on);
        diagram.name += "-" + stage.drive.name;
        diagram.title += fmt::format(": {}, {}", stage.drive.name, variant.name);
        return diagram;
    });
    add("extent", [&] { return extent_study(stage, variant, go_on); });
    add("beam", [&] { return beam_study(stage, variant, go_on); });
    add("metrics", [&] { return metrics_study(stage, variant, device, go_on); });
    add("step", [&] { return step_study(stage, variant, go_on); });
}

} // namespace

std::vector<std::string> diagram_names() {
    return {"techniques", "reference", "classical", "solvers", "extent", "beam", "metrics", "step"};
}

AccuracyResult run_accuracy(const AccuracyRequest& request) {
    std::deque<Stage> stages; // everything is read and checked before the first frame
    for (const Drive& drive : request.drives) {
        const Stage& stage = stages.emplace_back(drive);
        check_sweep(request.sweep, stage);
    }
    Device device = open_device(request.backend);
    check_sanity(device);
    OutputFolder folder(request.folder);
    AccuracyResult result;
    result.context = make_context(device.info(), request.command, request.sweep.seed);
    result.cores = std::thread::hardware_concurrency();
    result.rounds = static_cast<std::size_t>(request.sweep.rounds);
    result.target_error = request.sweep.target_error;
    result.most_samples = request.sweep.most_samples;
    const Interruption listening;
    const CpuUse before = cpu_use();
    for (const Stage& stage : stages) {
        add_inputs(result.context.inputs, stage.drive.opened);
        add_inputs(result.context.inputs, stage.network.opened);
        if (asked_for(request, "techniques") && !Interruption::asked())
            add_sweep(request, stage, device, result);
        add_studies(request, stage, device, result);
    }
    if (asked_for(request, "solvers") && !Interruption::asked())
        std::ranges::move(solver_diagrams(study_solvers()), std::back_inserter(result.diagrams));
    result.others = other_use(before, cpu_use(), ::getpid());
    if (Interruption::asked())
        result.interrupted = "interrupted by the user";
    write_accuracy(result, request.folder);
    if (result.interrupted.empty())
        folder.finish();
    return result;
}

} // namespace fernlicht
