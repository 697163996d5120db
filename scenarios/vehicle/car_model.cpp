#include "scenarios/vehicle/car_model.h"

#include "scenarios/vehicle/dual.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

using namespace car_state;

constexpr double air_kg_per_m3 = 1.2;
constexpr double standing_rad_s = 0.02;  ///< brakes and rolling resistance turn from holding to sliding over this spin: 6 mm/s of the tyre
constexpr double tyre_damping_s = 0.008; ///< of the contact's stretch: about a tenth of the critical damping of a car held by its tyres
constexpr double min_load_n = 10.0;      ///< of an axle in the air, so that nothing is divided by 0

// The driver: reacts and acts with a lag, brakes a little harder when too fast, holds with a fifth of g. Looks 5 m and 1 s ahead.
constexpr double pedal_lag_s = 0.1, steering_lag_s = 0.1;
constexpr double speed_gain_per_s = 2.0, persistence_per_s2 = 0.4, holding_mps2 = 2.0;
constexpr double strongest_push_g = 0.6, strongest_brake_of_friction = 0.95;
constexpr double look_m = 5.0, look_s = 1.0;

template <class Real> Real on_course(const std::vector<double>& table, const Real& distance_m) {
    double derivative = 0.0;
    const double value = RoadCourse::at(table, value_of(distance_m), derivative);
    return chained(distance_m, value, derivative);
}

/// What an axle feels of the road's roughness.
template <class Real> struct Unevenness { Real slope{0.0}, tilt_rad{0.0}, tilt_rate_rad_s{0.0}; };

template <class Real> Unevenness<Real> unevenness(const RoughRoad& rough, const Real& distance_m, const Real& along_mps) {
    if (rough.empty())
        return {};
    const RoughPlace at = rough.at(value_of(distance_m));
    return {chained(distance_m, at.slope, at.bend_per_m), chained(distance_m, at.tilt_rad, at.tilt_slope_rad_per_m),
            chained(distance_m, at.tilt_slope_rad_per_m, at.tilt_bend_rad_per_m2) * along_mps};
}

template <class Real> struct Contact {
    Real stretch_rate, sway_rate; ///< m/s
    Real along_n, across_n;       ///< on the car, in the wheel's directions
};

/// Bernard & Clover 1995: the contact's stretch u moves with the slip speed and is left behind by rolling, u' = -v_s - |v| u / length: at
/// v = 0 a spring, at speed the usual slip. The force grows as the brush model's with one friction for both directions (Pacejka 2012, 3.2).
template <class Real> Contact<Real> contact(const AxleParameters& axle, const VehicleParameters& car, const Real& load_n,
                                            const Real& rolling_mps, const Real& slip_along_mps, const Real& slip_across_mps,
                                            const Real& stretch_m, const Real& sway_m) {
    Contact<Real> c;
    const Real left_behind = magnitude(rolling_mps) / car.relaxation_length_m;
    c.stretch_rate = -slip_along_mps - left_behind * stretch_m;
    c.sway_rate = -slip_across_mps - left_behind * sway_m;
    const double along = axle.slip_stiffness_n / car.relaxation_length_m,
                 across = axle.cornering_stiffness_n_per_rad / car.relaxation_length_m;
    const Real grip_n = car.friction * load_n;
    const Real x = along * (stretch_m + tyre_damping_s * c.stretch_rate) / grip_n;
    const Real y = across * (sway_m + tyre_damping_s * c.sway_rate) / grip_n;
    const Real use = square_root(x * x + y * y + 1.0e-12);
    const Real weakening = value_of(use) < 3.0 ? 1.0 - use / 3.0 + use * use / 27.0 : 1.0 / use;
    c.along_n = grip_n * weakening * x;
    c.across_n = grip_n * weakening * y;
    return c;
}

template <class Real> struct Controls { Real force_rate, persistence_rate, steering_rate; };

