#include "scenarios/drives/play/moment_traffic.h"

#include "scenarios/drives/play/advance.h"

namespace fernlicht {
namespace {

void add_lamps(const RoadUser& user, int body, const Pose& pose, double until_s, std::vector<LitLamp>& lit) {
    for (const TrafficLamp& mounted : user.lamps) {
        MountedLamp lamp = mounted.lamp;
        for (const LampChange& change : user.changes) {
            if (change.time_s > until_s)
                break;
            if (change.lamp == lamp.name)
                apply(change, lamp);
        }
        if (const double factor = lamp.intensity_factor(); factor > 0.0)
            lit.push_back({user.name + " " + lamp.name, lamp.file, compose(pose, lamp.pose()), factor, lamp.colour,
                           lamp.photometric_distance_m, body, mounted.face_m});
    }
}

} // namespace

void add_traffic(const Drive& drive, Moment& moment) {
    moment.least_traffic_lx = drive.least_traffic_lx;
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

} // namespace fernlicht
