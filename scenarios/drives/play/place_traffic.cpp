#include "scenarios/drives/play/place_traffic.h"

#include "scenarios/drives/play/advance.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/refusals.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

constexpr double sampled_every_s = 0.1;
constexpr double braking_mps2 = 0.7; // what drivers brake with rather than coast [estimate]
constexpr double wheelbase_share = 0.6;

[[noreturn]] void refuse(const Drive& drive, const TrafficRow& row, const std::string& found, const std::string& expected) {
    throw InputError({drive.file, 0, 0, "traffic." + row.name}, found, expected);
}

/// The driving lane of the other direction that lies nearest to the own one.
int oncoming_lane(const Drive& drive, const TrafficRow& row, const Route& route, double at_m) {
    const RouteLane* nearest = nullptr;
    const CrossSection section = route.cross_section(at_m);
    const auto offset = [](const RouteLane& lane) { return std::abs(lane.left_m + lane.right_m); };
    for (const RouteLane& lane : section.lanes)
        if (!lane.same_direction && lane.type == "driving" && (nearest == nullptr || offset(lane) < offset(*nearest)))
            nearest = &lane;
    if (nearest == nullptr)
        refuse(drive, row, fmt::format("no driving lane of the other direction {:.6g} m along the route", at_m),
               "a road with oncoming traffic, or lane: {road, lane, s_m}");
    return nearest->road_lane_id;
}

/// Where on a way the point beside `target_m` lies, from a first guess.
double beside(const Route& way, const glm::dvec3& target_m, double guess_m) {
    for (int i = 0; i < 20; ++i) {
        const Pose pose = way.pose(guess_m);
        const double step = glm::dot(target_m - pose.position_m, pose.forward());
        guess_m = std::clamp(guess_m + step, 0.0, way.length_m());
        if (std::abs(step) < 1e-6)
            break;
    }
    return guess_m;
}

std::shared_ptr<const Track> follow(const Route& way, double start_m, const TrafficRow& row, double wheelbase_m, double duration_s) {
    std::vector<TrackPoint> points;
    const int steps = static_cast<int>(std::ceil(duration_s / sampled_every_s)) + 1;
    for (int i = 0; i <= steps; ++i) {
        const double t = i * sampled_every_s, at_m = start_m + distance_m(row.speed, t);
        if (at_m + wheelbase_m > way.length_m() && !points.empty())
            break;
        points.push_back({t, ego_pose(way, at_m, wheelbase_m), speed_mps(row.speed, t)});
        if (row.speed.size() == 1 && row.speed.front().speed_mps == 0.0) { // parked for good
            points.push_back({std::max(1.0, 2.0 * duration_s), points.back().pose, 0.0});
            break;
        }
    }
    return std::make_shared<const Track>(std::move(points));
}

/// On while the profile falls steeply.
std::vector<LampChange> brake_changes(const std::vector<SpeedPoint>& speed) {
    std::vector<LampChange> changes;
    bool on = false;
    const auto set = [&](double at_s, bool brakes) {
        if (brakes == on)
            return;
        on = brakes;
        for (const char* lamp : {"brake-left", "brake-right"}) {
            LampChange change;
            change.time_s = at_s;
            change.lamp = lamp;
            change.level = brakes ? 1.0 : 0.0;
            changes.push_back(std::move(change));
        }
    };
    for (std::size_t i = 0; i + 1 < speed.size(); ++i)
        set(speed[i].time_s, (speed[i].speed_mps - speed[i + 1].speed_mps) / (speed[i + 1].time_s - speed[i].time_s) >= braking_mps2);
    if (speed.size() > 1)
        set(speed.back().time_s, false);
    return changes;
}

/// Tail and brake lamps of a model where it has them: "tail-left" at "lamp.tail.left", or at "lamp.tail.centre". They look along the mount.
void put_on_mounts(std::vector<TrafficLamp>& lamps, const std::vector<Mount>& mounts) {
    for (TrafficLamp& rear : lamps) {
        const std::string& name = rear.lamp.name; // FUNCTION-SIDE
        const std::size_t dash = name.find('-');
        const std::string function = "lamp." + name.substr(0, dash) + '.';
        auto mount = std::ranges::find(mounts, function + name.substr(dash + 1), &Mount::name);
        if (mount == mounts.end())
            mount = std::ranges::find(mounts, function + "centre", &Mount::name);
        if (mount == mounts.end())
            continue;
        rear.lamp.position_m = mount->pose.position_m;
        rear.lamp.yaw_rad = 0.0;
        rear.lamp.mount = turn_of(mount->pose.axes);
    }
}

} // namespace

