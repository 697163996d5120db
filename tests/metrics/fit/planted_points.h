// Lux points of a car whose lamps are shifted by known amounts.
#pragma once

#include "metrics/fit/lamp_fit.h"
#include "scenarios/lamps/lamp_file.h"

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace fernlicht::tests {

/// Standard normal, the same on every machine (Box and Muller 1958).
inline double normal(std::mt19937_64& random) {
    const auto unit = [&] { return (static_cast<double>(random() >> 11) + 0.5) / 9007199254740992.0; };
    const double radius = std::sqrt(-2.0 * std::log(unit()));
    return radius * std::cos(2.0 * pi * unit());
}

/// Our halogen low beams, 1.2 m apart and 0.65 m up, as the drives have them.
inline CarAtReading two_lamps() {
    static const auto file =
        std::make_shared<const LampFile>(read_lamp(FERNLICHT_SOURCE_DIR "/scenarios/library/lamps/halogen-low.ies"));
    CarAtReading car;
    for (const auto& [name, left_m] : {std::pair("left", 0.6), std::pair("right", -0.6)}) {
        MountedLamp& lamp = car.lamps.emplace_back();
        lamp.name = name;
        lamp.file = file;
        lamp.position_m = {3.4, left_m, 0.65};
    }
    return car;
}

/// Where our halogen beam ends at `h_deg`: level at 0.57 degrees below the horizon, rising by 15 degrees right of V-V.
inline double cut_off_deg(double h_deg) { return -0.57 + std::max(h_deg, 0.0) * std::tan(radians(15.0)); }

/// A luxmeter that looks back along the car, `ahead_m` from the lamps, where H and V of a lamp in the car's middle at nominal height and
/// aim would be these.
inline LuxPoint point_at(double ahead_m, double h_deg, double v_deg, std::vector<std::size_t> lamps = {0, 1}) {
    LuxPoint point;
    const double right_m = ahead_m * std::tan(radians(h_deg));
    point.place_m = {3.4 + ahead_m, -right_m, 0.65 + std::hypot(ahead_m, right_m) * std::tan(radians(v_deg))};
    point.normal = glm::dvec3(-1.0, 0.0, 0.0);
    point.lamps = std::move(lamps);
    point.relative = 0.03;
    return point;
}

/// 80 points at each distance: a third within 0.4 degrees of the cut-off, the others below it; half with both lamps lit, a quarter with
/// each alone.
inline std::vector<LuxPoint> planned_points(const std::vector<double>& distances_m) {
    std::vector<LuxPoint> points;
    for (const double ahead_m : distances_m)
        for (int i = 0; i < 80; ++i) {
            const double h_deg = -8.0 + 16.0 * ((i * 37) % 80) / 79.0;
            const bool across = i % 3 == 0;
            const double v_deg = across ? cut_off_deg(h_deg) - 0.4 + 0.8 * ((i * 7) % 27) / 26.0 : -0.9 - 2.5 * ((i * 11) % 53) / 52.0;
            const int lit = (i / 3) % 4;
            points.push_back(point_at(ahead_m, h_deg, v_deg, lit < 2 ? std::vector<std::size_t>{0, 1} : std::vector<std::size_t>{lit == 2 ? 0U : 1U}));
        }
    return points;
}

/// Misaimed the other way each, one dim and one bright, one raised and one sunk.
inline Shifts planted_shifts() {
    return {{radians(0.31), radians(-0.62), std::log(0.91), 0.013}, {radians(-0.44), radians(0.85), std::log(1.08), -0.008}};
}

/// What is read with these shifts, with normal noise of each point's own uncertainty.
inline void read_points(const CarAtReading& car, const Shifts& shifts, std::vector<LuxPoint>& points, std::mt19937_64* random) {
    const std::vector<CarAtReading> cars{car};
    for (LuxPoint& point : points)
        point.lux = 1.0; // so that there is an uncertainty
    const std::vector<double> lux = FitModel(cars, points).lux(shifts);
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i].lux = std::max(
            random ? lux[i] + normal(*random) * std::hypot(points[i].relative * lux[i], points[i].absolute_lx) : lux[i], 0.0);
}

/// A fitted value; the test fails without it.
inline const FittedValue& value_of(const LampFit& fit, const std::string& lamp, FitQuantity quantity) {
    for (const FittedValue& value : fit.values)
        if (value.lamp == lamp && value.quantity == quantity)
            return value;
    throw std::runtime_error("no such value");
}

} // namespace fernlicht::tests
