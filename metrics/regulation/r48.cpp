#include "metrics/regulation/r48.h"

#include "scenarios/vehicle/car_model.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }
glm::dvec2 left_of(glm::dvec2 d) { return {-d.y, d.x}; }

/// Masses at places behind the front axle, one after the other.
struct Loading {
    double wheelbase_m;
    LoadState state;

    void put(double kg, double behind_front_m) {
        state.rear_kg += kg * behind_front_m / wheelbase_m;
        state.front_kg += kg * (1.0 - behind_front_m / wheelbase_m);
    }
    double added_kg() const { return state.front_kg + state.rear_kg; }
};

} // namespace

CarCapacity CarCapacity::usual(const VehicleParameters& car, double wheelbase_m) {
    const VehicleParameters middle_class;
    const CarCapacity known;
    constexpr double its_wheelbase_m = 2.7;
    const double longer = wheelbase_m / its_wheelbase_m, heavier = car.mass_kg / middle_class.mass_kg;
    CarCapacity capacity;
    capacity.front_seats_m = longer * known.front_seats_m;
    capacity.rear_seats_m = longer * known.rear_seats_m;
    capacity.boot_m = longer * known.boot_m;
    capacity.permissible_kg = heavier * known.permissible_kg;
    capacity.permissible_rear_axle_kg = heavier * known.permissible_rear_axle_kg;
    return capacity;
}

std::vector<LoadState> r48_load_states(const VehicleParameters& car, double wheelbase_m, const CarCapacity& capacity) {
    const double rear_at_rest_kg = car.mass_kg * (1.0 - car.front_load);
    const auto fill_boot = [&](Loading& loading) {
        const double by_axle_kg =
            (capacity.permissible_rear_axle_kg - rear_at_rest_kg - loading.state.rear_kg) * wheelbase_m / capacity.boot_m;
        const double by_mass_kg = capacity.permissible_kg - car.mass_kg - loading.added_kg();
        loading.put(std::max(0.0, std::min(by_axle_kg, by_mass_kg)), capacity.boot_m);
    };
    Loading one{wheelbase_m, {.name = "driver"}};
    Loading two = one;
    two.state.name = "driver and front passenger";
    two.put(capacity.person_kg, capacity.front_seats_m);
    Loading all = two;
    all.state.name = "all seats";
    all.put(capacity.person_kg * capacity.rear_seats, capacity.rear_seats_m);
    Loading full = all;
    full.state.name = "all seats and the boot";
    fill_boot(full);
    Loading boot = one;
    boot.state.name = "driver and the boot";
    fill_boot(boot);
    return {one.state, two.state, all.state, full.state, boot.state};
}

LoadedBody loaded_body(const VehicleParameters& car, double wheelbase_m, const std::optional<LevellingParameters>& levelling,
                       const LoadState& load) {
    const double front_n = gravity_mps2 * load.front_kg, rear_n = gravity_mps2 * load.rear_kg;
    const double in_springs_rad = (rear_n / car.rear.spring_n_per_m - front_n / car.front.spring_n_per_m) / wheelbase_m;
    const double in_tyres_rad = (rear_n / car.rear.tyre_spring_n_per_m - front_n / car.front.tyre_spring_n_per_m) / wheelbase_m;
    LoadedBody body{.pitch_rad = in_springs_rad + in_tyres_rad};
    if (levelling) {
        body.levelling_rad = std::clamp(0.0 - in_springs_rad, levelling->actuator.min_rad, levelling->actuator.max_rad);
        body.at_stop = body.levelling_rad != -in_springs_rad;
    }
    return body;
}

std::optional<CarCircle> circle_through(glm::dvec2 before_m, glm::dvec2 at_m, glm::dvec2 after_m) {
    const glm::dvec2 in = at_m - before_m, out = after_m - at_m;
    const double a = glm::length(in), b = glm::length(out), c = glm::length(in + out);
    if (!(a > 0.0 && b > 0.0 && c > 0.0))
        return std::nullopt;
    CarCircle circle{.centre_of_gravity_m = at_m, .curvature_per_m = 2.0 * cross(in, out) / (a * b * c)};
    // The tangent is off the chord before it by half that chord's arc.
    const double half = std::asin(std::clamp(0.5 * a * circle.curvature_per_m, -1.0, 1.0));
    const glm::dvec2 along = in / a;
    circle.forward = along * std::cos(half) + left_of(along) * std::sin(half);
    return circle;
}

std::optional<glm::dvec2> last_crossing_m(const CarCircle& circle, glm::dvec2 from_m, glm::dvec2 towards) {
    const double k = circle.curvature_per_m;
    if (std::abs(k) < straight_per_m)
        return std::nullopt;
    const glm::dvec2 d = glm::normalize(towards), begin = from_m - circle.centre_of_gravity_m, left = left_of(circle.forward);
    // |begin + s d - left / k|^2 = 1 / k^2, times k
    const double half_b = k * glm::dot(d, begin) - glm::dot(d, left), c = k * glm::dot(begin, begin) - 2.0 * glm::dot(begin, left);
    const double root = half_b * half_b - k * c;
    if (root < 0.0)
        return std::nullopt;
    const double s = std::max((-half_b + std::sqrt(root)) / k, (-half_b - std::sqrt(root)) / k);
    if (!(s > 0.0))
        return std::nullopt;
    return from_m + s * d;
}

} // namespace fernlicht