template <class Real> Controls<Real> driver(const CarModel& model, const Real& t_s, const Real* x, const Real& offset_rate_mps) {
    const VehicleParameters& car = model.car;
    Controls<Real> hands;
    if (!model.driven) {
        hands.force_rate = (model.held_force_n - x[force]) / pedal_lag_s;
        hands.persistence_rate = Real(0.0);
        hands.steering_rate = (model.held_steering_rad - x[steering]) / steering_lag_s;
        return hands;
    }
    const Real wished_mps = model.wish.speed_mps + model.wish.acceleration_mps2 * (t_s - model.wish.start_s);
    const Real late_mps = wished_mps - x[forward_speed];
    Real asked_n = car.mass_kg * (model.wish.acceleration_mps2 + speed_gain_per_s * late_mps) + x[persistence];
    hands.persistence_rate = persistence_per_s2 * car.mass_kg * late_mps;
    if (model.wish.holds()) {
        asked_n = Real(-car.mass_kg * holding_mps2);
        hands.persistence_rate = -x[persistence] / 0.5;
    }
    const double weight_n = car.mass_kg * gravity_mps2;
    asked_n = at_most(at_least(asked_n, -strongest_brake_of_friction * car.friction * weight_n), strongest_push_g * weight_n);
    hands.force_rate = (asked_n - x[force]) / pedal_lag_s;

    const Real& v = x[forward_speed];
    const Real look = look_m + look_s * magnitude(v);
    const Real offset_ahead_m = x[offset] + look * offset_rate_mps / square_root(v * v + 1.0);
    const Real ahead_m = x[distance] + steering_lag_s * v;
    const Real bend_per_m = on_course(model.road.curvature_per_m, ahead_m) - 2.0 * offset_ahead_m / (look * look);
    const Real asked_rad = (model.wheelbase_m + model.self_steering_gradient() * v * v) * bend_per_m;
    hands.steering_rate = (at_most(at_least(asked_rad, -0.6), 0.6) - x[steering]) / steering_lag_s;
    return hands;
}

