// Nudges: by how much a car's lamps are usually uncertain, and how a moment's lamps stand and shine when nudged.
#pragma once

#include "scenarios/drives/play/moment.h"

#include <array>

namespace fernlicht {

/// Of one lamp about itself.
struct LampNudge {
    std::string lamp;
    double pitch_rad = 0.0, yaw_rad = 0.0, roll_rad = 0.0; ///< up, to the left, left side lifted
    double flux_factor = 1.0;
};

struct Nudge {
    double pitch_rad = 0.0;                              ///< of each lamp about itself, up positive
    double flux_factor = 1.0;                            ///< of all lamps
    double lift_m = 0.0;                                 ///< of all lamps
    double body_pitch_rad = 0.0, body_rear_lift_m = 0.0; ///< of the car about its rear axle, nose up positive; of its rear axle
    std::vector<LampNudge> lamps = {};                   ///< of single lamps by name, beside all that
};

/// The moment with the own lamps nudged; nothing else of it changes, the car's own place neither.
Moment nudged(Moment moment, const Nudge& nudge);

/// Of the car by so much over its rear axle, which presses springs and tyres; levelling takes back what sensors at the springs see of it,
/// as far as its actuator goes. nullopt for a car without a vehicle, whose springs nobody knows.
std::optional<Nudge> loaded_nudge(const Drive& drive, const LampSet& lamp_set, double load_kg);

/// 0.1 degrees of aim, 10 % of flux, 10 mm of height, and 75 kg over the rear axle.
enum class NudgeKind { aim_up, aim_down, brighter, dimmer, higher, lower, loaded };
inline constexpr std::size_t nudge_kinds = 7;
inline constexpr double nudge_aim_deg = 0.1, nudge_flux = 0.1, nudge_height_m = 0.01, nudge_load_kg = 75.0;

/// In the order of NudgeKind; nullopt as loaded_nudge() has it.
using Nudges = std::array<std::optional<Nudge>, nudge_kinds>;
Nudges usual_nudges(const Drive& drive, const LampSet& lamp_set);

} // namespace fernlicht
