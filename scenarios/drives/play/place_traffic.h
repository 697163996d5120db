// From the rows of a drive file to road users with tracks.
#pragma once

#include "scenarios/drives/drive.h"

namespace fernlicht {

/// A row's road user without a track: body, lamps, changes (brakes by row.speed). `number`: which of the row's.
RoadUser road_user_of(const TrafficRow& row, int number);

/// Adds the road users of the drive's rows to drive.traffic, each with a track for the drive's duration along its lane as far as the road
/// goes: where it ends, they go. Brake lamps light while the speed falls by 0.7 m/s2 or more. After fit_to_route(). Throws InputError for a
/// row that has no place on the road.
void place_traffic(Drive& drive, const RoadNetwork& network, const Route& route);

} // namespace fernlicht
