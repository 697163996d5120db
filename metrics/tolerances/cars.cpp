#include "metrics/tolerances/cars.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <random>

namespace fernlicht {
namespace {

constexpr double slope_deviations = 1.5;

/// What this share of cars lies below; 0 < share < 1.
double inverse(const Tolerance& tolerance, double share) {
    if (tolerance.from)
        return std::lerp(*tolerance.from, *tolerance.to, share);
    return tolerance.mean + tolerance.sigma * normal_quantile(share);
}

LampNudge& nudge_of_lamp(Nudge& nudge, const std::string& lamp) {
    const auto found = std::ranges::find(nudge.lamps, lamp, &LampNudge::lamp);
    return found != nudge.lamps.end() ? *found : nudge.lamps.emplace_back(LampNudge{lamp});
}

} // namespace

std::string name_of(const CarPart& part) {
    return part.lamp.empty() ? name_of(part.kind) : fmt::format("{} of {}", name_of(part.kind), part.lamp);
}

std::vector<CarPart> varying_parts(const ToleranceParameters& tolerances, const std::vector<std::string>& lamps, bool has_vehicle) {
    std::vector<CarPart> parts;
    const auto add = [&](const std::string& lamp) {
        for (std::size_t i = 0; i < tolerance_kinds; ++i)
            if (const auto kind = static_cast<ToleranceKind>(i); is_of_each_lamp(kind) != lamp.empty() &&
                                                                 tolerance_of(tolerances, kind).counts() &&
                                                                 (kind != ToleranceKind::load || has_vehicle))
                parts.push_back({kind, lamp, tolerance_of(tolerances, kind)});
    };
    for (const std::string& lamp : lamps)
        add(lamp);
    add("");
    return parts;
}

std::vector<CarValues> drawn_cars(const std::vector<CarPart>& parts, int seed, std::size_t count) {
    std::mt19937_64 generator(static_cast<std::uint64_t>(seed));
    std::vector<CarValues> cars(count, CarValues(parts.size()));
    for (CarValues& car : cars)
        for (std::size_t i = 0; i < parts.size(); ++i)
            car[i] = inverse(parts[i].tolerance, (static_cast<double>(generator() >> 11U) + 0.5) * 0x1p-53);
    return cars;
}

std::pair<double, double> slope_ends(const Tolerance& tolerance) {
    if (tolerance.from)
        return {*tolerance.from, *tolerance.to};
    return {tolerance.mean - slope_deviations * tolerance.sigma, tolerance.mean + slope_deviations * tolerance.sigma};
}

Nudge nudge_of(const std::vector<CarPart>& parts, const CarValues& car, const Drive& drive, const LampSet& lamp_set) {
    Nudge nudge;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const double value = car[i];
        switch (parts[i].kind) {
        case ToleranceKind::pitch:
            nudge_of_lamp(nudge, parts[i].lamp).pitch_rad = radians(value);
            break;
        case ToleranceKind::yaw:
            nudge_of_lamp(nudge, parts[i].lamp).yaw_rad = radians(value);
            break;
        case ToleranceKind::roll:
            nudge_of_lamp(nudge, parts[i].lamp).roll_rad = radians(value);
            break;
        case ToleranceKind::flux:
            nudge_of_lamp(nudge, parts[i].lamp).flux_factor = std::max(0.0, 1.0 + value / 100.0);
            break;
        case ToleranceKind::height:
            nudge.lift_m = value / 1000.0;
            break;
        case ToleranceKind::load:
            if (const std::optional<Nudge> loaded = loaded_nudge(drive, lamp_set, value)) {
                nudge.pitch_rad = loaded->pitch_rad;
                nudge.body_pitch_rad = loaded->body_pitch_rad;
                nudge.body_rear_lift_m = loaded->body_rear_lift_m;
            }
            break;
        }
    }
    return nudge;
}

} // namespace fernlicht
