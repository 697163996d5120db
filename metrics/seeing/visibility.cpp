#include "metrics/seeing/visibility.h"

#include "metrics/glare/wet_road.h"
#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"
#include "scenarios/photometry.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr double cone_branch_cdm2 = 0.6, rod_branch_cdm2 = 0.00418, min_negative_cdm2 = 0.004, long_exposure_s = 2.0, timed_arcmin = 60.0;

/// sqrt(phi), after Ricco's law: small targets are seen by their light.
double ricco_root(double lb) {
    const double lg = std::log10(lb);
    if (lb >= cone_branch_cdm2)
        return std::log10(4.1925 * std::pow(lb, 0.1556)) + 0.1684 * std::pow(lb, 0.5867);
    return std::pow(10.0, lb > rod_branch_cdm2 ? -0.072 + 0.3372 * lg + 0.0866 * lg * lg : 0.028 + 0.173 * lg);
}

/// sqrt(L), after Weber's law: large ones by their contrast.
double weber_root(double lb) {
    const double lg = std::log10(lb);
    if (lb >= cone_branch_cdm2)
        return 0.05946 * std::pow(lb, 0.466);
    return std::pow(10.0, lb > rod_branch_cdm2 ? -1.256 + 0.319 * lg : -0.891 + 0.5275 * lg + 0.0227 * lg * lg);
}

/// Fcp: dark targets are seen better than light ones.
double negative_contrast_factor(double lb, double alpha, double positive_difference) {
    const double f = lb >= 0.1 ? 0.125 : 0.075, lg = std::log10(lb) + 1.0;
    const double m = std::pow(10.0, -std::pow(10.0, -(f * lg * lg + 0.0245)));
    const double beta = 0.6 * std::pow(lb, -0.1488);
    return 1.0 - m * std::pow(alpha, -beta) / (2.4 * positive_difference);
}

/// TF: what shows for a short time is seen worse.
double exposure_factor(double lb, double alpha, double time_s) {
    const double x = std::log10(alpha) + 0.523, y = std::log10(lb) + 6.0;
    const double of_size = 0.36 - 0.0972 * x * x / (x * x - 2.513 * x + 2.7895);
    const double of_luminance = 0.355 - 0.1217 * y * y / (y * y - 10.4 * y + 52.28);
    return (std::hypot(of_size, of_luminance) / 2.1 + time_s) / time_s;
}

/// AF.
double age_factor(double age) {
    const double from = age < 64.0 ? age - 19.0 : age - 56.6;
    return age < 64.0 ? from * from / 2160.0 + 0.99 : from * from / 116.3 + 1.43;
}

constexpr double scotopic_weight = 683.0 / 1699.0;
constexpr double converged = 1e-10; // of m: 3e-10 of the luminance, far below the four digits that a and b have
constexpr int max_iterations = 200;

double luminance_at(double m, double photopic_cdm2, double scotopic_cdm2) {
    const double rods = (1.0 - m) * scotopic_weight;
    return (m * photopic_cdm2 + rods * scotopic_cdm2) / (m + rods);
}

double adapted(double mesopic_cdm2) { return std::clamp(0.7670 + 0.3334 * std::log10(mesopic_cdm2), 0.0, 1.0); }

} // namespace

Value threshold_difference_cdm2(double background_cdm2, double size_arcmin, bool positive, const Onlooker& onlooker) {
    if (!(size_arcmin > 0.0) || !(onlooker.time_s > 0.0) || !(onlooker.k > 0.0) || !(background_cdm2 >= 0.0))
        throw std::invalid_argument(fmt::format("a target of {} arc minutes for {} s before {} cd/m2, k {}", size_arcmin, onlooker.time_s,
                                                background_cdm2, onlooker.k));
    if (background_cdm2 == 0.0)
        return Value::not_measured("a dark background, of which the thresholds know nothing");
    if (onlooker.age_years < 23.0 || onlooker.age_years > 75.0)
        return Value::not_measured(fmt::format("an age of {:g}: the age factor holds from 23 to 75", onlooker.age_years));
    const bool timed = onlooker.time_s < long_exposure_s;
    if (timed && size_arcmin >= timed_arcmin)
        return Value::not_measured(fmt::format("a target of {:.3g} arc minutes: the factor of exposure holds below 60", size_arcmin));
    const double root = ricco_root(background_cdm2) / size_arcmin + weber_root(background_cdm2);
    double difference = onlooker.k * root * root;
    if (!positive) {
        if (background_cdm2 <= min_negative_cdm2)
            return Value::not_measured(fmt::format("negative contrast on {:.2g} cd/m2: its factor holds above 0.004", background_cdm2));
        const double factor = negative_contrast_factor(background_cdm2, size_arcmin, difference);
        if (!(factor > 0.0))
            return Value::not_measured(
                fmt::format("a target of {:.3g} arc minutes: the factor of negative contrast is not above 0", size_arcmin));
        difference *= factor;
    }
    if (timed)
        difference *= exposure_factor(background_cdm2, size_arcmin, onlooker.time_s);
    return difference * age_factor(onlooker.age_years);
}

