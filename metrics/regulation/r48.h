// UN R48 (09 series) of lamps on a car: loads under which a low beam's cut-off keeps to its band (6.2.6.1, annex 5), and how far ahead bend
// light's kink may cross the car's path (6.2.6.4).
#pragma once

#include "scenarios/vehicle/vehicle_parameters.h"

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

/// What a car carries and where. R48 states the loads by seats, boot and permissible loads, which are the car's own.
struct CarCapacity {
    double person_kg = 75.0;
    double front_seats_m = 1.25, rear_seats_m = 2.15, boot_m = 3.1; ///< middles, behind the front axle
    int rear_seats = 3;
    double permissible_kg = 2000.0, permissible_rear_axle_kg = 1100.0;

    /// A car of five seats: places are shares of the wheelbase, masses of the mass with the driver, as of our middle-class car.
    static CarCapacity usual(const VehicleParameters& car, double wheelbase_m);
    bool operator==(const CarCapacity&) const = default;
};

/// Weight over the axles beyond the car with its driver.
struct LoadState {
    std::string name;
    double front_kg = 0.0, rear_kg = 0.0;

    bool operator==(const LoadState&) const = default;
};

/// The states of annex 5 for a car of two rows of seats (M1): driver; with the front passenger; all seats, which are the rearmost ones as
/// well; all seats and the boot up to a permissible load; driver and boot up to one. The first is that of the initial aim.
std::vector<LoadState> r48_load_states(const VehicleParameters& car, double wheelbase_m, const CarCapacity& capacity);
inline constexpr const char* r48_loads_source =
    "UN R48, annex 5, as we remember its list; the fully loaded state also as an EU directive quotes it";

/// How the body stands at rest, against the car with its driver.
struct LoadedBody {
    double pitch_rad = 0.0;     ///< nose up positive
    double levelling_rad = 0.0; ///< lamps up positive
    bool at_stop = false;       ///< levelling would go on and cannot
};
/// Springs in series with tyres: an axle sinks by g M (1/k + 1/kt). Levelling, of either kind, has come to rest: minus the pitch in the
/// springs, inside its stops.
LoadedBody loaded_body(const VehicleParameters& car, double wheelbase_m, const std::optional<LevellingParameters>& levelling,
                       const LoadState& load);

/// The circle that the car's centre of gravity is on.
struct CarCircle {
    glm::dvec2 centre_of_gravity_m{0.0};
    glm::dvec2 forward{1.0, 0.0}; ///< along its path, of length 1
    double curvature_per_m = 0.0; ///< left bends positive
};
/// Through three places in order, at the middle one; nullopt: it stands.
std::optional<CarCircle> circle_through(glm::dvec2 before_m, glm::dvec2 at_m, glm::dvec2 after_m);
/// Paths straighter than this count as straight: 100 km.
inline constexpr double straight_per_m = 1.0e-5;

/// Where a vertical plane that begins at `from_m` and goes along `towards` crosses the circle last; nullopt: nowhere ahead of its
/// beginning.
std::optional<glm::dvec2> last_crossing_m(const CarCircle& circle, glm::dvec2 from_m, glm::dvec2 towards);

/// 6.2.6.4: the kink of a low beam that moves sideways crosses the path no farther from the car's front than this times the mounting
/// height.
inline constexpr double kink_heights = 100.0;

} // namespace fernlicht
