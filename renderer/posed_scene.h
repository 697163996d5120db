// A scene with its bodies where a moment has them, for what knows nothing of bodies.
#pragma once

#include "scenarios/drives/play/moment.h"
#include "scenarios/values/scene.h"

namespace fernlicht {

/// A copy in which every mesh stands in the world. Meshes of bodies that are not visible, or not among `bodies`, are empty; numbers of
/// meshes stay.
Scene posed_scene(const Scene& scene, const std::vector<Body>& bodies);

} // namespace fernlicht
