// Readings of a luxmeter, and what the twin makes of them when the lamps are shifted.
#pragma once

#include "metrics/fit/scaled_svd.h"
#include "scenarios/lamps/mounted_lamp.h"
#include "scenarios/sky/weather.h"
#include "scenarios/values/pose.h"

#include <array>
#include <optional>
#include <vector>

namespace fernlicht {

/// The car when something was read.
struct CarAtReading {
    Pose ego;                       ///< its frame in the world (Moment::ego)
    std::vector<MountedLamp> lamps; ///< as of then (lamps_at); the same lamps in the same order at all times
    Weather weather;
};

/// One reading. Its standard uncertainty has three independent parts; one of the first two is above 0.
struct LuxPoint {
    std::size_t car = 0;              ///< when, into the cars
    glm::dvec3 place_m{0.0};          ///< in the world
    std::optional<glm::dvec3> normal; ///< unit, of the luxmeter, in the world; nullopt: it faces each lamp (E = I / d^2)
    std::vector<std::size_t> lamps;   ///< that shone, into CarAtReading::lamps
    double lux = 0.0;                 ///< of these lamps alone; >= 0
    double relative = 0.0;            ///< share of the illuminance
    double absolute_lx = 0.0;
    double place_uncertainty_m = 0.0; ///< in each direction of space
};

/// What of a lamp is fitted, in the order of LampShift.
enum class FitQuantity { pitch, yaw, flux, height };
inline constexpr std::size_t fit_quantities = 4;

/// What is added to a lamp of the drive: pitch and yaw in rad, logarithm of the flux factor, height in m. All lamps' one behind the other
/// are the unknowns.
using LampShift = std::array<double, fit_quantities>;
using Shifts = std::vector<LampShift>;
MountedLamp shifted(MountedLamp lamp, const LampShift& shift);

class FitModel {
  public:
    /// Both outlive the model. Throws std::invalid_argument for lamps that differ from car to car, indices out of range and a point
    /// without an uncertainty.
    FitModel(const std::vector<CarAtReading>& cars, const std::vector<LuxPoint>& points);

    const std::vector<LuxPoint>& points() const { return points_; }
    std::size_t lamps() const { return points_of_.size(); }
    /// Points on which the lamp shone.
    const std::vector<std::size_t>& points_of(std::size_t lamp) const { return points_of_[lamp]; }

    /// Adds a lamp's light on each point, `offset_m` beside where the point is: E = I(H, V) cos / d^2, times what the air leaves. lx.
    void add_light(std::size_t lamp, const LampShift& shift, std::vector<double>& lux, const glm::dvec3& offset_m = glm::dvec3(0.0)) const;
    std::vector<double> lux(const Shifts& shifts, const glm::dvec3& offset_m = glm::dvec3(0.0)) const;
    /// Of lux by the unknowns, a row a point. Central differences over +-0.005 degrees and +-1 mm.
    Matrix jacobian(const Shifts& shifts) const;
    /// Standard uncertainty of each point at these shifts, of which `lux` is the light. The relative part is taken of the calculated lux,
    /// kept within a factor of two of the reading: taken of the reading it would pull the flux down, points that read low weighing more.
    /// The part of the place is the gradient times its uncertainty (effective variance, Orear 1982).
    std::vector<double> sigma_lx(const Shifts& shifts, const std::vector<double>& lux) const;

  private:
    const std::vector<CarAtReading>& cars_;
    const std::vector<LuxPoint>& points_;
    std::vector<std::vector<std::size_t>> points_of_; ///< by lamp
    bool places_uncertain_ = false;
};

} // namespace fernlicht
