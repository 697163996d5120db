// What is read of a drive: one row for each quantity, and all that follows from it.
#pragma once

#include <span>

namespace fernlicht {

enum class Quantity {
    reach,
    unlit_before_reach,
    width,
    area,
    probe_illuminance,
    sensor_reach,
    sensor_illuminance,
    glare_facing,
    glare_eye,
    glare_veiling,
    glare_increment,
    glare_de_boer,
    glare_adaptation,
    glare_time,
    glare_length,
    mirror_illuminance,
    detection,
    undetected,
    visibility_level,
    background_luminance,
    mesopic_luminance,
    gradient_per_m,
    gradient_per_deg,
    patch_dark,
    patch_bright,
    foreground,
    foreground_ratio,
    uniformity,
    kerb_illuminance,
    board_illuminance,
    board_luminance,
    marking_luminance,
    control_swivel,
    control_inside,
    control_reach,
    control_glare,
    control_others,
    control_high_beam,
    control_class,
    cars_within,
    pass_time
};

enum class Better { neither, higher, lower };

/// What a quantity's subject is the name of. A drive gives these names, limits (a reading's name) and passes apart.
enum class SubjectKind { none, probe, sensor, eye, mirror, target, limit, pass };

/// Where a figure's numerical uncertainty comes from.
enum class Exactness {
    unknown,
    double_precision,   ///< computed at places and by definitions that leave no choice
    grid_and_drawing,   ///< the grid's error on that line, and the difference between rendering and twin
    grid,               ///< the grid's error
    grid_columns,       ///< a column of the grid at either end
    drawing,            ///< the difference between rendering and twin
    between_moments,    ///< half a step of the drive at either end
    look_step,          ///< a step between the places looked at
    look_step_twice,    ///< one at either end
    evenness_step_twice ///< a step of the grid of evenness at either end
};

/// How more light moves a figure.
enum class WithLight {
    unknown,
    proportional,
    twice,        ///< a ratio of two places: one may go up and the other down
    like_de_boer, ///< 2 less for ten times the light
    as_nudged     ///< as 10 % of flux move it
};

struct QuantityRow {
    Quantity quantity;
    const char* id; ///< "reach"
    /// How its names are made, one form or several between spaces (reading_key.cpp):
    /// "width_<lx>lx_(road|target)_<lane>_at_<m>m(median|_min)_m".
    const char* forms;
    const char* unit; ///< "m", "cd/m2", "%", "1"
    SubjectKind subject = SubjectKind::none;
    Better better = Better::neither;
    bool is_extent = false; ///< lit road, measured as `extent` asks
    Exactness exactness = Exactness::unknown;
    WithLight with_light = WithLight::unknown;
    const char* words; ///< for people; reading_labels.cpp fills the braces
    const char *meaning, *equation = "", *source = "";
};

/// In the order of Quantity.
std::span<const QuantityRow> quantities();
const QuantityRow& row_of(Quantity quantity);

} // namespace fernlicht
