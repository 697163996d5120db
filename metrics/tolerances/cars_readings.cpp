#include "metrics/tolerances/cars_readings.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <tuple>

namespace fernlicht {
namespace {

using ValuesByKey = std::map<ReadingKey, Value>;

ValuesByKey by_key(const Readings& readings) {
    ValuesByKey values;
    for (const Reading& reading : readings)
        if (reading.tick < 0)
            values.emplace(reading.key, reading.value);
    return values;
}

std::optional<double> number_in(const ValuesByKey& values, const ReadingKey& key) {
    const auto found = values.find(key);
    return found == values.end() ? std::nullopt : found->second.number();
}

/// The cars at whose readings slopes are taken, and of which part's which end each is; first the car as designed.
struct SlopeCars {
    std::vector<CarValues> cars;
    std::vector<std::pair<std::size_t, double>> at; ///< part and its value, of each car after the first
};

SlopeCars slope_cars(const std::vector<CarPart>& parts) {
    SlopeCars slopes;
    slopes.cars.emplace_back(parts.size(), 0.0);
    for (std::size_t part = 0; part < parts.size(); ++part) {
        const auto [low, high] = slope_ends(parts[part].tolerance);
        for (const double end : {low, high})
            if (end != 0.0) {
                slopes.cars.emplace_back(parts.size(), 0.0).at(part) = end;
                slopes.at.emplace_back(part, end);
            }
    }
    return slopes;
}

/// nullopt where a car's reading is no number.
std::optional<ReadingSlopes> slopes_of(const ReadingKey& key, const std::vector<ValuesByKey>& evaluated, const SlopeCars& cars,
                                       std::size_t parts) {
    ReadingSlopes slopes{std::vector<double>(parts), std::vector<double>(parts)};
    std::vector<double> up_at(parts), down_at(parts);
    const std::optional<double> designed = number_in(evaluated.front(), key);
    for (std::size_t i = 0; i < cars.at.size(); ++i) {
        const std::optional<double> there = number_in(evaluated[1 + i], key);
        if (!designed || !there)
            return std::nullopt;
        const auto& [part, end] = cars.at[i];
        double& taken = (end > 0.0 ? up_at : down_at)[part];
        if (std::abs(end) <= taken) // of two ends on one side, the farther
            continue;
        taken = std::abs(end);
        (end > 0.0 ? slopes.up : slopes.down)[part] = (*there - *designed) / end;
    }
    for (std::size_t part = 0; part < parts; ++part) {
        if (up_at[part] == 0.0)
            slopes.up[part] = slopes.down[part];
        if (down_at[part] == 0.0)
            slopes.down[part] = slopes.up[part];
    }
    return slopes;
}

/// A car's reading, counted from the reading that was played of the car as designed.
Value counted_from(const Value& played, const Value& car, const Value& designed) {
    if (!car.measured() || !played.number() || !designed.number())
        return car;
    const double figure = *played.number() + (*car.figure() - *designed.number());
    return car.kind() == Value::Kind::at_least ? Value::at_least(figure) : car.censored() ? Value::at_most(figure) : Value(figure);
}

/// One reading of every car, as far as there is one.
struct Cars {
    std::vector<Value> in_full;
    std::vector<double> followed; ///< by slopes; empty where these do not hold
};

void take_quantiles(ReadingOfCars& reading, const Cars& cars) {
    const auto take = [&](const auto& quantile) {
        reading.p05 = quantile(0.05);
        reading.median = quantile(0.5);
        reading.p95 = quantile(0.95);
    };
    if (reading.by_slopes) {
        std::vector<double> ascending = cars.followed;
        std::ranges::sort(ascending);
        take([&](double share) { return Value(quantile_of(ascending, share)); });
        return;
    }
    CensoredSamples samples("no car gave this reading");
    for (const Value& value : cars.in_full)
        samples.add(value);
    take([&](double share) { return samples.quantile(share); });
}

/// How well slopes tell the cars in full; sets what the reading says of it.
void hold_slopes(ReadingOfCars& reading, const ReadingSlopes& slopes, const std::vector<CarValues>& drawn, Cars& cars) {
    std::vector<double> truth;
    double squares = 0.0;
    for (std::size_t i = 0; i < cars.in_full.size(); ++i) {
        if (!cars.in_full[i].number())
            return;
        truth.push_back(*cars.in_full[i].number());
        squares += std::pow(*reading.as_designed.number() + slopes.move(drawn[i]) - truth.back(), 2);
    }
    const std::optional<Spread> spread = spread_of(truth);
    if (!spread)
        return;
    reading.spread = spread->standard_deviation;
    reading.slope_error = std::sqrt(squares / static_cast<double>(truth.size()));
    reading.by_slopes = *reading.slope_error <= most_slope_error * *reading.spread;
    if (!reading.by_slopes)
        return;
    for (const CarValues& car : drawn) {
        const double figure = *reading.as_designed.number() + slopes.move(car);
        cars.followed.push_back(spread->minimum >= 0.0 ? std::max(0.0, figure) : figure);
    }
}

std::vector<double> variance_shares(const ReadingSlopes& slopes, const std::vector<CarValues>& drawn) {
    std::vector<double> shares;
    double sum = 0.0;
    for (std::size_t part = 0; part < slopes.up.size(); ++part) {
        double moved = 0.0, squares = 0.0;
        for (const CarValues& car : drawn) {
            const double move = (car[part] >= 0.0 ? slopes.up : slopes.down)[part] * car[part];
            moved += move;
            squares += move * move;
        }
        const double count = static_cast<double>(drawn.size());
        sum += shares.emplace_back(std::max(0.0, squares / count - moved / count * (moved / count)));
    }
    for (double& share : shares)
        share = sum > 0.0 ? share / sum : 0.0;
    return shares;
}

Value percent(std::size_t within, std::size_t of) { return 100.0 * static_cast<double>(within) / static_cast<double>(of); }

/// Whether each car keeps a limit, of those that follow slopes and of those in full; nullopt: open.
using Kept = std::vector<std::optional<bool>>;
bool is_open(const std::optional<bool>& car) { return !car; }
struct Keeps {
    Kept followed, in_full;
};

Keeps keeps(const Limit& limit, const Cars& cars) {
    Keeps kept;
    for (const double figure : cars.followed)
        kept.followed.push_back(holds(figure, limit.at_least, limit.at_most));
    for (const Value& value : cars.in_full)
        kept.in_full.push_back(holds(value, limit.at_least, limit.at_most));
    return kept;
}

/// The share of those that keep a limit, at least so much where some are open, and its interval.
std::tuple<Value, double, double> share_of(const Kept& cars) {
    const auto kept = static_cast<std::size_t>(std::ranges::count(cars, std::optional(true))),
               open = static_cast<std::size_t>(std::ranges::count_if(cars, is_open));
    const Value share = percent(kept, cars.size());
    return {open == 0             ? share
            : open == cars.size() ? Value::not_measured("every car's reading leaves the limit open")
                                  : Value::at_least(*share.number()),
            share_interval_percent(kept, cars.size()).first, share_interval_percent(kept + open, cars.size()).second};
}

void count_cars(CarsWithin& within, const Keeps& kept) {
    const Kept& told = kept.followed.empty() ? kept.in_full : kept.followed;
    if (told.empty()) {
        within.share_percent = Value::not_measured("no car was evaluated");
        return;
    }
    within.of = told.size();
    within.open = static_cast<std::size_t>(std::ranges::count_if(told, is_open));
    std::tie(within.share_percent, within.low_percent, within.high_percent) = share_of(told);
    if (!kept.followed.empty() && !kept.in_full.empty())
        std::tie(within.in_full_percent, within.in_full_low_percent, within.in_full_high_percent) = share_of(kept.in_full);
}

/// Both limits: false where either is, open where neither is false and one is open.
void both(Kept& all, const Kept& kept) {
    for (std::size_t i = 0; i < all.size() && i < kept.size(); ++i)
        all[i] = all[i] == false || kept[i] == false ? std::optional(false) : all[i] && kept[i] ? std::optional(true) : std::nullopt;
}

std::vector<CarsWithin> shares_within(const std::vector<Limit>& limits, const std::map<ReadingKey, Cars>& cars) {
    std::vector<CarsWithin> shares;
    std::optional<Keeps> all;
    bool all_known = true, all_follow = true;
    for (const Limit& limit : limits) {
        CarsWithin& within = shares.emplace_back(CarsWithin{.limit = limit});
        const auto key = key_of(limit.reading);
        const auto found = key ? cars.find(*key) : cars.end();
        if (found == cars.end() || std::ranges::none_of(found->second.in_full, &Value::measured)) {
            within.share_percent = Value::not_measured(found == cars.end() ? "the car as designed has no such reading"
                                                                           : found->second.in_full.front().reason());
            all_known = false;
            continue;
        }
        const Keeps kept = keeps(limit, found->second);
        count_cars(within, kept);
        all_follow = all_follow && !kept.followed.empty();
        if (!all)
            all = kept;
        both(all->in_full, kept.in_full);
        both(all->followed, kept.followed);
    }
    if (limits.size() > 1) {
        CarsWithin& within = shares.emplace_back(CarsWithin{.limit = {.reading = "all", .at_least = {}, .at_most = {}}});
        if (all_known && !all_follow)
            all->followed.clear();
        if (all_known)
            count_cars(within, *all);
        else
            within.share_percent = Value::not_measured("one of the limits is on a reading that is not measured");
    }
    return shares;
}

} // namespace

double ReadingSlopes::move(const CarValues& car) const {
    double sum = 0.0;
    for (std::size_t part = 0; part < car.size(); ++part)
        sum += (car[part] >= 0.0 ? up : down)[part] * car[part];
    return sum;
}

std::pair<double, double> share_interval_percent(std::size_t within, std::size_t of) {
    if (of == 0)
        return {0.0, 100.0};
    const double z = normal_bound(0.05, 1), n = static_cast<double>(of), p = static_cast<double>(within) / n;
    const double middle = p + z * z / (2.0 * n), half = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n)), scale = 1.0 + z * z / n;
    return {100.0 * std::max(0.0, (middle - half) / scale), 100.0 * std::min(1.0, (middle + half) / scale)};
}

