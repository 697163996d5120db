#include "metrics/rating/path_circle.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace fernlicht {

std::optional<PathCircle> path_circle(const std::vector<glm::dvec2>& places_m) {
    if (places_m.size() < 3)
        return std::nullopt;
    const glm::dvec2 b = places_m[places_m.size() / 2] - places_m.front(), c = places_m.back() - places_m.front();
    const double chord_m = glm::length(c), twice_area = b.x * c.y - b.y * c.x;
    if (std::abs(twice_area) < 1e-6 * chord_m) // the middle is within a micrometre of the chord
        return PathCircle{std::numeric_limits<double>::infinity(), 0.0};
    // circumcircle: the product of the sides over four areas
    const double radius_m = glm::length(b) * chord_m * glm::length(c - b) / (2.0 * twice_area);
    return PathCircle{radius_m, 2.0 * std::asin(std::min(1.0, 0.5 * chord_m / std::abs(radius_m)))};
}

double off_circle_m(const std::vector<glm::dvec2>& places_m, double radius_m) {
    const glm::dvec2 c = places_m.back() - places_m.front();
    const double half_m = 0.5 * glm::length(c), radius = std::max(std::abs(radius_m), half_m);
    const glm::dvec2 left = glm::dvec2(-c.y, c.x) / (2.0 * half_m) * (radius_m > 0.0 ? 1.0 : -1.0);
    const glm::dvec2 centre = places_m.front() + 0.5 * c + std::sqrt(radius * radius - half_m * half_m) * left;
    double off_m = 0.0;
    for (const glm::dvec2& place : places_m)
        off_m = std::max(off_m, std::abs(glm::length(place - centre) - radius));
    return off_m;
}

} // namespace fernlicht
