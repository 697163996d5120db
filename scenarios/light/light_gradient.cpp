#include "scenarios/light/light_gradient.h"

#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

/// d E / d intensity of one lamp, 1/m2; 0 where it gives nothing whatever its table says.
double lx_per_cd(const Moment& moment, std::size_t lamp, const LightPlace& place) {
    const glm::dvec3 to_lamp = moment.lamps[lamp].pose.position_m - place.point_m;
    if (moment.lamps[lamp].intensity_factor == 0.0 || to_lamp == glm::dvec3(0.0) || (!place.hidden.empty() && place.hidden[lamp]))
        return 0.0;
    const double cosine = place.facing == Facing::lamps ? 1.0 : photometry::incidence(place.normal, to_lamp);
    return cosine > 0.0 ? photometry::facing_illuminance(1.0, to_lamp) * cosine * air_transmittance(moment.weather, glm::length(to_lamp))
                        : 0.0;
}

std::vector<double>& samples_of(BeamGradient& gradient, const LitLamp& lamp) {
    const auto known =
        std::ranges::find_if(gradient, [&](const LampGradient& one) { return one.lamp == lamp.name && one.file == lamp.file; });
    if (known != gradient.end())
        return known->per_cd;
    return gradient.emplace_back(LampGradient{lamp.name, lamp.file, std::vector<double>(lamp.file->table.cd.size())}).per_cd;
}

void add_lamp(BeamGradient& gradient, const LitLamp& lamp, const glm::dvec3& point_m, double per_cd) {
    const std::optional<TwoAngles> angles = angles_from(lamp, point_m);
    const auto weights = angles ? sample_weights(lamp.file->table, angles->h_deg, angles->v_deg) : std::nullopt;
    if (!weights)
        return;
    std::vector<double>& samples = samples_of(gradient, lamp);
    for (const SampleWeight& one : *weights)
        samples[one.sample] += per_cd * lamp.intensity_factor * one.weight;
}

} // namespace

double light_lx(const Moment& moment, const LightPlace& place) {
    double e = place.facing == Facing::surface ? daylight_illuminance_lx(moment.daylight, place.normal) : 0.0;
    for (std::size_t lamp = 0; lamp < moment.lamps.size(); ++lamp)
        if (const double factor = lx_per_cd(moment, lamp, place); factor > 0.0)
            e += factor * intensity_towards_cd(moment.lamps[lamp], place.point_m);
    return e;
}

void add_gradient(BeamGradient& gradient, const Moment& moment, const LightPlace& place, double per_lx) {
    for (std::size_t i = 0; i < moment.lamps.size(); ++i)
        if (const double factor = lx_per_cd(moment, i, place); factor > 0.0)
            add_lamp(gradient, moment.lamps[i], place.point_m, per_lx * factor);
}

void add_gradient(BeamGradient& gradient, const Moment& moment, const glm::dvec3& point_m, std::span<const double> per_cd) {
    for (std::size_t i = 0; i < moment.lamps.size(); ++i)
        if (per_cd[i] != 0.0)
            add_lamp(gradient, moment.lamps[i], point_m, per_cd[i]);
}

} // namespace fernlicht
