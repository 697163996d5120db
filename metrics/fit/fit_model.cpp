#include "metrics/fit/fit_model.h"

#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr double angle_step_rad = radians(0.005), length_step_m = 0.001;

double light_on(const LuxPoint& point, const LitLamp& lamp, const Weather& weather, const glm::dvec3& offset_m) {
    const glm::dvec3 place = point.place_m + offset_m, to_lamp = lamp.pose.position_m - place;
    const double cosine = point.normal ? photometry::incidence(*point.normal, to_lamp) : 1.0;
    const double cd = cosine > 0.0 ? intensity_towards_cd(lamp, place) : 0.0;
    return cd > 0.0 ? photometry::facing_illuminance(cd, to_lamp) * cosine * air_transmittance(weather, glm::length(to_lamp)) : 0.0;
}

} // namespace

MountedLamp shifted(MountedLamp lamp, const LampShift& shift) {
    lamp.pitch_rad += shift[0];
    lamp.yaw_rad += shift[1];
    lamp.flux_factor *= std::exp(shift[2]);
    lamp.position_m.z += shift[3];
    return lamp;
}

FitModel::FitModel(const std::vector<CarAtReading>& cars, const std::vector<LuxPoint>& points) : cars_(cars), points_(points) {
    if (cars.empty() || points.empty())
        throw std::invalid_argument("FitModel: no car or no points");
    for (const CarAtReading& car : cars)
        if (!std::ranges::equal(car.lamps, cars[0].lamps, {}, &MountedLamp::name, &MountedLamp::name))
            throw std::invalid_argument("FitModel: other lamps at another time");
    points_of_.resize(cars[0].lamps.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const LuxPoint& point = points[i];
        if (point.car >= cars.size() || !(point.lux >= 0.0) || !(point.relative * point.lux + point.absolute_lx > 0.0))
            throw std::invalid_argument("FitModel: a point without car, reading or uncertainty");
        places_uncertain_ = places_uncertain_ || point.place_uncertainty_m > 0.0;
        for (const std::size_t lamp : point.lamps)
            points_of_.at(lamp).push_back(i);
    }
}

void FitModel::add_light(std::size_t lamp, const LampShift& shift, std::vector<double>& lux, const glm::dvec3& offset_m) const {
    std::vector<std::optional<LitLamp>> lit(cars_.size());
    for (const std::size_t i : points_of_[lamp]) {
        const CarAtReading& car = cars_[points_[i].car];
        std::optional<LitLamp>& here = lit[points_[i].car];
        if (!here) {
            const MountedLamp moved = shifted(car.lamps[lamp], shift);
            here = LitLamp{moved.name, moved.file, compose(car.ego, moved.pose()), moved.intensity_factor(), moved.colour};
        }
        lux[i] += light_on(points_[i], *here, car.weather, offset_m);
    }
}

std::vector<double> FitModel::lux(const Shifts& shifts, const glm::dvec3& offset_m) const {
    std::vector<double> lux(points_.size(), 0.0);
    for (std::size_t lamp = 0; lamp < lamps(); ++lamp)
        add_light(lamp, shifts[lamp], lux, offset_m);
    return lux;
}

Matrix FitModel::jacobian(const Shifts& shifts) const {
    Matrix jacobian(points_.size(), fit_quantities * lamps());
    const LampShift steps{angle_step_rad, angle_step_rad, 0.0, length_step_m};
    for (std::size_t lamp = 0; lamp < lamps(); ++lamp)
        for (std::size_t k = 0; k < fit_quantities; ++k) {
            LampShift above = shifts[lamp], below = shifts[lamp];
            above[k] += steps[k];
            below[k] -= steps[k];
            std::vector<double> up(points_.size(), 0.0), down(points_.size(), 0.0);
            add_light(lamp, above, up);
            if (steps[k] > 0.0)
                add_light(lamp, below, down);
            for (const std::size_t i : points_of_[lamp]) // light is proportional to flux
                jacobian.at(i, fit_quantities * lamp + k) = steps[k] > 0.0 ? (up[i] - down[i]) / (2.0 * steps[k]) : up[i];
        }
    return jacobian;
}

std::vector<double> FitModel::sigma_lx(const Shifts& shifts, const std::vector<double>& lux) const {
    std::vector<double> variance(points_.size(), 0.0);
    for (int axis = 0; places_uncertain_ && axis < 3; ++axis) {
        glm::dvec3 step(0.0);
        step[axis] = length_step_m;
        const std::vector<double> ahead = this->lux(shifts, step), behind = this->lux(shifts, -step);
        for (std::size_t i = 0; i < points_.size(); ++i)
            variance[i] += std::pow((ahead[i] - behind[i]) / (2.0 * length_step_m) * points_[i].place_uncertainty_m, 2.0);
    }
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const LuxPoint& point = points_[i];
        const double of_lx = std::clamp(lux[i], 0.5 * point.lux, 2.0 * point.lux);
        variance[i] = std::sqrt(variance[i] + std::pow(point.relative * of_lx, 2.0) + point.absolute_lx * point.absolute_lx);
    }
    return variance;
}

} // namespace fernlicht
