#include "scenarios/vehicle/car_run.h"

#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

using namespace car_state;

constexpr std::size_t kept[] = {distance,  offset,      heading,    forward_speed, front_body,
                                rear_body, front_wheel, rear_wheel, steering,      yaw_rate};

/// Watches for the next step in the road under each axle, in this order.
struct RoadSteps {
    const CarModel& model;
    std::size_t front = 0, rear = 0;

    double next_m(std::size_t index) const {
        const std::vector<RoadStep>& steps = model.car.road_steps;
        return index < steps.size() ? steps[index].at_m : std::numeric_limits<double>::max();
    }
    std::vector<Watch> watches() const {
        if (model.car.road_steps.empty())
            return {};
        const double ahead_m = model.wheelbase_m, front_m = next_m(front), rear_m = next_m(rear);
        return {{[=](double, const double* x) { return x[distance] + ahead_m - front_m; }, true, false},
                {[=](double, const double* x) { return x[distance] - rear_m; }, true, false}};
    }
    /// The road comes up: body and wheel lie that much lower by it.
    void climb(std::size_t axle, std::vector<double>& x) {
        std::size_t& passed = axle == 0 ? front : rear;
        const double height_m = model.car.road_steps[passed++].height_m;
        x[axle == 0 ? front_body : rear_body] -= height_m;
        x[axle == 0 ? front_wheel : rear_wheel] -= height_m;
    }
    /// Steps under or behind an axle at the start lie behind it.
    void skip(const std::vector<double>& x) {
        while (next_m(front) <= x[distance] + model.wheelbase_m)
            ++front;
        while (next_m(rear) <= x[distance])
            ++rear;
    }
};

/// Weights that come over the axles, in the order of their times.
struct LoadSteps {
    CarModel& model;
    std::size_t next = 0;

    double until_s(double end_s) const {
        const std::vector<LoadStep>& steps = model.car.load_steps;
        return next < steps.size() ? std::min(steps[next].at_s, end_s) : end_s;
    }
    void add(double time_s) {
        for (const std::vector<LoadStep>& steps = model.car.load_steps; next < steps.size() && steps[next].at_s <= time_s; ++next) {
            model.front_added_n += gravity_mps2 * steps[next].front_kg;
            model.rear_added_n += gravity_mps2 * steps[next].rear_kg;
        }
    }
};

} // namespace

CarPlace CarRun::at(double time_s) const {
    const auto value = [&](std::size_t component) {
        return path_.at(time_s, static_cast<std::size_t>(std::ranges::find(kept, component) - std::begin(kept)));
    };
    CarPlace place;
    place.distance_m = value(distance);
    place.offset_left_m = value(offset);
    place.heading_rad = value(heading);
    place.speed_mps = value(forward_speed);
    const double front_lift_m = value(front_body), rear_lift_m = value(rear_body);
    place.rear_lift_m = rear_lift_m;
    place.pitch_rad = (front_lift_m - rear_lift_m) / wheelbase_m_;
    if (!rough_.empty()) {
        const double rear_road_m = rough_.at(place.distance_m).height_m;
        place.pitch_rad += (rough_.at(place.distance_m + wheelbase_m_).height_m - rear_road_m) / wheelbase_m_;
        place.rear_lift_m += rear_road_m;
    }
    if (roll_) {
        place.roll_rad = path_.at(time_s, std::size(kept)); // behind those that every car has
        place.roll_axis_m = roll_->axis_height_m;
    }
    const double front_wheel_m = value(front_wheel), rear_wheel_m = value(rear_wheel);
    place.spring_pitch_rad = (front_lift_m - front_wheel_m - rear_lift_m + rear_wheel_m) / wheelbase_m_;
    place.steering_rad = value(steering);
    place.yaw_rate_rad_s = value(yaw_rate);
    place.front_load_n = std::max(front_rest_n_ - front_tyre_n_per_m_ * front_wheel_m, 0.0);
    place.rear_load_n = std::max(rear_rest_n_ - rear_tyre_n_per_m_ * rear_wheel_m, 0.0);
    return place;
}

