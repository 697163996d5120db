#include "scenarios/drives/advance.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

/// Times are tick * step with step perhaps 1/30, so a moment meant to be at 4 s may lie a rounding error before it.
constexpr double tick_tolerance = 1.0e-6;

State state_at(int tick, const Drive& drive) {
    const double time_s = tick * drive.step_s;
    return {tick, time_s, distance_m(drive.speed, time_s), speed_mps(drive.speed, time_s)};
}

/// Surface point and normal at a distance; beyond the route's end the surface goes on straight.
Pose contact(const Route& route, double distance_m, double offset_left_m) {
    Pose pose = route.pose(std::min(distance_m, route.length_m()), offset_left_m);
    pose.position_m += pose.forward() * std::max(distance_m - route.length_m(), 0.0);
    return pose;
}

void apply(const LampChange& change, MountedLamp& lamp) {
    lamp.level = change.level.value_or(lamp.level);
    lamp.pitch_rad = change.pitch_rad.value_or(lamp.pitch_rad);
    lamp.yaw_rad = change.yaw_rad.value_or(lamp.yaw_rad);
    lamp.roll_rad = change.roll_rad.value_or(lamp.roll_rad);
    lamp.file = change.file ? change.file : lamp.file;
    lamp.colour = change.colour.value_or(lamp.colour);
    lamp.source = change.source.value_or(lamp.source);
}

LitLamp lit(const MountedLamp& lamp, const Pose& ego) {
    return {lamp.name, lamp.file, compose(ego, lamp.pose()), lamp.intensity_factor(), lamp.colour, lamp.photometric_distance_m};
}

} // namespace

State start(const Drive& drive) { return state_at(0, drive); }

State advance(const State& state, const Drive& drive) { return state_at(state.tick + 1, drive); }

int tick_count(const Drive& drive) { return std::max(1, static_cast<int>(std::ceil(drive.duration_s / drive.step_s - tick_tolerance))); }

double speed_mps(const std::vector<SpeedPoint>& profile, double time_s) {
    const auto next =
        std::upper_bound(profile.begin(), profile.end(), time_s, [](double t, const SpeedPoint& point) { return t < point.time_s; });
    if (next == profile.begin())
        return profile.front().speed_mps;
    const SpeedPoint& before = *(next - 1);
    if (next == profile.end())
        return before.speed_mps;
    return std::lerp(before.speed_mps, next->speed_mps, (time_s - before.time_s) / (next->time_s - before.time_s));
}

double distance_m(const std::vector<SpeedPoint>& profile, double time_s) {
    double distance = profile.front().speed_mps * std::min(time_s, profile.front().time_s);
    for (std::size_t i = 0; i < profile.size() && profile[i].time_s < time_s; ++i) {
        const double end_s = i + 1 < profile.size() ? std::min(time_s, profile[i + 1].time_s) : time_s;
        distance += (end_s - profile[i].time_s) * 0.5 * (profile[i].speed_mps + speed_mps(profile, end_s));
    }
    return distance;
}

void fit_to_route(Drive& drive, const Route& route) {
    const double room_m = route.length_m() - drive.bumper_m;
    if (room_m < 0.0)
        throw InputError({drive.road_file, 0, 0, {}}, fmt::format("a route of {:.3g} m", route.length_m()),
                         fmt::format("more than the {:.3g} m from the rear axle to the bumper", drive.bumper_m));
    const int planned = tick_count(drive);
    if (state_at(planned - 1, drive).distance_m <= room_m)
        return;
    int fits = 1, too_far = planned - 1; // ticks; the distance grows with the tick
    while (fits < too_far) {
        const int middle = fits + (too_far - fits) / 2;
        if (state_at(middle, drive).distance_m <= room_m)
            fits = middle + 1;
        else
            too_far = middle;
    }
    const double asked_s = drive.duration_s;
    drive.duration_s = fits * drive.step_s;
    drive.notes.push_back(fmt::format("the route is {:.1f} m long: the drive ends after {:.3g} s instead of {:.3g} s", route.length_m(),
                                      drive.duration_s, asked_s));
}

Pose ego_pose(const Route& route, double distance_m, double wheelbase_m) {
    const Pose rear = contact(route, distance_m, 0.0);
    // The front axle's place seen from the lane there: the lane may bend away from under it.
    const glm::dvec3 straight_ahead = to_parent(rear, {wheelbase_m, 0.0, 0.0});
    const glm::dvec3 beside = to_local(contact(route, distance_m + wheelbase_m, 0.0), straight_ahead);
    const Pose front = contact(route, distance_m + wheelbase_m + beside.x, beside.y);

    const glm::dvec3 forward = glm::normalize(front.position_m - rear.position_m);
    const glm::dvec3 left = glm::normalize(glm::cross(rear.up() + front.up(), forward));
    return {rear.position_m, {forward, left, glm::cross(forward, left)}};
}

Moment moment_at(const State& state, const Drive& drive, const Route& route, const Variant& variant) {
    std::vector<MountedLamp> lamps = variant.lamps;
    for (const LampChange& change : variant.changes) {
        if (change.time_s > state.time_s + tick_tolerance * drive.step_s)
            break; // sorted by time
        for (MountedLamp& lamp : lamps)
            if (lamp.name == change.lamp)
                apply(change, lamp);
    }
    Moment moment;
    moment.tick = state.tick;
    moment.time_s = state.time_s;
    moment.distance_m = state.distance_m;
    moment.speed_mps = state.speed_mps;
    moment.ego = ego_pose(route, state.distance_m, drive.wheelbase_m);
    moment.daylight = drive.daylight;
    for (const MountedLamp& lamp : lamps)
        moment.lamps.push_back(lit(lamp, moment.ego));
    return moment;
}

} // namespace fernlicht
