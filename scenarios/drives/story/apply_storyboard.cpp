#include "scenarios/drives/story/apply_storyboard.h"

#include "scenarios/drives/play/place_traffic.h"
#include "scenarios/drives/story/story_environment.h"
#include "scenarios/openscenario/play_story.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace fernlicht {
namespace {

constexpr double story_step_s = 0.01;
constexpr std::size_t speed_every = 10; ///< samples from one speed to the next

std::shared_ptr<const Track> track_of(const osc::PlayedEntity& entity, double step_s) {
    std::vector<TrackPoint> points;
    for (std::size_t i = 0; i < entity.samples.size(); ++i)
        if (entity.samples[i].present)
            points.push_back({static_cast<double>(i) * step_s, entity.samples[i].pose(), entity.samples[i].speed_mps});
    return points.empty() ? nullptr : std::make_shared<const Track>(std::move(points));
}

std::vector<SpeedPoint> speeds_of(const osc::PlayedEntity& entity, double step_s) {
    std::vector<SpeedPoint> speeds;
    for (std::size_t i = 0; i < entity.samples.size(); i += speed_every)
        speeds.push_back({static_cast<double>(i) * step_s, std::max(0.0, entity.samples[i].speed_mps)});
    return speeds;
}

/// The first lane that the car is on and the roads that it comes to.
void take_route(Drive& drive, const osc::PlayedEntity& ego, const RoadNetwork& network) {
    std::optional<std::size_t> road;
    drive.via.clear();
    for (const osc::EntitySample& at : ego.samples) {
        if (!at.present || road == at.road || at.road >= network.roads.size())
            continue;
        if (road)
            drive.via.push_back(network.roads[at.road].id);
        else
            drive.start = {network.roads[at.road].id, at.lane, at.s_m};
        road = at.road;
    }
}

/// A route follows lanes; a story may turn where its lane does not lead. Then the roads from there on are left out of it.
void keep_to_lanes(Drive& drive, const RoadNetwork& network) {
    const std::size_t roads = drive.via.size();
    while (!drive.via.empty()) {
        try {
            const Route whole(network, drive.start, drive.via);
            break;
        } catch (const InputError&) {
            drive.via.pop_back();
        }
    }
    if (drive.via.size() < roads)
        drive.notes.push_back(fmt::format("storyboard: the own car's lane does not lead to the road that it takes after '{}': what is "
                                          "measured along the lane holds until there",
                                          printable(drive.via.empty() ? drive.start.road : drive.via.back())));
}

RoadUserKind kind_of(const osc::Entity& entity) {
    if (entity.kind == osc::EntityKind::pedestrian)
        return RoadUserKind::pedestrian;
    if (entity.kind == osc::EntityKind::object)
        return RoadUserKind::other;
    for (std::size_t i = 0; i < std::size(road_user_kinds); ++i)
        if (entity.category == road_user_kinds[i])
            return static_cast<RoadUserKind>(i);
    if (entity.category == "motorbike")
        return RoadUserKind::motorcycle;
    return entity.category == "semitrailer" || entity.category == "trailer" ? RoadUserKind::truck : RoadUserKind::car;
}

/// The row that names the entity; else, for vehicles, the one for all.
const TrafficRow* row_for(const Drive& drive, const osc::Entity& entity) {
    const TrafficRow* all = nullptr;
    for (const TrafficRow& row : drive.traffic_rows) {
        if (row.place != TrafficPlace::storyboard)
            continue;
        if (std::ranges::find(row.entities, entity.name) != row.entities.end())
            return &row;
        if (row.entities.empty() && !all && entity.kind == osc::EntityKind::vehicle)
            all = &row;
    }
    return all;
}

/// From the body that the row's lamps were mounted on to the entity's: as far behind the front, as far in share of width and height.
void put_on_box(std::vector<MountedLamp>& lamps, const glm::dvec3& size_m, double rear_m, const osc::BoundingBox& box) {
    const double forward_m = box.x_m + 0.5 * box.length_m - (rear_m + size_m.x);
    for (MountedLamp& lamp : lamps) {
        lamp.position_m.x += forward_m;
        lamp.position_m.y = box.y_m + lamp.position_m.y * box.width_m / size_m.y;
        lamp.position_m.z = std::min(lamp.position_m.z, lamp.position_m.z * box.height_m / size_m.z);
    }
}

RoadUser user_of(const Drive& drive, const osc::PlayedEntity& played, double step_s) {
    const osc::Entity& entity = played.entity;
    TrafficRow row;
    row.tail_cd = row.brake_cd = 0.0;
    const TrafficRow* given = row_for(drive, entity);
    if (given)
        row = *given;
    row.name = entity.name;
    row.count = 1;
    const bool has_box = entity.box.length_m > 0.0 && entity.box.width_m > 0.0 && entity.box.height_m > 0.0;
    if (!given || !given->size_m) {
        if (row.kind == RoadUserKind::car) // a row's default
            row.kind = kind_of(entity);
        if (has_box)
            row.size_m = {entity.box.length_m, entity.box.width_m, entity.box.height_m};
        if (given && has_box && given->model.empty())
            put_on_box(row.lamps, default_size_m(given->kind), default_rear_m(given->kind), entity.box);
    }
    const bool brakes_told = std::ranges::any_of(played.lights, [](const auto& light) { return light.action.light == "brakeLights"; });
    row.speed = brakes_told ? std::vector<SpeedPoint>{{0.0, 0.0}} : speeds_of(played, step_s);
    RoadUser user = road_user_of(row, 0);
    if (!given || !given->size_m)
        user.rear_m = entity.box.x_m - 0.5 * entity.box.length_m;
    user.track = track_of(played, step_s);
    const double end_s = static_cast<double>(played.samples.size()) * step_s;
    std::ranges::move(light_changes(played.lights, user.lamps, end_s), std::back_inserter(user.changes));
    std::ranges::stable_sort(user.changes, {}, &LampChange::time_s);
    bool seen = true;
    for (std::size_t i = 0; i < played.samples.size(); ++i)
        if (const bool now = played.samples[i].visible && played.samples[i].present; now != seen) {
            user.visibility.emplace_back(static_cast<double>(i) * step_s, now);
            seen = now;
        }
    return user;
}

void tell_ego(Drive& drive, const osc::PlayedEntity& ego, const RoadNetwork& network, double step_s) {
    drive.ego_track = track_of(ego, step_s);
    if (!drive.ego_track)
        throw InputError({drive.storyboard->file, 0, 0, "Storyboard"}, fmt::format("gives '{}' no place", printable(drive.storyboard->ego)),
                         "a TeleportAction in Init for the entity that is the own car");
    take_route(drive, ego, network);
    keep_to_lanes(drive, network);
    drive.speed = speeds_of(ego, step_s);
    const double end_s = static_cast<double>(ego.samples.size()) * step_s;
    for (LampSet& lamp_set : drive.lamp_sets) {
        std::vector<TrafficLamp> lamps;
        for (const MountedLamp& lamp : lamp_set.lamps)
            lamps.push_back({lamp, function_of(lamp.name), {}});
        lamp_set.storyboard_changes = light_changes(ego.lights, lamps, end_s);
    }
}

} // namespace

