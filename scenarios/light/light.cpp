#include "scenarios/light/light.h"

#include "scenarios/light/fog_light.h"
#include "scenarios/photometry.h"

namespace fernlicht {
double intensity_towards_cd(const LitLamp& lamp, const glm::dvec3& point_m) {
    if (lamp.intensity_factor == 0.0)
        return 0.0;
    const glm::dvec3 w = photometry::lamp_space(point_m - lamp.pose.position_m, -lamp.pose.left(), lamp.pose.up(), lamp.pose.forward());
    if (w.z <= 0.0)
        return 0.0;
    const glm::dvec2 angles = photometry::goniometer_angles(w);
    return lamp.intensity_factor * intensity_cd(lamp.file->table, degrees(angles.x), degrees(angles.y));
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

} // namespace fernlicht
