#include "scenarios/drives/play/nudge.h"

#include "scenarios/control/control_parameters.h"
#include "scenarios/values/pose.h"
#include "scenarios/vehicle/car_model.h"

#include <algorithm>

namespace fernlicht {

std::optional<Nudge> loaded_nudge(const Drive& drive, const LampSet& lamp_set, double load_kg) {
    if (!drive.vehicle)
        return std::nullopt;
    const double load_n = load_kg * gravity_mps2;
    const double springs_m = load_n / drive.vehicle->rear.spring_n_per_m, tyres_m = load_n / drive.vehicle->rear.tyre_spring_n_per_m;
    const std::optional<LevellingParameters>& levelling = lamp_set.control ? lamp_set.control->levelling : lamp_set.levelling;
    const double seen_rad = springs_m / drive.wheelbase_m;
    return Nudge{.pitch_rad = levelling ? std::clamp(-seen_rad, levelling->actuator.min_rad, levelling->actuator.max_rad) : 0.0,
                 .body_pitch_rad = (springs_m + tyres_m) / drive.wheelbase_m,
                 .body_rear_lift_m = -(springs_m + tyres_m)};
}

Moment nudged(Moment moment, const Nudge& nudge) {
    const Pose car = moment.ego;
    const Pose body{car.position_m + nudge.body_rear_lift_m * car.up(), car.axes * axes_from_angles(0.0, nudge.body_pitch_rad, 0.0)};
    const bool body_moves = nudge.body_pitch_rad != 0.0 || nudge.body_rear_lift_m != 0.0;
    for (LitLamp& lamp : moment.lamps) {
        if (body_moves)
            lamp.pose = compose(body, {to_local(car, lamp.pose.position_m), glm::transpose(car.axes) * lamp.pose.axes});
        lamp.pose.position_m += nudge.lift_m * car.up();
        lamp.pose.axes = lamp.pose.axes * axes_from_angles(0.0, nudge.pitch_rad, 0.0);
        lamp.intensity_factor *= nudge.flux_factor;
        for (const LampNudge& own : nudge.lamps)
            if (own.lamp == lamp.name) {
                lamp.pose.axes = lamp.pose.axes * axes_from_angles(own.yaw_rad, own.pitch_rad, own.roll_rad);
                lamp.intensity_factor *= own.flux_factor;
            }
    }
    return moment;
}

Nudges usual_nudges(const Drive& drive, const LampSet& lamp_set) {
    const double aim_rad = radians(nudge_aim_deg);
    return {Nudge{.pitch_rad = aim_rad},
            Nudge{.pitch_rad = -aim_rad},
            Nudge{.flux_factor = 1.0 + nudge_flux},
            Nudge{.flux_factor = 1.0 - nudge_flux},
            Nudge{.lift_m = nudge_height_m},
            Nudge{.lift_m = -nudge_height_m},
            loaded_nudge(drive, lamp_set, nudge_load_kg)};
}

} // namespace fernlicht