void apply_storyboard(Drive& drive, const RoadNetwork& network) {
    if (!drive.storyboard)
        return;
    const osc::Storyboard storyboard = osc::read_storyboard(drive.storyboard->file, drive.storyboard->options);
    const osc::PlayedStory story = osc::play_story(
        storyboard, network, {.step_s = story_step_s, .max_s = drive.storyboard->max_s, .day_rate = drive.storyboard->day_rate});
    const double length_s = static_cast<double>(std::max<std::size_t>(story.ticks(), 2) - 1) * story.step_s;
    drive.notes.push_back(fmt::format("storyboard: {:.6g} s, until {}", length_s, story.end));
    drive.notes.insert(drive.notes.end(), story.notes.begin(), story.notes.end());
    drive.duration_s = std::min(drive.duration_s, length_s);
    drive.traffic.clear();
    for (const osc::PlayedEntity& entity : story.entities) {
        if (entity.entity.name == drive.storyboard->ego)
            tell_ego(drive, entity, network, story.step_s);
        else if (std::ranges::any_of(entity.samples, &osc::EntitySample::present))
            drive.traffic.push_back(user_of(drive, entity, story.step_s));
    }
    apply_environment(drive, story, network);
}

namespace {

constexpr double ramp_step_s = 0.02;

struct Ramp {
    std::vector<LampChange>& out;
    const std::string& lamp;
    double level; ///< now

