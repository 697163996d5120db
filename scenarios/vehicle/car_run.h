// A car driven along its lane once, before anything is drawn: its motion as a function of time.
// Where the model of the car ends. Its equations hold for small angles and for wheels that stay on the road but for hops; they know no
// stops of the springs. A car beyond that is not simulated wrongly in silence: the drive is refused.
#pragma once

#include "scenarios/vehicle/car_model.h"
#include "scenarios/vehicle/integrator.h"

#include <optional>
#include <string>

namespace fernlicht {

/// What a moment needs of the car.
struct CarPlace {
    double distance_m = 0.0;       ///< of the rear axle along the lane's centre
    double offset_left_m = 0.0;    ///< of the rear axle from it
    double heading_rad = 0.0;      ///< beside the lane's, left positive
    double speed_mps = 0.0;        ///< along the car
    double rear_lift_m = 0.0;      ///< of the body over the rear axle, from the rest on a level road
    double pitch_rad = 0.0;        ///< of the body against the road under its axles, without their roughness, nose up positive
    double spring_pitch_rad = 0.0; ///< what sensors at both axles' springs see of it: without the tyres
    double roll_rad = 0.0;         ///< of the body against the road without its roughness, left side up positive
    double roll_axis_m = 0.0;      ///< height of the axis that it turns about
    double steering_rad = 0.0;
    double yaw_rate_rad_s = 0.0;                  ///< to the left positive
    double front_load_n = 0.0, rear_load_n = 0.0; ///< of the axles' tyres on the road; 0: in the air
};

class CarRun {
  public:
    /// Time is clamped to the run. The same for every frame rate: steps follow from the equations alone.
    CarPlace at(double time_s) const;
    const DensePath& path() const { return path_; } ///< components: car_run_kept
    const SolverWork& work() const { return work_; }

  private:
    friend CarRun run_car(CarModel model, const std::vector<SpeedSegment>& wishes, double end_s);
    DensePath path_;
    SolverWork work_;
    RoughRoad rough_;
    std::optional<RollParameters> roll_;
    double wheelbase_m_ = 0.0;
    double front_rest_n_ = 0.0, rear_rest_n_ = 0.0; ///< loads at rest
    double front_tyre_n_per_m_ = 0.0, rear_tyre_n_per_m_ = 0.0;
};

/// Drives from time 0 and distance 0 to `end_s`. `wishes`: by time, the first at 0. The road's roughness and weight
/// that comes on follow from `model.car`. Kinks and loads are hit by the integrator exactly, the car's steps in the road within
/// SolverOptions::event_tolerance_s. Throws InputError when the solver gives up.
CarRun run_car(CarModel model, const std::vector<SpeedSegment>& wishes, double end_s);

/// By which the sprung weight may press the springs together at rest. A body on such springs swings with sqrt(g / 0.4 m) = 0.8 Hz, below
/// the 1 to 1.5 Hz of cars (Mitschke & Wallentowitz 2014, part B); with more the springs have no place left in a car.
inline constexpr double greatest_deflection_m = 0.4;
/// Of the body against the road: the equations take the angle for its sine, which differ by 0.4 % here.
inline constexpr double greatest_pitch_rad = 0.15;
/// As for the pitch. A car that leans by less has the wheels of both sides on the road, but for very tall or narrow ones.
inline constexpr double greatest_roll_rad = 0.15;
/// For which both wheels of an axle may be in the air at a stretch: in 0.2 s a falling body comes down by 0.2 m, the whole way of a car's
/// springs, whose stops are not modelled. A wheel's own hop (10 to 14 Hz) is over sooner.
inline constexpr double longest_hop_s = 0.2;

/// By which the sprung weight presses an axle's springs together at rest, in m: g (m load - unsprung) / k.
double deflection_at_rest_m(const VehicleParameters& car, const AxleParameters& axle, double part_of_load);

/// What a run did that the model does not describe, as the two parts of an InputError's sentence.
struct BeyondModel {
    std::string found, expected;
};

struct CarValidity {
    std::optional<BeyondModel> beyond; ///< the first in time
    int hops = 0;                      ///< axles in the air for at most longest_hop_s
    double longest_hop_s = 0.0;
};

/// Looks at the run until `end_s`, six times in each step of the solver.
CarValidity car_validity(const CarRun& run, double end_s);

} // namespace fernlicht
