#include "renderer/reference/surface_response.h"

#include "scenarios/light/retro_tint.h"
#include "scenarios/photometry.h"

#include <cmath>

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
                             retro_tint(material)};
    if (material.texture < 0)
        return response;
    const glm::dvec4 texel = texel_at(scene.textures[static_cast<std::size_t>(material.texture)], hit.uv);
    const glm::dvec3 own = response.albedo;
    response.albedo =
        photometry::combined_reflectance(static_cast<int>(material.texture_mode), own, texel, glm::dvec3(material.blend_colour));
    response.retro_rl = photometry::textured_rl(response.retro_rl, own, response.albedo);
    return response;
}

} // namespace fernlicht::reference
