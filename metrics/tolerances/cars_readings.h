// What cars of one series read: quantiles, and how many keep a limit. Most cars follow slopes, some are evaluated in full.
#pragma once

#include "metrics/readings/readings.h"
#include "metrics/tolerances/cars.h"

#include <functional>

namespace fernlicht {

/// Readings of cars, in their order; of an interrupted one whatever there is.
using EvaluateCars = std::function<std::vector<Readings>(const std::vector<CarValues>& cars)>;

/// How one reading answers to its car's parts, about the car as designed, whose parts are 0.
struct ReadingSlopes {
    std::vector<double> up, down; ///< for each part, a unit of it above and below 0
    /// What slopes add to the reading of a car as designed.
    double move(const CarValues& car) const;
};

/// One reading over all cars.
struct ReadingOfCars {
    ReadingKey key;
    std::string where;
    Value as_designed, p05 = {}, median = {}, p95 = {};
    bool by_slopes = false;                              ///< else of the cars in full alone
    std::optional<double> slope_error = {}, spread = {}; ///< of the cars in full: r.m.s. of what slopes miss; standard deviation
    std::vector<double> variance_shares = {};            ///< of each part, 0..1 of the sum that slopes make of them; empty without slopes
    Sensitivity sensitivity = {};                        ///< of the reading as designed
};

/// Cars within a limit; of `all`, within every one. A car whose reading is a bound that leaves the limit open, or that has none, is open.
struct CarsWithin {
    Limit limit;                                  ///< reading "all" for all of them
    Value share_percent = {};                     ///< at least so much where cars are open; not measured, with its reason, where all are
    double low_percent = 0.0, high_percent = 0.0; ///< of chance among the cars counted, 95 % (Wilson 1927), open ones either way
    std::size_t of = 0, open = 0;                 ///< cars
    Value in_full_percent = {};                   ///< of the cars in full, where the others follow slopes; with its interval
    double in_full_low_percent = 0.0, in_full_high_percent = 0.0;
};

struct SeriesFindings {
    std::vector<CarPart> parts;
    std::vector<ReadingOfCars> readings;
    std::vector<CarsWithin> within;
    std::size_t draws = 0, cars = 0;
    bool rendered = false; ///< the cars in full
};

/// Slopes hold where they miss less than this share of the spread, r.m.s. over the cars in full: 4 % of the variance.
inline constexpr double most_slope_error = 0.2;

/// `played`: what the car as designed reads, from a drive that was played; readings of cars are its figure and what the evaluation moves it
/// by. `slopes` and `in_full` evaluate alike or not (calculated, rendered); each counts from its own car as designed.
SeriesFindings measure_cars(const ToleranceParameters& tolerances, std::vector<CarPart> parts, const Readings& played,
                            const EvaluateCars& slopes, const EvaluateCars& in_full);

/// As readings: quantiles by aspect, shares as cars_within.
Readings readings_of(const SeriesFindings& findings);

/// The interval of 95 % of a share of which `within` of `of` tell, in per cent (Wilson 1927); 0 to 100 of none.
std::pair<double, double> share_interval_percent(std::size_t within, std::size_t of);

} // namespace fernlicht
