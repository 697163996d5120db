#include "scenarios/vehicle/car_run.h"

#include <algorithm>
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
    place.rear_lift_m = value(rear_body);
    const double front_lift_m = value(front_body);
    place.pitch_rad = (front_lift_m - place.rear_lift_m) / wheelbase_m_;
    const double front_wheel_m = value(front_wheel), rear_wheel_m = value(rear_wheel);
    place.spring_pitch_rad = (front_lift_m - front_wheel_m - place.rear_lift_m + rear_wheel_m) / wheelbase_m_;
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
    run.path_ = DensePath({std::begin(kept), std::end(kept)});
    start.wish = wishes.front();
    const auto model = std::make_shared<CarModel>(std::move(start));
    const OdeProblem problem = car_problem(model);
    OdeIntegrator integrator(problem, {.solver = model->car.solver, .tolerance = model->car.tolerance});
    std::vector<double> x = steady_car(*model, 0.0);
    RoadSteps steps{*model};
    steps.skip(x);
    double t_s = 0.0;
    for (std::size_t i = 0; i < wishes.size() && t_s < end_s; ++i) {
        model->wish = wishes[i];
        const double until_s = i + 1 < wishes.size() ? std::min(wishes[i + 1].start_s, end_s) : end_s;
        while (t_s < until_s) {
            const Arrival arrival = integrator.integrate(t_s, until_s, x, steps.watches(), &run.path_);
            t_s = arrival.time_s;
            if (arrival.event)
                steps.climb(*arrival.event, x);
        }
    }
    run.work_ = integrator.work();
    return run;
}

} // namespace fernlicht
