// One Scene feeds the rasteriser, the double-precision twin and the reference: what is there, without light or time.
#pragma once

#include "scenarios/values/pose.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace fernlicht {

enum class SurfaceKind : std::uint8_t { road, marking, verge, terrain, board, object, vehicle, target };

/// What maps show: the ground, and not what stands on it.
inline bool is_ground(SurfaceKind kind) {
    return kind == SurfaceKind::road || kind == SurfaceKind::marking || kind == SurfaceKind::verge || kind == SurfaceKind::terrain;
}

/// What rain puts a film of water on. Grass and upright things stay as they are.
inline bool gets_wet(SurfaceKind kind) { return kind == SurfaceKind::road || kind == SurfaceKind::marking; }
/// Roughness (GGX alpha) of that film on asphalt: 0.15, between a smooth road under standing water and a drained one. Ours, not measured.
inline constexpr double wet_roughness = 0.15;

/// How a texture's colour Ct and opacity At meet the material's own colour Cf, as OpenGL 1.x's texture environments name them (OpenGL 1.5,
/// table 3.22). modulate: Cf Ct. replace: Ct. decal: Cf (1 - At) + Ct At. blend: Cf (1 - Ct) + Cc Ct. What comes out is the reflectance.
/// Retroreflection goes with it: retro_rl is multiplied by the ratio of its luminance to the own colour's (photometry.glsl: textured_rl).
enum class TextureMode : std::uint8_t { modulate, replace, decal, blend };

/// A picture of reflectances that repeats in both directions. Rows from v = 0 up.
struct SurfaceTexture {
    std::string name;
    int width = 0, height = 0;      ///< powers of two; all textures of a scene have the same size
    std::vector<std::uint8_t> rgba; ///< 4 bytes a texel, 0..255 for 0..1, linear (no gamma); alpha is opacity
};

/// How a surface returns light. Diffuse: L = albedo E / pi. Retroreflecting: L = retro_rl * E_perp * falloff(observation angle), with
/// E_perp on a plane perpendicular to the light (EN 1436's R_L, CIE 54.2's R_A / cos(view angle)). Glossy, while dry: facets of GGX mirror
/// with Fresnel's share, which at grazing angles sends light on to an oncoming eye (photometry.glsl: facet_mirrored).
struct Material {
    std::string name;
    SurfaceKind kind = SurfaceKind::object;
    glm::vec3 albedo{0.2F};              ///< linear sRGB reflectances, each 0..1
    float retro_rl = 0.0F;               ///< cd/(m2 lx) at the reference observation angle; 0: no retroreflection
    float retro_reference_rad = 0.0183F; ///< observation angle (between light and eye, seen from the surface) at which retro_rl holds
    float retro_falloff_rad = 0.1F;      ///< retro part goes as exp(-(angle - reference) / falloff)
    glm::vec3 emission_cdm2{0.0F};       ///< luminance by its own light, linear sRGB with Y in cd/m2
    int texture = -1;                    ///< into Scene::textures; -1: none, the surface has its own colour everywhere
    TextureMode texture_mode = TextureMode::modulate;
    glm::vec3 blend_colour{0.0F}; ///< Cc, for blend only
    /// Share of light that a smooth surface mirrors, 0..1, with the albedo at most 1. Followed by rays alone; rasterised pictures leave it
    /// out.
    float mirror = 0.0F;
    float glass_index = 0.0F; ///< refractive index against air, >= 1, of a closed body without albedo; 0: opaque. By rays alone, too
    /// Colour that the retroreflected part has in white light, linear sRGB, each >= 0, not all 0; its size says nothing (light.h).
    glm::vec3 retro_rgb{1.0F};
    float gloss = 0.0F;           ///< share of the surface that facets cover, 0..1
    float gloss_roughness = 0.5F; ///< GGX alpha of them, > 0
    float retro_wet = 0.0F;       ///< share of retro_rl that is left under a film of water, 0..1

    bool operator==(const Material&) const = default;
};

struct Vertex {
    glm::vec3 position_m; ///< relative to the mesh's origin
    glm::vec3 normal;     ///< unit, on the lit side
    glm::vec2 uv{0.0F};   ///< texture coordinates; 1 is one repetition
};

/// A run of triangles of one material: `indices[first .. first + count)`.
struct Batch {
    std::uint32_t material = 0; ///< into Scene::materials
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// Triangles near one another (at most some 100 m across), single precision about a double-precision origin. Counter-clockwise
/// triangles face their normals. Small enough to be culled as a whole.
struct Mesh {
    std::string name; ///< "road 12", "board 44": what a report or an id image calls it
    glm::dvec3 origin_m{0.0};
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<Batch> batches;
    int body = -1;               ///< -1: stands in the world; else in the frame of Moment::bodies[body], with its origin, and moves with it
    bool casts = true;           ///< false: stands in no light's way
    bool closed = false;         ///< no view meets its faces from behind
    bool measured_alone = false; ///< ground that maps measure and views do not show, as over a ditch; casts nothing
    bool whole = false;          ///< its parts stand together, as leaves of a tree do: one box round it bounds it well enough
};

struct Scene {
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<SurfaceTexture> textures;
};

} // namespace fernlicht
