#include "scenarios/drives/play/motion.h"

#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/bus_play.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double slow_filter_s = 10.0; ///< static levelling: slower than any swing of the body, quicker than loading

std::vector<SpeedSegment> wishes(const std::vector<SpeedPoint>& profile) {
    std::vector<SpeedSegment> segments;
    if (profile.front().time_s > 0.0)
        segments.push_back({0.0, profile.front().speed_mps, 0.0});
    for (std::size_t i = 0; i + 1 < profile.size(); ++i)
        segments.push_back({profile[i].time_s, profile[i].speed_mps,
                            (profile[i + 1].speed_mps - profile[i].speed_mps) / (profile[i + 1].time_s - profile[i].time_s)});
    segments.push_back({profile.back().time_s, profile.back().speed_mps, 0.0});
    return segments;
}

/// "1 step", "2 steps"
std::string counted(std::uint64_t count, const char* what) { return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s"); }

std::string solved(const SolverWork& work) {
    const auto part = [](const char* method, const MethodWork& did) {
        return did.steps == 0 ? std::string() : fmt::format("{} for {:.3g} s ({}), ", method, did.simulated_s, counted(did.steps, "step"));
    };
    return fmt::format("{}{}{} rejected, {}", part("dormand-prince", work.dormand_prince), part("rosenbrock", work.rosenbrock),
                       counted(work.dormand_prince.rejected + work.rosenbrock.rejected, "step"), counted(work.derivatives, "evaluation"));
}

/// The largest differences between plan and motion, looked at where steps end.
std::string strayed(const CarRun& car, const std::vector<SpeedPoint>& profile) {
    double speed = 0.0, place = 0.0, offset = 0.0;
    for (std::size_t step = 0; step < car.path().steps(); ++step) {
        const double t_s = car.path().step_end_s(step);
        const CarPlace at = car.at(t_s);
        speed = std::max(speed, std::abs(at.speed_mps - speed_mps(profile, t_s)));
        place = std::max(place, std::abs(at.distance_m - distance_m(profile, t_s)));
        offset = std::max(offset, std::abs(at.offset_left_m));
    }
    return fmt::format("at most {:.2g} m/s from the speed that the drive asks for, {:.2g} m from that place, {:.2g} m beside the lane's "
                       "centre",
                       speed, place, offset);
}

/// Whether any lamp shines at `time_s`, changes at that very time included.
bool shines(const LampSet& lamp_set, double time_s) {
    return std::ranges::any_of(lamp_set.lamps, [&](const MountedLamp& lamp) {
        double level = lamp.level;
        for (const LampChange& change : lamp_set.changes)
            if (change.time_s <= time_s && change.lamp == lamp.name)
                level = change.level.value_or(level);
        return level > 0.0;
    });
}

/// When lamps may go on or off.
std::vector<double> switches_s(const LampSet& lamp_set, double end_s) {
    std::vector<double> times_s;
    for (const LampChange& change : lamp_set.changes)
        if (change.level && change.time_s < end_s)
            times_s.push_back(change.time_s);
    return times_s;
}

ActuatorRun run_lamp_actuator(const Drive& drive, const LampSet& lamp_set, const ActuatorParameters& actuator,
                              const std::function<double(double)>& command) {
    return run_actuator(actuator, command, switches_s(lamp_set, drive.duration_s), drive.duration_s,
                        {.solver = drive.vehicle->solver, .tolerance = drive.vehicle->tolerance});
}

ActuatorRun run_levelling(const Drive& drive, const LampSet& lamp_set, const CarRun& car) {
    double mean_rad = car.at(0.0).spring_pitch_rad, last_s = 0.0;
    const auto command = [&](double tick_s) {
        const double pitch_rad = car.at(tick_s).spring_pitch_rad;
        mean_rad += (1.0 - std::exp((last_s - tick_s) / slow_filter_s)) * (pitch_rad - mean_rad);
        last_s = tick_s;
        if (!shines(lamp_set, tick_s))
            return 0.0;
        return lamp_set.levelling->control == LevellingControl::dynamic ? -pitch_rad : -mean_rad;
    };
    return run_lamp_actuator(drive, lamp_set, lamp_set.levelling->actuator, command);
}

/// The circle of curvature k that the steering drives lies at an angle of k d / 2 to the left after a way of d.
ActuatorRun run_swivel(const Drive& drive, const LampSet& lamp_set, const CarRun& car, const CarModel& model) {
    const auto command = [&](double tick_s) {
        const CarPlace place = car.at(tick_s);
        const double v = place.speed_mps;
        const double bend_per_m = place.steering_rad / (model.wheelbase_m + model.self_steering_gradient() * v * v);
        return shines(lamp_set, tick_s) ? 0.5 * bend_per_m * v * lamp_set.swivel->preview_s : 0.0;
    };
    return run_lamp_actuator(drive, lamp_set, lamp_set.swivel->actuator, command);
}

/// fit_to_route held the plan to the route; a car that cannot brake as it was asked to comes further.
void fit_to_route(Drive& drive, const Route& route, const CarRun& car) {
    const int planned = tick_count(drive);
    int ticks = planned;
    while (ticks > 1 && car.at((ticks - 1) * drive.step_s).distance_m + drive.bumper_m > route.length_m())
        --ticks;
    if (ticks == planned)
        return;
    drive.notes.push_back(fmt::format("the car comes to the end of the route, {:.1f} m, sooner than planned: the drive ends after {:.3g} s "
                                      "instead of {:.3g} s",
                                      route.length_m(), ticks * drive.step_s, drive.duration_s));
    drive.duration_s = ticks * drive.step_s;
}

std::string actuator_note(const char* which, const ActuatorRun& run) {
    return fmt::format("{}: {}; {} at its rate limit, {} at a stop", which, solved(run.work), counted(run.rate_limited, "time"),
                       counted(run.at_stop, "time"));
}

/// Refuses what the model does not describe; a note of wheels that hop.
void check_validity(Drive& drive, const CarRun& car) {
    const CarValidity validity = car_validity(car, drive.duration_s);
    if (validity.beyond)
        throw InputError({drive.file, 0, 0, "vehicle"}, validity.beyond->found, validity.beyond->expected);
    if (validity.hops > 0)
        drive.notes.push_back(fmt::format("vehicle: wheels of an axle leave the road {}, for at most {:.2g} s",
                                          counted(static_cast<std::uint64_t>(validity.hops), "time"), validity.longest_hop_s));
}

/// What disturbances do to the body, and so to a cut-off that no levelling holds: standard deviations over the drive, every 10 ms.
std::string swung(const CarRun& car, double end_s) {
    double n = 0.0, pitch = 0.0, pitch2 = 0.0, roll = 0.0, roll2 = 0.0;
    for (double t_s = 0.0; t_s < end_s; t_s = 0.01 * n) {
        const CarPlace at = car.at(t_s);
        n += 1.0;
        pitch += at.pitch_rad, pitch2 += at.pitch_rad * at.pitch_rad;
        roll += at.roll_rad, roll2 += at.roll_rad * at.roll_rad;
    }
    const auto deviation_deg = [n](double sum, double squares) {
        return degrees(std::sqrt(std::max(squares / n - sum / n * (sum / n), 0.0)));
    };
    return fmt::format("vehicle: the body's pitch has a standard deviation of {:.2g} degrees over the drive, its roll {:.2g}",
                       deviation_deg(pitch, pitch2), deviation_deg(roll, roll2));
}

void simulate_vehicle(Drive& drive, const Route& route) {
    CarModel model;
    model.car = *drive.vehicle;
    model.wheelbase_m = drive.wheelbase_m;
    // As far as it may come; it lags behind its plan rather than running ahead, by metres at most.
    const std::vector<SpeedPoint> speed = drive.bus_motion ? drive.bus_motion->profile() : drive.speed;
    model.road = road_course(route, route_distance_m(drive, drive.duration_s) + 200.0);
    const auto car = std::make_shared<const CarRun>(run_car(model, wishes(speed), drive.duration_s));
    fit_to_route(drive, route, *car);
    check_validity(drive, *car);
    drive.notes.push_back(fmt::format("vehicle: {}; {}", solved(car->work()), strayed(*car, speed)));
    if (model.car.roll || model.car.roughness || !model.car.load_steps.empty())
        drive.notes.push_back(swung(*car, drive.duration_s));
    for (LampSet& lamp_set : drive.lamp_sets) {
        auto motion = std::make_shared<Motion>(Motion{car, std::nullopt, std::nullopt, std::nullopt, {}, {}});
        if (lamp_set.levelling) {
            motion->levelling = run_levelling(drive, lamp_set, *car);
            motion->notes.push_back(actuator_note("levelling", *motion->levelling));
        }
        if (lamp_set.swivel) {
            motion->swivel = run_swivel(drive, lamp_set, *car, model);
            motion->notes.push_back(actuator_note("swivel", *motion->swivel));
        }
        lamp_set.motion = std::move(motion);
    }
}

} // namespace

void simulate(Drive& drive, const Route& route) {
    if (!drive.vehicle)
        return;
    try {
        simulate_vehicle(drive, route);
    } catch (const InputError& error) {
        if (!error.where().file.empty())
            throw;
        throw InputError({drive.file, 0, 0, "vehicle"}, error.what());
    }
}

void turn(MountedLamp& lamp, const Motion& motion, double time_s) {
    if (motion.levelling)
        lamp.pitch_rad += motion.levelling->angle_rad(time_s);
    if (motion.swivel)
        lamp.yaw_rad += motion.swivel->angle_rad(time_s);
    if (!motion.control)
        return;
    const ControlRun& control = *motion.control;
    const std::size_t controlled = control.lamp(lamp.name);
    if (controlled == control.lamps.size())
        return;
    lamp.pitch_rad += control.pitch_rad(controlled, time_s);
    lamp.yaw_rad += control.swivel_rad(controlled, time_s);
    lamp.level *= control.level(controlled, time_s);
    lamp.pitch_rad += control.mode(controlled, time_s).pitch_rad;
    if (const auto file = control.file(controlled, time_s, lamp.file))
        lamp.file = file;
}

} // namespace fernlicht
