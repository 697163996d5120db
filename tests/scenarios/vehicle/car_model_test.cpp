// The car's equations against closed forms.
#include "scenarios/vehicle/car_run.h"

#include <cmath>
#include <gmock/gmock.h>
#include <random>

namespace fernlicht {
namespace {

using namespace car_state;

std::shared_ptr<CarModel> standing() {
    auto model = std::make_shared<CarModel>();
    model->driven = false;
    return model;
}

/// Integrates on, tightly.
std::vector<double> after(const std::shared_ptr<CarModel>& model, std::vector<double> x, double duration_s, double tolerance = 1e-10) {
    const OdeProblem problem = car_problem(model);
    OdeIntegrator integrator(problem, {.tolerance = tolerance});
    integrator.integrate(0.0, duration_s, x);
    return x;
}

TEST(CarModel, JacobianIsThatOfDifferences) {
    CarModel model{.wish = {0.0, 20.0, -2.0}};
    for (int k = 0; k < 400; ++k) {
        model.road.slope.push_back(0.05 * std::sin(0.1 * k));
        model.road.curvature_per_m.push_back(0.01 * std::cos(0.07 * k));
    }
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<double> x = steady_car(model, 30.0);
        const OdeProblem problem = car_problem(std::make_shared<CarModel>(model));
        for (std::size_t i = 0; i < count; ++i)
            x[i] += problem.scale[i] * unit(random);
        x[distance] = 30.0 + 50.0 * std::abs(unit(random));
        if (trial % 5 == 0)
            x[forward_speed] = 0.3 * unit(random);
        std::vector<double> jacobian(count * count), dfdt(count), before(count), behind(count);
        car_jacobian(model, 0.3, x.data(), jacobian.data(), dfdt.data());
        for (std::size_t column = 0; column < count; ++column) {
            const double h = 1.0e-6 * problem.scale[column], kept = x[column];
            x[column] = kept + h;
            car_rates(model, 0.3, x.data(), behind.data());
            x[column] = kept - h;
            car_rates(model, 0.3, x.data(), before.data());
            x[column] = kept;
            for (std::size_t row = 0; row < count; ++row) {
                const double difference = (behind[row] - before[row]) / (2.0 * h);
                // Rounding of rates up to 1e6 over an increment of 1e-6 of the scale; curvature of the equations, h^2.
                const double rounding = 4e-16 * (std::abs(behind[row]) + 1e3) / h;
                EXPECT_NEAR(jacobian[row * count + column], difference, 1e-5 * std::abs(difference) + 4.0 * rounding + 1e-6)
                    << "row " << row << ", column " << column << ", trial " << trial;
            }
        }
        if (trial % 5 == 0)
            continue; // so slow that the driver pushes as hard as he does
        EXPECT_NEAR(dfdt[force], model.car.mass_kg * 2.0 * -2.0 / 0.1, 1e-6) << "the wish changes with time";
    }
}

TEST(CarModel, SteadyBrakingPitchesByTheLever) {
    // Quasi-static: the body turns by (1 - links) m a h / (springs), the tyres by m a h / (l^2 kt); docs/vehicle.md.
    CarModel model;
    const VehicleParameters& car = model.car;
    const double deceleration_mps2 = 4.0;
    const std::vector<SpeedSegment> wishes{{0.0, 50.0, 0.0}, {1.0, 50.0, -deceleration_mps2}};
    const CarRun run = run_car(model, wishes, 8.0);
    const CarPlace place = run.at(7.9);
    const double v = place.speed_mps, l = model.wheelbase_m;
    EXPECT_NEAR(v, 50.0 - 6.9 * deceleration_mps2, 0.2) << "the driver lags a little";
    const double ground_n = -car.mass_kg * deceleration_mps2 + 0.6 * car.drag_area_m2 * v * v; // the drag does its part of it
    const double moment_nm = ground_n * car.centre_of_gravity_height_m;
    const double springs = moment_nm * (1.0 - car.anti_pitch) / (l * l) * (1.0 / car.front.spring_n_per_m + 1.0 / car.rear.spring_n_per_m);
    const double tyres = moment_nm / (l * l) * (1.0 / car.front.tyre_spring_n_per_m + 1.0 / car.rear.tyre_spring_n_per_m);
    // The drag fades as the car slows, so the pitch lags a little: 1e-4 rad is a hundredth of it.
    EXPECT_NEAR(place.pitch_rad, springs + tyres, 1e-4);
    EXPECT_NEAR(place.spring_pitch_rad, springs, 1e-4);
    EXPECT_LT(place.pitch_rad, -0.009);
}

TEST(CarModel, SteadyCorneringTurnsByTheSelfSteeringGradient) {
    // w = v delta / (l + EG v^2), Rill 2011, ch. 8; the linear tyre, so a gentle bend.
    for (const double v : {5.0, 20.0, 40.0}) {
        auto model = standing();
        model->wish = {0.0, v, 0.0};
        model->held_steering_rad = 1.0e-4;
        model->car.drag_area_m2 = model->car.rolling_resistance = 0.0; // the front tyres' push would soften them sideways
        std::vector<double> x = steady_car(*model, 0.0);
        model->held_force_n = x[force];
        x = after(model, x, 20.0);
        const double l = model->wheelbase_m, m = model->car.mass_kg;
        const double gradient = m / (l * l) *
                                (model->rear_m() * l / model->car.front.cornering_stiffness_n_per_rad -
                                 model->front_m() * l / model->car.rear.cornering_stiffness_n_per_rad);
        // The tyre's force bends off by a third of its use of the grip, here up to 1 %.
        EXPECT_NEAR(x[yaw_rate] / (x[forward_speed] * 1.0e-4 / (l + gradient * x[forward_speed] * x[forward_speed])), 1.0, 0.012) << v;
    }
}

double energy_j(const CarModel& model, const std::vector<double>& x) {
    const VehicleParameters& car = model.car;
    const auto half = [](double k, double u) { return 0.5 * k * u * u; };
    return half(model.sprung_kg(), x[heave_rate]) + half(car.pitch_inertia_kgm2, x[pitch_rate]) +
           half(car.front.unsprung_mass_kg, x[front_wheel_rate]) + half(car.rear.unsprung_mass_kg, x[rear_wheel_rate]) +
           half(car.front.spring_n_per_m, x[front_body] - x[front_wheel]) + half(car.rear.spring_n_per_m, x[rear_body] - x[rear_wheel]) +
           half(car.front.tyre_spring_n_per_m, x[front_wheel]) + half(car.rear.tyre_spring_n_per_m, x[rear_wheel]);
}

std::vector<double> lifted(const CarModel& model) {
    std::vector<double> x = steady_car(model, 0.0);
    x[force] = 0.0;
    x[front_body] = 0.02;
    x[rear_body] = -0.01;
    return x;
}

TEST(CarModel, WithoutDampersTheSpringsKeepTheirEnergy) {
    auto model = standing();
    model->car.front.damper_ns_per_m = model->car.rear.damper_ns_per_m = 0.0;
    const std::vector<double> x = lifted(*model);
    const double before = energy_j(*model, x), after_10_s = energy_j(*model, after(model, x, 10.0, 1e-11));
    EXPECT_GT(before, 5.0);
    EXPECT_NEAR(after_10_s / before, 1.0, 1e-7); // 110 periods of the wheels at a tolerance of 1e-11
}

TEST(CarModel, DampersTakeExactlyTheirWork) {
    // d(energy)/dt = -sum of c u'^2, in quadrature along the path by the integrator itself: a 24th equation.
    auto model = standing();
    OdeProblem problem = car_problem(model), with_work = problem;
    with_work.scale.push_back(1.0);
    with_work.jacobian = nullptr;
    with_work.derivative = [&](double t_s, const double* x, double* dxdt) {
        problem.derivative(t_s, x, dxdt);
        const double front = x[heave_rate] + model->front_m() * x[pitch_rate] - x[front_wheel_rate];
        const double rear = x[heave_rate] - model->rear_m() * x[pitch_rate] - x[rear_wheel_rate];
        dxdt[count] = model->car.front.damper_ns_per_m * front * front + model->car.rear.damper_ns_per_m * rear * rear;
    };
    std::vector<double> x = lifted(*model);
    const double before = energy_j(*model, x);
    x.push_back(0.0);
    OdeIntegrator integrator(with_work, {.tolerance = 1e-10});
    integrator.integrate(0.0, 0.3, x);
    EXPECT_NEAR(energy_j(*model, x) + x[count], before, 1e-7 * before);
    EXPECT_GT(x[count], 0.3 * before);
}

TEST(CarModel, NaturalFrequenciesAreThoseOfACar) {
    // Zero crossings of the undamped body lie half a period apart; textbooks: body 1 to 1.5 Hz, wheels 10 to 14 Hz.
    const VehicleParameters car;
    const double front_kg = 0.55 * (car.mass_kg - 170.0);
    const double series = 1.0 / (1.0 / car.front.spring_n_per_m + 1.0 / car.front.tyre_spring_n_per_m);
    EXPECT_NEAR(std::sqrt(series / front_kg) / (2.0 * std::numbers::pi), 1.15, 0.1);
    EXPECT_NEAR(std::sqrt((car.front.spring_n_per_m + car.front.tyre_spring_n_per_m) / car.front.unsprung_mass_kg) /
                    (2.0 * std::numbers::pi),
                11.2, 0.2);
}

TEST(CarModel, CoastsDownByTheClosedForm) {
    // m' v' = -(f m g + c v^2) with the wheels' inertia in m': v = sqrt(A/B) tan(atan(v0 sqrt(B/A)) - t sqrt(A B)).
    auto model = standing();
    const VehicleParameters& car = model->car;
    model->wish = {0.0, 30.0, 0.0};
    std::vector<double> x = steady_car(*model, 0.0);
    x[force] = 0.0;
    x[front_stretch] = x[rear_stretch] = 0.0;
    x[front_spin] = x[rear_spin] = 30.0 / car.wheel_radius_m;
    x = after(model, x, 20.0);
    const double radius2 = car.wheel_radius_m * car.wheel_radius_m;
    const double inert_kg = car.mass_kg + (car.front.wheel_inertia_kgm2 + car.rear.wheel_inertia_kgm2) / radius2;
    const double a = car.rolling_resistance * car.mass_kg * 9.81 / inert_kg, b = 0.6 * car.drag_area_m2 / inert_kg;
    const double expected = std::sqrt(a / b) * std::tan(std::atan(30.0 * std::sqrt(b / a)) - 20.0 * std::sqrt(a * b));
    // The rolling tyres slip by their force over their stiffness: 1e-3 of the wheels' part, which is 3 % of the mass.
    EXPECT_NEAR(x[forward_speed], expected, 2e-3);
    EXPECT_NEAR(x[front_spin] * car.wheel_radius_m, x[forward_speed], 0.05);
}

TEST(CarModel, StandsOnASlopeButForTheBrakesCreep) {
    // Brakes of 2 m/s2 and rolling resistance hold m g s by turning at w, tanh(w / 0.02) = g s / (2 + f g): at 8 % that is 2.4 mm/s.
    CarModel model;
    model.road.slope.assign(400, 0.08);
    const double creep_mps = -model.car.wheel_radius_m * 0.02 * std::atanh(9.81 * 0.08 / (2.0 + model.car.rolling_resistance * 9.81));
    const CarRun standing = run_car(model, {{0.0, 0.0, 0.0}}, 60.0);
    EXPECT_NEAR(standing.at(60.0).speed_mps, creep_mps, 0.02 * -creep_mps); // the tyres' leaving behind is some per cent of it
    EXPECT_NEAR(standing.at(60.0).distance_m, 60.0 * creep_mps, 5e-3) << "and the tyres' stretch, 1.2 mm";
    const CarRun stopping = run_car(model, {{0.0, 10.0, 0.0}, {1.0, 10.0, -2.0}, {6.0, 0.0, 0.0}}, 12.0);
    EXPECT_NEAR(stopping.at(12.0).distance_m, 35.0, 1.0);
    EXPECT_NEAR(stopping.at(12.0).speed_mps, creep_mps, 0.02 * -creep_mps);
}

TEST(CarModel, StepsInTheRoadAreHitWithinTheTolerance) {
    // Where the body jumps against the road, an axle stands on an edge: within 1e-9 s of travel, whatever the tolerance of the steps.
    for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
        CarModel model;
        model.car.tolerance = tolerance;
        model.car.road_steps = {{20.0, 0.02}, {20.01, -0.03}, {31.7, 0.01}};
        const CarRun run = run_car(model, {{0.0, 25.0, 0.0}}, 2.0);
        std::vector<double> hits_m;
        for (std::size_t step = 0; step + 1 < run.path().steps(); ++step) {
            const double t_s = run.path().step_end_s(step);
            const CarPlace before = run.at(t_s - 1e-9), behind = run.at(t_s);
            if (std::abs(behind.rear_lift_m - before.rear_lift_m) > 5e-3) // rear axle
                hits_m.push_back(behind.distance_m);
            else if (std::abs(behind.pitch_rad - before.pitch_rad) > 5e-3 / model.wheelbase_m) // front axle
                hits_m.push_back(behind.distance_m + model.wheelbase_m);
        }
        ASSERT_EQ(hits_m.size(), 6U) << tolerance;
        const double edges_m[] = {20.0, 20.01, 20.0, 20.01, 31.7, 31.7};
        for (std::size_t i = 0; i < 6; ++i)
            EXPECT_NEAR(hits_m[i], edges_m[i], 25.0 * 1e-9 + 1e-12) << tolerance; // and some roundings of 20 m
    }
}

