// A study: lamps x drives x techniques x conditions, and what is to be compared with what. Read from YAML.
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/studies/study_axes.h"
#include "scenarios/studies/study_resources.h"

namespace fernlicht {

/// One lamp set of a study: what the car carries in place of the drive's own lamps.
struct StudyLamp {
    std::string name;
    std::size_t line = 0, column = 0;  ///< of its aim in the study's file; of the lamp where it has none of its own
    std::filesystem::path left, right; ///< low beams; the same file twice where the study names one
    std::filesystem::path high;        ///< high beams; "" for none
    std::filesystem::path recipe;      ///< of those of them that are text grids; "" for none
    SourceKind source = SourceKind::filament;
    LampColour colour;
    std::optional<BeamAim> aim;                         ///< nullopt: as the drive has its lamps
    std::optional<double> pitch_rad, yaw_rad, roll_rad; ///< in place of the drive's
    /// The dip that the lamp's file already holds: files measured in regulation aim have their cut-off 1 % down. Not of an automatic aim.
    double file_aim_percent = -1.0;
    std::optional<double> reference_voltage_v; ///< at which its files were measured; nullopt: not stated
    std::optional<BeamFunction> function;      ///< of `left` and `right`; nullopt: not stated
    bool mirrors = true;                       ///< false: its tables stay as the files have them where the condition mirrors
};

/// Values of each condition; every combination is played.
struct StudyConditions {
    std::vector<Daylight> times_of_day;
    std::vector<double> aim_percent{-1.0}; ///< of the cut-off: -1 is 1 cm down in 1 m; an automatic aim finds it, else the file has its dip
    std::vector<double> voltage_v{13.2};
    std::vector<bool> mirror{false}; ///< true: drives, roads and lamps in a mirror, for the other side's traffic
};

struct StudyComparison {
    std::string tested, against; ///< lamps by name
};

/// On a reading of one lamp, or on how much it changed.
struct StudyLimit {
    std::string reading;
    std::string lamp; ///< "" for every lamp; always "" for a change
    std::optional<double> at_least, at_most, change_at_least, change_at_most;
    std::size_t line = 0; ///< in the study's file
};

struct Study {
    std::string name, title;
    std::filesystem::path file;
    std::string text; ///< of the file
    std::vector<StudyLamp> lamps;
    std::vector<std::filesystem::path> drives;
    std::vector<std::string> techniques{"photometric"};
    StudyConditions conditions;
    std::vector<StudyAxis> axes;
    StudySample sample;
    std::vector<StudyPoint> points{{}}; ///< of the axes; every one is played under every condition
    SeeingParameters measure;           ///< what every drive measures of seeing and glare where it does not ask for it itself
    std::vector<StudyComparison> comparisons;
    std::vector<std::string> decide; ///< readings by name or pattern (glob.h), the most important first
    std::vector<StudyLimit> limits;
    std::vector<std::string> timed_cells;             ///< by name or pattern: what the history of its times is of
    int pictured_moments = 4;                         ///< stored moments of each cell
    std::optional<std::pair<int, int>> resolution_px; ///< of the camera views; nullopt: the drives' own
    StudyResources resources;                         ///< of each cell
    double noise_relative = 0.0;                      ///< standard deviation of the lamps' intensities, for the comparison of their tables
    FilesRead opened;
};

/// Whether the axis has more than one value: else it says nothing of a cell that is not true of all.
bool varies(const Study& study, std::size_t axis);

template <class Struct> struct Fields;
const Fields<Study>& study_fields(); ///< the keys of its file

/// Planning reads every drive once, some 40 ms each.
inline constexpr std::size_t max_study_cells = 100'000;

/// One thing that is played: a drive with one lamp set in one technique under one condition.
struct StudyCell {
    std::string name; ///< its folder: "straight_xenon", with technique, conditions and the number of the point where the study has several
    std::size_t drive = 0, lamp = 0, technique = 0, time_of_day = 0, aim = 0, voltage = 0, mirror = 0,
                point = 0;       ///< indices into the study's lists
    std::vector<AxisValue> axes; ///< of its point, all axes of the study
    std::string condition;       ///< "night, mirrored, weather.wetness 0.5"; aim and voltage where they are not the usual ones; for people
};

/// Reads and checks a study file, version 1 (scenarios/study.example.yaml explains every key). Throws InputError with file, line, column
/// and key: unknown keys (with the nearest known one), names that no lamp has, a condition that cannot be played, more cells than
/// max_study_cells. Lamp and drive files must exist; they are read by cell_drive.
Study read_study(const std::filesystem::path& path);

/// All cells: drives, then techniques, times of day, aims, voltages, mirrors, points of the axes, and lamps innermost, so that what is
/// compared lies side by side.
std::vector<StudyCell> cells_of(const Study& study);

/// The drive that plays a cell: the study's drive file with the values of its point and with this lamp set alone, its aim, voltage and
/// daylight, few stored moments. Throws InputError for what the drive file or the lamp refuses, naming the axis where a value is the
/// reason, and for a drive with high beams where the lamp set has none.
Drive cell_drive(const Study& study, const StudyCell& cell);

/// The readings that decide where nobody names any: what is bought with light (docs/studies.md#what-decides).
const std::vector<std::string>& decides_by_default();

} // namespace fernlicht
