// Luminance of a surface in the light of a moment's lamps, by the same equations as every picture (scenarios/photometry.glsl), in double.
#pragma once

#include "scenarios/drives/play/moment.h"
#include "scenarios/values/scene.h"

namespace fernlicht {

struct SurfaceLuminance {
    double photopic_cdm2 = 0.0;
    double scotopic_cdm2 = 0.0; ///< lamps alone, by their ratios S/P; of daylight nothing is known
};

/// Diffuse and retroreflected light of the material's own colour, without textures, whose mean it is. Luminance as of a grey of the same Y:
/// lamps' colours change it by what colour and surface have in common, which rendered pictures know. Sky included.
SurfaceLuminance surface_luminance(const Moment& moment, const glm::dvec3& point_m, const glm::dvec3& normal, const Material& material,
                                   const glm::dvec3& eye_m);

/// Y of a linear sRGB reflectance.
double reflectance_of(const glm::vec3& linear_srgb);

} // namespace fernlicht