template <bool rolls, class Real> void rates(const CarModel& model, const Real& t_s, const Real* x, Real* out) {
    const VehicleParameters& car = model.car;
    const double a = model.front_m(), b = model.rear_m(), l = model.wheelbase_m, m = car.mass_kg, radius = car.wheel_radius_m;
    const Real &v = x[forward_speed], &w = x[yaw_rate];
    const Real c = cosine(x[steering]), s = sine(x[steering]);

    // Where: the rear axle's place in the lane's own coordinates.
    const Real rear_side_mps = x[side_speed] - b * w;
    const Real bend = on_course(model.road.curvature_per_m, x[distance]);
    const Real along = (v * cosine(x[heading]) - rear_side_mps * sine(x[heading])) / at_least(1.0 - x[offset] * bend, 0.1);
    out[distance] = along;
    out[offset] = v * sine(x[heading]) + rear_side_mps * cosine(x[heading]);
    out[heading] = w - bend * along;

    // Up and down: springs, dampers and tyres, each by its change from the rest.
    const Real front_slope = on_course(model.road.slope, x[distance] + l), rear_slope = on_course(model.road.slope, x[distance]);
    const Real front_body_rate = x[heave_rate] + a * x[pitch_rate], rear_body_rate = x[heave_rate] - b * x[pitch_rate];
    const Unevenness<Real> under_front = unevenness(model.rough, x[distance] + l, along),
                           under_rear = unevenness(model.rough, x[distance], along);
    const Real front_rise = front_slope + under_front.slope, rear_rise = rear_slope + under_rear.slope;
    out[front_body] = front_body_rate - front_rise * along;
    out[rear_body] = rear_body_rate - rear_rise * along;
    out[front_wheel] = x[front_wheel_rate] - front_rise * along;
    out[rear_wheel] = x[rear_wheel_rate] - rear_rise * along;
    const Real front_spring_n =
        -car.front.spring_n_per_m * (x[front_body] - x[front_wheel]) - car.front.damper_ns_per_m * (front_body_rate - x[front_wheel_rate]);
    const Real rear_spring_n =
        -car.rear.spring_n_per_m * (x[rear_body] - x[rear_wheel]) - car.rear.damper_ns_per_m * (rear_body_rate - x[rear_wheel_rate]);
    const double front_rest_n = m * gravity_mps2 * b / l, rear_rest_n = m * gravity_mps2 * a / l;
    const Real front_load_n = at_least(front_rest_n - car.front.tyre_spring_n_per_m * x[front_wheel], 0.0);
    const Real rear_load_n = at_least(rear_rest_n - car.rear.tyre_spring_n_per_m * x[rear_wheel], 0.0);

    // Along and across: the tyres' contacts.
    const Real front_side_mps = x[side_speed] + a * w;
    const Real front_rolling = v * c + front_side_mps * s;
    const Contact<Real> front =
        contact(car.front, car, at_least(front_load_n, min_load_n), front_rolling, front_rolling - radius * x[front_spin],
                front_side_mps * c - v * s, x[front_stretch], x[front_sway]);
    const Contact<Real> rear = contact(car.rear, car, at_least(rear_load_n, min_load_n), v, v - radius * x[rear_spin], rear_side_mps,
                                       x[rear_stretch], x[rear_sway]);
    out[front_stretch] = front.stretch_rate;
    out[front_sway] = front.sway_rate;
    out[rear_stretch] = rear.stretch_rate;
    out[rear_sway] = rear.sway_rate;

    const Real push_nm = at_least(x[force], 0.0) * radius, brake_nm = at_least(-x[force], 0.0) * radius;
    const Real front_hold_nm = car.brake_balance * brake_nm + car.rolling_resistance * radius * front_load_n;
    const Real rear_hold_nm = (1.0 - car.brake_balance) * brake_nm + car.rolling_resistance * radius * rear_load_n;
    out[front_spin] = (push_nm - front_hold_nm * hyperbolic_tangent(x[front_spin] / standing_rad_s) - radius * front.along_n) /
                      car.front.wheel_inertia_kgm2;
    out[rear_spin] =
        (-rear_hold_nm * hyperbolic_tangent(x[rear_spin] / standing_rad_s) - radius * rear.along_n) / car.rear.wheel_inertia_kgm2;

    const Real front_forward_n = front.along_n * c - front.across_n * s, front_left_n = front.along_n * s + front.across_n * c;
    const Real slope = (b * front_slope + a * rear_slope) / l;
    const Real drag_n = 0.5 * air_kg_per_m3 * car.drag_area_m2 * v * magnitude(v);
    const Real ground_n = front_forward_n + rear.along_n;
    out[forward_speed] = (ground_n - drag_n - m * gravity_mps2 * slope) / m + x[side_speed] * w;
    out[side_speed] = (front_left_n + rear.across_n) / m - v * w;
    out[yaw_rate] = (a * front_left_n - b * rear.across_n) / car.yaw_inertia_kgm2;

    // The forces on the ground pitch the body; links take their part of it straight to the wheels.
    const Real pitching_nm = ground_n * car.centre_of_gravity_height_m;
    const Real link_n = -car.anti_pitch * pitching_nm / l;
    const Real front_lift_n = front_spring_n - model.front_added_n, rear_lift_n = rear_spring_n - model.rear_added_n;
    out[heave_rate] = (front_lift_n + rear_lift_n) / model.sprung_kg();
    out[pitch_rate] = (a * front_lift_n - b * rear_lift_n + (1.0 - car.anti_pitch) * pitching_nm) / car.pitch_inertia_kgm2;
    out[front_wheel_rate] = (front_load_n - front_rest_n - front_spring_n - link_n) / car.front.unsprung_mass_kg;
    out[rear_wheel_rate] = (rear_load_n - rear_rest_n - rear_spring_n + link_n) / car.rear.unsprung_mass_kg;

    if constexpr (rolls) {
        const RollModel body = model.roll();
        const Real to_the_left_mps2 = (front_left_n + rear.across_n) / m;
        out[body_roll] = x[body_roll_rate];
        out[body_roll_rate] =
            (body.arm_kgm * (to_the_left_mps2 + gravity_mps2 * x[body_roll]) -
             body.front_nm_per_rad * (x[body_roll] - under_front.tilt_rad) - body.rear_nm_per_rad * (x[body_roll] - under_rear.tilt_rad) -
             body.front_nms_per_rad * (x[body_roll_rate] - under_front.tilt_rate_rad_s) -
             body.rear_nms_per_rad * (x[body_roll_rate] - under_rear.tilt_rate_rad_s)) /
            body.inertia_kgm2;
    }

    const Controls<Real> hands = driver(model, t_s, x, out[offset]);
    out[force] = hands.force_rate;
    out[persistence] = hands.persistence_rate;
    out[steering] = hands.steering_rate;
}

