#include "metrics/folds/homogeneity_fold.h"

#include "metrics/folds/place_fold.h"
#include "metrics/statistics/statistics.h"
#include "scenarios/light/light.h"

#include <fmt/format.h>
#include <functional>

namespace fernlicht {
namespace {

constexpr double along_m = 0.5, across_m = 0.25;

/// On targets across the own lane, that far ahead of the bumper.
Value uniformity_at(const Drive& drive, const Route& route, const Moment& moment, double ahead_m) {
    const double at_m = moment.distance_m + drive.bumper_m + ahead_m;
    if (at_m > route.length_m())
        return Value::not_measured("beyond the route's end");
    std::vector<double> lx;
    for (const glm::dvec3& target : targets_across(route, at_m))
        lx.push_back(target_illuminance_lx(moment, target));
    return uniformity(lx);
}

} // namespace

LanePlaces lane_places(const Drive& drive, const HomogeneityParameters& asked, const Route& route, const Moment& moment,
                       const glm::dvec3& eye_m) {
    LanePlaces places;
    LaneLight& light = places.light;
    const double bumper_m = moment.distance_m + drive.bumper_m;
    const CrossSection section = route.cross_section(bumper_m);
    double left_m = 1.75, right_m = -1.75, lamps_m = 0.0;
    for (const RouteLane& lane : section.lanes)
        if (lane.name == "own") {
            left_m = lane.left_m;
            right_m = lane.right_m;
        }
    for (const LitLamp& lamp : moment.lamps)
        lamps_m += to_local(moment.ego, lamp.pose.position_m).x / static_cast<double>(moment.lamps.size());
    for (int k = 0; right_m + k * across_m <= left_m + 1e-9; ++k)
        light.offset_m.push_back(right_m + k * across_m);
    const double room_m = std::min(asked.ahead_m, route.length_m() - bumper_m);
    std::vector<Pose> row(light.offset_m.size());
    for (int k = 2; k * along_m <= room_m; ++k) {
        route.poses(bumper_m + k * along_m, light.offset_m, row);
        light.ahead_m.push_back(k * along_m + drive.bumper_m - lamps_m);
        for (const Pose& pose : row) {
            places.surface.push_back(pose);
            light.seen_at.push_back(pose.position_m - eye_m);
        }
    }
    return places;
}

std::vector<glm::dvec3> targets_across(const Route& route, double along_m) {
    constexpr double target_m = 0.25;
    std::vector<glm::dvec3> targets;
    for (const RouteLane& lane : route.cross_section(along_m).lanes)
        if (lane.name == "own")
            for (int k = 0; lane.right_m + k * across_m <= lane.left_m + 1e-9; ++k) {
                const Pose pose = route.pose(along_m, lane.right_m + k * across_m);
                targets.push_back(pose.position_m + target_m * pose.up());
            }
    return targets;
}

void HomogeneityFold::add(const Moment& moment) {
    const HomogeneityParameters& asked = *drive_.seeing.homogeneity;
    Moment lit = moment;
    std::erase_if(lit.lamps, [](const LitLamp& lamp) { return lamp.intensity_factor == 0.0; });
    if (lit.lamps.empty())
        return;
    LanePlaces places = lane_places(drive_, asked, route_, lit, to_parent(moment.ego, driver_eye_m(drive_)));
    LaneLight& light = places.light;
    for (const Pose& pose : places.surface)
        light.lx.push_back(surface_illuminance_lx(lit, pose.position_m, pose.up()));
    Row& row = rows_.emplace_back(Row{moment.tick,
                                      moment.distance_m,
                                      largest_gradients(light, asked.min_lx),
                                      patches(light, asked.min_lx, asked.patch_factor),
                                      foreground_lx(light),
                                      foreground_ratio(light),
                                      {}});
    for (const double ahead_m : asked.distances_m)
        row.uniformity.push_back(uniformity_at(drive_, route_, lit, ahead_m));
}

Readings HomogeneityFold::readings() const {
    const HomogeneityParameters& asked = *drive_.seeing.homogeneity;
    Readings readings;
    const auto say = [&](Quantity quantity, ReadingPlace place, const std::string& what, const std::function<double(const Row&)>& figure) {
        std::vector<double> values;
        for (const Row& row : rows_)
            values.push_back(figure(row));
        const std::optional<Spread> spread = spread_of(values);
        const std::string where = fmt::format("own lane to {} m, where it has {} lx, {}", asked.ahead_m, asked.min_lx, what);
        const Value none = Value::not_measured("no lamp was lit in any moment");
        ReadingKey key{.quantity = quantity, .lane = "own", .place = place, .statistic = Statistic::median};
        readings.push_back({key, spread ? Value(spread->median) : none, where + ", median"});
        key.statistic = Statistic::maximum;
        readings.push_back({key, spread ? Value(spread->maximum) : none, where + ", largest"});
    };
    say(Quantity::gradient_per_m, ReadingPlace::along, "largest |d lg E| along", [](const Row& row) { return row.gradients.along.per_m; });
    say(Quantity::gradient_per_deg, ReadingPlace::along, "largest |d lg E| along, seen from the driver",
        [](const Row& row) { return row.gradients.along.per_degree; });
    say(Quantity::gradient_per_m, ReadingPlace::across, "largest |d lg E| across",
        [](const Row& row) { return row.gradients.across.per_m; });
    say(Quantity::gradient_per_deg, ReadingPlace::across, "largest |d lg E| across, seen from the driver",
        [](const Row& row) { return row.gradients.across.per_degree; });
    const std::string beyond = fmt::format(" than its surroundings by more than a factor of {}", asked.patch_factor);
    say(Quantity::patch_dark, ReadingPlace::none, "longest patch darker" + beyond,
        [](const Row& row) { return row.patches.dark.longest_m; });
    say(Quantity::patch_bright, ReadingPlace::none, "longest patch brighter" + beyond,
        [](const Row& row) { return row.patches.bright.longest_m; });
    const auto median = [&](const ReadingKey& key, const std::string& where, const std::function<Value(const Row&)>& figure) {
        CensoredSamples moments("no lamp was lit in any moment");
        for (const Row& row : rows_)
            moments.add(figure(row));
        readings.push_back({key, moments.quantile(0.5), fmt::format("own lane, {}, median; {}", where, moments.account())});
    };
    median({.quantity = Quantity::foreground, .lane = "own", .statistic = Statistic::median}, "mean from 5 to 15 m before the lamps",
           [](const Row& row) { return row.foreground_lx; });
    median({.quantity = Quantity::foreground_ratio, .lane = "own", .statistic = Statistic::median},
           "mean from 5 to 15 m over mean from 40 to 60 m before the lamps", [](const Row& row) { return row.foreground_ratio; });
    for (std::size_t i = 0; i < asked.distances_m.size(); ++i)
        median({.quantity = Quantity::uniformity,
                .surface = ReadingSurface::target,
                .lane = "own",
                .distance_m = asked.distances_m[i],
                .statistic = Statistic::median},
               fmt::format("smallest over mean on targets across the lane {} m ahead", asked.distances_m[i]),
               [&](const Row& row) { return row.uniformity[i]; });
    return readings;
}

std::vector<SeeingSeries> HomogeneityFold::series() const {
    SeeingSeries series{"homogeneity_own", "Evenness of the own lane", "distance along the route"};
    for (const Row& row : rows_) {
        series.ticks.push_back(row.tick);
        series.at_m.push_back(row.along_m);
    }
    series.add({"gradient_along_per_m", "largest gradient along", "1/m"}, rows_, [](const Row& row) { return row.gradients.along.per_m; });
    series.add({"gradient_across_per_m", "largest gradient across", "1/m"}, rows_,
               [](const Row& row) { return row.gradients.across.per_m; });
    series.add({"foreground_ratio", "foreground ratio", ""}, rows_, [](const Row& row) { return row.foreground_ratio; });
    return {series};
}

} // namespace fernlicht
