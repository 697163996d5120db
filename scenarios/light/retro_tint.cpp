#include "scenarios/light/retro_tint.h"

#include "scenarios/lamps/mounted_lamp.h"

#include <glm/geometric.hpp>

namespace fernlicht {

glm::dvec3 retro_tint(const Material& material) {
    static const glm::dvec3 illuminant_a = colour_of_temperature(2856.0).linear_srgb;
    if (!is_tinted(material))
        return glm::dvec3(1.0);
    const glm::dvec3 rgb(material.retro_rgb);
    return rgb / glm::dot(glm::dvec3(0.2126, 0.7152, 0.0722), illuminant_a * rgb);
}

} // namespace fernlicht