Value visibility_level(double target_cdm2, double background_cdm2, double adaptation_cdm2, double size_arcmin, const Onlooker& onlooker) {
    Value threshold = threshold_difference_cdm2(adaptation_cdm2, size_arcmin, target_cdm2 >= background_cdm2, onlooker);
    if (!threshold.measured())
        return threshold;
    return std::abs(target_cdm2 - background_cdm2) / *threshold.number();
}

Mesopic mesopic_luminance(double photopic_cdm2, double sp_ratio) {
    if (!(photopic_cdm2 > 0.0) || !std::isfinite(photopic_cdm2) || !(sp_ratio >= 0.01 && sp_ratio <= 100.0))
        throw std::invalid_argument(fmt::format("mesopic_luminance of {} cd/m2 with S/P {}", photopic_cdm2, sp_ratio));
    const double scotopic_cdm2 = sp_ratio * photopic_cdm2;
    const auto next = [&](double m) { return adapted(luminance_at(m, photopic_cdm2, scotopic_cdm2)); };
    Mesopic result;
    double m = 0.5, change = 1.0;
    for (int i = 0; change >= converged && i < max_iterations; ++i) {
        const double updated = next(m);
        change = std::abs(updated - m);
        m = updated;
    }
    result.bisected = change >= converged;
    if (result.bisected) {
        double low = 0.0, high = 1.0; // next(low) >= low and next(high) <= high, for next() stays within 0 and 1
        for (int halving = 0; halving < 60; ++halving) {
            m = 0.5 * (low + high);
            (next(m) > m ? low : high) = m;
        }
    }
    result.m = m;
    result.luminance_cdm2 = luminance_at(m, photopic_cdm2, scotopic_cdm2);
    return result;
}

double arc_minutes_of(double length_m, double distance_m) { return 120.0 * degrees(std::atan(0.5 * length_m / distance_m)); }

double reflectance_of(const glm::vec3& c) {
    return 0.2126 * static_cast<double>(c.x) + 0.7152 * static_cast<double>(c.y) + 0.0722 * static_cast<double>(c.z);
}

namespace {

/// Of a grey surface in light from one place: dry, and as far as it is wet.
double returned_cdm2(const Moment& moment, double albedo, double e_perp, const glm::dvec3& to_light, const glm::dvec3& normal,
                     const Material& material, const glm::dvec3& to_eye) {
    const double cosine = photometry::incidence(normal, to_light);
    if (!(cosine > 0.0) || !(e_perp > 0.0))
        return 0.0;
    double luminance = photometry::diffuse_luminance(albedo, e_perp * cosine), returned = 0.0;
    if (material.retro_rl > 0.0F)
        returned = photometry::retro_luminance(
            static_cast<double>(material.retro_rl), e_perp, cosine, photometry::observation_angle(to_light, to_eye),
            static_cast<double>(material.retro_reference_rad), 1.0 / static_cast<double>(material.retro_falloff_rad));
    luminance += returned;
    if (material.gloss > 0.0F)
        luminance += gloss_light(facets_of(material), normal, glm::normalize(to_light), glm::normalize(to_eye), e_perp);
    if (moment.weather.wetness > 0.0 && gets_wet(material.kind))
        return partly_wet(glm::dvec3(luminance),
                          wet_light(glm::dvec3(albedo), normal, glm::normalize(to_light), glm::normalize(to_eye), e_perp) +
                              static_cast<double>(material.retro_wet) * returned,
                          moment.weather.wetness)
            .x;
    return luminance;
}

double of_sky_cdm2(const Moment& moment, double albedo, const glm::dvec3& normal, const Material& material, const glm::dvec3& to_eye) {
    double dry = photometry::diffuse_luminance(albedo, daylight_illuminance_lx(moment.daylight, normal));
    if (const Facets facets = facets_of(material); facets.share > 0.0) {
        dry += gloss_sky_light(facets, normal, glm::normalize(to_eye), sky_luminance_cdm2(moment.daylight));
        if (const DirectLight* const direct = moment.daylight.direct())
            dry += gloss_light(facets, normal, direct->towards(), glm::normalize(to_eye), direct->illuminance_lx);
    }
    if (!(moment.weather.wetness > 0.0) || !gets_wet(material.kind))
        return dry;
    const glm::dvec3 out = glm::normalize(to_eye);
    glm::dvec3 wet =
        wet_sky_light(glm::dvec3(albedo), normal, out, photometry::sky_illuminance(moment.daylight.horizontal_illuminance_lx, normal),
                      sky_luminance_cdm2(moment.daylight));
    if (const DirectLight* const direct = moment.daylight.direct())
        wet += wet_light(glm::dvec3(albedo), normal, direct->towards(), out, direct->illuminance_lx);
    return partly_wet(glm::dvec3(dry), wet, moment.weather.wetness).x;
}

} // namespace

