#include "scenarios/drives/play/advance.h"

#include "scenarios/drives/play/bus_play.h"
#include "scenarios/drives/play/storyboard_timeline.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {

State state_at(int tick, const Drive& drive) {
    const double time_s = tick * drive.step_s;
    return {tick, time_s, route_distance_m(drive, time_s), own_speed_mps(drive, time_s)};
}

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

double route_distance_m(const Drive& drive, double time_s) {
    const auto place = track_place(drive, time_s);
    return place ? place->distance_m : drive.bus_motion ? drive.bus_motion->route_distance_m(time_s) : distance_m(drive.speed, time_s);
}

double own_speed_mps(const Drive& drive, double time_s) {
    return drive.bus_motion ? drive.bus_motion->speed_mps(time_s) : speed_mps(drive.speed, time_s);
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

} // namespace fernlicht