    void to(double target, double from_s, double lasts_s, double until_s) {
        const int steps = std::clamp(static_cast<int>(std::ceil(lasts_s / ramp_step_s)), 1, 1000);
        const double from = level;
        for (int i = 1; i <= steps; ++i) {
            const double share = static_cast<double>(i) / steps, time = from_s + (lasts_s > 0.0 ? share * lasts_s : 0.0);
            if (time >= until_s)
                return;
            level = std::lerp(from, target, share);
            out.push_back({time, lamp, level, {}, {}, {}, {}, {}, {}});
        }
    }
};

} // namespace

bool is_light(const std::string& light, LampFunction function) {
    using F = LampFunction;
    static const std::map<std::string, std::vector<F>> lights{{"lowBeam", {F::low, F::tail, F::position}}, // wired together (UN R48, 5.11)
                                                              {"highBeam", {F::high}},
                                                              {"daytimeRunningLights", {F::daytime}},
                                                              {"fogLights", {F::fog, F::rear_fog}},
                                                              {"fogLightsFront", {F::fog}},
                                                              {"fogLightsRear", {F::rear_fog}},
                                                              {"brakeLights", {F::brake}},
                                                              {"reversingLights", {F::reverse}},
                                                              {"indicatorLeft", {F::indicator_left}},
                                                              {"indicatorRight", {F::indicator_right}},
                                                              {"warningLights", {F::indicator_left, F::indicator_right}}};
    const auto meant = lights.find(light);
    return meant != lights.end() && std::ranges::find(meant->second, function) != meant->second.end();
}

std::vector<LampChange> light_changes(const std::vector<osc::LightChange>& lights, const std::vector<TrafficLamp>& lamps, double end_s) {
    std::vector<LampChange> out;
    for (const TrafficLamp& mounted : lamps) {
        const double lit = mounted.lamp.level > 0.0 ? mounted.lamp.level : 1.0;
        Ramp ramp{out, mounted.lamp.name, mounted.lamp.level};
        for (std::size_t i = 0; i < lights.size(); ++i) {
            if (!is_light(lights[i].action.light, mounted.function))
                continue;
            double until_s = end_s;
            for (std::size_t k = i + 1; k < lights.size(); ++k)
                if (is_light(lights[k].action.light, mounted.function)) {
                    until_s = std::min(until_s, lights[k].time_s);
                    break;
                }
            const osc::LightStateAction& to = lights[i].action;
            if (to.mode != osc::LightMode::flashing) {
                ramp.to(to.mode == osc::LightMode::on ? lit : 0.0, lights[i].time_s, to.transition_s, until_s);
                continue;
            }
            for (double time_s = lights[i].time_s; time_s < until_s; time_s += to.flash_on_s + to.flash_off_s) { // of 10 ms at least
                ramp.to(lit, time_s, 0.0, until_s);
                ramp.to(0.0, time_s + to.flash_on_s, 0.0, until_s);
            }
        }
    }
    std::ranges::stable_sort(out, {}, &LampChange::time_s);
    return out;
}

} // namespace fernlicht
