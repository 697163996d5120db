#include "metrics/rating/score.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

double points_of(const std::vector<std::pair<double, double>>& points_by, double reading) {
    const auto next = std::ranges::upper_bound(points_by, reading, {}, &std::pair<double, double>::first);
    if (next == points_by.begin())
        return next->second;
    const auto& [from, points] = *(next - 1);
    return next == points_by.end() ? points : std::lerp(points, next->second, (reading - from) / (next->first - from));
}

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

} // namespace fernlicht
