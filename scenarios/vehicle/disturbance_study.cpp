#include "scenarios/vehicle/disturbance_study.h"

#include "scenarios/vehicle/car_run.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fernlicht {
namespace {

constexpr int disturbance_samples = 997;
constexpr double study_s = 1.2, tight_tolerance = 1.0e-10;

struct DisturbedCar {
    std::string what;
    double speed_mps = 0.0;
    CarModel model;
};

/// Pitch and roll by turns.
std::vector<double> swings(const DisturbedCar& car, Solver solver, double tolerance) {
    CarModel model = car.model;
    model.car.solver = solver;
    model.car.tolerance = tolerance;
    const CarRun run = run_car(std::move(model), {{0.0, car.speed_mps, 0.0}}, study_s);
    std::vector<double> found;
    for (int k = 1; k <= disturbance_samples; ++k) {
        const CarPlace at = run.at(study_s * k / disturbance_samples);
        found.push_back(at.pitch_rad);
        found.push_back(at.roll_rad);
    }
    return found;
}

void study(const DisturbedCar& car, std::vector<ExtremeTrial>& trials) {
    const std::vector<double> reference = swings(car, Solver::rosenbrock, tight_tolerance);
    const auto worst = [&](const std::vector<double>& found) {
        double largest = 0.0;
        for (std::size_t i = 0; i < found.size(); ++i)
            largest = std::max(largest, std::abs(found[i] - reference[i]));
        return largest;
    };
    trials.push_back({car.what, worst(swings(car, Solver::automatic, VehicleParameters{}.tolerance))});
    trials.push_back({car.what + ", the reference itself", worst(swings(car, Solver::dormand_prince, tight_tolerance))});
}

DisturbedCar rolling(const char* what, double speed_mps) {
    DisturbedCar car{what, speed_mps, {}};
    car.model.car.roll = RollParameters{};
    return car;
}

} // namespace

std::vector<ExtremeTrial> roll_of_extreme_cars() {
    std::vector<ExtremeTrial> trials;
    const auto slalom = [](CarModel& model, double bend_per_m) {
        for (int cell = -1; cell < 60; ++cell)
            model.road.curvature_per_m.push_back(bend_per_m * std::sin(2.0 * std::numbers::pi * cell * RoadCourse::cell_m / 40.0));
    };
    DisturbedCar stiff = rolling("roll on bars of 1e8 Nm/rad", 20.0);
    slalom(stiff.model, 0.01);
    stiff.model.car.roll->front_bar_nm_per_rad = stiff.model.car.roll->rear_bar_nm_per_rad = 1.0e8;
    stiff.model.car.front.tyre_spring_n_per_m = stiff.model.car.rear.tyre_spring_n_per_m = 1.0e9;
    study(stiff, trials);
    // Springs without bars hold 43 kNm/rad; 3.3 m above the axis 1330 kg pull with almost as much.
    DisturbedCar leaning = rolling("roll of a body that all but tips over", 20.0);
    slalom(leaning.model, 0.001);
    leaning.model.car.roll->front_bar_nm_per_rad = leaning.model.car.roll->rear_bar_nm_per_rad = 0.0;
    const auto left_nm_per_rad = [&] { return leaning.model.roll().stiffness_nm_per_rad(); };
    for (double step_m = 2.0; step_m > 1.0e-4; step_m *= 0.5) { // lower the axis as far as it stands
        leaning.model.car.roll->axis_height_m -= step_m;
        while (left_nm_per_rad() <= 0.0)
            leaning.model.car.roll->axis_height_m += step_m;
    }
    study(leaning, trials);
    return trials;
}

std::vector<ExtremeTrial> extreme_rough_roads() {
    std::vector<ExtremeTrial> trials;
    DisturbedCar stiff = rolling("class B on dampers of 1e6 Ns/m", 30.0);
    stiff.model.car.roughness = Roughness{RoadClass::B, 1};
    for (AxleParameters* axle : {&stiff.model.car.front, &stiff.model.car.rear})
        axle->damper_ns_per_m = 1.0e6;
    study(stiff, trials);
    DisturbedCar flying = rolling("class H at 60 m/s", 60.0);
    flying.model.car.roughness = Roughness{RoadClass::H, 1};
    study(flying, trials);
    return trials;
}

std::vector<ExtremeTrial> extreme_loads() {
    std::vector<ExtremeTrial> trials;
    DisturbedCar stiff = rolling("2 t at once on springs of 1e8 N/m", 20.0);
    stiff.model.car.load_steps = {{0.5, 0.0, 2000.0}};
    for (AxleParameters* axle : {&stiff.model.car.front, &stiff.model.car.rear}) {
        axle->spring_n_per_m = 1.0e8;
        axle->damper_ns_per_m = 1.0e6;
    }
    study(stiff, trials);
    DisturbedCar restless = rolling("100 loads that come and go every 5 ms", 20.0);
    for (int i = 0; i < 100; ++i)
        restless.model.car.load_steps.push_back({0.5 + 0.005 * i, 0.0, i % 2 == 0 ? 500.0 : -500.0});
    study(restless, trials);
    return trials;
}

} // namespace fernlicht
