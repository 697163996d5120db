#include "renderer/reference/retro_lobe.h"

#include "renderer/reference/sampling.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht::reference {

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
