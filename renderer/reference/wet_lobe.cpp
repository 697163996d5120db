#include "renderer/reference/wet_lobe.h"

#include "renderer/reference/retro_lobe.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht::reference {

glm::dvec3 diffuse_reflectance(const glm::dvec3& albedo, double wetness, double cosine_in, double cosine_out) {
    if (wetness <= 0.0)
        return albedo;
    const double in = photometry::facet_cosine(std::max(cosine_in, 0.0), wet_roughness),
                 out = photometry::facet_cosine(std::max(cosine_out, 0.0), wet_roughness);
    glm::dvec3 wet;
    for (int i = 0; i < 3; ++i)
        wet[i] = photometry::wet_albedo(albedo[i], in, out);
    return (1.0 - wetness) * albedo + wetness * wet;
}

FilmSample sample_film(const glm::dvec3& normal, const glm::dvec3& out, const glm::dvec2& square) {
    const auto [u, v] = across(normal);
    const double c_out = glm::dot(normal, out);
    if (c_out <= 0.0)
        return {};
    // E. Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4), 2018: on the stretched hemisphere the facets seen are a
    // disc.
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(wet_roughness * glm::dot(u, out), wet_roughness * glm::dot(v, out), c_out));
    const auto [s, t] = across(stretched);
    const double radius = std::sqrt(square.x), turn = 2.0 * pi * square.y, upright = 0.5 * (1.0 + stretched.z);
    // `t` must lie on the side that the horizon cuts: the frame is turned so that `s` is level.
    glm::dvec3 level = glm::cross(glm::dvec3(0.0, 0.0, 1.0), stretched);
    const double slope = glm::length(level);
    level = slope > 1e-9 ? level / slope : s;
    const glm::dvec3 upwards = slope > 1e-9 ? glm::cross(stretched, level) : t;
    const double a = radius * std::cos(turn), full = radius * std::sin(turn),
                 b = (1.0 - upright) * std::sqrt(std::max(0.0, 1.0 - a * a)) + upright * full;
    const glm::dvec3 facet = a * level + b * upwards + std::sqrt(std::max(0.0, 1.0 - a * a - b * b)) * stretched;
    const glm::dvec3 h = glm::normalize(wet_roughness * (u * facet.x + v * facet.y) + normal * std::max(1e-12, facet.z));
    FilmSample sample;
    const double c_h = glm::dot(out, h);
    sample.direction = glm::normalize(2.0 * c_h * h - out);
    const double c_in = glm::dot(normal, sample.direction);
    if (c_in <= 0.0 || c_h <= 0.0)
        return sample;
    // Smith's correlated shadowing of both directions over that of one.
    const double a2 = wet_roughness * wet_roughness, root_out = std::sqrt(a2 + (1.0 - a2) * c_out * c_out),
                 root_in = std::sqrt(a2 + (1.0 - a2) * c_in * c_in);
    sample.weight = photometry::water_reflectance(std::min(c_h, 1.0)) * c_in * (c_out + root_out) / (c_out * root_in + c_in * root_out);
    return sample;
}

double film_share(const glm::dvec3& normal, const glm::dvec3& out) {
    return photometry::water_reflectance(photometry::facet_cosine(std::clamp(glm::dot(normal, out), 0.0, 1.0), wet_roughness));
}

} // namespace fernlicht::reference
