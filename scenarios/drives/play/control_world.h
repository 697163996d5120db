// What lamp control is told of a drive at any time: the car's state, the road ahead, light and others.
#pragma once

#include "scenarios/control/control_run.h"
#include "scenarios/drives/drive.h"
#include "scenarios/vehicle/car_run.h"

namespace fernlicht {

/// All that control reads, as a function of time alone. Of a car that follows a bus: until the last tick that its motion knows.
class ControlWorld {
  public:
    /// After place_traffic(). Drive, route and car must outlive it; `car`: nullptr without a vehicle.
    ControlWorld(const Drive& drive, const Route& route, const CarRun* car);
    ~ControlWorld();

    ControlInputs at(double time_s, const ControlParameters& control) const;

    struct Resting {
        double spring_pitch_rad = 0.0, body_pitch_rad = 0.0, rear_lift_m = 0.0;
    };
    /// Springs and tyres of the vehicle, else of the middle-class car; each axle goes down by its load over its stiffness.
    Resting load_on_springs(const AxleLoad& load) const;

  private:
    struct Parts;
    std::unique_ptr<const Parts> parts_;
};

} // namespace fernlicht
