#include "renderer/reference/surface_response.h"

#include "renderer/reference/sampling.h"
#include "scenarios/light/light.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht::reference {
namespace {

/// Between which two texels a coordinate lies; sizes are powers of two, so that a mask wraps.
struct Between {
    std::size_t low, high;
    double share;
};

Between between(double coordinate, int size) {
    const double x = coordinate * size - 0.5, floor = std::floor(x);
    const auto mask = static_cast<std::int64_t>(size) - 1, low = static_cast<std::int64_t>(floor);
    return {static_cast<std::size_t>(low & mask), static_cast<std::size_t>((low + 1) & mask), x - floor};
}

} // namespace

glm::dvec4 texel_at(const SurfaceTexture& texture, const glm::dvec2& uv) {
    const Between x = between(uv.x, texture.width), y = between(uv.y, texture.height);
    const auto at = [&](std::size_t column, std::size_t row) {
        const std::uint8_t* t = &texture.rgba[4 * (row * static_cast<std::size_t>(texture.width) + column)];
        return glm::dvec4(t[0], t[1], t[2], t[3]);
    };
    const glm::dvec4 lower = at(x.low, y.low) * (1.0 - x.share) + at(x.high, y.low) * x.share,
                     upper = at(x.low, y.high) * (1.0 - x.share) + at(x.high, y.high) * x.share;
    return (lower * (1.0 - y.share) + upper * y.share) / 255.0;
}

SurfaceResponse response_at(const Scene& scene, const SurfaceHit& hit) {
    const Material& material = scene.materials[hit.material];
    SurfaceResponse response{glm::dvec3(material.albedo),
                             static_cast<double>(material.retro_rl),
                             static_cast<double>(material.retro_reference_rad),
                             1.0 / static_cast<double>(material.retro_falloff_rad),
                             glm::dvec3(material.emission_cdm2),
                             gets_wet(material.kind),
                             retro_tint(material),
                             facets_of(material),
                             static_cast<double>(material.retro_wet)};
    if (material.texture < 0)
        return response;
    const glm::dvec4 texel = texel_at(scene.textures[static_cast<std::size_t>(material.texture)], hit.uv);
    const glm::dvec3 own = response.albedo;
    response.albedo =
        photometry::combined_reflectance(static_cast<int>(material.texture_mode), own, texel, glm::dvec3(material.blend_colour));
    response.retro_rl = photometry::textured_rl(response.retro_rl, own, response.albedo);
    return response;
}

RetroLobe retro_lobe(const SurfaceResponse& response, double albedo) {
    if (response.retro_rl <= 0.0)
        return {};
    const double k = response.retro_inverse_falloff, at_zero = response.retro_rl * std::exp(response.retro_reference_rad * k),
                 most = std::max({response.retro_tint.r, response.retro_tint.g, response.retro_tint.b}),
                 sphere = most * 2.0 * pi * at_zero * (1.0 + std::exp(-k * pi)) / (1.0 + k * k),
                 scale = std::min(1.0, std::max(0.0, 1.0 - albedo) / sphere);
    return {scale * at_zero, k, scale * sphere};
}

double retro_times_cosine(const RetroLobe& lobe, double angle_rad, double cos_in, double cos_out) {
    return lobe.at_zero * std::exp(-angle_rad * lobe.k) * cos_in / std::max(cos_in, cos_out);
}

RetroSample sample_retro(const RetroLobe& lobe, const glm::dvec3& towards, const glm::dvec3& normal, const glm::dvec2& radial,
                         double around) {
    // The sum of two exponential variables has the density k^2 gamma exp(-k gamma).
    const double gamma = -(std::log(radial.x) + std::log(radial.y)) / lobe.k;
    if (gamma >= pi)
        return {};
    const auto [u, v] = across(towards);
    const double turn = 2.0 * pi * around;
    const glm::dvec3 direction = towards * std::cos(gamma) + (u * std::cos(turn) + v * std::sin(turn)) * std::sin(gamma);
    const double cos_in = glm::dot(normal, direction), cos_out = glm::dot(normal, towards);
    if (cos_in <= 0.0)
        return {};
    const double sine_ratio = gamma > 1e-9 ? std::sin(gamma) / gamma : 1.0;
    return {direction, lobe.at_zero * 2.0 * pi * sine_ratio / (lobe.k * lobe.k) * cos_in / std::max(cos_in, cos_out)};
}

Across across(const glm::dvec3& n) {
    const double sign = std::copysign(1.0, n.z), a = -1.0 / (sign + n.z), b = n.x * n.y * a;
    return {{1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}};
}

glm::dvec3 sample_cosine(const glm::dvec3& normal, const glm::dvec2& square) {
    const glm::dvec2 disc = on_disc(square);
    const auto [u, v] = across(normal);
    return u * disc.x + v * disc.y + normal * std::sqrt(std::max(0.0, 1.0 - disc.x * disc.x - disc.y * disc.y));
}

} // namespace fernlicht::reference
