// Cars of one series, drawn from their tolerances.
#pragma once

#include "scenarios/drives/play/nudge.h"

#include <string>
#include <vector>

namespace fernlicht {

/// What of a car is drawn: a value of one lamp, or of the car.
struct CarPart {
    ToleranceKind kind = ToleranceKind::pitch;
    std::string lamp = {}; ///< "" of the car
    Tolerance tolerance = {};
};
std::string name_of(const CarPart& part); ///< "pitch of left", "load"

/// Degrees, %, mm or kg from what the drive has, one for each part.
using CarValues = std::vector<double>;

/// Parts whose tolerance varies: lamp by lamp, then the car's. Load only where the car has a vehicle.
std::vector<CarPart> varying_parts(const ToleranceParameters& tolerances, const std::vector<std::string>& lamps, bool has_vehicle);
/// `count` cars, the first ones the same whatever the count. By inversion of the distributions at values of std::mt19937_64: the same on
/// every machine.
std::vector<CarValues> drawn_cars(const std::vector<CarPart>& parts, int seed, std::size_t count);
/// Where slopes are taken: what one car in 15 exceeds to either side (1.5 standard deviations), or an even distribution's ends.
std::pair<double, double> slope_ends(const Tolerance& tolerance);

Nudge nudge_of(const std::vector<CarPart>& parts, const CarValues& car, const Drive& drive, const LampSet& lamp_set);

} // namespace fernlicht
