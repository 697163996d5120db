#include "metrics/rating/score.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <limits>

namespace fernlicht {
namespace {

double points_of(const std::vector<std::pair<double, double>>& points_by, double reading) {
    const auto next = std::ranges::upper_bound(points_by, reading, {}, &std::pair<double, double>::first);
    if (next == points_by.begin())
        return next->second;
    const auto& [from, points] = *(next - 1);
    return next == points_by.end() ? points : std::lerp(points, next->second, (reading - from) / (next->first - from));
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

} // namespace

Value points_at(const std::vector<std::pair<double, double>>& points_by, const Value& reading) {
    if (!reading.measured())
        return reading;
    if (reading.number())
        return points_of(points_by, *reading.number());
    double least = points_of(points_by, *reading.figure()), most = least;
    for (const auto& [value, points] : points_by)
        if (value >= reading.low() && value <= reading.high()) {
            least = std::min(least, points);
            most = std::max(most, points);
        }
    return Value::between(least, most, "");
}

Score score(const std::vector<ScoredRow>& rows, const std::vector<Grade>& grades) {
    Score whole;
    double sum = 0.0;
    std::string open;
    for (const ScoredRow& row : rows) {
        whole.most += row.weight * row.most;
        if (open.empty() && ((row.most > 0.0 && !row.points.number()) || (row.cap && row.verdict == RatingVerdict::not_measured)))
            open = row.name;
        if (row.most > 0.0)
            sum += row.weight * row.points.number().value_or(0.0);
    }
    if (whole.most == 0.0)
        return whole;
    if (!open.empty()) {
        whole.points = Value::not_measured(fmt::format("what row {} gives is not known", open));
        return whole;
    }
    for (const ScoredRow& row : rows)
        if (row.cap && row.verdict == RatingVerdict::exceeded && *row.cap < sum) {
            sum = *row.cap;
            whole.capped_by = row.name;
        }
    whole.points = sum;
    for (const Grade& grade : grades)
        if (sum >= grade.from_points)
            whole.grade = grade.name;
    return whole;
}

std::optional<PathCircle> path_circle(const std::vector<glm::dvec2>& places_m) {
    if (places_m.size() < 3)
        return std::nullopt;
    const glm::dvec2 first = places_m.front(), b = places_m[places_m.size() / 2] - first, c = places_m.back() - first;
    const double twice_area = cross(b, c);
    const double length = glm::length(c);
    PathCircle circle{std::numeric_limits<double>::infinity(), 0.0};
    if (std::abs(twice_area) < 1e-6 * length) { // the middle is within a micrometre of the chord
        for (const glm::dvec2& place : places_m)
            circle.off_m = std::max(circle.off_m, length > 0.0 ? std::abs(cross(c, place - first)) / length : 0.0);
        return circle;
    }
    // of the triangle 0, b, c: its circumcentre
    const double bb = glm::dot(b, b), cc = glm::dot(c, c);
    const glm::dvec2 centre = glm::dvec2(c.y * bb - b.y * cc, b.x * cc - c.x * bb) / (2.0 * twice_area);
    const double radius = glm::length(centre);
    circle.radius_m = twice_area > 0.0 ? radius : -radius;
    for (const glm::dvec2& place : places_m)
        circle.off_m = std::max(circle.off_m, std::abs(glm::length(place - first - centre) - radius));
    return circle;
}

} // namespace fernlicht
