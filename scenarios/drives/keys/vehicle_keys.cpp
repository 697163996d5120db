#include "scenarios/drives/keys/drive_keys.h"

#include "scenarios/fields/field.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/vehicle/car_model.h"
#include "scenarios/vehicle/car_run.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t max_road_steps = 10'000, max_load_steps = 1000;

const Fields<AxleParameters>& axle_fields() {
    static const Fields<AxleParameters> fields{
        field("unsprung_mass_kg", 1, &AxleParameters::unsprung_mass_kg, range(1.0, 10'000.0), "of both wheels together, as all of these"),
        field("spring_n_per_m", 2, &AxleParameters::spring_n_per_m, range(1.0e3, 1.0e8), "at the wheel"),
        field("damper_ns_per_m", 3, &AxleParameters::damper_ns_per_m, range(0.0, 1.0e7), "at the wheel"),
        field("tyre_spring_n_per_m", 4, &AxleParameters::tyre_spring_n_per_m, range(1.0e3, 1.0e9), "vertical"),
        field("cornering_stiffness_n_per_rad", 5, &AxleParameters::cornering_stiffness_n_per_rad, range(1.0e3, 1.0e8),
              "side force by slip angle"),
        field("slip_stiffness_n", 6, &AxleParameters::slip_stiffness_n, range(1.0e3, 1.0e8), "longitudinal force by slip"),
        field("wheel_inertia_kgm2", 7, &AxleParameters::wheel_inertia_kgm2, range(0.01, 1000.0), "about the axle"),
    };
    return fields;
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

void check_roll(const YamlEntry& entry, const VehicleParameters& car) {
    CarModel model;
    model.car = car;
    const RollModel body = model.roll();
    if (body.arm_kgm < 0.0)
        entry.refuse(fmt::format("a roll axis at {:g} m, above the body's centre of gravity", car.roll->axis_height_m),
                     "axis_height_m below centre_of_gravity_height_m");
    if (!(body.stiffness_nm_per_rad() > 0.0))
        entry.refuse(fmt::format("springs and bars that hold {:.3g} Nm/rad, while the leaning body's weight pulls with {:.3g}",
                                 body.front_nm_per_rad + body.rear_nm_per_rad, gravity_mps2 * body.arm_kgm),
                     "a car that does not fall over: more front_bar_nm_per_rad or track_m, a lower centre_of_gravity_height_m");
}

constexpr std::string_view levelling_words[] = {"none", "static", "dynamic"};

/// "none" stays with whoever may leave the levelling out.
void read_levelling_control(const YamlEntry& entry, LevellingParameters& levelling) {
    const std::size_t choice = entry.choice(levelling_words);
    if (choice > 0)
        levelling.control = static_cast<LevellingControl>(choice - 1);
}

void check_vehicle(const YamlMap& keys, const VehicleParameters& car) {
    for (std::size_t i = 1; i < car.road_steps.size(); ++i)
        if (car.road_steps[i].at_m <= car.road_steps[i - 1].at_m)
            keys.require("road_steps")
                .list(0, max_road_steps)[i]
                .refuse(fmt::format("at_m {} after {}", car.road_steps[i].at_m, car.road_steps[i - 1].at_m), "places that ascend");
    const double unsprung_kg = car.front.unsprung_mass_kg + car.rear.unsprung_mass_kg;
    if (unsprung_kg > 0.5 * car.mass_kg)
        keys.entry().refuse(fmt::format("axles of {} kg under a car of {} kg", unsprung_kg, car.mass_kg), "at most half of mass_kg");
    for (std::size_t i = 1; i < car.load_steps.size(); ++i)
        if (car.load_steps[i].at_s <= car.load_steps[i - 1].at_s)
            keys.require("load_steps")
                .list(0, max_load_steps)[i]
                .refuse(fmt::format("at_s {} after {}", car.load_steps[i].at_s, car.load_steps[i - 1].at_s), "times that ascend");
    if (car.roll)
        check_roll(keys.require("roll"), car);
    check_springs(keys, "front", car, car.front, car.front_load);
    check_springs(keys, "rear", car, car.rear, 1.0 - car.front_load);
}

void check_actuator(const YamlMap& keys, const ActuatorParameters& actuator) {
    if (!(actuator.min_rad <= 0.0 && actuator.max_rad >= 0.0 && actuator.min_rad < actuator.max_rad))
        keys.entry().refuse(fmt::format("limits of {:.4g} and {:.4g} degrees", degrees(actuator.min_rad), degrees(actuator.max_rad)),
                            "least below greatest, and 0 not outside them");
}

} // namespace

const Fields<ActuatorParameters>& actuator_fields() {
    using Actuator = ActuatorParameters;
    static const Fields<Actuator> fields =
        Fields<Actuator>{
            field("natural_frequency_hz", 1, &Actuator::natural_frequency_hz, range(1.0e-3, 1.0e6), "of its second order"),
            field("damping", 2, &Actuator::damping, range(0.0, 1.0e6), "1: aperiodic"),
            field("rate_limit", 3, &Actuator::rate_limit_rad_s, angular_speed("rate_limit", 1.0e-4, 1.0e7, 1.0e-6, 1.0e6),
                  "how fast it turns"),
            field("min", 4, &Actuator::min_rad, degrees_within("min", 90.0), "how far down or right"),
            field("max", 5, &Actuator::max_rad, degrees_within("max", 90.0), "how far up or left"),
            field("control_period_s", 6, &Actuator::control_period_s, range(1.0e-4, 100.0), "between two commands"),
            field("dead_time_s", 7, &Actuator::dead_time_s, range(0.0, 10.0), "until a command takes effect"),
        }
            .checked(check_actuator);
    return fields;
}

const Fields<LevellingParameters>& levelling_fields() {
    using Levelling = LevellingParameters;
    static const Fields<Levelling> fields{
        own<Levelling>(
            "control", 1, read_levelling_control,
            [](const Levelling& of) { return std::string(levelling_words[1 + static_cast<std::size_t>(of.control)]); },
            R"({"enum": ["none", "static", "dynamic"]})", "static: against the body's mean pitch over 10 s"),
        inlined(2, &Levelling::actuator, actuator_fields()),
    };
    return fields;
}

std::optional<LevellingParameters> read_levelling(const YamlEntry& given, bool own_period) {
    LevellingParameters levelling;
    const auto asked = [&](const YamlEntry& word) {
        read_levelling_control(word, levelling);
        return word.value().text == "none" ? std::nullopt : std::optional(levelling);
    };
    if (given.is_scalar())
        return asked(given);
    const YamlMap of = given.map(keys_of(levelling_fields()));
    if (const auto period = of.find("control_period_s"); period && !own_period)
        period->refuse("a period of the levelling alone", "control.period_s, which holds for all laws");
    read_group(levelling_fields(), of, &levelling);
    const auto word = of.find("control");
    return word ? asked(*word) : levelling;
}

const Fields<LampSet>& actuators_fields() {
    static const Fields<LampSet> fields =
        Fields<LampSet>{
            field("levelling", 1, &LampSet::levelling, levelling_fields(), "against the body's pitch")
                .read_by([](const YamlEntry& entry, LampSet& lamp_set) { lamp_set.levelling = read_levelling(entry); })
                .short_for("control"),
            field("swivel", 2, &LampSet::swivel,
                  Fields<SwivelParameters>{
                      field("preview_s", 1, &SwivelParameters::preview_s, range(0.0, 10.0), "to where the bend leads in this time"),
                      inlined(2, &SwivelParameters::actuator, actuator_fields()),
                  },
                  "bend lighting: all lamps turn")
                .or_flag(),
        }
            .block()
            .defined_as("actuators");
    return fields;
}

const Fields<VehicleParameters>& vehicle_fields() {
    using Car = VehicleParameters;
    static const Fields<Car> fields =
        Fields<Car>{
            own<Car>(
                "model", 1, [](const YamlEntry& entry, Car&) { entry.choice({"single-track"}); },
                [](const Car&) { return std::string("single-track"); }, R"({"enum": ["single-track"]})", "the only one"),
            field("mass_kg", 2, &Car::mass_kg, range(50.0, 100'000.0), "with its driver"),
            field("front_load", 3, &Car::front_load, range(0.05, 0.95), "part of the weight on the front axle"),
            field("centre_of_gravity_height_m", 4, &Car::centre_of_gravity_height_m, range(0.0, 5.0), "above the road"),
            field("yaw_inertia_kgm2", 5, &Car::yaw_inertia_kgm2, range(1.0, 1.0e7), "about the vertical"),
            field("pitch_inertia_kgm2", 6, &Car::pitch_inertia_kgm2, range(1.0, 1.0e7), "of the sprung mass"),
            field("front", 7, &Car::front, axle_fields(), "axle"),
            field("rear", 8, &Car::rear, axle_fields(), "axle"),
            field("relaxation_length_m", 9, &Car::relaxation_length_m, range(0.01, 10.0), "of the tyres, along and across"),
            field("friction", 10, &Car::friction, range(0.01, 2.0), "tyre on road"),
            field("wheel_radius_m", 11, &Car::wheel_radius_m, range(0.05, 2.0), "of the rolling tyre"),
            field("brake_balance", 12, &Car::brake_balance, range(0.0, 1.0), "part of the braking that the front axle does"),
            field("anti_pitch", 13, &Car::anti_pitch, range(0.0, 1.0), "part of the pitching moment that the suspension's links take"),
            field("drag_area_m2", 14, &Car::drag_area_m2, range(0.0, 50.0), "cw times A"),
            field("rolling_resistance", 15, &Car::rolling_resistance, range(0.0, 0.5), "part of the weight"),
            list("road_steps", 16, &Car::road_steps, 0, max_road_steps,
                 Fields<RoadStep>{
                     field("at_m", 1, &RoadStep::at_m, range(0.0, 1.0e6), "along the route").required(),
                     field("height_m", 2, &RoadStep::height_m, range(-0.2, 0.2), "the road goes on higher by this").required(),
                 },
                 "edges across the road that the tyres feel; by distance"),
            field("roll", 19, &Car::roll,
                  Fields<RollParameters>{
                      field("inertia_kgm2", 1, &RollParameters::inertia_kgm2, range(1.0, 1.0e7), "of the sprung mass"),
                      field("axis_height_m", 2, &RollParameters::axis_height_m, range(-1.0, 5.0), "of the roll axis above the road"),
                      field("track_m", 3, &RollParameters::track_m, range(0.2, 5.0), "between the wheels of an axle"),
                      field("front_bar_nm_per_rad", 4, &RollParameters::front_bar_nm_per_rad, range(0.0, 1.0e8), "anti-roll bar"),
                      field("rear_bar_nm_per_rad", 5, &RollParameters::rear_bar_nm_per_rad, range(0.0, 1.0e8), "anti-roll bar"),
                  },
                  "the body rolls on its springs")
                .or_flag(),
            field("roughness", 20, &Car::roughness,
                  Fields<Roughness>{
                      field("class", 1, &Roughness::road_class, words({"A", "B", "C", "D", "E", "F", "G", "H"}), "of ISO 8608"),
                      field("seed", 2, &Roughness::seed, range(0.0, 1.0e9), "another seed is another road of that class"),
                  },
                  "of the road, which the tyres feel; not drawn")
                .short_for("class"),
            list("load_steps", 21, &Car::load_steps, 0, max_load_steps,
                 Fields<LoadStep>{
                     field("at_s", 1, &LoadStep::at_s, above(0.0, 1.0e6), "from then on").required(),
                     field("front_kg", 2, &LoadStep::front_kg, range(-5000.0, 5000.0), "more over the front axle"),
                     field("rear_kg", 3, &LoadStep::rear_kg, range(-5000.0, 5000.0), "more over the rear axle"),
                 },
                 "people who get in or out; by time"),
            field("solver", 17, &Car::solver, words({"auto", "dormand-prince", "rosenbrock"}), "auto: by stiffness"),
            field("tolerance", 18, &Car::tolerance, range(1.0e-12, 1.0e-2), "of the solver"),
        }
            .block()
            .checked(check_vehicle);
    return fields;
}

void read_actuators(const YamlMap& drive, const YamlMap* keys, LampSet& lamp_set) {
    auto given = keys ? keys->find("actuators") : std::nullopt;
    if (!given)
        given = drive.find("actuators");
    if (!given)
        return;
    if (!drive.find("vehicle"))
        given->refuse("actuators in a drive without a vehicle", "vehicle: single-track, whose pitch and steering they follow");
    read_group(actuators_fields(), *given, &lamp_set);
}

} // namespace fernlicht
