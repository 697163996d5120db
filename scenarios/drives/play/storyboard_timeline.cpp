#include "scenarios/drives/play/storyboard_timeline.h"

#include "scenarios/drives/play/advance.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

constexpr double searched_every_m = 4.0;
constexpr double found_within_m = 1e-6, lost_beyond_m = 0.01; ///< what is left along the route when a place is found, and when it is not

/// How far along the route the point lies before the place at `distance_m`.
double left_along_m(const Route& route, double distance_m, const glm::dvec3& point_m) {
    const Pose pose = route.pose(distance_m);
    return glm::dot(point_m - pose.position_m, pose.forward());
}

/// The foot of the point on the route, from a guess. Ends of the route are feet of all that lies beyond them.
double foot_m(const Route& route, const glm::dvec3& point_m, double guess_m) {
    for (int i = 0; i < 30; ++i) {
        const double next = std::clamp(guess_m + left_along_m(route, guess_m, point_m), 0.0, route.length_m());
        const bool found = std::abs(next - guess_m) < found_within_m;
        guess_m = next;
        if (found)
            break;
    }
    return guess_m;
}

double foot_anywhere_m(const Route& route, const glm::dvec3& point_m) {
    double best_m = 0.0, least = HUGE_VAL;
    for (double d = 0.0; d <= route.length_m(); d += searched_every_m)
        if (const double away = glm::distance(route.pose(d).position_m, point_m); away < least) {
            least = away;
            best_m = d;
        }
    return foot_m(route, point_m, best_m);
}

double lane_centre_m(const Route& route, double distance_m, double offset_left_m) {
    for (const RouteLane& lane : route.cross_section(distance_m).lanes)
        if (offset_left_m <= lane.left_m && offset_left_m >= lane.right_m)
            return 0.5 * (lane.left_m + lane.right_m);
    return 0.0;
}

TrackPlace place_on(const Route& route, const TrackPoint& point, double guess_m) {
    const glm::dvec3& at_m = point.pose.position_m;
    double along_m = foot_m(route, at_m, guess_m);
    const bool within = along_m > 0.0 && along_m < route.length_m();
    if (within && std::abs(left_along_m(route, along_m, at_m)) > lost_beyond_m)
        along_m = foot_anywhere_m(route, at_m);
    const Pose foot = route.pose(along_m);
    const double offset_m = glm::dot(at_m - foot.position_m, foot.left());
    return {point.time_s, along_m, offset_m, lane_centre_m(route, along_m, offset_m)};
}

const SkyChange* sky_at(const Drive& drive, double time_s) {
    if (!drive.timeline)
        return nullptr;
    const auto after = std::ranges::upper_bound(drive.timeline->skies, time_s + tick_tolerance * drive.step_s, {}, &SkyChange::from_s);
    return after == drive.timeline->skies.begin() ? nullptr : &*(after - 1);
}

} // namespace

Daylight daylight_of(const Drive& drive, double time_s) {
    if (const SkyChange* sky = sky_at(drive, time_s))
        return daylight_at(sky->daylight, time_s - sky->clock_from_s);
    return daylight_at(drive.daylight, time_s);
}

const Weather& weather_of(const Drive& drive, double time_s) {
    const SkyChange* sky = sky_at(drive, time_s);
    return sky ? sky->weather : drive.weather;
}

void lay_on_route(Drive& drive, const Route& route) {
    if (!drive.ego_track)
        return;
    StoryboardTimeline timeline = drive.timeline ? *drive.timeline : StoryboardTimeline{};
    timeline.places.clear();
    double guess_m = foot_anywhere_m(route, drive.ego_track->points().front().pose.position_m);
    for (const TrackPoint& point : drive.ego_track->points()) {
        timeline.places.push_back(place_on(route, point, guess_m));
        guess_m = timeline.places.back().distance_m;
    }
    drive.timeline = std::make_shared<const StoryboardTimeline>(std::move(timeline));
}

std::optional<TrackPlace> track_place(const Drive& drive, double time_s) {
    if (!drive.timeline || drive.timeline->places.empty())
        return {};
    const std::vector<TrackPlace>& places = drive.timeline->places;
    const auto after = std::ranges::upper_bound(places, time_s, {}, &TrackPlace::time_s);
    if (after == places.begin())
        return places.front();
    if (after == places.end())
        return places.back();
    const TrackPlace &a = *(after - 1), &b = *after;
    const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
    return TrackPlace{time_s, std::lerp(a.distance_m, b.distance_m, share), std::lerp(a.offset_left_m, b.offset_left_m, share),
                      a.lane_left_m};
}

} // namespace fernlicht
