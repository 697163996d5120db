// Roll, roughness and loads of a car against closed forms and against the linear car's answer to each wave.
#include "scenarios/values/pose.h"
#include "scenarios/vehicle/car_run.h"

#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using namespace car_state;
using Complex = std::complex<double>;

/// The default car, by hand: (1500 * 0.55 - 170 * 0.31) / 1330 - 0.1 = 0.48068 m above the axis.
constexpr double sprung_kg = 1330.0, arm_m = 0.480677;

CarModel rolling_car() {
    CarModel model;
    model.car.roll = RollParameters{};
    return model;
}

/// Of the axle: springs over the track and bar, in series with the tyres.
double axle_roll_nm_per_rad(double spring_n_per_m, double bar_nm_per_rad) {
    return 1.0 / (1.0 / (spring_n_per_m * 1.5 * 1.5 / 4.0 + bar_nm_per_rad) + 1.0 / (400'000.0 * 1.5 * 1.5 / 4.0));
}

TEST(BodyRoll, LeansOutOfABendByMassTimesArmTimesAcceleration) {
    const double stiffness = axle_roll_nm_per_rad(41'600.0, 25'000.0) + axle_roll_nm_per_rad(43'000.0, 15'000.0);
    const double left_of_it = stiffness - sprung_kg * arm_m * 9.81;
    EXPECT_NEAR(rolling_car().roll().stiffness_nm_per_rad(), left_of_it, 1e-4 * left_of_it);
    EXPECT_NEAR(degrees(sprung_kg * arm_m * 9.81 / left_of_it), 5.4, 0.1) << "textbooks: 3 to 7 degrees at 1 g";
    for (const double bend_per_m : {0.01, -0.005}) {
        CarModel model = rolling_car();
        model.road.curvature_per_m.assign(2000, bend_per_m);
        const CarRun run = run_car(model, {{0.0, 20.0, 0.0}}, 20.0);
        const CarPlace place = run.at(20.0);
        const double to_the_left_mps2 = place.speed_mps * place.yaw_rate_rad_s;
        EXPECT_NEAR(place.yaw_rate_rad_s, 20.0 * bend_per_m, 2e-3);
        EXPECT_NEAR(place.roll_rad, sprung_kg * arm_m * to_the_left_mps2 / left_of_it, 2e-3 * std::abs(place.roll_rad));
        EXPECT_NEAR(run.at(0.0).roll_rad, place.roll_rad, 0.02 * std::abs(place.roll_rad)) << "it begins in balance";
        EXPECT_EQ(place.roll_axis_m, 0.1);
    }
}

TEST(BodyRoll, SwingsByTheClosedForm) {
    // I p'' + c p' + k p = 0 from rest at p0: exp(-d t) (cos w t + d/w sin w t) p0.
    auto model = std::make_shared<CarModel>(rolling_car());
    model->driven = false;
    const RollModel body = model->roll();
    EXPECT_NEAR(body.inertia_kgm2, 500.0 + sprung_kg * arm_m * arm_m, 1e-2);
    const double k = body.stiffness_nm_per_rad(), d = (body.front_nms_per_rad + body.rear_nms_per_rad) / (2.0 * body.inertia_kgm2);
    const double w = std::sqrt(k / body.inertia_kgm2 - d * d);
    EXPECT_NEAR(w / (2.0 * pi), 1.43, 0.02) << "Hz";
    EXPECT_NEAR(d / std::sqrt(k / body.inertia_kgm2), 0.17, 0.01) << "damping";
    std::vector<double> x = steady_car(*model, 0.0);
    ASSERT_EQ(x.size(), 25U);
    x[body_roll] = 0.03;
    const OdeProblem problem = car_problem(model);
    OdeIntegrator integrator(problem, {.tolerance = 1e-10});
    for (int i = 0; i < 20; ++i) {
        integrator.integrate(0.1 * i, 0.1 * (i + 1), x);
        const double t = 0.1 * (i + 1);
        EXPECT_NEAR(x[body_roll], 0.03 * std::exp(-d * t) * (std::cos(w * t) + d / w * std::sin(w * t)), 1e-9) << t;
    }
}

/// Half a car's answers to waves of 1 m under its tyres, from their impedances: {heave, pitch}, by Cramer's rule on what is left of it when
/// each axle is eliminated.
Complex pitch_by_wave(const CarModel& model, double rad_per_m, double speed_mps) {
    const VehicleParameters& car = model.car;
    const double w = rad_per_m * speed_mps, a = model.front_m(), b = model.rear_m();
    struct Leg {
        Complex stiffness, push;
    }; ///< of the body's corner; force of a wave of 1 m on it while it is held
    const auto leg = [&](const AxleParameters& axle) {
        const Complex spring = axle.spring_n_per_m + Complex(0.0, w) * axle.damper_ns_per_m;
        const Complex wheel = spring + axle.tyre_spring_n_per_m - w * w * axle.unsprung_mass_kg;
        return Leg{spring - spring * spring / wheel, spring * axle.tyre_spring_n_per_m / wheel};
    };
    const Leg front = leg(car.front), rear = leg(car.rear);
    const Complex ahead = std::polar(1.0, rad_per_m * model.wheelbase_m); // the front axle meets the wave first
    const Complex force = front.push * ahead + rear.push, moment = a * front.push * ahead - b * rear.push;
    const Complex heave = front.stiffness + rear.stiffness - w * w * model.sprung_kg();
    const Complex both = a * front.stiffness - b * rear.stiffness;
    const Complex pitch = a * a * front.stiffness + b * b * rear.stiffness - w * w * car.pitch_inertia_kgm2;
    return (heave * moment - both * force) / (heave * pitch - both * both);
}

struct Swing {
    double pitch_rad = 0.0, roll_rad = 0.0;
}; ///< standard deviations

Swing by_waves(const CarModel& model, double speed_mps) {
    const RoughRoad road(*model.car.roughness, model.car.roll->track_m, model.wheelbase_m);
    const RollModel body = model.roll();
    double pitch2 = 0.0, roll2 = 0.0;
    for (const RoughRoad::Wave& wave : road.waves()) {
        const double w = wave.rad_per_m * speed_mps;
        const auto axle = [&](double k, double c) { return k + Complex(0.0, w) * c; };
        const Complex front = axle(body.front_nm_per_rad, body.front_nms_per_rad), rear = axle(body.rear_nm_per_rad, body.rear_nms_per_rad);
        const Complex roll = (front * std::polar(1.0, wave.rad_per_m * model.wheelbase_m) + rear) /
                             (front + rear - gravity_mps2 * body.arm_kgm - w * w * body.inertia_kgm2);
        const auto half_square = [](double s, double c) { return 0.5 * (s * s + c * c); };
        pitch2 += half_square(wave.height_sine_m, wave.height_cosine_m) * std::norm(pitch_by_wave(model, wave.rad_per_m, speed_mps));
        roll2 += half_square(wave.tilt_sine_rad, wave.tilt_cosine_rad) * std::norm(roll);
    }
    return {std::sqrt(pitch2), std::sqrt(roll2)};
}

Swing by_run(const CarModel& model, double speed_mps, double end_s) {
    const CarRun run = run_car(model, {{0.0, speed_mps, 0.0}}, end_s);
    double n = 0.0, pitch = 0.0, pitch2 = 0.0, roll = 0.0, roll2 = 0.0;
    for (double t_s = 4.0; t_s < end_s; t_s += 0.013) {
        const CarPlace at = run.at(t_s);
        n += 1.0;
        pitch += at.pitch_rad;
        pitch2 += at.pitch_rad * at.pitch_rad;
        roll += at.roll_rad;
        roll2 += at.roll_rad * at.roll_rad;
    }
    return {std::sqrt(pitch2 / n - pitch * pitch / n / n), std::sqrt(roll2 / n - roll * roll / n / n)};
}

TEST(RoughDrive, MovesTheCutOffAsTheLinearCarAnswersTheWaves) {
    const double speed_mps = 100.0 / 3.6;
    for (const RoadClass road_class : {RoadClass::A, RoadClass::C}) {
        CarModel model = rolling_car();
        model.car.roughness = Roughness{road_class, 1};
        const Swing run = by_run(model, speed_mps, 124.0), waves = by_waves(model, speed_mps);
        std::string line =
            fmt::format("class {}: pitch {:.3f} degrees (waves {:.3f}), roll {:.3f} (waves {:.3f})", "ABC"[static_cast<int>(road_class)],
                        degrees(run.pitch_rad), degrees(waves.pitch_rad), degrees(run.roll_rad), degrees(waves.roll_rad));
        RecordProperty(std::string(1, "ABC"[static_cast<int>(road_class)]), line);
        SCOPED_TRACE(line);
        // Two minutes hold 150 swings of the body: the square of what is found scatters by 10 %.
        EXPECT_NEAR(run.pitch_rad / waves.pitch_rad, 1.0, 0.08);
        EXPECT_NEAR(run.roll_rad / waves.roll_rad, 1.0, 0.08);
        // By hand: below its own 1.2 Hz, in waves of more than 23 m, the body follows the road, whose slope then has a standard deviation
        // of 2 pi sqrt(G(n0) n0^2 (0.043 - 0.011)/m): 0.026 degrees on A. Resonance adds to it, the wheelbase takes from shorter waves.
        const double followed_rad = 2.0 * pi * 0.1 * std::sqrt(roughness_m3(road_class) * 0.032);
        EXPECT_GT(waves.pitch_rad, followed_rad);
        EXPECT_LT(waves.pitch_rad, 2.5 * followed_rad);
    }
}

TEST(RoughDrive, LeavesACarWithoutItAsItWas) {
    // Roll alone adds equations: the others' motion stays within the tolerance. A smooth road is none.
    const std::vector<SpeedSegment> wishes{{0.0, 20.0, 0.0}, {1.0, 20.0, -3.0}, {4.0, 11.0, 0.0}};
    CarModel plain, rolls = rolling_car();
    plain.car.tolerance = rolls.car.tolerance = 1e-9;
    const CarRun one = run_car(plain, wishes, 6.0), other = run_car(rolls, wishes, 6.0);
    for (double t_s = 0.0; t_s < 6.0; t_s += 0.1) {
        EXPECT_NEAR(one.at(t_s).pitch_rad, other.at(t_s).pitch_rad, 1e-8);
        EXPECT_EQ(one.at(t_s).roll_rad, 0.0);
        EXPECT_NEAR(other.at(t_s).roll_rad, 0.0, 1e-12) << "straight on nothing leans";
    }
}

TEST(LoadSteps, SinkTheBodyByTheirWeightOverTheStiffness) {
    CarModel model;
    model.car.load_steps = {{2.0, 0.0, 100.0}, {20.0, 50.0, -60.0}};
    const CarRun run = run_car(model, {{0.0, 0.0, 0.0}}, 40.0);
    EXPECT_EQ(run.at(1.999).pitch_rad, 0.0);
    const double rear_m = -100.0 * gravity_mps2 * (1.0 / 43'000.0 + 1.0 / 400'000.0);
    EXPECT_NEAR(run.at(19.9).rear_lift_m, rear_m, 1e-6);
    EXPECT_NEAR(run.at(19.9).pitch_rad, -rear_m / 2.7, 1e-6);
    EXPECT_NEAR(run.at(19.9).spring_pitch_rad, 100.0 * gravity_mps2 / 43'000.0 / 2.7, 1e-6) << "levelling sees the springs' part";
    EXPECT_NEAR(run.at(19.9).rear_load_n - run.at(1.0).rear_load_n, 100.0 * gravity_mps2, 0.1);
    EXPECT_NEAR(run.at(39.9).rear_lift_m, 0.4 * rear_m, 1e-6);
    EXPECT_NEAR(run.at(39.9).pitch_rad * 2.7, -50.0 * gravity_mps2 * (1.0 / 41'600.0 + 1.0 / 400'000.0) - 0.4 * rear_m, 2e-6);
    // A step ends exactly there.
    bool at_the_load = false;
    for (std::size_t step = 0; step < run.path().steps(); ++step)
        at_the_load |= run.path().step_end_s(step) == 20.0;
    EXPECT_TRUE(at_the_load);
}

TEST(BodyRoll, JacobianIsThatOfDifferences) {
    CarModel model = rolling_car();
    model.wish = {0.0, 20.0, 0.0};
    model.road.curvature_per_m.assign(400, 0.004);
    model.rough = RoughRoad({RoadClass::D, 2}, 1.5, 2.7);
    std::vector<double> x = steady_car(model, 50.0);
    x[body_roll_rate] = 0.02;
    x[front_body] = 0.004;
    const OdeProblem problem = car_problem(std::make_shared<CarModel>(model));
    std::vector<double> jacobian(count_with_roll * count_with_roll), dfdt(count_with_roll), before(count_with_roll),
        behind(count_with_roll);
    car_jacobian(model, 0.0, x.data(), jacobian.data(), dfdt.data());
    for (std::size_t column = 0; column < count_with_roll; ++column) {
        const double h = 1.0e-6 * problem.scale[column], kept = x[column];
        x[column] = kept + h;
        car_rates(model, 0.0, x.data(), behind.data());
        x[column] = kept - h;
        car_rates(model, 0.0, x.data(), before.data());
        x[column] = kept;
        for (const std::size_t row : {body_roll, body_roll_rate, front_body, rear_body, front_wheel, rear_wheel, heave_rate, pitch_rate}) {
            const double difference = (behind[row] - before[row]) / (2.0 * h);
            EXPECT_NEAR(jacobian[row * count_with_roll + column], difference, 1e-5 * std::abs(difference) + 1e-4) << row << ' ' << column;
        }
    }
}

} // namespace
} // namespace fernlicht
