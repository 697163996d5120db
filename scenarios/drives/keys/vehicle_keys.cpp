#include "scenarios/drives/keys/vehicle_keys.h"

#include "scenarios/vehicle/car_validity.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t most_road_steps = 10'000;

void read_axle(const YamlMap& keys, std::string_view name, AxleParameters& axle) {
    const auto given = keys.find(name);
    if (!given)
        return;
    const YamlMap of = given->map({"unsprung_mass_kg", "spring_n_per_m", "damper_ns_per_m", "tyre_spring_n_per_m",
                                   "cornering_stiffness_n_per_rad", "slip_stiffness_n", "wheel_inertia_kgm2"});
    axle.unsprung_mass_kg = of.number_or("unsprung_mass_kg", axle.unsprung_mass_kg, 1.0, 10'000.0);
    axle.spring_n_per_m = of.number_or("spring_n_per_m", axle.spring_n_per_m, 1.0e3, 1.0e8);
    axle.damper_ns_per_m = of.number_or("damper_ns_per_m", axle.damper_ns_per_m, 0.0, 1.0e7);
    axle.tyre_spring_n_per_m = of.number_or("tyre_spring_n_per_m", axle.tyre_spring_n_per_m, 1.0e3, 1.0e9);
    axle.cornering_stiffness_n_per_rad = of.number_or("cornering_stiffness_n_per_rad", axle.cornering_stiffness_n_per_rad, 1.0e3, 1.0e8);
    axle.slip_stiffness_n = of.number_or("slip_stiffness_n", axle.slip_stiffness_n, 1.0e3, 1.0e8);
    axle.wheel_inertia_kgm2 = of.number_or("wheel_inertia_kgm2", axle.wheel_inertia_kgm2, 0.01, 1000.0);
}

/// At the key that was given: the springs, else the mass.
void check_springs(const YamlMap& keys, const char* name, const VehicleParameters& car, const AxleParameters& axle, double part_of_load) {
    const double deflection_m = deflection_at_rest_m(car, axle, part_of_load);
    if (deflection_m <= greatest_deflection_m)
        return;
    YamlEntry blamed = keys.find("mass_kg").value_or(keys.entry());
    if (const auto given = keys.find(name))
        blamed = *given;
    blamed.refuse(fmt::format("{} springs of {:g} N/m, which the car's {:g} kg press together by {:.2g} m at rest", name,
                              axle.spring_n_per_m, car.mass_kg, deflection_m),
                  fmt::format("at most {:g} m (0.8 Hz): stiffer springs or less mass_kg", greatest_deflection_m));
}

std::vector<RoadStep> read_road_steps(const YamlMap& keys) {
    std::vector<RoadStep> steps;
    if (const auto given = keys.find("road_steps"))
        for (const YamlEntry& entry : given->list(0, most_road_steps)) {
            const YamlMap step = entry.map({"at_m", "height_m"});
            const double at_m = step.require("at_m").number(0.0, 1.0e6);
            if (!steps.empty() && at_m <= steps.back().at_m)
                entry.refuse(fmt::format("at_m {} after {}", at_m, steps.back().at_m), "places that ascend");
            steps.push_back({at_m, step.require("height_m").number(-0.2, 0.2)});
        }
    return steps;
}

std::optional<SwivelParameters> read_swivel(const YamlMap& keys) {
    const auto given = keys.find("swivel");
    SwivelParameters swivel;
    if (!given || given->is_scalar())
        return given && given->flag() ? std::optional(swivel) : std::nullopt;
    const YamlMap of = given->map({"preview_s", "natural_frequency_hz", "damping", "rate_limit_deg_s", "rate_limit_rad_s", "least_deg",
                                   "least_rad", "greatest_deg", "greatest_rad", "control_period_s", "dead_time_s"});
    swivel.preview_s = of.number_or("preview_s", swivel.preview_s, 0.0, 10.0);
    swivel.actuator = read_actuator(of, swivel.actuator);
    return swivel;
}

} // namespace

ActuatorParameters read_actuator(const YamlMap& keys, ActuatorParameters actuator) {
    actuator.natural_frequency_hz = keys.number_or("natural_frequency_hz", actuator.natural_frequency_hz, 1.0e-3, 1.0e6);
    actuator.damping = keys.number_or("damping", actuator.damping, 0.0, 1.0e6);
    if (const auto rate = keys.one_of({"rate_limit_deg_s", "rate_limit_rad_s"}))
        actuator.rate_limit_rad_s =
            rate->first == "rate_limit_rad_s" ? rate->second.number(1.0e-6, 1.0e6) : radians(rate->second.number(1.0e-4, 1.0e7));
    actuator.least_rad = keys.angle_rad("least", 90.0).value_or(actuator.least_rad);
    actuator.greatest_rad = keys.angle_rad("greatest", 90.0).value_or(actuator.greatest_rad);
    if (!(actuator.least_rad <= 0.0 && actuator.greatest_rad >= 0.0 && actuator.least_rad < actuator.greatest_rad))
        keys.entry().refuse(fmt::format("limits of {:.4g} and {:.4g} degrees", degrees(actuator.least_rad), degrees(actuator.greatest_rad)),
                            "least below greatest, and 0 not outside them");
    actuator.control_period_s = keys.number_or("control_period_s", actuator.control_period_s, 1.0e-4, 100.0);
    actuator.dead_time_s = keys.number_or("dead_time_s", actuator.dead_time_s, 0.0, 10.0);
    return actuator;
}