template <std::size_t states> void jacobian_by_duals(const CarModel& model, double t_s, const double* x, double* jacobian, double* dfdt) {
    using Number = Dual<states + 1>;
    std::array<Number, states> at, out;
    for (std::size_t i = 0; i < states; ++i)
        at[i] = Number::variable(x[i], i);
    rates<(states > count)>(model, Number::variable(t_s, states), at.data(), out.data());
    for (std::size_t row = 0; row < states; ++row) {
        std::copy_n(out[row].slope.begin(), states, jacobian + row * states);
        dfdt[row] = out[row].slope[states];
    }
}

} // namespace

double RollModel::stiffness_nm_per_rad() const { return front_nm_per_rad + rear_nm_per_rad - gravity_mps2 * arm_kgm; }

RollModel CarModel::roll() const {
    const double lever_m2 = 0.25 * car.roll->track_m * car.roll->track_m; // of two wheels: half the stiffness, at half the track, each
    const double unsprung_kg = car.mass_kg - sprung_kg();
    const double sprung_height_m = (car.mass_kg * car.centre_of_gravity_height_m - unsprung_kg * car.wheel_radius_m) / sprung_kg();
    const double arm_m = sprung_height_m - car.roll->axis_height_m;
    RollModel body{car.roll->inertia_kgm2 + sprung_kg() * arm_m * arm_m, sprung_kg() * arm_m, 0.0, 0.0, 0.0, 0.0};
    const auto in_series = [&](const AxleParameters& axle, double bar_nm_per_rad, double& stiffness, double& damping) {
        const double springs = axle.spring_n_per_m * lever_m2 + bar_nm_per_rad, tyres = axle.tyre_spring_n_per_m * lever_m2;
        const double part = tyres / (springs + tyres); // of the roll that lies in the springs
        stiffness = springs * part;
        damping = axle.damper_ns_per_m * lever_m2 * part * part;
    };
    in_series(car.front, car.roll->front_bar_nm_per_rad, body.front_nm_per_rad, body.front_nms_per_rad);
    in_series(car.rear, car.roll->rear_bar_nm_per_rad, body.rear_nm_per_rad, body.rear_nms_per_rad);
    return body;
}

double CarModel::self_steering_gradient() const {
    return car.mass_kg / wheelbase_m *
           (rear_m() / car.front.cornering_stiffness_n_per_rad - front_m() / car.rear.cornering_stiffness_n_per_rad);
}

void car_rates(const CarModel& model, double t_s, const double* x, double* dxdt) {
    model.car.roll ? rates<true>(model, t_s, x, dxdt) : rates<false>(model, t_s, x, dxdt);
}

void car_jacobian(const CarModel& model, double t_s, const double* x, double* jacobian, double* dfdt) {
    model.car.roll ? jacobian_by_duals<count_with_roll>(model, t_s, x, jacobian, dfdt)
                   : jacobian_by_duals<count>(model, t_s, x, jacobian, dfdt);
}

