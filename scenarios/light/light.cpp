#include "scenarios/light/light.h"

#include "scenarios/lamps/mounted_lamp.h"
#include "scenarios/light/fog_light.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace fernlicht {

std::optional<TwoAngles> angles_from(const LitLamp& lamp, const glm::dvec3& point_m) {
    const glm::dvec3 w = photometry::lamp_space(point_m - lamp.pose.position_m, -lamp.pose.left(), lamp.pose.up(), lamp.pose.forward());
    if (w.z <= 0.0)
        return std::nullopt;
    const glm::dvec2 angles = photometry::goniometer_angles(w);
    return TwoAngles{degrees(angles.x), degrees(angles.y)};
}

double intensity_towards_cd(const LitLamp& lamp, const glm::dvec3& point_m) {
    if (lamp.intensity_factor == 0.0)
        return 0.0;
    const std::optional<TwoAngles> angles = angles_from(lamp, point_m);
    return angles ? lamp.intensity_factor * intensity_cd(lamp.file->table, angles->h_deg, angles->v_deg) : 0.0;
}

double daylight_illuminance_lx(const Daylight& daylight, const glm::dvec3& normal) {
    const double sky = photometry::sky_illuminance(daylight.horizontal_illuminance_lx, normal);
    const DirectLight* direct = daylight.direct();
    return direct ? sky + photometry::directional_illuminance(direct->illuminance_lx, normal, direct->towards()) : sky;
}

double surface_illuminance_lx(const Moment& moment, const glm::dvec3& point_m, const glm::dvec3& normal) {
    double e = daylight_illuminance_lx(moment.daylight, normal);
    for (const LitLamp& lamp : moment.lamps) {
        const glm::dvec3 to_lamp = lamp.pose.position_m - point_m;
        const double cosine = photometry::incidence(normal, to_lamp);
        if (cosine > 0.0)
            e += photometry::facing_illuminance(intensity_towards_cd(lamp, point_m), to_lamp) * cosine *
                 air_transmittance(moment.weather, glm::length(to_lamp));
    }
    return e;
}

double target_illuminance_lx(const Moment& moment, const glm::dvec3& point_m) {
    double e = 0.0;
    for (const LitLamp& lamp : moment.lamps)
        if (const double cd = intensity_towards_cd(lamp, point_m); cd > 0.0) // in the lamp itself: no light, not 0 / 0
            e += photometry::facing_illuminance(cd, lamp.pose.position_m - point_m) *
                 air_transmittance(moment.weather, glm::length(lamp.pose.position_m - point_m));
    return e;
}

glm::dvec3 retro_tint(const Material& material) {
    static const glm::dvec3 illuminant_a = colour_of_temperature(2856.0).linear_srgb;
    if (!is_tinted(material))
        return glm::dvec3(1.0);
    const glm::dvec3 rgb(material.retro_rgb);
    return rgb / glm::dot(glm::dvec3(0.2126, 0.7152, 0.0722), illuminant_a * rgb);
}

namespace {

glm::dvec3 diffuse(const glm::dvec3& albedo, double facet_in, double facet_out, double e_lx) {
    glm::dvec3 light;
    for (int i = 0; i < 3; ++i)
        light[i] = photometry::diffuse_luminance(photometry::wet_albedo(albedo[i], facet_in, facet_out), e_lx);
    return light;
}

double facet(double cosine) { return photometry::facet_cosine(std::max(cosine, 0.0), wet_roughness); }

} // namespace

glm::dvec3 wet_light(const glm::dvec3& albedo, const glm::dvec3& normal, const glm::dvec3& to_light, const glm::dvec3& to_eye,
                     double e_perp_lx) {
    if (e_perp_lx <= 0.0)
        return glm::dvec3(0.0);
    const double in = std::max(glm::dot(normal, to_light), 0.0);
    return diffuse(albedo, facet(in), facet(glm::dot(normal, to_eye)), e_perp_lx * in) +
           e_perp_lx * photometry::wet_mirrored(normal, to_light, to_eye, wet_roughness);
}

glm::dvec3 wet_sky_light(const glm::dvec3& albedo, const glm::dvec3& normal, const glm::dvec3& to_eye, double e_lx, double sky_cdm2) {
    const double out = facet(glm::dot(normal, to_eye));
    constexpr double from_all_sides = 0.5; // cosine at which water mirrors about as much as of diffuse light
    return diffuse(albedo, from_all_sides, out, e_lx) + sky_cdm2 * photometry::water_reflectance(out);
}

double gloss_light(const Facets& facets, const glm::dvec3& normal, const glm::dvec3& to_light, const glm::dvec3& to_eye, double e_perp_lx) {
    return facets.share > 0.0 && e_perp_lx > 0.0
               ? facets.share * e_perp_lx * photometry::facet_mirrored(normal, to_light, to_eye, facets.roughness, photometry::facet_index)
               : 0.0;
}

double gloss_sky_light(const Facets& facets, const glm::dvec3& normal, const glm::dvec3& to_eye, double sky_cdm2) {
    if (!(facets.share > 0.0))
        return 0.0;
    const double out = photometry::facet_cosine(std::max(glm::dot(normal, to_eye), 0.0), facets.roughness);
    return facets.share * sky_cdm2 * photometry::dielectric_reflectance(out, photometry::facet_index);
}

} // namespace fernlicht
