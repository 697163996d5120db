#include "metrics/readings/left_open.h"

#include <cmath>

namespace fernlicht {
namespace {

/// Calculated from the lamps' tables in double precision, on places and by definitions that leave no choice.
constexpr double double_precision = 1e-6;
/// The own lane's grid of evenness (docs/seeing.md): patches begin and end at its points.
constexpr double evenness_step_m = 0.5;

std::optional<double> positive(double step) { return step > 0.0 ? std::optional(step) : std::nullopt; }

/// The grid's error on that line and the distance between drawing and double precision.
std::optional<double> of_grid_and_drawing(const PlayedReadings& played, const ReadingKey& key) {
    const auto centre = value_of(played, about_lane(Quantity::reach, key, Aspect::grid_error)),
               twin = value_of(played, about_lane(Quantity::reach, key, Aspect::twin_difference));
    ReadingKey line = about_lane(key.quantity, key, Aspect::grid_error);
    line.place = key.place == ReadingPlace::none ? ReadingPlace::none : ReadingPlace::edges;
    auto grid = value_of(played, line);
    grid = grid ? grid : centre;
    return grid && twin ? std::optional(*grid + *twin) : std::nullopt;
}

std::optional<double> of_drawing(const PlayedReadings& played, const Reading& reading) {
    ReadingKey key = reading.key;
    key.aspect = Aspect::twin;
    const auto twin = reading.key.aspect == Aspect::value && key.statistic == Statistic::median ? value_of(played, key) : std::nullopt;
    return twin ? std::optional(std::abs(*twin - *reading.value.figure())) : std::nullopt;
}

} // namespace

std::optional<double> left_open(const PlayedReadings& played, const Reading& reading) {
    if (!reading.value.measured())
        return std::nullopt;
    if (ReadingKey key = reading.key; key.aspect == Aspect::value) {
        key.aspect = Aspect::standard_error;
        if (const auto stated = value_of(played, key))
            return stated;
    }
    switch (row_of(reading.key.quantity).exactness) {
    case Exactness::double_precision:
        return double_precision * std::abs(*reading.value.figure());
    case Exactness::grid_and_drawing:
        return of_grid_and_drawing(played, reading.key);
    case Exactness::grid:
        return value_of(played, about_lane(reading.key.quantity, reading.key, Aspect::grid_error));
    case Exactness::grid_columns:
        return 2.0 * played.grid_cell_m / 4.0; // across a column is a quarter of a row
    case Exactness::drawing:
        return of_drawing(played, reading);
    case Exactness::between_moments:
        return positive(reading.key.quantity == Quantity::glare_time ? played.step_s : played.step_m);
    case Exactness::look_step:
        return positive(played.look_step_m);
    case Exactness::look_step_twice:
        return positive(2.0 * played.look_step_m);
    case Exactness::evenness_step_twice:
        return 2.0 * evenness_step_m;
    case Exactness::unknown:
        break;
    }
    return std::nullopt;
}

} // namespace fernlicht
