// The car as a system of 23 ordinary differential equations: single track with relaxing tyres, turning wheels, half a car on springs, a
// driver; with roll they are 25. docs/vehicle.md has them and names the sources. Angles are small where they are pitch, slope or
// heading beside the lane.
#pragma once

#include "scenarios/roads/route.h"
#include "scenarios/vehicle/rough_road.h"
#include "scenarios/vehicle/vehicle_parameters.h"

#include <memory>

namespace fernlicht {

inline constexpr double gravity_mps2 = 9.81;

/// Means over cells of `cell_m` about each knot, joined by a cubic B-spline: two continuous derivatives, and a bump is spread over about
/// 2 m. A car of the real world does so too (a tyre envelops, a driver looks at stretches); edges are RoadStep's.
struct RoadCourse {
    static constexpr double cell_m = 1.0;
    std::vector<double> slope;           ///< rise by distance at -1, 0, 1 .. cells
    std::vector<double> curvature_per_m; ///< of the lane's centre, left turns positive

    /// The spline and its derivative at a distance; constant beyond the ends. An empty table is 0.
    static double at(const std::vector<double>& table, double distance_m, double& derivative);
};

/// Up to `length_m` from the route's start; beyond its end the lane goes on straight with the last slope.
RoadCourse road_course(const Route& route, double length_m);

/// Places in the state vector. "By the road": above the place that the road gives it, from the rest on a level road.
namespace car_state {
enum : std::size_t {
    distance,      ///< of the rear axle along the lane's centre, m
    offset,        ///< of the rear axle from the lane's centre, left positive, m
    heading,       ///< beside the lane's, left positive, rad
    forward_speed, ///< along the car, m/s
    side_speed,    ///< of the centre of gravity, left positive, m/s
    yaw_rate,      ///< rad/s
    front_stretch, ///< of the tyres' contact, along the wheel, m
    rear_stretch,
    front_sway, ///< of the tyres' contact, across the wheel, m
    rear_sway,
    front_spin, ///< of the wheels, rad/s
    rear_spin,
    front_body, ///< the body over the axle, by the road, m
    rear_body,
    front_wheel, ///< the wheels, by the road, m
    rear_wheel,
    heave_rate,       ///< of the centre of gravity, upwards, m/s
    pitch_rate,       ///< nose up positive, rad/s
    front_wheel_rate, ///< upwards, m/s
    rear_wheel_rate,
    force,       ///< of engine (positive) or brakes (negative), N
    persistence, ///< of the driver: the integral part of the force, N
    steering,    ///< angle of the front wheels, left positive, rad
    count,
    body_roll = count, ///< against the road without its roughness, left side up positive, rad; where the car has `roll`
    body_roll_rate,
    count_with_roll
};
}

/// What the driver wants on a stretch of time without kinks.
struct SpeedSegment {
    double start_s = 0.0, speed_mps = 0.0, acceleration_mps2 = 0.0;

    bool holds() const { return speed_mps == 0.0 && acceleration_mps2 == 0.0; } ///< stands, with the foot on the brake
};

/// Roll of the body: inertia p'' = arm (a + g p) - sum over axles of (stiffness (p - tilt) + damping (p' - tilt')).
struct RollModel {
    double inertia_kgm2 = 0.0; ///< about the axis
    double arm_kgm = 0.0;      ///< sprung mass by its height above the axis
    double front_nm_per_rad = 0.0, rear_nm_per_rad = 0.0, front_nms_per_rad = 0.0, rear_nms_per_rad = 0.0;

    /// What is left of the axles' stiffness when the weight has leant over; at or below 0 the car falls over.
    double stiffness_nm_per_rad() const;
};

/// `driven` false: nobody touches pedals or steering, for checks against closed forms.
struct CarModel {
    VehicleParameters car;
    double wheelbase_m = 2.7;
    RoadCourse road;
    RoughRoad rough;
    double front_added_n = 0.0, rear_added_n = 0.0; ///< weight that has come over the axles
    SpeedSegment wish;
    bool driven = true;
    double held_steering_rad = 0.0; ///< where it is not driven
    double held_force_n = 0.0;

    double front_m() const { return wheelbase_m * (1.0 - car.front_load); } ///< centre of gravity to front axle
    double rear_m() const { return wheelbase_m * car.front_load; }
    double sprung_kg() const { return car.mass_kg - car.front.unsprung_mass_kg - car.rear.unsprung_mass_kg; }
    /// Steering for a bend of curvature k: (l + gradient v^2) k. rad s2/m
    double self_steering_gradient() const;
    /// Springs, bars and dampers act over the track, in series with the tyres, which follow at once. Only where the car has `roll`.
    RollModel roll() const;
    std::size_t states() const { return car.roll ? car_state::count_with_roll : car_state::count; }
};

/// x' by the model; both evaluate the same text.
void car_rates(const CarModel& model, double t_s, const double* x, double* dxdt);
void car_jacobian(const CarModel& model, double t_s, const double* x, double* jacobian, double* dfdt);

/// The car at `distance_m`, rolling steadily as wished: forces in balance, so that nothing swings that the drive does not excite.
std::vector<double> steady_car(const CarModel& model, double distance_m);

/// The problem for an integrator. Holds on to `model`, whose wish may be exchanged between two calls of the integrator.
OdeProblem car_problem(const std::shared_ptr<const CarModel>& model);

} // namespace fernlicht
