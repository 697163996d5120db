// What a storyboard changes during a drive besides where cars are: the sky, the weather; and where the own car's track lies on the route.
#pragma once

#include "scenarios/drives/drive.h"

namespace fernlicht {

/// The sky and the air from a time on.
struct SkyChange {
    double from_s = 0.0;
    double clock_from_s = 0.0; ///< when the date and time of the daylight's clock were given
    Daylight daylight;
    Weather weather;
};

/// A track beside a route: its points' places along it.
struct TrackPlace {
    double time_s = 0.0;
    double distance_m = 0.0;    ///< along the route, 0 to its length
    double offset_left_m = 0.0; ///< of the car from the centre of the route's lane
    double lane_left_m = 0.0;   ///< of the centre of the lane that it is on; 0 beside all lanes
};

struct StoryboardTimeline {
    std::vector<SkyChange> skies;   ///< those after the beginning, by time; before the first the drive's own holds
    std::vector<TrackPlace> places; ///< by time; empty: not laid on a route
};

/// Daylight and weather of a drive at that time; changes hold from the first tick at or after them.
Daylight daylight_of(const Drive& drive, double time_s);
const Weather& weather_of(const Drive& drive, double time_s);

/// Lays the own car's track, where the drive has one, on its route: each point's nearest place, found from the one before. From then on
/// track_place() and the distances of advance.h go by it. Nothing without a track.
void lay_on_route(Drive& drive, const Route& route);

/// Linear between the track's points. nullptr-like (nullopt) without a track, or before lay_on_route().
std::optional<TrackPlace> track_place(const Drive& drive, double time_s);

} // namespace fernlicht
