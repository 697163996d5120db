// Is a change of a reading real? The one rule that studies and comparisons of runs judge by; docs/studies.md explains it.
#pragma once

#include "metrics/readings/readings.h"

#include <cmath>
#include <map>

namespace fernlicht {

/// How sure a change is.
enum class ChangeKind {
    real,       ///< beyond what calculation and noise leave open, and beyond what 0.1 degrees of aim would do
    within_aim, ///< beyond calculation and noise, but 0.1 degrees of aim would do as much
    none,       ///< not beyond what calculation and noise leave open, or the very same figure
    unknown     ///< one side was not measured, or nothing tells how exact the reading is
};
const char* change_name(ChangeKind kind); ///< "real", "within aim", "no difference", "not known"

/// One reading, new against old.
struct ReadingChange {
    ReadingKey reading = {};
    Value new_value = {}, old_value = {};
    std::optional<double> uncertainty = {}; ///< of the difference, same unit; docs/studies.md
    /// What 0.1 degrees of aim, 10 % of flux, 10 mm of height and 75 kg over the rear axle move the reading by, the larger of both sides
    /// and of either way. Aim alone decides what is real: flux and place of a lamp are measured, its aim is set by hand.
    std::optional<double> aim_effect = {}, flux_effect = {}, height_effect = {}, load_effect = {};
    std::optional<double> noise_effect = {}; ///< what three standard deviations of the lamps' noise move it by; nullopt when nothing tells
    ChangeKind kind = ChangeKind::unknown;
    std::string reason_unknown = {}; ///< for unknown

    const char* unit() const { return unit_of(reading); }
    double total_uncertainty() const {
        return std::hypot(uncertainty.value_or(0.0), noise_effect.value_or(0.0));
    } ///< calculation and noise
    Value change() const { return difference(new_value, old_value, unit()); }
    double least() const;                   ///< |change| is at least this; 0 where it is not measured
    std::optional<double> relative() const; ///< to the old value's size; nullopt where that is 0, or one of both is no number
    /// least() over the larger of both sizes, 0 to 2: the measure by which changes are ranked. 1 where the old value was 0.
    double size() const;
};

/// How fine a drive is looked at: what lies between is interpolated or not seen.
struct Steps {
    double grid_cell_m = 0.5;          ///< of the extents' grid along the road; across it is a quarter of this
    double step_s = 0.0, step_m = 0.0; ///< between moments, at most; 0: not known
    double look_step_m = 0.0;          ///< between places at which a small target is looked for; 0: not known
};

/// What one side of a comparison read over a whole drive, rows that say how exact others are among it.
struct ReadingsOfCell : Steps {
    std::map<ReadingKey, Reading> readings;
    std::map<ReadingKey, double> by_repeats; ///< of readings that differ between repeats: what chance reaches in 5 % of them
};

/// Both sides must have this reading. `lamp_noise` is the standard deviation of the difference of two intensities of the lamps'
/// tables that is no difference of the lamps, relative; 0 where both sides' tables are taken as they are.
ReadingChange change_of_reading(const ReadingKey& key, const ReadingsOfCell& now, const ReadingsOfCell& before, double lamp_noise = 0.0);

} // namespace fernlicht
