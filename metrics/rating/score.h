// The score of a rating: the points of its rows, taken together.
#pragma once

#include "metrics/rating/light_limits.h"
#include "metrics/readings/value.h"

namespace fernlicht {

/// By pairs of reading and points, readings rising, linear between and level beyond. Of a bound: at least or at most so many, as it leaves
/// them open; a number where that does not matter. Not measured as the reading.
Value points_at(const std::vector<std::pair<double, double>>& points_by, const Value& reading);

struct ScoredRow {
    std::string name;
    RatingVerdict verdict = RatingVerdict::told;
    Value points;      ///< without the weight
    double most = 0.0; ///< points that it can get
    double weight = 1.0;
    std::optional<double> cap; ///< of the whole, where the row exceeds a limit
};

struct Score {
    Value points;          ///< weighted; not measured where a row's are not
    double most = 0.0;     ///< of all rows, weighted; 0: the rating has no points
    std::string capped_by; ///< the row that does; "": none
    std::string grade;     ///< "": none, or not measured
};
Score score(const std::vector<ScoredRow>& rows, const std::vector<Grade>& grades);

} // namespace fernlicht
