// What each simplification of the published techniques costs by itself, from the formulas in double precision: the right equation with one
// thing changed, on points of the road's own triangles.
#pragma once

#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/play/stage.h"

namespace fernlicht {

/// In the table's order: no cosine; 1 + d^2 for d^2; 1 + d for d^2; one lamp's distance for all; distance from the triangle's vertices;
/// beam textures of the founding thesis's size in float and in its 8 bits; and what as-published `full` has of these together. The distance
/// from the vertices depends on how the road is cut into triangles. Errors of illuminance by lamps without shadows on the carriageway up to
/// 120 m around the car, at points spread evenly over its area (pictures: indices of the moments; pixels: no places).
std::vector<Simplification> price_simplifications(const Stage& stage, const std::vector<Moment>& moments);

} // namespace fernlicht