std::vector<double> steady_car(const CarModel& model, double distance_m) {
    const VehicleParameters& car = model.car;
    const double a = model.front_m(), b = model.rear_m(), l = model.wheelbase_m, m = car.mass_kg;
    const double v = model.wish.speed_mps, length_m = car.relaxation_length_m;
    std::vector<double> x(model.states(), 0.0);
    x[distance] = distance_m;
    x[forward_speed] = v;
    double unused = 0.0;
    const double front_slope = RoadCourse::at(model.road.slope, distance_m + l, unused);
    const double rear_slope = RoadCourse::at(model.road.slope, distance_m, unused);
    if (model.wish.holds()) {
        x[force] = -m * holding_mps2;
        return x;
    }
    // Along: the wheels drive against drag, slope and the wished acceleration; rolling resistance stays between engine and wheel.
    const double ground_n = 0.5 * air_kg_per_m3 * car.drag_area_m2 * v * v + m * gravity_mps2 * (b * front_slope + a * rear_slope) / l +
                            m * model.wish.acceleration_mps2;
    const double rear_n = v > 0.0 ? -car.rolling_resistance * m * gravity_mps2 * a / l : 0.0;
    x[force] = ground_n - rear_n + (v > 0.0 ? car.rolling_resistance * m * gravity_mps2 * b / l : 0.0);
    x[persistence] = x[force] - m * model.wish.acceleration_mps2;
    x[front_stretch] = (ground_n - rear_n) * length_m / car.front.slip_stiffness_n;
    x[rear_stretch] = rear_n * length_m / car.rear.slip_stiffness_n;
    x[front_spin] = v * (1.0 + x[front_stretch] / length_m) / car.wheel_radius_m;
    x[rear_spin] = v * (1.0 + x[rear_stretch] / length_m) / car.wheel_radius_m;
    // Across: the bend's side forces, by the linear tyre.
    const double bend = RoadCourse::at(model.road.curvature_per_m, distance_m, unused);
    const double front_side_n = m * v * v * bend * b / l, rear_side_n = m * v * v * bend * a / l;
    x[yaw_rate] = v * bend;
    x[front_sway] = front_side_n * length_m / car.front.cornering_stiffness_n_per_rad;
    x[rear_sway] = rear_side_n * length_m / car.rear.cornering_stiffness_n_per_rad;
    x[heading] = rear_side_n / car.rear.cornering_stiffness_n_per_rad;
    x[side_speed] = -v * x[heading] + b * x[yaw_rate];
    x[steering] = (l + model.self_steering_gradient() * v * v) * bend;
    if (car.roll)
        x[body_roll] = model.roll().arm_kgm * v * v * bend / model.roll().stiffness_nm_per_rad();
    // Up: on the slope, pitched by the forces.
    const double pitching_nm = ground_n * car.centre_of_gravity_height_m;
    x[front_wheel] = pitching_nm / (l * car.front.tyre_spring_n_per_m);
    x[rear_wheel] = -pitching_nm / (l * car.rear.tyre_spring_n_per_m);
    x[front_body] = x[front_wheel] + (1.0 - car.anti_pitch) * pitching_nm / (l * car.front.spring_n_per_m);
    x[rear_body] = x[rear_wheel] - (1.0 - car.anti_pitch) * pitching_nm / (l * car.rear.spring_n_per_m);
    x[front_wheel_rate] = front_slope * v;
    x[rear_wheel_rate] = rear_slope * v;
    x[pitch_rate] = (front_slope - rear_slope) * v / l;
    x[heave_rate] = rear_slope * v + b * x[pitch_rate];
    return x;
}

