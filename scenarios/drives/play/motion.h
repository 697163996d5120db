// How car and lamps move in a drive with a vehicle or with lamp control: simulated once, before the first frame, in steps independent of
// frames.
#pragma once

#include "scenarios/can/can_frame.h"
#include "scenarios/control/control_run.h"
#include "scenarios/drives/drive.h"
#include "scenarios/vehicle/actuator.h"
#include "scenarios/vehicle/car_run.h"

namespace fernlicht {

struct Motion {
    std::shared_ptr<const CarRun> car; ///< the same for all lamp sets: lamps do not act on it; none without a vehicle
    std::optional<ActuatorRun> levelling, swivel;
    std::optional<ControlRun> control;
    std::vector<std::string> notes; ///< on how they were solved
    std::vector<CanFrame> sent;     ///< what lamp control sent to the drive's bus (Drive::can), stamped from the drive's 0 s
};

/// Gives each lamp set its motion and the drive notes on how the car's was solved and how far the car strayed from its plan. Nothing for a
/// drive without a vehicle. Lamp control comes after it (simulate_control, control_play.h). A drive whose car comes to the route's end too
/// soon is cut, with a note. Throws InputError when the equations cannot be solved as the drive asks, and when the car does what its model
/// does not describe (car_run.h).
void simulate(Drive& drive, const Route& route);

/// Adds the actuators' angles at that time to a lamp's aim, and takes the level that lamp control gives it.
void turn(MountedLamp& lamp, const Motion& motion, double time_s);

} // namespace fernlicht
