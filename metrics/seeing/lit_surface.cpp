#include "metrics/seeing/lit_surface.h"

#include "scenarios/light/light.h"
#include "scenarios/photometry.h"

namespace fernlicht {

double reflectance_of(const glm::vec3& c) {
    return 0.2126 * static_cast<double>(c.x) + 0.7152 * static_cast<double>(c.y) + 0.0722 * static_cast<double>(c.z);
}

SurfaceLuminance surface_luminance(const Moment& moment, const glm::dvec3& point_m, const glm::dvec3& normal, const Material& material,
                                   const glm::dvec3& eye_m) {
    const double albedo = reflectance_of(material.albedo);
    SurfaceLuminance result;
    result.photopic_cdm2 = photometry::diffuse_luminance(albedo, daylight_illuminance_lx(moment.daylight, normal));
    for (const LitLamp& lamp : moment.lamps) {
        const glm::dvec3 to_lamp = lamp.pose.position_m - point_m;
        const double cosine = photometry::incidence(normal, to_lamp), cd = intensity_towards_cd(lamp, point_m);
        if (!(cosine > 0.0) || !(cd > 0.0))
            continue;
        const double e_perp = photometry::facing_illuminance(cd, to_lamp);
        double luminance = photometry::diffuse_luminance(albedo, e_perp * cosine);
        if (material.retro_rl > 0.0F)
            luminance += photometry::retro_luminance(
                static_cast<double>(material.retro_rl), e_perp, cosine, photometry::observation_angle(to_lamp, eye_m - point_m),
                static_cast<double>(material.retro_reference_rad), 1.0 / static_cast<double>(material.retro_falloff_rad));
        result.photopic_cdm2 += luminance;
        result.scotopic_cdm2 += lamp.colour.sp_ratio * luminance;
    }
    return result;
}

} // namespace fernlicht
