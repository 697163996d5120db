#include "scenarios/light.h"

#include "scenarios/photometry.h"

namespace fernlicht {
namespace {

/// Share of the sky that a surface of this normal sees, for a uniform sky over a black ground: (1 + cos(slope)) / 2.
double sky_share(const glm::dvec3& normal) { return 0.5 * (1.0 + normal.z); }

} // namespace

double intensity_towards_cd(const LitLamp& lamp, const glm::dvec3& point_m) {
    if (lamp.intensity_factor == 0.0)
        return 0.0;
    const glm::dvec3 w = photometry::lamp_space(point_m - lamp.pose.position_m, -lamp.pose.left(), lamp.pose.up(), lamp.pose.forward());
    if (w.z <= 0.0)
        return 0.0;
    const glm::dvec2 angles = photometry::goniometer_angles(w);
    return lamp.intensity_factor * intensity_cd(lamp.file->table, degrees(angles.x), degrees(angles.y));
}

double surface_illuminance_lx(const Moment& moment, const glm::dvec3& point_m, const glm::dvec3& normal) {
    double e = moment.daylight.horizontal_illuminance_lx * sky_share(normal);
    for (const LitLamp& lamp : moment.lamps) {
        const glm::dvec3 to_lamp = lamp.pose.position_m - point_m;
        const double cosine = photometry::incidence(normal, to_lamp);
        if (cosine > 0.0)
            e += photometry::facing_illuminance(intensity_towards_cd(lamp, point_m), to_lamp) * cosine;
    }
    return e;
}

double target_illuminance_lx(const Moment& moment, const glm::dvec3& point_m) {
    double e = 0.0;
    for (const LitLamp& lamp : moment.lamps)
        if (const double cd = intensity_towards_cd(lamp, point_m); cd > 0.0) // in the lamp itself: no light, not 0 / 0
            e += photometry::facing_illuminance(cd, lamp.pose.position_m - point_m);
    return e;
}

} // namespace fernlicht
