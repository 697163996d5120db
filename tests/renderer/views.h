// Views that tests draw, and their pixels; with what every test of pictures includes.
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <tuple>
#include <utility>
#include <vector>

namespace fernlicht {

/// (x, y) row by row, but those so near to the picture's edge; of every `step`th row and column.
inline std::vector<std::pair<int, int>> each_pixel(int width, int height, int edge = 0, int step = 1) {
    std::vector<std::pair<int, int>> all;
    for (int y = edge; y < height - edge; y += step)
        for (int x = edge; x < width - edge; x += step)
            all.emplace_back(x, y);
    return all;
}
inline std::vector<std::pair<int, int>> each_pixel(const View& view, int edge = 0, int step = 1) {
    return each_pixel(view.width_px, view.height_px, edge, step);
}

/// From where a driver sits, along the road.
inline View driver_view(int width_px, int height_px, double fov_deg = 30.0, double pitch_deg = -3.0) {
    return {.name = "driver",
            .position_m = {1.5, 0.35, 1.2},
            .pitch_rad = radians(pitch_deg),
            .vertical_fov_rad = radians(fov_deg),
            .width_px = width_px,
            .height_px = height_px};
}

inline View map_view(double ahead_m, double behind_m, double beside_m, int width_px, int height_px) {
    View view{.name = "map", .projection = Projection::map, .width_px = width_px, .height_px = height_px};
    view.map_ahead_m = ahead_m;
    view.map_behind_m = behind_m;
    view.map_left_m = view.map_right_m = beside_m;
    return view;
}

} // namespace fernlicht
