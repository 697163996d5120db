// Playing what a study's store lacks on a cluster: job arrays of Slurm over the commands that any machine could run.
#pragma once

#include "runner/experiments/study/cell_playing.h"

namespace fernlicht {

struct SlurmPatience {
    double ask_every_s = 2.0;      ///< the controller, at first; up to ten times that in a long study
    double late_files_s = 30.0;    ///< a shared file system may show results so much later than their task ended
    int submissions = 3;           ///< of a cell whose task was lost: by a node, a kill, a preemption without requeue
    double refused_every_s = 60.0; ///< then sbatch is asked again for a later array that it refused
    int refusals = 60;             ///< in a row; then, where no task is active, what is due fails
};

/// Submits, waits, and submits what was lost again, until each of these cells (places in the plan) is in the store or known to have failed.
/// What was submitted stands in `options.folder`/slurm.json; a call that goes on there adopts arrays that are still active instead of
/// submitting their cells twice. A cell that was lost is submitted again in a task of its own. An interruption cancels all. As
/// play_in_workers otherwise. Throws DeviceError where Slurm refuses the first submission.
std::map<std::size_t, PlayedInWorker> play_on_slurm(const CellStore& store, const Study& study, const StudyPlan& plan,
                                                    const std::vector<std::size_t>& cells, const StudyOptions& options,
                                                    const SlurmPatience& patience = {});

} // namespace fernlicht
