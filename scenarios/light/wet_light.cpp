#include "scenarios/light/wet_light.h"

#include "scenarios/photometry.h"
#include "scenarios/values/scene.h"

#include <algorithm>

namespace fernlicht {
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

} // namespace fernlicht