SeriesFindings measure_cars(const ToleranceParameters& tolerances, std::vector<CarPart> parts, const Readings& played,
                            const EvaluateCars& slopes, const EvaluateCars& in_full) {
    SeriesFindings found{.parts = std::move(parts),
                         .readings = {},
                         .within = {},
                         .draws = static_cast<std::size_t>(tolerances.draws),
                         .cars = static_cast<std::size_t>(tolerances.cars),
                         .rendered = tolerances.rendered};
    const SlopeCars ends = slope_cars(found.parts);
    const std::vector<CarValues> drawn = drawn_cars(found.parts, tolerances.seed, found.draws);
    std::vector<CarValues> full_cars{ends.cars.front()};
    full_cars.insert(full_cars.end(), drawn.begin(), drawn.begin() + static_cast<std::ptrdiff_t>(found.cars));
    std::vector<ValuesByKey> at_ends, of_cars;
    for (const Readings& readings : slopes(ends.cars))
        at_ends.push_back(by_key(readings));
    if (at_ends.size() == ends.cars.size())
        for (const Readings& readings : in_full(full_cars))
            of_cars.push_back(by_key(readings));
    if (of_cars.size() != full_cars.size()) // interrupted
        return found;
    std::map<ReadingKey, Cars> cars;
    for (const Reading& reading : played) {
        const auto designed = of_cars.front().find(reading.key);
        if (reading.tick >= 0 || reading.key.aspect != Aspect::value || designed == of_cars.front().end())
            continue;
        ReadingOfCars& of = found.readings.emplace_back(
            ReadingOfCars{.key = reading.key, .where = reading.where, .as_designed = reading.value, .sensitivity = reading.sensitivity});
        Cars& its = cars[reading.key];
        for (std::size_t i = 1; i < of_cars.size(); ++i) {
            const auto car = of_cars[i].find(reading.key);
            its.in_full.push_back(!reading.value.measured() ? reading.value
                                  : car == of_cars[i].end() ? Value::not_measured("this car has no such reading")
                                                            : counted_from(reading.value, car->second, designed->second));
        }
        if (const auto its_slopes = slopes_of(reading.key, at_ends, ends, found.parts.size()); its_slopes && of.as_designed.number()) {
            hold_slopes(of, *its_slopes, drawn, its);
            of.variance_shares = variance_shares(*its_slopes, drawn);
        }
        take_quantiles(of, its);
        if (std::ranges::find(tolerances.limits, name_of(of.key), &Limit::reading) == tolerances.limits.end())
            its = {}; // no limit asks for its cars
    }
    found.within = shares_within(tolerances.limits, cars);
    return found;
}

