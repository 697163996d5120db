// A map of the ground before the car, as programs place it themselves.
#pragma once

#include "scenarios/drives/drive.h"

#include <string>
#include <utility>

namespace fernlicht {

/// From `from_m` to `to_m` ahead of the car's reference point (from_m < to_m; behind it they are negative) and `beside_m` > 0 to each side.
inline View map_of(std::string name, double from_m, double to_m, double beside_m, int width_px, int height_px) {
    View view;
    view.name = std::move(name);
    view.projection = Projection::map;
    view.map_ahead_m = to_m;
    view.map_behind_m = -from_m;
    view.map_left_m = view.map_right_m = beside_m;
    view.width_px = width_px;
    view.height_px = height_px;
    return view;
}

} // namespace fernlicht
