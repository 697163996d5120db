// What a study found: its cells as read back from their reports, what changed from lamp to lamp, verdicts.
#pragma once

#include "metrics/beam/lamp_difference.h"
#include "metrics/readings/significance.h"
#include "runner/experiments/compare/runs/played_report.h"
#include "runner/findings/cell_inputs.h"
#include "runner/findings/document.h"
#include "runner/findings/lamp_checks.h"
#include "runner/judge/known_failures.h"
#include "scenarios/studies/study.h"

#include <set>

namespace fernlicht {

struct CellResult : PlayedResult {
    StudyCell cell;
    std::string title;                       ///< of the drive, for people
    std::vector<View> maps;                  ///< the drive's views from above
    std::vector<LuxMap::Polyline> map_edges; ///< lanes and car on the map that is shown
    std::string failed;                      ///< why there is no report; "" when there is one
    CellInputs inputs;                       ///< what decides its figures
    std::string key;                         ///< under which the store has it
    bool has_all_readings = true;            ///< else those that are told alone: all_readings()
    std::string hash_of_readings;            ///< of all, times apart, where it has not all
    bool is_kept = true;                     ///< its folder is below the study's
    bool reused = false;                     ///< taken from the store as an earlier call left it there
    std::string command;                     ///< that repeats it
    int moments = 0, moments_of_drive = 0;   ///< that were to be played, and that the whole drive has
};

/// One reading of one drive under one condition: a lamp against another.
struct Change : ReadingChange {
    std::string id;                      ///< "c3": its place in the study's list
    std::size_t tested = 0, against = 0; ///< cells
    bool decides = false;
};

struct LampComparison {
    std::string tested, against; ///< lamps of the study
    std::string side;            ///< "left", "right", or "left and right" where both are the same files
    std::filesystem::path file, other_file;
    LampDifference difference;
    std::filesystem::path recipe = {}, other_recipe = {}; ///< of files that are text grids; "" for none
    bool is_turned_later = false; ///< the study aims one of both lamps by its cut-off, and the difference is that of the files
};

struct StudyFigure {
    Plot plot;                      ///< its files lie below figures/
    std::string title;              ///< for people
    std::vector<std::size_t> cells; ///< whose reports it was drawn from
};

struct StudyResult : Findings {
    Study study;
    std::vector<std::string> call; ///< its words, to repeat parts of it
    std::string played_by;         ///< "52 of 60 cells came from the store; 8 were played, 2 at a time"
    std::string only;              ///< "straight*,*xenon": the cells asked for; "" for all
    std::string frames;            ///< "0:8": the moments asked for; "" for all
    std::string played_in_part;    ///< "Only moments 0:8 of each drive were played: 9 of 660"; "" where all of all cells were
    std::vector<CellResult> cells;
    std::vector<LampComparison> lamps;
    std::filesystem::path folder;      ///< with the reports of its cells
    bool tells_all = true;             ///< else it is too large: readings that are not told are left out of all that is written
    std::set<ReadingKey> keys;         ///< of all readings of all cells
    std::vector<Change> changes;       ///< of readings that both cells have, in the order of comparisons, cells and names
    std::size_t changes_elsewhere = 0; ///< of readings that lie in reports alone: each_change()
    std::vector<std::size_t> largest;  ///< at most three of `changes`: the largest real ones, each reading once
    std::vector<Verdict> verdicts;     ///< the study's own limits
    std::vector<StudyFigure> figures;
    std::vector<std::string> warnings;       ///< of the list of known failures
    std::vector<CheckedLampFile> lamp_files; ///< as their check found them before the first frame

    bool complete() const; ///< all cells were tried and played
    /// What the study calls the lamps of one of its cells.
    const std::string& lamp_of(std::size_t cell) const { return study.lamps[cells[cell].cell.lamp].name; }
    /// Of one of its cells: the drive, and the condition where there are several.
    std::string place_of(std::size_t cell) const;
    /// Cells that differ in nothing but the lamp: of the tested one and of the other.
    std::vector<std::pair<std::size_t, std::size_t>> pairs_of(const StudyComparison& comparison) const;
};

/// Cells of everything but the lamp alike.
bool is_same_place(const StudyCell& a, const StudyCell& b);

/// What a cell read that is told, from its report where it has not all; steps are the drive's.
ReadingsOfCell all_readings(const StudyResult& result, const CellResult& cell);

/// Hands over every change of every reading, those that `changes` lacks computed anew, two reports at a time in memory.
void each_change(const StudyResult& result, const std::function<void(const Change&)>& take);

/// Leaves what decides or has limits, and where the study is too large to tell all what tells how exact those are: a cell has more than a
/// thousand readings, and a study many cells.
void keep_told_readings(StudyResult& result, CellResult& cell);

/// Of all readings of a cell, times apart, whether or not it still has them.
std::string hash_of_readings(const CellResult& cell);

/// Adds a verdict for each of the study's own limits, and for each deciding reading that nothing has.
void judge(StudyResult& result);

/// As of a run (report.h): fail if a limit or a baseline was exceeded, flaky, not_measured if anything is missing (a cell that failed,
/// too), else pass.
VerdictKind overall(const StudyResult& result);

/// Whether a cell was not played as a disk was full: the machine's fault, not the lamps'.
bool met_full_disk(const StudyResult& result);

/// As of a run, over all cells (known_failures.h); a cell's own report does not know of it.
void apply_known_failures(StudyResult& result, const KnownFailures& known, const std::string& today);

/// Lamps whose beams stand outside the band of UN R48, each once.
void add_aim_warnings(StudyResult& result);

/// Eyes that look into the lamps (gazes.h), each once.
void add_gaze_warnings(StudyResult& result);

/// Axes of which several values read the same in every cell.
void add_axis_warnings(StudyResult& result);

/// What was played in part; the comparisons, ranking and limits of what was played.
void compare_cells(StudyResult& result);

} // namespace fernlicht
