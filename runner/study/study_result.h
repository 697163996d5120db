// What a study found: its cells as read back from their reports, what changed from lamp to lamp, verdicts.
#pragma once

#include "metrics/lamp_difference.h"
#include "runner/report/report.h"
#include "scenarios/studies/study.h"

#include <map>

namespace fernlicht {

/// Reach on the own lane's centre over a drive; NaN where it was not measured.
struct ReachOverDrive {
    ExtentPlane plane = ExtentPlane::road;
    double limit_lx = 0.0;
    std::vector<double> distance_m, reach_m;
};

/// Illuminance in an oncoming eye, facing the lamps, or through mirrors, over the distance to it; NaN where it was not measured.
struct GlareOverDrive {
    std::string subject, over; ///< "glare_opposite", "distance to the observer"
    std::vector<double> at_m, facing_lx;
};

struct CellResult {
    StudyCell cell;
    std::string drive, variant;              ///< names as its report has them; "" when it was not played
    std::string title;                       ///< of the drive, for people
    std::vector<View> maps;                  ///< the drive's views from above
    double grid_cell_m = 0.5;                ///< of the extents' grid along the road; across it is a quarter of this
    std::string failed;                      ///< why there is no report; "" when there is one
    bool reused = false;                     ///< played by an earlier call
    std::map<std::string, Reading> readings; ///< of the whole drive, by name
    std::vector<ReachOverDrive> reaches;     ///< rendered
    std::vector<GlareOverDrive> glares;
    std::vector<StoredFrame> frames;                      ///< paths relative to the study's folder
    std::vector<Verdict> verdicts;                        ///< limits of the drive, references
    std::optional<double> error_share, error_floor_share; ///< 95 % of the road's illuminance against the reference lies within
    std::optional<double> frame_s;                        ///< a driver's view
    std::string command;                                  ///< that repeats it
};

/// How sure a change is.
enum class ChangeKind {
    real,       ///< beyond what calculation leaves open, and beyond what 0.1 degrees of aim would do
    within_aim, ///< beyond calculation, but 0.1 degrees of aim would do as much
    none,       ///< not beyond what calculation leaves open
    unknown     ///< one side was not measured, or nothing tells how exact the reading is
};
const char* change_name(ChangeKind kind); ///< "real", "within aim", "no difference", "not known"

/// One reading of one drive under one condition: a lamp against another.
struct Change {
    std::size_t tested = 0, against = 0; ///< cells
    std::string reading, unit;
    std::optional<double> new_value, old_value;
    std::optional<double> uncertainty; ///< of the difference, same unit; docs/studies.md
    std::optional<double> by_aim;      ///< what 0.1 degrees of aim moves the reading by, the larger of both lamps
    ChangeKind kind = ChangeKind::unknown;
    std::string why_not; ///< for unknown
    bool decides = false;

    double delta() const { return new_value.value_or(0.0) - old_value.value_or(0.0); }
    /// |delta| over the larger of both sizes, 0 to 2: the measure by which changes are ranked. 1 where the old value was 0.
    double size() const;
};

struct LampComparison {
    std::string tested, against; ///< lamps of the study
    std::string side;            ///< "left", "right", or "left and right" where both are the same files
    std::filesystem::path file, other_file;
    LampDifference difference;
};

struct StudyFigure {
    std::string name;  ///< of its files below figures/, without extension
    std::string title; ///< for people
    std::string svg;
    std::vector<std::size_t> cells; ///< whose reports it was drawn from
};

struct StudyResult {
    Study study;
    RunContext context; ///< of this call
    std::vector<CellResult> cells;
    std::vector<LampComparison> lamps;
    std::vector<Change> changes;      ///< all readings, in the order of comparisons, cells and names
    std::vector<std::size_t> largest; ///< at most three of `changes`: the largest real ones, each reading once
    std::vector<Verdict> verdicts;    ///< the study's own limits
    std::vector<StudyFigure> figures;
    std::string interrupted; ///< why not all cells were tried; "" when they were
    bool complete() const;
};

/// fail if a limit was exceeded, else not_measured if anything is missing (a cell that failed, too), else pass.
VerdictKind overall(const StudyResult& result);

/// Fills a cell's result from the report in its folder. Throws InputError when that is no complete report of one drive.
void read_cell_report(const std::filesystem::path& study_folder, CellResult& cell);

/// The comparisons, ranking and limits of what was played.
void compare_cells(StudyResult& result);

} // namespace fernlicht