OdeProblem car_problem(const std::shared_ptr<const CarModel>& model) {
    OdeProblem problem;
    problem.derivative = [model](double t_s, const double* x, double* dxdt) { car_rates(*model, t_s, x, dxdt); };
    problem.jacobian = [model](double t_s, const double* x, double* jacobian, double* dfdt) {
        car_jacobian(*model, t_s, x, jacobian, dfdt);
    };
    problem.scale.assign(model->states(), 1.0);
    // What counts as one: 1 m along, 0.1 m across, 1 m/s, 1 cm in springs and tyres, 1 mm in contacts.
    static constexpr std::pair<std::size_t, double> scales[] = {
        {offset, 0.1},      {heading, 0.01},       {yaw_rate, 0.1},    {front_stretch, 1e-3},   {rear_stretch, 1e-3},
        {front_sway, 1e-3}, {rear_sway, 1e-3},     {front_body, 0.01}, {rear_body, 0.01},       {front_wheel, 0.01},
        {rear_wheel, 0.01}, {heave_rate, 0.1},     {pitch_rate, 0.1},  {front_wheel_rate, 0.1}, {rear_wheel_rate, 0.1},
        {force, 1000.0},    {persistence, 1000.0}, {steering, 0.01}};
    for (const auto& [component, scale] : scales)
        problem.scale[component] = scale;
    if (model->car.roll) {
        problem.scale[body_roll] = 0.01;
        problem.scale[body_roll_rate] = 0.1;
    }
    return problem;
}

double RoadCourse::at(const std::vector<double>& table, double distance_m, double& derivative) {
    derivative = 0.0;
    if (table.empty())
        return 0.0;
    const double place = distance_m / cell_m + 1.0; // knot 0 lies at -1 cells
    const double last = static_cast<double>(table.size() - 1);
    if (!(place > 1.0) || place >= last - 1.0)
        return place > 1.0 ? table.back() : table.front();
    const auto knot = static_cast<std::size_t>(place);
    const double u = place - static_cast<double>(knot), v = 1.0 - u;
    const double* c = &table[knot - 1];
    derivative = (-0.5 * v * v * c[0] + (1.5 * u * u - 2.0 * u) * c[1] + (-1.5 * u * u + u + 0.5) * c[2] + 0.5 * u * u * c[3]) / cell_m;
    return (v * v * v * c[0] + (3.0 * u * u * u - 6.0 * u * u + 4.0) * c[1] + (3.0 * v * v * v - 6.0 * v * v + 4.0) * c[2] +
            u * u * u * c[3]) /
           6.0;
}

RoadCourse road_course(const Route& route, double length_m) {
    RoadCourse course;
    const double used_m = std::min(length_m, route.length_m());
    const auto cells = static_cast<std::size_t>(std::ceil(used_m / RoadCourse::cell_m));
    const auto heading = [](const Pose& pose) { return std::atan2(pose.forward().y, pose.forward().x); };
    Pose before = route.pose(0.0);
    double before_m = 0.0;
    course.slope.push_back(before.forward().z);
    course.curvature_per_m.push_back(0.0);
    for (std::size_t k = 0; k <= cells; ++k) {
        const double end_m = std::min((static_cast<double>(k) + 0.5) * RoadCourse::cell_m, route.length_m());
        const Pose pose = route.pose(end_m);
        const double length = end_m - before_m;
        if (!(length > 1.0e-6)) {
            course.slope.push_back(course.slope.back());
            course.curvature_per_m.push_back(0.0);
            continue;
        }
        course.slope.push_back((pose.position_m.z - before.position_m.z) / length);
        course.curvature_per_m.push_back(std::remainder(heading(pose) - heading(before), 2.0 * pi) / length);
        before = pose;
        before_m = end_m;
    }
    course.slope.front() = course.slope[1];
    course.curvature_per_m.front() = course.curvature_per_m[1];
    for (int beyond = 0; beyond < 3; ++beyond) {
        course.slope.push_back(course.slope.back());
        course.curvature_per_m.push_back(used_m < route.length_m() ? course.curvature_per_m.back() : 0.0);
    }
    return course;
}

} // namespace fernlicht