RoadUser road_user_of(const TrafficRow& row, int number) {
    RoadUser user;
    user.name = row.count == 1 ? row.name : fmt::format("{}-{}", row.name, number + 1);
    user.kind = row.kind;
    user.model = row.model;
    user.model_yaw_rad = row.model_yaw_rad;
    user.model_scale = row.model_scale;
    user.size_m = row.size_m.value_or(default_size_m(row.kind));
    user.rear_m = row.rear_m.value_or(default_rear_m(row.kind) * user.size_m.x / default_size_m(row.kind).x);
    for (const MountedLamp& lamp : row.lamps)
        user.lamps.push_back({lamp, function_of(lamp.name), row.face_m});
    std::vector<TrafficLamp> rear = rear_lamps(user.size_m, user.rear_m, row.tail_cd, row.brake_cd);
    put_on_mounts(rear, row.mounts);
    std::ranges::move(rear, std::back_inserter(user.lamps));
    user.changes = row.changes;
    std::ranges::move(brake_changes(row.speed), std::back_inserter(user.changes));
    std::ranges::stable_sort(user.changes, {}, &LampChange::time_s);
    return user;
}

namespace {

void add(Drive& drive, const TrafficRow& row, const Route& way, const std::vector<double>& starts_m) {
    for (std::size_t i = 0; i < starts_m.size(); ++i) {
        RoadUser user = road_user_of(row, static_cast<int>(i));
        user.track = follow(way, starts_m[i], row, wheelbase_share * user.size_m.x, drive.duration_s);
        drive.traffic.push_back(std::move(user));
    }
}

void place_row(Drive& drive, const TrafficRow& row, const RoadNetwork& network, const Route& route) {
    std::vector<double> starts_m;
    if (row.place == TrafficPlace::lane) {
        Route::Start start = row.start;
        start.asked_in = drive.file;
        start.key = "traffic." + row.name + ".lane";
        if (drive.mirrored_road) // lanes are named as the road's file has them
            start.lane = -start.lane;
        const Route way(network, start);
        for (int i = 0; i < row.count; ++i)
            starts_m.push_back(i * row.every_m);
        if (starts_m.back() > way.length_m())
            refuse(drive, row, fmt::format("{} road users over {:.6g} m", row.count, starts_m.back()),
                   fmt::format("at most the {:.6g} m that their lane goes on", way.length_m()));
        return add(drive, row, way, starts_m);
    }
    std::vector<double> gaps_m;
    for (int i = 0; i < row.count; ++i)
        gaps_m.push_back(row.gap_m + i * row.every_m);
    if (gaps_m.front() < 0.0 || gaps_m.back() > route.length_m())
        refuse(drive, row,
               row.count == 1 ? fmt::format("found a road user {:.6g} m along the route", row.gap_m)
                              : fmt::format("found road users from {:.6g} to {:.6g} m along the route", gaps_m.front(), gaps_m.back()),
               fmt::format("0 to {:.6g} m, where it ends", route.length_m()));
    if (row.place == TrafficPlace::ahead)
        return add(drive, row, route, gaps_m);
    const auto [road, s_m] = route.place(gaps_m.back());
    const Route way(network, {road, oncoming_lane(drive, row, route, gaps_m.back()), s_m});
    for (const double gap_m : gaps_m)
        starts_m.push_back(beside(way, route.pose(gap_m).position_m, gaps_m.back() - gap_m));
    add(drive, row, way, starts_m);
}

} // namespace

void place_traffic(Drive& drive, const RoadNetwork& network, const Route& route) {
    EachRead each;
    for (const TrafficRow& row : drive.traffic_rows)
        if (row.place != TrafficPlace::storyboard)
            each([&] { place_row(drive, row, network, route); });
    each.end();
}

} // namespace fernlicht
