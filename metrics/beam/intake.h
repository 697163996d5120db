// Whether a lamp's file can be what it is used for: looked at once, before anything is measured with it.
//
// A check of files, not of lamps: it names what exports, readers and hands do to a sound beam (units, axes, sides, aim, steps), and is
// silent where a beam might be so. Figures of UN R149 are those of its tables in metrics/regulation.
#pragma once

#include "scenarios/lamps/lamp_file.h"

#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

enum class IntakeFault { function, cut_off_high, aim, rise_side, flux, peak, axis, units, coverage, steps, sharpness, sides };
/// "function", "cut-off", "aim", "rise", "flux", "peak", "type or axis", "units", "coverage", "steps", "sharpness", "sides"
const char* name_of(IntakeFault fault);
const char* name_of(BeamFunction function);

struct IntakeFinding {
    IntakeFault fault = IntakeFault::peak;
    bool meaningless = false; ///< readings with this file say nothing of the lamp; else it is doubtful, and may be so
    std::string text;         ///< what was found and what is expected, without full stop
};

/// What is known of a lamp beside its file.
struct IntakeContext {
    std::optional<BeamFunction> function; ///< nullopt: recognised
    bool left_hand_traffic = false;
    /// How far its mount turns the beam up, degrees; nullopt where it is aimed by its cut-off, wherever the table has that.
    std::optional<double> turned_up_deg = 0.0;
    double turned_right_deg = 0.0;          ///< and to the right
    std::optional<BeamFunction> mount = {}; ///< whose place on the car it has, low or high; nullopt: not known, or for any beam
};

struct Intake {
    BeamFunction function = BeamFunction::other;
    bool function_stated = false;
    Peak peak;
    double flux_lm = 0.0;
    std::optional<double>
        cut_off_v_deg; ///< V of the cut-off's level part as the table has it, as measure_cut_off finds it or to about 0.1 degrees
    std::optional<double> elbow_h_deg;   ///< where that rise begins, to about 0.3 degrees
    std::optional<double> sharpness;     ///< G of the cut-off, the largest of three places beside V-V; of steps up to 0.1 degrees alone
    std::optional<double> rise_deg;      ///< by which it lies higher on the right, between 1.5 and 6 degrees aside; < 0: on the left
    std::optional<double> step_deg;      ///< of the file's own samples in V, across the cut-off; low beams alone
    std::vector<IntakeFinding> findings; ///< at most one of a fault
};

/// The table must hold its invariants. A beam of another function than low and high has no findings. Where type or axis is wrong, or a low
/// beam stands for a high beam or the other way round, nothing else is claimed: all else follows from it.
Intake check_intake(const LampFile& lamp, const IntakeContext& context = {});

/// Low or high where the light alone leaves no doubt: a cut-off below the horizon, or none and half the maximum straight ahead; else other.
BeamFunction clear_function(const LampFile& lamp);

/// Whether the files of a car's left and right lamp of one function stand in each other's place: by "left" and "right" in their names
/// (`by_names`; false where the lamps were mirrored after reading), or by the wide light, of which a headlamp sends more to its own side of
/// the car. nullopt for one file twice, and where names and light do not say so.
std::optional<IntakeFinding> swapped_sides(const LampFile& left, const LampFile& right, bool by_names = true);

} // namespace fernlicht
