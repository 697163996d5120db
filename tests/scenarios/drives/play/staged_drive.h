// A drive brought to where its moments can be had, without a scene.
#pragma once

#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/control_play.h"
#include "scenarios/drives/play/place_traffic.h"

#include <cmath>

namespace fernlicht {

struct StagedDrive {
    Drive drive;
    RoadNetwork network = read_opendrive(drive.road_file);
    Route route{network, drive.start, drive.via};

    explicit StagedDrive(Drive d) : drive(std::move(d)) {
        simulate_bus(drive, route);
        fit_to_route(drive, route);
        simulate(drive, route);
        place_traffic(drive, network, route);
        simulate_control(drive, route);
    }
    Moment at_tick(int tick, std::size_t lamp_set) const {
        return moment_at(state_at(tick, drive), drive, route, drive.lamp_sets.at(lamp_set));
    }
    /// By the drive's own speed.
    Moment at(double time_s, std::size_t lamp_set = 0) const {
        const int tick = static_cast<int>(std::lround(time_s / drive.step_s));
        return moment_at({tick, time_s, distance_m(drive.speed, time_s), speed_mps(drive.speed, time_s)}, drive, route,
                         drive.lamp_sets.at(lamp_set));
    }
};

/// Angle of a lamp to the left of the car.
inline double swivel_rad(const Moment& moment, std::size_t lamp) {
    const glm::dvec3 in_car = moment.lamps[lamp].pose.forward() * moment.ego.axes;
    return std::atan2(in_car.y, in_car.x);
}

} // namespace fernlicht
