// The radius of a path, and how far it strays from a circle, as track tests define them.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace fernlicht {

struct PathCircle {
    double radius_m = 0.0; ///< through first, middle and last place, left positive; infinite on a straight
    double arc_rad = 0.0;  ///< of it from the first to the last
};
/// nullopt for fewer than three places.
std::optional<PathCircle> path_circle(const std::vector<glm::dvec2>& places_m);
/// How far the farthest place is off the circle of that radius (left positive) through the first and the last, at most half round.
double off_circle_m(const std::vector<glm::dvec2>& places_m, double radius_m);

} // namespace fernlicht