namespace {

std::string how_told(const ReadingOfCars& of, const SeriesFindings& found) {
    if (of.by_slopes)
        return fmt::format("{} cars by slopes, which miss {} in full by {:.2g} % of their spread, r.m.s.", found.draws, found.cars,
                           *of.spread > 0.0 ? 100.0 * *of.slope_error / *of.spread : 0.0);
    if (of.slope_error && *of.spread > 0.0)
        return fmt::format("{} cars in full; slopes miss them by {:.2g} % of their spread, r.m.s.", found.cars,
                           100.0 * *of.slope_error / *of.spread);
    return fmt::format("{} cars in full", found.cars);
}

} // namespace

Readings readings_of(const SeriesFindings& found) {
    Readings readings;
    for (const ReadingOfCars& of : found.readings)
        for (const auto& [aspect, value] :
             {std::pair(Aspect::cars_p05, &of.p05), std::pair(Aspect::cars_median, &of.median), std::pair(Aspect::cars_p95, &of.p95)}) {
            ReadingKey key = of.key;
            key.aspect = aspect;
            readings.push_back({key, *value, fmt::format("{}; {}", of.where, how_told(of, found)), -1, of.sensitivity});
        }
    for (const CarsWithin& within : found.within) {
        std::string where = within.limit.reading == "all" ? "every limit" : within.limit.reading;
        if (within.limit.at_least)
            where += fmt::format(", at least {}", *within.limit.at_least);
        if (within.limit.at_most)
            where += fmt::format(", at most {}", *within.limit.at_most);
        if (within.share_percent.measured())
            where += fmt::format("; {:.1f} to {:.1f} % by chance among {} cars (95 %)", within.low_percent, within.high_percent, within.of);
        if (within.in_full_percent.number())
            where += fmt::format("; {:.1f} % of {} in full ({:.1f} to {:.1f} %)", *within.in_full_percent.number(), found.cars,
                                 within.in_full_low_percent, within.in_full_high_percent);
        readings.push_back({{.quantity = Quantity::cars_within, .subject = within.limit.reading}, within.share_percent, where});
    }
    return readings;
}

} // namespace fernlicht