TEST(CarModel, From60MetresASecondToRestAndBack) {
    const std::vector<SpeedSegment> wishes{{0.0, 60.0, 0.0}, {1.0, 60.0, -7.5}, {9.0, 0.0, 0.0}, {12.0, 0.0, 3.0}, {32.0, 60.0, 0.0}};
    const auto run_by = [&](Solver solver) {
        CarModel model;
        model.car.solver = solver;
        return run_car(model, wishes, 34.0);
    };
    const CarRun run = run_by(Solver::automatic);
    EXPECT_NEAR(run.at(0.0).speed_mps, 60.0, 1e-12);
    EXPECT_NEAR(run.at(11.9).speed_mps, 0.0, 1e-5);
    // Stopped from 7.5 m/s2, the car springs back by what its tyres were stretched, m a / (2 k / length): 11 mm, and a little from the
    // other side.
    double furthest_m = 0.0;
    for (double t = 8.5; t < 11.9; t += 0.001)
        furthest_m = std::max(furthest_m, run.at(t).distance_m);
    EXPECT_NEAR(run.at(11.9).distance_m, furthest_m - 0.011, 0.011);
    EXPECT_NEAR(run.at(34.0).speed_mps, 60.0, 0.5);
    // Friction's 1 g, to which the air and the springing back add little, is all that a millisecond may change the speed by; and every
    // solver finds the same.
    const double dt = 1.0e-3;
    for (const Solver solver : {Solver::automatic, Solver::dormand_prince, Solver::rosenbrock}) {
        const CarRun by_solver = run_by(solver);
        CarPlace before = by_solver.at(0.0);
        for (int k = 1; k <= 34'000; ++k) {
            const CarPlace now = by_solver.at(k * dt);
            ASSERT_LT(std::abs(now.speed_mps - before.speed_mps), 1.1 * 9.81 * dt) << name(solver) << ' ' << k;
            ASSERT_LT(std::abs(now.pitch_rad - before.pitch_rad), 0.3 * dt) << name(solver) << ' ' << k;
            ASSERT_NEAR(now.pitch_rad, run.at(k * dt).pitch_rad, 1e-4) << name(solver) << ' ' << k;
            ASSERT_LT(std::abs(now.offset_left_m), 1e-9);
            before = now;
        }
    }
    EXPECT_GT(run.work().rosenbrock.steps, 0U) << "rest is stiff";
    EXPECT_GT(run.work().dormand_prince.steps, 0U) << "driving is not";
}

} // namespace
} // namespace fernlicht
