// Whether a model's materials can be what they claim: reflectance, emission.
#pragma once

#include "scenarios/models/model.h"

namespace fernlicht {

/// Y of linear sRGB.
double luminance_of(const glm::dvec3& rgb);

/// Mean luminance reflectance of the material under white light, 0..1, with its picture.
double mean_reflectance(const Model& model, const Material& material);

/// Share of light from straight ahead that retroreflection returns: 2 pi times the integral over the hemisphere of
/// retro_rl exp(-(a - reference) / falloff) cos a sin a da.
double returned_share(const Material& material);

/// Adds to the model's doubts what its materials' figures say, sorts them by material, and notes the names of those that have any.
void add_doubts(Model& model);

} // namespace fernlicht
