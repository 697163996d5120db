// Ground beyond the terrain beside the roads, so that by day no sky is seen below the horizon.
#pragma once

#include "scenarios/values/scene.h"

namespace fernlicht {

/// Adds level tiles of terrain's reflectance below all that the scene has, half a metre under its lowest point and 2.5 km farther than it
/// reaches. They are seen and lit, stand in no light's way and in no map. Nothing for an empty scene.
void add_far_ground(Scene& scene);

} // namespace fernlicht
