#include "metrics/folds/sensor_fold.h"

#include "metrics/folds/place_fold.h"
#include "metrics/glare/eye_light.h"

#include <fmt/format.h>

namespace fernlicht {

SensorFold::SensorFold(const Drive& drive, const Route& route) : drive_(drive), route_(route) {
    for (const Sensor& sensor : drive.seeing.sensors->points) {
        const std::optional<double> left_m = offset_across_m(route.cross_section(sensor.at_m), sensor.across);
        followed_.emplace_back();
        if (!left_m)
            continue;
        const Pose surface = route.pose(sensor.at_m, *left_m);
        followed_.back().point_m = surface.position_m + sensor.above_m * surface.up();
    }
}

void SensorFold::add(const Moment& moment) {
    for (std::size_t i = 0; i < followed_.size(); ++i) {
        Followed& here = followed_[i];
        const Sensor& sensor = drive_.seeing.sensors->points[i];
        const double to_go_m = sensor.at_m - moment.distance_m - drive_.bumper_m;
        here.passed = here.passed || to_go_m < 0.0;
        if (!here.point_m || to_go_m < 0.0)
            continue;
        double lx = 0.0;
        for (const SeenLamp& lamp : seen_lamps(moment, *here.point_m))
            if (lamp.facing_lx > 0.0 && !road_hides(route_, moment.distance_m, sensor.at_m, lamp.position_m, *here.point_m))
                lx += lamp.facing_lx;
        for (const LitLamp& lamp : moment.lamps)
            here.near_field = here.near_field || glm::distance(lamp.pose.position_m, *here.point_m) < lamp.photometric_distance_m;
        here.approach.push_back({moment.time_s, to_go_m, lx});
        here.ticks.push_back(moment.tick);
    }
}

Readings SensorFold::readings() const {
    Readings readings;
    const SensorParameters& parameters = *drive_.seeing.sensors;
    for (std::size_t i = 0; i < followed_.size(); ++i) {
        const Sensor& sensor = parameters.points[i];
        const Followed& here = followed_[i];
        const std::string cut = cut_short(here.approach, here.passed);
        const std::string where = fmt::format(
            "{}, {} m along the route, {} m above the road, facing the lamps{}{}", place_name(sensor.across), sensor.at_m, sensor.above_m,
            here.near_field ? ", near-field: nearer than a lamp's photometric distance" : "", cut.empty() ? "" : "; " + cut);
        const auto say = [&](const ReadingKey& key, Value found) {
            if (!here.point_m)
                found = Value::not_measured(fmt::format("there is no {} at {} m", place_name(sensor.across), sensor.at_m));
            readings.push_back({key, found, where});
            readings.back().key.subject = sensor.name;
        };
        for (const double limit : parameters.limits_lx)
            say({.quantity = Quantity::sensor_reach, .threshold = {limit, ThresholdUnit::lx}},
                reached_from_m(here.approach, limit, here.passed));
        for (const double distance_m : parameters.distances_m)
            say({.quantity = Quantity::sensor_illuminance, .distance_m = distance_m}, value_at(here.approach, distance_m));
        say({.quantity = Quantity::sensor_illuminance, .statistic = Statistic::maximum},
            Value::of(largest(here.approach), "no moment of the drive before this place was measured"));
    }
    return readings;
}

std::vector<SeeingSeries> SensorFold::series() const {
    std::vector<SeeingSeries> all;
    for (std::size_t i = 0; i < followed_.size(); ++i) {
        const Sensor& sensor = drive_.seeing.sensors->points[i];
        SeeingSeries series{fmt::format("sensor_{}", sensor.name),
                            fmt::format("Sensor \u201c{}\u201d", sensor.name),
                            "distance to the sensor",
                            followed_[i].ticks,
                            {},
                            {}};
        SeeingSeries::Column lx{"facing_lx", "illuminance facing the lamps", "lx", true, true, {}};
        for (const ApproachSample& sample : followed_[i].approach) {
            series.at_m.push_back(sample.distance_m);
            lx.values.push_back(Value::of(sample.value, "not measured at this place"));
        }
        series.columns.push_back(std::move(lx));
        all.push_back(std::move(series));
    }
    return all;
}

} // namespace fernlicht
