#include "runner/accuracy/accuracy_run.h"

#include "renderer/sanity.h"
#include "runner/accuracy/solver_diagrams.h"
#include "runner/interruption.h"
#include "runner/output_folder.h"
#include "runner/progress.h"
#include "runner/run_context.h"

#include <algorithm>
#include <deque>
#include <iterator>
#include <optional>
#include <thread>
#include <unistd.h>

namespace fernlicht {

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
        if (Interruption::asked())
            break;
        std::optional<Progress> progress;
        result.drives.push_back(sweep_techniques(stage, device, request.sweep, [&](std::size_t done, std::size_t all, const std::string&) {
            if (!progress)
                progress.emplace("accuracy of " + stage.drive.name, static_cast<int>(all), request.quiet, "steps");
            progress->done(static_cast<int>(done));
            return !Interruption::asked();
        }));
        std::ranges::move(sweep_diagrams(result.drives.back()), std::back_inserter(result.diagrams));
    }
    if (request.solvers && !Interruption::asked())
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
