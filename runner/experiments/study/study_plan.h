// What a study is about to play: every cell with all that decides its figures, read and checked before the first frame, and its key.
#pragma once

#include "runner/experiments/run/run_drives.h"
#include "runner/findings/lamp_checks.h"
#include "runner/store/cell_key.h"
#include "runner/store/cell_store.h"
#include "scenarios/studies/study.h"

namespace fernlicht {

struct StudyOptions;

/// A cell without its drive, which is read again when it is played and when it is collected: a study may have thousands.
struct PlannedCell {
    StudyCell cell;
    std::string drive, title;  ///< of the drive: its name, and for people
    std::string resolved_file; ///< its name in the cell's folder
    bool left_hand_traffic = false, limits_times = false;
    int moments = 0, moments_of_drive = 0; ///< to be played, and that the whole drive has
    CellSettings settings;
    CellInputs own_inputs; ///< but for those of the machine
    std::string key;
    std::shared_ptr<const FilesRead> road, others; ///< opened for its road, and beside road and lamps
};

struct StudyPlan {
    std::vector<PlannedCell> cells;
    std::vector<CheckedLampFile> lamp_files;
    RunContext context;    ///< of this machine
    CellInputs of_machine; ///< inputs of every cell: program, libraries, device

    CellInputs inputs(const PlannedCell& cell) const;
};

/// Reads everything that the chosen cells need, and opens the device once. Throws InputError and DeviceError where anything could not be
/// played.
StudyPlan plan_study(const Study& study, const StudyOptions& options);

/// Throws InputError for a name among `decide` and `limits` that no reading can have. plan_study asks for it, too.
void refuse_unknown_readings(const Study& study);

/// As `--frames` takes it; "" for all moments.
std::string frames_text(const TickRange& ticks);

/// Places of the cells that are to be played and that the store lacks; with `damaged_too`, which reads the whole store, also of those that
/// it holds damaged.
std::vector<std::size_t> lacking_cells(const CellStore& store, const StudyPlan& plan, bool damaged_too = false);

/// Why each of these cells (places in the plan), which the store lacks or holds damaged, must be played; "new" where this study never
/// played it.
std::vector<std::vector<std::string>> reasons_to_play(const Study& study, const StudyPlan& plan, const std::vector<std::size_t>& cells,
                                                      const CellStore& store);

} // namespace fernlicht
