// What is never known exactly of a car's lamps, by as much as usual: how a moment's lamps would stand and shine then.
#pragma once

#include "scenarios/drives/play/moment.h"

#include <array>

namespace fernlicht {

struct Nudge {
    double pitch_rad = 0.0;                              ///< of each lamp about itself, up positive
    double flux_factor = 1.0;                            ///< of all lamps
    double lift_m = 0.0;                                 ///< of all lamps
    double body_pitch_rad = 0.0, body_rear_lift_m = 0.0; ///< of the car about its rear axle, nose up positive; of its rear axle
};

/// The moment with the own lamps nudged; nothing else of it changes, the car's own place neither.
Moment nudged(Moment moment, const Nudge& nudge);

/// 0.1 degrees of aim, 10 % of flux, 10 mm of height, and 75 kg over the rear axle.
enum class NudgeKind { aim_up, aim_down, brighter, dimmer, higher, lower, loaded };
inline constexpr std::size_t nudge_kinds = 7;
inline constexpr double nudge_aim_deg = 0.1, nudge_flux = 0.1, nudge_height_m = 0.01, nudge_load_kg = 75.0;

/// In the order of NudgeKind; nullopt for the load of a car without a vehicle, whose springs nobody knows. The load presses springs and
/// tyres of the rear axle; levelling takes back what sensors at the springs see of it, as far as its actuator goes.
using Nudges = std::array<std::optional<Nudge>, nudge_kinds>;
Nudges usual_nudges(const Drive& drive, const LampSet& lamp_set);

} // namespace fernlicht
