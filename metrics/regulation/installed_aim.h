// How a lamp on a car is turned so that its beam stands where it belongs, as UN R48 has lamps aimed, and which inclination that regulation
// allows. By the same procedures as the check of a regulation (regulation_check.h), but on a lamp that turns rather than on shifted angles.
#pragma once

#include "metrics/regulation/regulation_check.h"
#include "scenarios/lamps/mounted_lamp.h"

#include <optional>
#include <string>

namespace fernlicht {

/// What a beam is aimed by, in the coordinates of its own table.
struct AimMark {
    bool high_beam = false;
    std::optional<double> v_deg; ///< of the cut-off's level part, of a high beam's middle; nullopt: nothing to aim by
    std::optional<double> h_deg; ///< of the elbow, of a high beam's middle; nullopt: nothing to aim by sideways
    Direction bound;             ///< of both, in 99 of 100 beams; 0 of a middle and of what is missing
    bool left_hand = false;      ///< the cut-off rises to the left
    std::string by;              ///< "kink", "shoulder", "elbow", "level part", "middle of the maximum"
    std::string why_not;         ///< of what is missing, without a full stop

    /// The place that an aim puts right: where nothing is found sideways, the level part where it was looked for. Needs `v_deg`.
    Direction place() const;
};

/// Low beams by AimRule::automatic, whichever side they rise to: the table as it is, then in a mirror, the first in which all is found; if
/// neither has it, by the straighter of both level parts alone. High beams by AimRule::maximum.
AimMark aim_mark(const CandelaTable& lamp, bool high_beam);

/// Yaw and pitch that put the mark straight ahead, its V at atan(cut_off_percent / 100): a rotation, exact at any angle. Without an elbow
/// the yaw is 0. A high beam's middle comes level at -1 %, and moves with the cut-off of the low beam that it stands beside. Needs `v_deg`.
Turn turn_to(const AimMark& mark, double cut_off_percent);

/// The same within a place on the car that is turned: V counts from the car's level, H from where the place faces.
Turn turn_within(const Turn& mount, const Turn& turn);

/// Height over run in per cent, up positive, of a direction of a lamp's table as it is mounted, and its angle to the right of the car's
/// axis. `body_pitch_rad`: of the car's body on its wheels, nose up positive; both then count against the road.
struct MarkOnCar {
    double percent = 0.0, right_deg = 0.0;
};
MarkOnCar mark_on_car(const MountedLamp& lamp, Direction of_table, double body_pitch_rad = 0.0);

/// Limits of a low beam's inclination in per cent, up positive.
struct InclinationBand {
    double lowest_percent = 0.0, highest_percent = 0.0;
    bool holds(double percent) const; ///< to a thousandth of a per cent, which no aim comes nearer to
};
/// UN R48, 09 series, 6.2.6.1.2, by `height_m` of the lamp over the road: from -(h + 1.2) % to -0.5 % for 0.5 to 0.9 m, from -(2.17 h +
/// 0.15) % to -(2.17 h - 1.45) % above, up to 1.2 m. It holds over all loads of annex 5. The text takes the lower edge of the lens, which a
/// drive does not know. nullopt: no band, as no passing beam of a car may be mounted there.
std::optional<InclinationBand> r48_band(double height_m);
inline constexpr const char* r48_band_source = "UN R48 (09 series, 6.2.6.1.2)";

} // namespace fernlicht
