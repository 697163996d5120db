// The bird's-eye lux map of a captured moment with the lanes' edges in map coordinates.
#pragma once

#include "runner/report/report.h"

namespace fernlicht {

/// From a frame of a map view that has illuminance.
LuxMap lux_map_of(const Frame& frame, const Moment& moment, const View& view, const Route& route);

} // namespace fernlicht
