// The car and its lamp actuators in numbers. docs/vehicle.md says where the defaults come from. A drive without them has no suspension.
#pragma once

#include "scenarios/vehicle/ode.h"

#include <numbers>
#include <optional>

namespace fernlicht {

/// Both wheels of an axle together.
struct AxleParameters {
    double unsprung_mass_kg = 0.0;
    double spring_n_per_m = 0.0, damper_ns_per_m = 0.0; ///< at the wheel
    double tyre_spring_n_per_m = 0.0;                   ///< vertical
    double cornering_stiffness_n_per_rad = 0.0;         ///< side force by slip angle
    double slip_stiffness_n = 0.0;                      ///< longitudinal force by slip
    double wheel_inertia_kgm2 = 0.0;                    ///< about the axle; what turns with it included

    bool operator==(const AxleParameters&) const = default;
};

/// An edge across the road: what the tyres feel; it is not drawn.
struct RoadStep {
    double at_m = 0.0;     ///< along the route
    double height_m = 0.0; ///< the road goes on higher by this; negative: lower

    bool operator==(const RoadStep&) const = default;
};

/// Of ISO 8608, from very smooth to hardly passable; D is a bad road of asphalt.
enum class RoadClass { A, B, C, D, E, F, G, H };

/// All along the route: what the tyres feel; it is not drawn.
struct Roughness {
    RoadClass road_class = RoadClass::C;
    int seed = 1; ///< at least 0

    bool operator==(const Roughness&) const = default;
};

/// The body turns about an axis along the car, on its springs and its anti-roll bars; the axles roll with the road.
struct RollParameters {
    double inertia_kgm2 = 500.0; ///< of the sprung mass, about its centre of gravity
    double axis_height_m = 0.1;  ///< above the road, below the centre of gravity
    double track_m = 1.5;        ///< between the wheels of an axle
    double front_bar_nm_per_rad = 25'000.0, rear_bar_nm_per_rad = 15'000.0;

    bool operator==(const RollParameters&) const = default;
};

/// Weight that comes over the axles at a time, as forces on the body: who gets in. Negative: who gets out.
struct LoadStep {
    double at_s = 0.0; ///< above 0
    double front_kg = 0.0, rear_kg = 0.0;

    bool operator==(const LoadStep&) const = default;
};

/// A middle-class car with front-wheel drive, driver included.
struct VehicleParameters {
    double mass_kg = 1500.0;
    double front_load = 0.55; ///< part of the weight on the front axle at rest; 0.05 .. 0.95
    double centre_of_gravity_height_m = 0.55;
    double yaw_inertia_kgm2 = 2700.0, pitch_inertia_kgm2 = 2200.0; ///< the latter of the sprung mass
    AxleParameters front{90.0, 41'600.0, 3'300.0, 400'000.0, 90'000.0, 150'000.0, 2.4};
    AxleParameters rear{80.0, 43'000.0, 3'050.0, 400'000.0, 110'000.0, 150'000.0, 2.4};
    double relaxation_length_m = 0.3; ///< of the tyres, along and across
    double friction = 1.0;            ///< tyre on road
    double wheel_radius_m = 0.31;
    double brake_balance = 0.7; ///< part of the braking that the front axle does
    double anti_pitch = 0.4;    ///< part of the pitching moment that the suspension's links take in place of its springs; 0 .. 1
    double drag_area_m2 = 0.65; ///< cw * A
    double rolling_resistance = 0.012;
    std::vector<RoadStep> road_steps; ///< by distance
    Solver solver = Solver::automatic;
    double tolerance = 1.0e-6;
    std::optional<RollParameters> roll; ///< none: the body does not roll
    std::optional<Roughness> roughness;
    std::vector<LoadStep> load_steps; ///< by time

    bool operator==(const VehicleParameters&) const = default;
};

/// Second order, x'' = w^2 (command - x) - 2 z w x', with limits on x' and x. The command is formed every control period and takes effect
/// after the dead time.
struct ActuatorParameters {
    double natural_frequency_hz = 5.0; ///< w / (2 pi)
    double damping = 1.0;              ///< z
    double rate_limit_rad_s = 0.2;
    double min_rad = -0.06, max_rad = 0.06; ///< 0 lies between them
    double control_period_s = 0.01;
    double dead_time_s = 0.02;

    double frequency_rad_s() const { return 2.0 * std::numbers::pi * natural_frequency_hz; }
    bool operator==(const ActuatorParameters&) const = default;
};

/// Which pitch of the body on its springs the lamps are turned against: its mean, by a filter of 10 s ("static"), or each (dynamic).
enum class LevellingControl { slow, dynamic };

/// Lamps up positive.
struct LevellingParameters {
    LevellingControl control = LevellingControl::dynamic;
    ActuatorParameters actuator{5.0, 0.9, 0.2, -0.06, 0.06, 0.01, 0.02};

    bool operator==(const LevellingParameters&) const = default;
};

/// Bend lighting: all lamps turn to where the bend that the steering drives leads in `preview_s`. Left positive.
struct SwivelParameters {
    double preview_s = 1.5;
    ActuatorParameters actuator{3.0, 0.9, 0.35, -0.262, 0.262, 0.02, 0.03};

    bool operator==(const SwivelParameters&) const = default;
};

} // namespace fernlicht
