#include "renderer/gl/scene/beam_bounds.h"

#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht::gl {
namespace {

constexpr int texels_a_cell = 32;
constexpr double slack_rad = 1e-3; // what the GPU's angles may differ, many times over

} // namespace

BeamBounds::BeamBounds(const BeamTexture& beam)
    : h_first_(beam.h_first_rad), v_first_(beam.v_first_rad), h_cell_(texels_a_cell * beam.h_step_rad),
      v_cell_(texels_a_cell * beam.v_step_rad), columns_((beam.width + texels_a_cell - 1) / texels_a_cell),
      rows_((beam.height + texels_a_cell - 1) / texels_a_cell),
      most_of_cell_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0F) {
    for (int y = 0; y < beam.height; ++y)
        for (int x = 0; x < beam.width; ++x) {
            const float cd = beam.cd[static_cast<std::size_t>(y) * static_cast<std::size_t>(beam.width) + static_cast<std::size_t>(x)];
            most_ = std::max(most_, static_cast<double>(cd));
            // A sample on a border belongs to the cells on both sides.
            for (int row = std::max(0, (y - 1) / texels_a_cell); row <= y / texels_a_cell; ++row)
                for (int column = std::max(0, (x - 1) / texels_a_cell); column <= x / texels_a_cell; ++column) {
                    float& most = most_of_cell_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                                                static_cast<std::size_t>(column)];
                    most = std::max(most, cd);
                }
        }
}

double BeamBounds::most_towards(const glm::dvec3& centre, double radius) const {
    const double distance = glm::length(centre);
    if (distance <= radius)
        return most_;
    const double cone = std::asin(radius / distance) + slack_rad;
    const double v = std::atan2(centre.y, std::hypot(centre.x, centre.z)), h = std::atan2(centre.x, centre.z);
    // Across, a cone about a raised direction spans more of H than its own angle, and all of H where it holds the pole.
    const double spread = std::sin(std::min(cone, 0.5 * pi)) / std::max(std::cos(v), 1e-9);
    const double across = std::abs(v) + cone >= 0.5 * pi || spread >= 1.0 ? pi : std::asin(spread);
    const auto cells = [](double from, double to, double first, double size, int count) {
        return std::pair(std::max(0, static_cast<int>(std::floor((from - first) / size))),
                         std::min(count - 1, static_cast<int>(std::floor((to - first) / size))));
    };
    const auto [left, right] = cells(h - across, h + across, h_first_, h_cell_, columns_);
    const auto [low, high] = cells(v - cone, v + cone, v_first_, v_cell_, rows_);
    float most = 0.0F;
    for (int row = low; row <= high; ++row)
        for (int column = left; column <= right; ++column)
            most = std::max(
                most, most_of_cell_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column)]);
    return static_cast<double>(most);
}

} // namespace fernlicht::gl
