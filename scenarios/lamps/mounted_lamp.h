// A lamp on a car: which light, its place, aim, brightness and colour.
// What happens to a mounted lamp at a time: switched, dimmed, aimed, replaced.
#pragma once

#include "scenarios/lamps/level_track.h"
#include "scenarios/values/pose.h"

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

enum class SourceKind { filament, arc, led };

/// What a spectrum gives through V(lambda), V'(lambda) and the colour matching functions.
struct LampColour {
    glm::dvec3 linear_srgb{1.0}; ///< scaled so that luminance (0.2126, 0.7152, 0.0722) . rgb = 1; components may be negative only after
                                 ///< gamut clipping is noted
    double sp_ratio = 1.0;       ///< scotopic over photopic
    double cct_k = 0.0;

    bool operator==(const LampColour&) const = default;
};

/// Planck's law between 1000 and 25 000 K.
LampColour colour_of_temperature(double kelvin);
/// CSV: wavelength in nm and relative power per line; separators comma, semicolon, tab or blanks; lines beginning with # and one line
/// of column names are skipped. Needs 400 to 700 nm covered in steps of at most 20 nm. Throws InputError.
LampColour read_spectrum(const std::filesystem::path& path, FilesRead& opened);

/// Yaw, pitch, roll as axes_from_angles has them.
struct Turn {
    double yaw_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;

    glm::dmat3 axes() const { return axes_from_angles(yaw_rad, pitch_rad, roll_rad); }
    /// What is turned by `inner` within what is turned so. Not turned at all, `inner` to the bit.
    glm::dmat3 axes_with(const glm::dmat3& inner) const { return *this == Turn{} ? inner : axes() * inner; }
    bool operator==(const Turn&) const = default;
};
/// The angles that give these axes; what is off by less than 1e-9 is not turned. Looking straight up or down, yaw 0.
Turn turn_of(const glm::dmat3& axes);

/// What its aim starts from.
enum class BeamAim {
    as_is,     ///< the axis of its file
    automatic, ///< its beam's own mark, a cut-off or the middle of a high beam, put where it belongs
};

/// At which lamps are measured: UN R149 and its forerunners; FMVSS 108, S14.2.5.4.
inline constexpr double un_voltage_v = 13.2, fmvss_voltage_v = 12.8;
/// Flux of a filament lamp at `voltage_v` over that at `reference_v`: (U / U_ref)^3.4, the lamp makers' law between 12.0 and 13.8 V.
double filament_flux_factor(double voltage_v, double reference_v);

/// Where an automatic aim puts a low beam's cut-off: below the horizon, and no lower than any regulation has it.
inline constexpr double lowest_cut_off_percent = -5.0, highest_cut_off_percent = -0.1;

struct MountedLamp {
    std::string name; ///< "left", "right", "high-left" ...
    std::shared_ptr<const LampFile> file;
    glm::dvec3 position_m{0.0};                            ///< in the car's frame: x forward, y left, z up
    double yaw_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0; ///< aim; pitch positive upwards
    double level = 1.0;                                    ///< 0..1, dimming
    double voltage_v = 13.2;
    std::optional<double> reference_voltage_v; ///< at which the file was measured; nullopt: not stated, taken as un_voltage_v
    SourceKind source = SourceKind::filament;
    LampColour colour;
    std::optional<BeamFunction> function;          ///< nullopt: not stated, recognised from the table where it matters
    double photometric_distance_m = 0.0;           ///< nearer than this the point-source equation is marked near-field
    Turn mount;                                    ///< how its place on the car is turned; the aim turns it further
    double flux_factor = 1.0;                      ///< light of this very lamp against its file's, undimmed; >= 0
    std::filesystem::path levels_file = {};        ///< of its pixels over time; empty: all at full, or as control has them
    std::shared_ptr<const LevelTrack> levels = {}; ///< what that file says

    BeamAim aim_rule = BeamAim::as_is;
    double cut_off_percent = -1.0; ///< where an automatic aim puts the cut-off: -1 is 1 cm down in 1 m
    Turn aligned;                  ///< what an automatic aim found (aim_lamps), within the angles of the aim; not part of a file

    Pose pose() const { return {position_m, mount.axes_with(aim_axes())}; }
    /// Angles of the aim, and what was found within them.
    glm::dmat3 aim_axes() const {
        const glm::dmat3 axes = axes_from_angles(yaw_rad, pitch_rad, roll_rad);
        return aligned == Turn{} ? axes : axes * aligned.axes();
    }
    /// level times flux factor times the supply's: (U / U_ref)^3.4 for filament lamps between 12.0 and 13.8 V (law of filament lamps'
    /// flux), 1 for arc and LED.
    double intensity_factor() const;
    bool operator==(const MountedLamp&) const = default; ///< with the very same file
};

/// At `time_s` the named lamps change; what is not given stays.
struct LampChange {
    double time_s = 0.0;
    std::string lamp; ///< name of a mounted lamp
    std::optional<double> level;
    std::optional<double> pitch_rad, yaw_rad, roll_rad;
    std::shared_ptr<const LampFile> file;
    std::optional<LampColour> colour;
    std::optional<SourceKind> source;
    std::optional<Turn> aligned = {}; ///< what an automatic aim found for `file`; not part of a file

    bool operator==(const LampChange&) const = default;
};

void apply(const LampChange& change, MountedLamp& lamp);

} // namespace fernlicht
