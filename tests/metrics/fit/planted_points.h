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
    static const auto file = std::make_shared<const LampFile>(read_lamp(FERNLICHT_SOURCE_DIR "/scenarios/library/lamps/halogen-low.ies"));
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

/// Misaimed the other way each, one dim and one bright, one raised and one sunk.
inline Shifts planted_shifts() {
    return {{radians(0.31), radians(-0.62), std::log(0.91), 0.013}, {radians(-0.44), radians(0.85), std::log(1.08), -0.008}};
}

/// A luxmeter that looks back along the car, `ahead_m` from the lamps, where H and V of a lamp at the car's middle, or `left_m` beside it,
/// at nominal height and aim would be these.
inline LuxPoint point_at(double ahead_m, double h_deg, double v_deg, std::vector<std::size_t> lamps = {0, 1}, double left_m = 0.0) {
    LuxPoint point;
    const double right_m = ahead_m * std::tan(radians(h_deg));
    point.place_m = {3.4 + ahead_m, left_m - right_m, 0.65 + std::hypot(ahead_m, right_m) * std::tan(radians(v_deg))};
    point.normal = glm::dvec3(-1.0, 0.0, 0.0);
    point.lamps = std::move(lamps);
    point.relative = 0.03;
    return point;
}

/// 80 points at each distance. Every third lies across the cut-off of one lamp that shines alone, within 0.2 degrees of where an eye sees
/// it (planted_shifts(), to a tenth of a degree), half on the level part and half on the rise. The others lie below, two fifths of them
/// with each lamp alone, a fifth with both.
inline std::vector<LuxPoint> planned_points(const std::vector<double>& distances_m) {
    std::vector<LuxPoint> points;
    const auto seen_deg = [](double rad) { return 0.1 * std::round(10.0 * degrees(rad)); };
    int across = 0;
    for (const double ahead_m : distances_m)
        for (int i = 0; i < 80; ++i) {
            if (i % 3 == 0) {
                const std::size_t lamp = i / 3 % 2 == 0 ? 0 : 1;
                const LampShift shift = planted_shifts()[lamp];
                const double over_h = (across / 4 * 7 % 20) / 19.0, over_v = (across / 4 * 3 % 7) / 6.0;
                const double h_deg = across / 2 % 2 == 0 ? -5.0 + 4.5 * over_h : 0.5 + 3.0 * over_h;
                const double v_deg = cut_off_deg(h_deg) - 0.2 + 0.4 * over_v + seen_deg(shift[0]);
                points.push_back(point_at(ahead_m, h_deg - seen_deg(shift[1]), v_deg, {lamp}, lamp == 0 ? 0.6 : -0.6));
                ++across;
            } else {
                const std::vector<std::vector<std::size_t>> shone{{0}, {1}, {0}, {1}, {0, 1}};
                points.push_back(point_at(ahead_m, -8.0 + 16.0 * (i * 37 % 80) / 79.0, -0.9 - 2.5 * (i * 11 % 53) / 52.0,
                                          shone[static_cast<std::size_t>(i % 5)]));
            }
        }
    return points;
}

/// What is read with these shifts, with normal noise of each point's own uncertainty.
inline void read_points(const CarAtReading& car, const Shifts& shifts, std::vector<LuxPoint>& points, std::mt19937_64* random) {
    const std::vector<CarAtReading> cars{car};
    for (LuxPoint& point : points)
        point.lux = 1.0; // so that there is an uncertainty
    const std::vector<double> lux = FitModel(cars, points).lux(shifts);
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i].lux =
            std::max(random ? lux[i] + normal(*random) * std::hypot(points[i].relative * lux[i], points[i].absolute_lx) : lux[i], 0.0);
}

/// A fitted value; the test fails without it.
inline const FittedValue& value_of(const LampFit& fit, const std::string& lamp, FitQuantity quantity) {
    for (const FittedValue& value : fit.values)
        if (value.lamp == lamp && value.quantity == quantity)
            return value;
    throw std::runtime_error("no such value");
}

} // namespace fernlicht::tests
