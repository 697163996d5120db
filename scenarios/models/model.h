// A model of a car or of scenery: triangles, materials and the places of its lamps, read from a file of another tool.
// A model as a glTF 2.0 file in one piece.
// Pictures of models on their way into a scene: linear, powers of two, one size for all.
// A model in a drive: which file, where, how large.
#pragma once

#include "scenarios/values/files.h"
#include "scenarios/values/scene.h"

#include <filesystem>
#include <memory>

namespace fernlicht {

/// A place on a model where a lamp can be: "lamp.low.left". Frame: x forward along the beam axis, y left, z up.
struct Mount {
    std::string name;
    Pose pose; ///< in the model's frame

    bool operator==(const Mount&) const = default;
};

/// What a material claims that no surface, or hardly any, does; one clause.
struct MaterialDoubt {
    std::uint32_t material = 0;
    std::string text;
};

/// In the model's own frame: x forward, y left, z up, metres. For a car: on the road's surface under the rear axle.
struct Model {
    std::string name;
    std::vector<Material> materials;
    std::vector<SurfaceTexture> textures; ///< powers of two, at most max_texture_px to a side, each of its own size
    std::vector<Mesh> meshes;             ///< one, or one a cell of 64 m where the model is larger than 128 m
    std::vector<Mount> mounts;            ///< by name
    glm::dvec3 low_m{0.0}, high_m{0.0};   ///< the box round it
    std::vector<std::string> notes;       ///< what of the file was left out or changed, one sentence each
    std::vector<MaterialDoubt> doubts;    ///< by material
    FilesRead opened;

    std::size_t triangles() const;
};

inline constexpr int max_texture_px = 512;
inline constexpr std::size_t max_model_triangles = 4'000'000;
inline constexpr double farthest_model_m = 100'000.0; ///< coordinates of a model

/// Reads glTF 2.0 (.gltf, .glb), or 1.0 as far as it can be said in 2.0. The file's axes (y up, z forward) become ours. Nodes whose name
/// starts with "lamp." become mounts. Throws InputError with the way to the value (meshes[2].primitives[0].indices) for files that are
/// broken, that name files elsewhere than beside or below them, that need an extension which is not known, or that exceed the limits
/// above, 256 MiB a file, 256 pictures of 4096 x 4096 pixels.
Model read_model(const std::filesystem::path& path);

/// A position in glTF's axes (y up, z forward, x left) in ours.
inline glm::dvec3 from_gltf_axes(const glm::dvec3& v) { return {v.z, v.x, v.y}; }
inline glm::dvec3 to_gltf_axes(const glm::dvec3& v) { return {v.y, v.z, v.x}; }

/// A .glb that read_model reads back to the same triangles, colours, retroreflection and mounts. Pictures are written as they are given:
/// `pictures[i]` is the PNG or JPEG of Model::textures[i], empty to leave it out; fewer may be given than there are textures.
std::string glb_of(const Model& model, const std::vector<std::string>& pictures = {});

/// `rgba` of width x height texels, sRGB-encoded colours with linear opacity, made linear and brought to the powers of two nearest to its
/// sides, at most `max_px`. Means of reflectance are kept to the rounding of 8 bits. Sizes of at least 1.
SurfaceTexture surface_texture(std::string name, int width, int height, const std::vector<std::uint8_t>& rgba, int max_px);

/// Brings all textures of a scene to the largest width and height among them, by repeating texels: means and, from the first mipmap on,
/// what is looked up stay what they are. Nothing changes where they have one size already.
void unify_texture_sizes(Scene& scene);

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