SurfaceLuminance surface_luminance(const Moment& moment, const glm::dvec3& point_m, const glm::dvec3& normal, const Material& material,
                                   const glm::dvec3& eye_m, const std::vector<SeenLamp>& by_road) {
    const double albedo = reflectance_of(material.albedo);
    const glm::dvec3 to_eye = eye_m - point_m;
    SurfaceLuminance result;
    result.photopic_cdm2 = of_sky_cdm2(moment, albedo, normal, material, to_eye);
    const auto add = [&](const LitLamp& lamp, double e_perp, const glm::dvec3& to_light) {
        const double luminance = returned_cdm2(moment, albedo, e_perp, to_light, normal, material, to_eye);
        result.photopic_cdm2 += luminance;
        result.scotopic_cdm2 += lamp.colour.sp_ratio * luminance;
    };
    for (std::size_t i = 0; i < moment.lamps.size(); ++i) {
        const LitLamp& lamp = moment.lamps[i];
        const glm::dvec3 to_lamp = lamp.pose.position_m - point_m;
        if (const double cd = intensity_towards_cd(lamp, point_m); cd > 0.0)
            add(lamp, photometry::facing_illuminance(cd, to_lamp) * air_transmittance(moment.weather, glm::length(to_lamp)), to_lamp);
        for (std::size_t k = i * streak_patches; k < std::min((i + 1) * streak_patches, by_road.size()); ++k)
            add(lamp, by_road[k].facing_lx, by_road[k].position_m - point_m);
    }
    return result;
}

std::vector<double> luminance_per_cd(const Moment& moment, const glm::dvec3& point_m, const glm::dvec3& normal, const Material& material,
                                     const glm::dvec3& eye_m) {
    const double albedo = reflectance_of(material.albedo);
    std::vector<double> per_cd;
    for (const LitLamp& lamp : moment.lamps) {
        const glm::dvec3 to_lamp = lamp.pose.position_m - point_m;
        const bool lit = lamp.intensity_factor > 0.0 && to_lamp != glm::dvec3(0.0);
        const double e_perp =
            lit ? photometry::facing_illuminance(1.0, to_lamp) * air_transmittance(moment.weather, glm::length(to_lamp)) : 0.0;
        per_cd.push_back(returned_cdm2(moment, albedo, e_perp, to_lamp, normal, material, eye_m - point_m));
    }
    return per_cd;
}

SurfaceLuminance lamps_airlight(const Moment& moment, const glm::dvec3& point_m, const glm::dvec3& eye_m) {
    SurfaceLuminance air;
    if (moment.weather.extinction_per_m > 0.0)
        for (const LitLamp& lamp : moment.lamps) {
            const double luminance = airlight_cdm2(lamp, moment.weather, eye_m, point_m, airlight_samples);
            air.photopic_cdm2 += luminance;
            air.scotopic_cdm2 += lamp.colour.sp_ratio * luminance;
        }
    return air;
}

SurfaceLuminance seen_through_air(const Moment& moment, const SurfaceLuminance& surface, const SurfaceLuminance& airlight,
                                  double distance_m) {
    const double left = air_transmittance(moment.weather, distance_m);
    return {left * surface.photopic_cdm2 + airlight.photopic_cdm2 + sky_airlight_cdm2(moment.daylight, moment.weather, distance_m),
            left * surface.scotopic_cdm2 + airlight.scotopic_cdm2};
}

SurfaceLuminance seen_luminance(const Moment& moment, const glm::dvec3& point_m, const glm::dvec3& normal, const Material& material,
                                const glm::dvec3& eye_m, const std::vector<SeenLamp>& by_road) {
    return seen_through_air(moment, surface_luminance(moment, point_m, normal, material, eye_m, by_road),
                            lamps_airlight(moment, point_m, eye_m), glm::distance(point_m, eye_m));
}

double illuminance_by_road_lx(const std::vector<SeenLamp>& by_road, const glm::dvec3& point_m, const glm::dvec3& normal) {
    double e = 0.0;
    for (const SeenLamp& patch : by_road)
        if (patch.facing_lx > 0.0)
            e += patch.facing_lx * photometry::incidence(normal, patch.position_m - point_m);
    return e;
}

} // namespace fernlicht
