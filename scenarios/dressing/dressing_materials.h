// What dressed scenery is made of: reflectances with their sources (docs/scenery.md), pictures by formula, and what seeds decide.
#pragma once

#include "scenarios/values/scene.h"

#include <string_view>

namespace fernlicht {

/// Positions in dressing_materials().
enum class Stuff : std::uint32_t {
    white_plaster,
    ochre_plaster,
    grey_plaster,
    rose_plaster,
    brick,
    plinth,
    red_tiles,
    dark_tiles,
    white_frame,
    glass,
    curtain,
    room,
    door,
    shutter,
    wood,
    bark,
    leaves,
    dry_leaves,
    needles,
    hedge,
    grass,
    zinc,
    blind,
    net,
    sheet_white,
    sheet_yellow,
    sheet_red,
    sheet_blue,
    sheet_black,
    sign_back,
    meadow,
    gravel,
    stubble,
    soil,
    patch,
    old_patch,
    seam,
    iron,
    lid,
    crossing,
    ditch,
    count
};

constexpr std::uint32_t index_of(Stuff stuff) { return static_cast<std::uint32_t>(stuff); }

/// By Stuff. Without pictures: reflectances are the means.
std::vector<Material> dressing_materials();

/// Adds them to the scene and returns the place of the first. `textures`: with pictures of plaster, brick, tiles, bark, leaves and ground,
/// of road_texture_px, whose mean reflectances are the materials'. What lies on the road is as the scene's asphalt and paint, darker or
/// lighter; without those, as road_materials() has them. The same seed gives the same bytes.
std::uint32_t add_dressing_materials(Scene& scene, bool textures, std::uint64_t seed);

/// Draws by SplitMix64 (Steele, Lea, Flood 2014): the same on every machine. Compilers order the arguments of a call as they like: two
/// draws go into variables.
class Dice {
  public:
    /// What is drawn for `name` with one seed is independent of what is drawn for another.
    Dice(std::uint64_t seed, std::string_view name);
    /// Uniform in [0, 1).
    double share();
    double between(double low, double high) { return low + (high - low) * share(); }
    /// 0 .. count - 1.
    std::size_t of(std::size_t count) { return static_cast<std::size_t>(share() * static_cast<double>(count)); }

    /// Dice of their own: how often they are thrown changes nothing here.
    Dice fork() { return Dice(static_cast<std::uint64_t>(share() * 0x1.0p53), "fork"); }

  private:
    std::uint64_t state_;
};

} // namespace fernlicht
