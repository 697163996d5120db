#include "scenarios/models/material_doubts.h"

#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// Fresh snow and magnesium oxide reflect 0.9 and more, white paint 0.8 to 0.85.
constexpr double lightest = 0.9;
/// Soot and black cloth; asphalt has 0.07, black paint and rubber 0.03 to 0.05.
constexpr double darkest = 0.02;
/// The most that CIE 150:2017 (table 5) lets a sign have in a city's centre, zone E4.
constexpr double brightest_cdm2 = 1000.0;
constexpr std::size_t named_at_most = 6;

glm::dvec3 mean_texel(const SurfaceTexture& texture) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i + 3 < texture.rgba.size(); i += 4)
        sum += glm::dvec3(texture.rgba[i], texture.rgba[i + 1], texture.rgba[i + 2]) / 255.0;
    const std::size_t texels = std::max<std::size_t>(texture.rgba.size() / 4, 1);
    return sum / static_cast<double>(texels);
}

} // namespace

double luminance_of(const glm::dvec3& rgb) { return 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b; }

double mean_reflectance(const Model& model, const Material& material) {
    const glm::dvec3 own(material.albedo);
    return luminance_of(material.texture < 0 ? own : own * mean_texel(model.textures[static_cast<std::size_t>(material.texture)]));
}

double returned_share(const Material& m) {
    const double f = static_cast<double>(m.retro_falloff_rad), peak = std::exp(static_cast<double>(m.retro_reference_rad) / f);
    return static_cast<double>(m.retro_rl) * peak * 2.0 * pi * f * f / (1.0 + 4.0 * f * f) * (1.0 + std::exp(-0.5 * pi / f));
}

void add_doubts(Model& model) {
    for (std::uint32_t i = 0; i < model.materials.size(); ++i) {
        const Material& m = model.materials[i];
        const auto doubt = [&](std::string text) { model.doubts.push_back({i, std::move(text)}); };
        const double diffuse = mean_reflectance(model, m), returned = returned_share(m),
                     emitted = luminance_of(glm::dvec3(m.emission_cdm2));
        if (diffuse > lightest)
            doubt(fmt::format("reflects {:.2f}: white paint has 0.85", diffuse));
        else if (diffuse + returned > 1.0)
            doubt(fmt::format("reflects {:.2f} diffusely and returns {:.2f} towards the lamp, more than all", diffuse, returned));
        if (diffuse < darkest && emitted == 0.0)
            doubt(fmt::format("reflects {:.3f}: black paint and rubber have 0.03 to 0.05", diffuse));
        if (emitted > brightest_cdm2)
            doubt(fmt::format("shines with {:.0f} cd/m2: a lit sign has at most {:.0f} (CIE 150, zone E4)", emitted, brightest_cdm2));
    }
    std::ranges::stable_sort(model.doubts, {}, &MaterialDoubt::material);
    std::string names;
    std::size_t count = 0;
    for (std::size_t i = 0; i < model.doubts.size(); ++i)
        if ((i == 0 || model.doubts[i].material != model.doubts[i - 1].material) && ++count <= named_at_most)
            names += (count > 1 ? ", " : "") + model.materials[model.doubts[i].material].name;
    if (count > named_at_most)
        names += fmt::format(" and {} more", count - named_at_most);
    if (count > 0)
        model.notes.push_back(fmt::format("reflectance or emission is doubtful of {}: `fernlicht model` says why", names));
}

} // namespace fernlicht
