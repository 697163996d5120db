#include "scenarios/drives/play/moment.h"

#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/drive_log.h"
#include "scenarios/drives/play/motion.h"
#include "scenarios/drives/play/place_street_lamps.h"
#include "scenarios/drives/play/storyboard_timeline.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace fernlicht {
namespace {

void add_lamps(const RoadUser& user, int body, const Pose& pose, double until_s, std::vector<LitLamp>& lit) {
    for (const TrafficLamp& mounted : user.lamps) {
        const MountedLamp lamp = user.lamp_at(mounted, until_s);
        if (const double factor = lamp.intensity_factor(); factor > 0.0)
            lit.push_back({user.name + " " + lamp.name, lamp.file, compose(pose, lamp.pose()), factor, lamp.colour,
                           lamp.photometric_distance_m, body, mounted.face_m});
    }
}

/// Fills the moment's bodies, and adds the lamps of those that are there and lit, from the drive's traffic at the moment's time.
void add_traffic(const Drive& drive, Moment& moment) {
    moment.min_traffic_lx = drive.min_traffic_lx;
    for (std::size_t i = 0; i < drive.traffic.size(); ++i) {
        const RoadUser& user = drive.traffic[i];
        Body body{user.name, {}, user.visible_at(moment.time_s), 0.0};
        if (user.track) {
            const TrackPoint at = user.track->at(moment.time_s);
            body.pose = at.pose;
            body.speed_mps = at.speed_mps;
        }
        if (body.visible)
            add_lamps(user, static_cast<int>(i), body.pose, moment.time_s + tick_tolerance * drive.step_s, moment.other_lamps);
        moment.bodies.push_back(std::move(body));
    }
}

/// Surface point and normal at a distance; beyond the route's end the surface goes on straight.
Pose contact(const Route& route, double distance_m, double offset_left_m) {
    Pose pose = route.pose(std::min(distance_m, route.length_m()), offset_left_m);
    pose.position_m += pose.forward() * std::max(distance_m - route.length_m(), 0.0);
    return pose;
}

/// The body on its springs and beside its lane: over the rear axle lifted, turned about it, and about its roll axis.
Pose moved(Pose ego, const CarPlace& place) {
    ego.position_m += place.rear_lift_m * ego.up();
    const glm::dvec3 axis_m = place.roll_axis_m * ego.up();
    ego.axes = ego.axes * axes_from_angles(place.heading_rad, place.pitch_rad, place.roll_rad);
    if (place.roll_rad != 0.0)
        ego.position_m += axis_m - place.roll_axis_m * ego.up();
    return ego;
}

/// False where nothing is loaded.
bool rest_on_load(CarPlace& place, const Motion& motion) {
    if (!motion.control || (motion.control->body_pitch_rad == 0.0 && motion.control->rear_lift_m == 0.0))
        return false;
    place.pitch_rad += motion.control->body_pitch_rad;
    place.rear_lift_m += motion.control->rear_lift_m;
    return true;
}

} // namespace

LitLamp lit_lamp(const MountedLamp& lamp, const Pose& car) {
    return {lamp.name, lamp.file, compose(car, lamp.pose()), lamp.intensity_factor(), lamp.colour, lamp.photometric_distance_m};
}

Pose ego_pose(const Route& route, double distance_m, double wheelbase_m, double offset_left_m) {
    const Pose rear = contact(route, distance_m, offset_left_m);
    // The front axle's place seen from the lane there: the lane may bend away from under it.
    const glm::dvec3 straight_ahead = to_parent(rear, {wheelbase_m, 0.0, 0.0});
    const glm::dvec3 beside = to_local(contact(route, distance_m + wheelbase_m, 0.0), straight_ahead);
    const Pose front = contact(route, distance_m + wheelbase_m + beside.x, beside.y);

    const glm::dvec3 forward = glm::normalize(front.position_m - rear.position_m);
    const glm::dvec3 left = glm::normalize(glm::cross(rear.up() + front.up(), forward));
    return {rear.position_m, {forward, left, glm::cross(forward, left)}};
}

std::vector<MountedLamp> lamps_at(const State& state, const Drive& drive, const LampSet& lamp_set) {
    std::vector<MountedLamp> lamps = lamp_set.lamps;
    for (const std::vector<LampChange>* changes : {&lamp_set.changes, &lamp_set.storyboard_changes})
        for (const LampChange& change : *changes) {
            if (change.time_s > state.time_s + tick_tolerance * drive.step_s)
                break; // sorted by time
            for (MountedLamp& lamp : lamps)
                if (lamp.name == change.lamp)
                    apply(change, lamp);
        }
    if (lamp_set.motion)
        for (MountedLamp& lamp : lamps)
            turn(lamp, *lamp_set.motion, state.time_s);
    else if (lamp_set.control)
        throw std::logic_error("lamps_at: a drive with lamp control that was not simulated");
    for (MountedLamp& lamp : lamps)
        if (lamp.levels && lamp.levels->lamp() == lamp.file) // a change may have given it another file
            lamp.file = lamp.levels->at(state.time_s + tick_tolerance * drive.step_s);
    return lamps;
}

Moment moment_at(const State& state, const Drive& drive, const Route& route, const LampSet& lamp_set) {
    Moment moment;
    moment.tick = state.tick;
    moment.time_s = state.time_s;
    moment.distance_m = state.distance_m;
    moment.speed_mps = state.speed_mps;
    moment.daylight = daylight_of(drive, state.time_s);
    moment.weather = weather_of(drive, state.time_s);
    if (drive.ego_track || !drive.vehicle) {
        moment.wheels = drive.ego_track ? drive.ego_track->at(state.time_s).pose : ego_pose(route, state.distance_m, drive.wheelbase_m);
        moment.ego = moment.wheels;
        if (drive.ego_track)
            moment.speed_mps = drive.ego_track->at(state.time_s).speed_mps;
        if (CarPlace place; lamp_set.motion && rest_on_load(place, *lamp_set.motion))
            moment.ego = moved(moment.ego, place);
    } else {
        if (!lamp_set.motion)
            throw std::logic_error("moment_at: a drive with a vehicle that was not simulated");
        CarPlace place = lamp_set.motion->car->at(state.time_s);
        rest_on_load(place, *lamp_set.motion);
        moment.distance_m = std::max(place.distance_m, 0.0);
        moment.speed_mps = place.speed_mps;
        const Pose in_lane = ego_pose(route, moment.distance_m, drive.wheelbase_m, place.offset_left_m);
        moment.ego = moved(in_lane, place);
        place.rear_lift_m = place.pitch_rad = place.roll_rad = 0.0;
        moment.wheels = moved(in_lane, place);
    }
    for (const MountedLamp& lamp : lamps_at(state, drive, lamp_set))
        moment.lamps.push_back(lit_lamp(lamp, moment.ego));
    add_traffic(drive, moment);
    add_street_lamps(drive, route, street_lamps_within_m, moment);
    if (drive.replay) {
        replay(*drive.replay, lamp_set.name, moment);
        moment.wheels = moment.ego;
    }
    if (drive.own_car)
        moment.bodies.push_back({"own car", moment.ego, true, moment.speed_mps, true});
    return moment;
}

} // namespace fernlicht
