// A model in a drive: which file, where, how large.
#pragma once

#include "scenarios/models/model.h"

#include <memory>

namespace fernlicht {

class Route;

struct PlacedModel {
    std::filesystem::path file;
    std::shared_ptr<const Model> model;
    bool along_route = false;
    /// In the world: x, y, z. Along the route: distance from its start, to the left of the own lane's centre, above the surface.
    glm::dvec3 position_m{0.0};
    double yaw_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0; ///< against the world's axes, or the route's there
    double scale = 1.0;                                    ///< > 0
    bool ground = false;                                   ///< it is ground, and stands in maps
};

/// Adds the model's meshes, materials and textures to the scene, turned and moved to `pose` and scaled. Surfaces become `kind`.
/// Sizes of textures are left to unify_texture_sizes().
void add_model(Scene& scene, const Model& model, const Pose& pose, double scale, SurfaceKind kind);

/// A drive's scenery, each model where the drive puts it; then one size for all textures.
void add_scenery(Scene& scene, const std::vector<PlacedModel>& scenery, const Route& route);

} // namespace fernlicht