std::optional<LevellingParameters> read_levelling(const YamlMap& keys, bool own_period) {
    const auto given = keys.find("levelling");
    if (!given)
        return std::nullopt;
    const auto control = [](const YamlEntry& entry, LevellingParameters& levelling) {
        const std::size_t choice = entry.choice({"none", "static", "dynamic"});
        levelling.control = choice == 1 ? LevellingControl::slow : LevellingControl::dynamic;
        return choice != 0;
    };
    LevellingParameters levelling;
    if (given->is_scalar())
        return control(*given, levelling) ? std::optional(levelling) : std::nullopt;
    const YamlMap of = given->map({"control", "natural_frequency_hz", "damping", "rate_limit_deg_s", "rate_limit_rad_s", "least_deg",
                                   "least_rad", "greatest_deg", "greatest_rad", "control_period_s", "dead_time_s"});
    if (const auto period = of.find("control_period_s"); period && !own_period)
        period->refuse("a period of the levelling alone", "control.period_s, which holds for all laws");
    levelling.actuator = read_actuator(of, levelling.actuator);
    const auto word = of.find("control");
    return !word || control(*word, levelling) ? std::optional(levelling) : std::nullopt;
}

std::optional<VehicleParameters> read_vehicle(const YamlMap& drive) {
    static constexpr Solver solvers[] = {Solver::automatic, Solver::dormand_prince, Solver::rosenbrock};
    const auto given = drive.find("vehicle");
    if (!given)
        return std::nullopt;
    VehicleParameters car;
    if (given->is_scalar()) {
        given->choice({"single-track"});
        return car;
    }
    const YamlMap keys =
        given->map({"model", "mass_kg", "front_load", "centre_of_gravity_height_m", "yaw_inertia_kgm2", "pitch_inertia_kgm2", "front",
                    "rear", "relaxation_length_m", "friction", "wheel_radius_m", "brake_balance", "anti_pitch", "drag_area_m2",
                    "rolling_resistance", "road_steps", "solver", "tolerance"});
    if (const auto model = keys.find("model"))
        model->choice({"single-track"});
    car.mass_kg = keys.number_or("mass_kg", car.mass_kg, 50.0, 100'000.0);
    car.front_load = keys.number_or("front_load", car.front_load, 0.05, 0.95);
    car.centre_of_gravity_height_m = keys.number_or("centre_of_gravity_height_m", car.centre_of_gravity_height_m, 0.0, 5.0);
    car.yaw_inertia_kgm2 = keys.number_or("yaw_inertia_kgm2", car.yaw_inertia_kgm2, 1.0, 1.0e7);
    car.pitch_inertia_kgm2 = keys.number_or("pitch_inertia_kgm2", car.pitch_inertia_kgm2, 1.0, 1.0e7);
    read_axle(keys, "front", car.front);
    read_axle(keys, "rear", car.rear);
    car.relaxation_length_m = keys.number_or("relaxation_length_m", car.relaxation_length_m, 0.01, 10.0);
    car.friction = keys.number_or("friction", car.friction, 0.01, 2.0);
    car.wheel_radius_m = keys.number_or("wheel_radius_m", car.wheel_radius_m, 0.05, 2.0);
    car.brake_balance = keys.number_or("brake_balance", car.brake_balance, 0.0, 1.0);
    car.anti_pitch = keys.number_or("anti_pitch", car.anti_pitch, 0.0, 1.0);
    car.drag_area_m2 = keys.number_or("drag_area_m2", car.drag_area_m2, 0.0, 50.0);
    car.rolling_resistance = keys.number_or("rolling_resistance", car.rolling_resistance, 0.0, 0.5);
    car.road_steps = read_road_steps(keys);
    if (const auto solver = keys.find("solver"))
        car.solver = solvers[solver->choice({"auto", "dormand-prince", "rosenbrock"})];
    car.tolerance = keys.number_or("tolerance", car.tolerance, 1.0e-12, 1.0e-2);
    const double unsprung_kg = car.front.unsprung_mass_kg + car.rear.unsprung_mass_kg;
    if (unsprung_kg > 0.5 * car.mass_kg)
        keys.entry().refuse(fmt::format("axles of {} kg under a car of {} kg", unsprung_kg, car.mass_kg), "at most half of mass_kg");
    check_springs(keys, "front", car, car.front, car.front_load);
    check_springs(keys, "rear", car, car.rear, 1.0 - car.front_load);
    return car;
}

void read_actuators(const YamlMap& drive, const YamlMap* keys, Variant& variant) {
    auto given = keys ? keys->find("actuators") : std::nullopt;
    if (!given)
        given = drive.find("actuators");
    if (!given)
        return;
    if (!drive.find("vehicle"))
        given->refuse("actuators in a drive without a vehicle", "vehicle: single-track, whose pitch and steering they follow");
    const YamlMap of = given->map({"levelling", "swivel"});
    variant.levelling = read_levelling(of);
    variant.swivel = read_swivel(of);
}

} // namespace fernlicht