CarRun run_car(CarModel start, const std::vector<SpeedSegment>& wishes, double end_s) {
    CarRun run;
    run.wheelbase_m_ = start.wheelbase_m;
    const double weight_n = start.car.mass_kg * gravity_mps2;
    run.front_rest_n_ = weight_n * start.rear_m() / start.wheelbase_m;
    run.rear_rest_n_ = weight_n * start.front_m() / start.wheelbase_m;
    run.front_tyre_n_per_m_ = start.car.front.tyre_spring_n_per_m;
    run.rear_tyre_n_per_m_ = start.car.rear.tyre_spring_n_per_m;
    run.roll_ = start.car.roll;
    if (start.car.roughness)
        start.rough = run.rough_ = RoughRoad(*start.car.roughness, run.roll_ ? run.roll_->track_m : 0.0, start.wheelbase_m);
    std::vector<std::size_t> components(std::begin(kept), std::end(kept));
    if (run.roll_)
        components.push_back(body_roll);
    run.path_ = DensePath(std::move(components));
    start.wish = wishes.front();
    const auto model = std::make_shared<CarModel>(std::move(start));
    const OdeProblem problem = car_problem(model);
    OdeIntegrator integrator(problem, {.solver = model->car.solver, .tolerance = model->car.tolerance});
    std::vector<double> x = steady_car(*model, 0.0);
    RoadSteps steps{*model};
    steps.skip(x);
    LoadSteps loads{*model};
    double t_s = 0.0;
    for (std::size_t i = 0; i < wishes.size() && t_s < end_s; ++i) {
        model->wish = wishes[i];
        const double until_s = i + 1 < wishes.size() ? std::min(wishes[i + 1].start_s, end_s) : end_s;
        while (t_s < until_s) {
            const Arrival arrival = integrator.integrate(t_s, loads.until_s(until_s), x, steps.watches(), &run.path_);
            t_s = arrival.time_s;
            loads.add(t_s);
            if (arrival.event)
                steps.climb(*arrival.event, x);
        }
    }
    run.work_ = integrator.work();
    return run;
}

namespace {

/// One axle's times in the air.
struct Hops {
    const char* axle;
    bool in_the_air = false;
    double since_s = 0.0;

    void look(double load_n, double time_s, CarValidity& validity) {
        if (load_n > 0.0) {
            in_the_air = false;
            return;
        }
        if (!in_the_air) {
            ++validity.hops;
            since_s = time_s;
        }
        in_the_air = true;
        const double hop_s = time_s - since_s;
        if (hop_s > longest_hop_s)
            validity.beyond = {
                fmt::format("the {} wheels are off the road for more than {:g} s from {:.3g} s on", axle, longest_hop_s, since_s),
                "a car that keeps its wheels on the road (a lower centre_of_gravity_height_m, milder braking and "
                "accelerating, lower road_steps, a smoother road)"};
        else
            validity.longest_hop_s = std::max(validity.longest_hop_s, hop_s);
    }
};

void look_at_pitch(double pitch_rad, double time_s, CarValidity& validity) {
    if (std::abs(pitch_rad) > greatest_pitch_rad)
        validity.beyond = {
            fmt::format("the body is pitched by {:.3g} degrees against the road at {:.3g} s", degrees(pitch_rad), time_s),
            fmt::format("at most {:.2g} degrees, up to which the equations' small angles hold (a lower "
                        "centre_of_gravity_height_m, stiffer springs, milder braking and accelerating, lower road_steps, a smoother road)",
                        degrees(greatest_pitch_rad))};
}

void look_at_roll(double roll_rad, double time_s, CarValidity& validity) {
    if (std::abs(roll_rad) > greatest_roll_rad)
        validity.beyond = {
            fmt::format("the body rolls by {:.3g} degrees at {:.3g} s", degrees(roll_rad), time_s),
            fmt::format("at most {:.2g} degrees, up to which the equations' small angles hold (stiffer springs and bars, a lower "
                        "centre_of_gravity_height_m, slower bends, a smoother road)",
                        degrees(greatest_roll_rad))};
}

} // namespace

double deflection_at_rest_m(const VehicleParameters& car, const AxleParameters& axle, double part_of_load) {
    return gravity_mps2 * (car.mass_kg * part_of_load - axle.unsprung_mass_kg) / axle.spring_n_per_m;
}

CarValidity car_validity(const CarRun& run, double end_s) {
    CarValidity validity;
    Hops front{"front"}, rear{"rear"};
    double start_s = run.path().start_s();
    for (std::size_t step = 0; step < run.path().steps() && start_s < end_s; ++step) {
        const double step_end_s = run.path().step_end_s(step);
        for (std::size_t node = step == 0 ? 0 : 1; node < DensePath::nodes; ++node) {
            const double time_s = start_s + (step_end_s - start_s) * static_cast<double>(node) / (DensePath::nodes - 1);
            if (time_s > end_s)
                break;
            const CarPlace place = run.at(time_s);
            look_at_pitch(place.pitch_rad, time_s, validity);
            look_at_roll(place.roll_rad, time_s, validity);
            front.look(place.front_load_n, time_s, validity);
            rear.look(place.rear_load_n, time_s, validity);
            if (validity.beyond)
                return validity;
        }
        start_s = step_end_s;
    }
    return validity;
}

} // namespace fernlicht
