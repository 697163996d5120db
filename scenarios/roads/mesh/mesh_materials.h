// The materials of a road scene, and which one a lane, a mark or an object has.
// Pictures for the surfaces of a road scene, drawn by formula.
// Noise on a square that repeats: for textures without seams. Whole-number hashes and the four basic operations only, so that the
// same seed gives the same bits on every machine.
#pragma once

#include "scenarios/roads/road_network.h"
#include "scenarios/roads/road_surface.h"
#include "scenarios/values/scene.h"

#include <cstdint>
#include <map>
#include <vector>

namespace fernlicht {

/// Positions in road_materials().
enum class RoadMaterial : std::uint32_t {
    asphalt,
    concrete,
    kerb,
    marking_white,
    marking_yellow,
    verge,
    terrain,
    board,
    board_back,
    post,
    delineator,
    object,
    trunk,
    leaves,
    count
};

constexpr std::uint32_t index_of(RoadMaterial material) { return static_cast<std::uint32_t>(material); }

/// What lanes are paved with; with wheel tracks the mean across a lane.
const Material& pavement_material(Pavement pavement);

/// How far tyres have polished a lane, from 0 to track_levels - 1; materials beyond RoadMaterial::count.
inline constexpr int track_levels = 5;
constexpr RoadMaterial track_material(int level) {
    return static_cast<RoadMaterial>(index_of(RoadMaterial::count) + static_cast<std::uint32_t>(level));
}
/// Asphalt, polished or not.
constexpr bool is_asphalt(RoadMaterial material) { return material == RoadMaterial::asphalt || material >= RoadMaterial::count; }

/// Where the polish of a lane changes its level: m from its middle, and the level from there on to the left.
struct TrackBorder {
    double from_middle_m = 0.0;
    int level = 0;
};
/// From right to left; the bare lane lies beyond both ends. Tyres run 0.75 m beside the lane's middle, with a standard deviation of 0.254 m
/// (NCHRP 1-37A's wander of 10 inches); the polish goes as their density, in steps of a quarter of its peak.
const std::vector<TrackBorder>& track_borders();

/// What a lane of this OpenDRIVE type is made of. Types that are not known are asphalt: something to drive on.
RoadMaterial lane_material(const std::string& lane_type);
/// Yellow and orange paint is yellow, all other colours are white: no other mark has a coefficient of its own in EN 1436.
RoadMaterial marking_material(const std::string& colour);

/// Texels along each side of every texture here. With mesh_builder.h's texture_repeat_m that is 31 mm a texel.
constexpr int road_texture_px = 256;

/// asphalt (mean level 128), concrete (190) and grass (112 of 255) are to modulate: R, G and B each have exactly that mean, so that no
/// mipmap needs to round it. paint-wear is a decal: the colour of bare asphalt everywhere, opaque where paint is gone; as the colour
/// does not vary, averaging it apart from the opacity, as mipmaps do, averages the reflectance. All repeat without a seam, and averages
/// over 0.5 m of the first three differ by 2 to 6 % (rms): from afar nothing shows the repetition. The same seed gives the same bytes.
std::vector<SurfaceTexture> road_textures(std::uint64_t seed);

/// Mean reflectance of a surface of colour `own` under the texture. `blend_colour` counts for blend only.
glm::dvec3 mean_reflectance(const SurfaceTexture& texture, TextureMode mode, const glm::dvec3& own, const glm::dvec3& blend_colour);

/// Gives the materials of build_scene (road_materials(), with the same surface) their textures: asphalt; concrete and objects; verge and
/// terrain; both kinds of paint. Albedo and retro_rl become such that their means over a repetition are what they were.
void add_road_textures(Scene& scene, std::uint64_t seed);

/// Remembers what it has drawn: one thread at a time.
class TilingNoise {
  public:
    /// `stream` tells apart what is drawn with one seed.
    TilingNoise(std::uint64_t seed, std::uint64_t stream);

    /// Uniform in [0, 1), independent for each pair of whole numbers.
    double uniform(int x, int y) const;
    /// Gradient noise (Perlin 1985) of `cells` x `cells` cells over the square u, v in [0, 1); smooth, repeats beyond it. Its mean is near
    /// 0, it lies within -1 .. 1, and it has little at wavelengths much longer than a cell. `cells` >= 1.
    double gradient(double u, double v, int cells);
    /// gradient() at `cells`, 2 `cells`, 4 `cells` ..., each octave `gain` as strong as the one before.
    double octaves(double u, double v, int cells, int count, double gain);

  private:
    std::uint64_t key_;
    std::map<int, std::vector<glm::dvec2>> lattices_; ///< gradients at the corners of so many cells, row by row
};

} // namespace fernlicht
