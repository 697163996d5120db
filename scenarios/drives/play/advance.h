// A drive over time: fixed steps, and what the world is like at each.
#pragma once

#include "scenarios/drives/play/moment.h"

namespace fernlicht {

/// Where a drive has got to. A function of the tick alone, so that no error adds up over the steps.
struct State {
    int tick = 0;
    double time_s = 0.0, distance_m = 0.0, speed_mps = 0.0;

    bool operator==(const State&) const = default;
};

/// Ticks are counted, and changes fall due, with this part of a step to spare: times are tick * step with step perhaps 1/30, so that a
/// moment meant to be at 4 s may lie a rounding error before it.
inline constexpr double tick_tolerance = 1.0e-6;

State state_at(int tick, const Drive& drive);
State start(const Drive& drive);
State advance(const State& state, const Drive& drive);

/// Moments of the drive: ticks 0 .. tick_count - 1, times in [0, duration). At least 1.
int tick_count(const Drive& drive);

/// Speed at `time_s` and its exact integral from 0 (trapezia of the piecewise linear profile).
double speed_mps(const std::vector<SpeedPoint>& profile, double time_s);
double distance_m(const std::vector<SpeedPoint>& profile, double time_s);

/// Distance along the route at `time_s`: of the own car's track where it has one that was laid on the route (storyboard_timeline.h), else
/// the integral of its speed.
double route_distance_m(const Drive& drive, double time_s);

/// What the drive wants of the own car at `time_s`: its own profile, or what a bus says.
double own_speed_mps(const Drive& drive, double time_s);

/// Cuts the duration so that the front bumper stays on the route, with a note. The whole drive must hold at least one tick:
/// throws InputError when the car stands beyond the route's end from the start.
void fit_to_route(Drive& drive, const Route& route);

/// The car's frame on the route: origin on the surface under the rear axle, which follows the lane's centre; heading along the lane
/// there; pitch from the contact points of both axles, roll from the mean of the surface under them. No suspension.
/// `offset_left_m`: the rear axle's from the lane's centre.
Pose ego_pose(const Route& route, double distance_m, double wheelbase_m, double offset_left_m = 0.0);

/// The lamp set's lamps at one state: changed, moved and dimmed as the drive has it.
std::vector<MountedLamp> lamps_at(const State& state, const Drive& drive, const LampSet& lamp_set);
/// A mounted lamp as a car in `car`'s pose has it.
LitLamp lit_lamp(const MountedLamp& lamp, const Pose& car);

/// Everything that the renderer and the metrics need at one state, with the lamp set's changes up to then applied. With a vehicle, place
/// and speed are those of the lamp set's motion: simulate() comes first, else std::logic_error.
Moment moment_at(const State& state, const Drive& drive, const Route& route, const LampSet& lamp_set);

} // namespace fernlicht
