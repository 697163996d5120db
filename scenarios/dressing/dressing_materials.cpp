#include "scenarios/dressing/dressing_materials.h"

#include "scenarios/roads/mesh/mesh_materials.h"
#include "scenarios/roads/mesh/road_mesh.h"
#include "scenarios/values/mixed_bits.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fernlicht {
namespace {

using Tone = std::array<double, 3>; ///< a texel's tone in R, G, B

/// A picture to modulate with: each channel's mean is `level` of 255 to within half a step, `tone(x, y, u, v)` its shape.
template <class At> SurfaceTexture toned_picture(const char* name, double level, const At& tone) {
    constexpr int px = road_texture_px;
    std::vector<Tone> rows;
    Tone sum{};
    for (int y = 0; y < px; ++y)
        for (int x = 0; x < px; ++x) {
            Tone row = tone(x, y, (x + 0.5) / px, (y + 0.5) / px);
            for (std::size_t c = 0; c < 3; ++c) {
                row[c] = std::max(row[c], 0.0);
                sum[c] += row[c];
            }
            rows.push_back(row);
        }
    SurfaceTexture texture{name, px, px, {}};
    for (const Tone& row : rows) {
        for (std::size_t c = 0; c < 3; ++c)
            texture.rgba.push_back(
                static_cast<std::uint8_t>(std::clamp(row[c] * level * static_cast<double>(rows.size()) / sum[c] + 0.5, 0.0, 255.0)));
        texture.rgba.push_back(255);
    }
    return texture;
}

Tone grey_tone(double tone) { return {tone, tone, tone}; }

/// Roughcast: fine grain, and the streaks that rain leaves below sills and eaves.
SurfaceTexture plaster_picture(std::uint64_t seed) {
    TilingNoise grain(seed, 41), stains(seed, 42), streaks(seed, 43);
    return toned_picture("plaster", 200.0, [&](int x, int y, double u, double v) {
        return grey_tone(1.0 + 0.10 * (grain.uniform(x, y) - 0.5) + 0.07 * stains.octaves(u, v, 8, 4, 0.9) +
                         0.06 * streaks.gradient(u, std::fmod(v * 0.125, 1.0), 64));
    });
}

/// Courses of 83 mm in stretcher bond (12 to the metre, 4 bricks to the metre), each brick of its own tone.
SurfaceTexture brick_picture(std::uint64_t seed) {
    const TilingNoise bricks(seed, 51);
    return toned_picture("brick", 140.0, [&](int, int, double u, double v) {
        const double course = v * 96.0, along = u * 32.0 + 0.5 * std::fmod(std::floor(course), 2.0);
        const bool joint = course - std::floor(course) < 0.16 || along - std::floor(along) < 0.06;
        const double own = bricks.uniform(static_cast<int>(along) % 32, static_cast<int>(course));
        const double tone = joint ? 1.25 : 0.75 + 0.5 * own;
        return Tone{tone * (joint ? 0.9 : 1.0), tone, tone * (joint ? 1.15 : 1.0)};
    });
}

/// Rows of interlocking tiles, 0.25 m wide and 0.33 m high, dark where one lies over the next.
SurfaceTexture tile_picture(std::uint64_t seed) {
    TilingNoise tiles(seed, 61), moss(seed, 62), grain(seed, 63);
    return toned_picture("tiles", 150.0, [&](int x, int y, double u, double v) {
        const double row = v * 24.0, column = u * 32.0, up = row - std::floor(row), side = column - std::floor(column);
        double tone = 0.85 + 0.35 * tiles.uniform(static_cast<int>(column), static_cast<int>(row)) + 0.15 * moss.octaves(u, v, 8, 3, 0.9);
        tone *= up < 0.18 ? 0.45 : 1.0;
        return grey_tone(tone * (0.82 + 0.36 * std::sin(pi * side)) + 0.06 * grain.uniform(x, y));
    });
}

/// Furrows along the trunk.
SurfaceTexture bark_picture(std::uint64_t seed) {
    TilingNoise furrows(seed, 71), plates(seed, 72), grain(seed, 73);
    return toned_picture("bark", 130.0, [&](int x, int y, double u, double v) {
        const double deep = std::abs(furrows.gradient(u, std::fmod(v * 0.25, 1.0), 64)) + 0.5 * std::abs(plates.gradient(u, v, 32));
        return grey_tone(0.45 + 2.2 * deep + 0.3 * (grain.uniform(x, y) - 0.5));
    });
}

/// Leaves of some 8 cm with dark gaps between them: what is bright lies in front, what is dark is the crown's inside.
SurfaceTexture leaf_picture(std::uint64_t seed) {
    TilingNoise leaves(seed, 81), twigs(seed, 82), grain(seed, 83), hue(seed, 84);
    return toned_picture("leaves", 90.0, [&](int x, int y, double u, double v) {
        const double cover = 1.1 * leaves.gradient(u, v, 96) + 0.7 * twigs.gradient(u, v, 40) + 0.5 * (grain.uniform(x, y) - 0.5);
        const double tone = std::clamp(0.75 + 2.2 * cover, 0.12, 2.4), dry = 0.2 * hue.octaves(u, v, 16, 3, 1.0);
        return Tone{tone * (1.0 + dry), tone, tone * (1.0 - dry)};
    });
}

/// Tufts seen from their sides: bright where blades stand, dark between them.
SurfaceTexture meadow_picture(std::uint64_t seed) {
    TilingNoise tufts(seed, 91), blades(seed, 92), grain(seed, 93), hue(seed, 94);
    return toned_picture("meadow", 100.0, [&](int x, int y, double u, double v) {
        const double tone =
                         0.8 + 0.9 * tufts.octaves(u, v, 24, 3, 0.8) + 0.8 * blades.gradient(u, v, 96) + 0.5 * (grain.uniform(x, y) - 0.5),
                     dry = 0.35 * hue.octaves(u, v, 8, 4, 0.9);
        return Tone{std::max(tone, 0.15) * (1.0 + dry), std::max(tone, 0.15), std::max(tone, 0.15) * (1.0 - dry)};
    });
}

/// Gravel with grass in it, as road shoulders are: the grass greener and darker than the stones.
SurfaceTexture gravel_picture(std::uint64_t seed) {
    TilingNoise stones(seed, 101), tufts(seed, 102), sand(seed, 103);
    return toned_picture("gravel", 130.0, [&](int x, int y, double u, double v) {
        const double grass = std::clamp(0.4 + 3.5 * tufts.octaves(u, v, 16, 4, 0.8), 0.0, 1.0);
        const double tone = 1.0 + 0.7 * (stones.uniform(x, y) - 0.5) + 0.2 * sand.octaves(u, v, 8, 3, 0.9) - 0.3 * grass;
        return Tone{tone * (1.0 - 0.25 * grass), tone * (1.0 + 0.10 * grass), tone * (1.0 - 0.45 * grass)};
    });
}

/// Rows, 0.25 m apart.
SurfaceTexture field_picture(std::uint64_t seed) {
    TilingNoise clods(seed, 111), grain(seed, 112);
    return toned_picture("field", 120.0, [&](int x, int y, double u, double v) {
        const double rows = std::sin(2.0 * pi * (32.0 * v + 0.5 * clods.gradient(u, v, 32)));
        return grey_tone(1.0 + 0.35 * rows + 0.35 * clods.octaves(u, v, 16, 4, 0.9) + 0.4 * (grain.uniform(x, y) - 0.5));
    });
}

enum class StuffPicture { plaster, brick, tiles, bark, leaves, meadow, gravel, field };

struct DressedStuff {
    Stuff stuff;
    const char* name;
    glm::vec3 reflectance;
    int picture = -1; ///< StuffPicture
    SurfaceKind kind = SurfaceKind::object;
    float retro = 0.0F; ///< cd/(m2 lx) at 20' from sheeting, at 1.05 degrees from the ground
    glm::vec3 retro_rgb{1.0F};
};

constexpr int layer_of(StuffPicture picture) { return static_cast<int>(picture); }

/// Sources: docs/scenery.md, by the same names.
const std::array<DressedStuff, index_of(Stuff::count)> dressed_stuff{{
    {Stuff::white_plaster, "white plaster", {0.57F, 0.55F, 0.50F}, layer_of(StuffPicture::plaster)},
    {Stuff::ochre_plaster, "ochre plaster", {0.50F, 0.38F, 0.20F}, layer_of(StuffPicture::plaster)},
    {Stuff::grey_plaster, "grey plaster", {0.33F, 0.33F, 0.32F}, layer_of(StuffPicture::plaster)},
    {Stuff::rose_plaster, "rose plaster", {0.48F, 0.33F, 0.27F}, layer_of(StuffPicture::plaster)},
    {Stuff::brick, "brick", {0.33F, 0.14F, 0.09F}, layer_of(StuffPicture::brick)},
    {Stuff::plinth, "plinth", {0.27F, 0.27F, 0.26F}, layer_of(StuffPicture::plaster)},
    {Stuff::red_tiles, "red tiles", {0.30F, 0.13F, 0.08F}, layer_of(StuffPicture::tiles)},
    {Stuff::dark_tiles, "dark tiles", {0.08F, 0.08F, 0.085F}, layer_of(StuffPicture::tiles)},
    {Stuff::white_frame, "window frame", {0.55F, 0.55F, 0.54F}},
    {Stuff::glass, "window", {0.07F, 0.07F, 0.07F}},
    {Stuff::curtain, "lit curtain", {0.30F, 0.30F, 0.28F}},
    {Stuff::room, "lit room", {0.07F, 0.07F, 0.07F}},
    {Stuff::door, "door", {0.11F, 0.06F, 0.035F}},
    {Stuff::shutter, "shutter", {0.05F, 0.09F, 0.06F}},
    {Stuff::wood, "wood", {0.24F, 0.20F, 0.15F}},
    {Stuff::bark, "bark", {0.12F, 0.09F, 0.06F}, layer_of(StuffPicture::bark)},
    {Stuff::leaves, "leaves", {0.078F, 0.113F, 0.043F}, layer_of(StuffPicture::leaves)},
    {Stuff::dry_leaves, "dry leaves", {0.145F, 0.120F, 0.045F}, layer_of(StuffPicture::leaves)},
    {Stuff::needles, "needles", {0.038F, 0.056F, 0.030F}, layer_of(StuffPicture::leaves)},
    {Stuff::hedge, "hedge", {0.064F, 0.089F, 0.036F}, layer_of(StuffPicture::leaves)},
    {Stuff::grass, "tall grass", {0.125F, 0.125F, 0.060F}, -1, SurfaceKind::object, 0.022F, {0.95F, 1.0F, 0.45F}},
    {Stuff::zinc, "zinc", {0.30F, 0.30F, 0.30F}},
    {Stuff::blind, "blind", {0.40F, 0.39F, 0.36F}},
    {Stuff::net, "curtain", {0.20F, 0.20F, 0.19F}},
    {Stuff::sheet_white, "white sheeting", glm::vec3(0.40F), -1, SurfaceKind::board, 180.0F},
    {Stuff::sheet_yellow, "yellow sheeting", {0.36F, 0.24F, 0.005F}, -1, SurfaceKind::board, 120.0F, {1.0F, 0.68F, 0.0F}},
    {Stuff::sheet_red, "red sheeting", {0.18F, 0.015F, 0.015F}, -1, SurfaceKind::board, 25.0F, {1.0F, 0.0F, 0.0F}},
    {Stuff::sheet_blue, "blue sheeting", {0.005F, 0.03F, 0.20F}, -1, SurfaceKind::board, 14.0F, {0.0F, 0.15F, 1.0F}},
    {Stuff::sheet_black, "black film", glm::vec3(0.03F), -1, SurfaceKind::board},
    {Stuff::sign_back, "sign's back", glm::vec3(0.20F)},
    {Stuff::meadow, "meadow", {0.120F, 0.125F, 0.060F}, layer_of(StuffPicture::meadow), SurfaceKind::terrain, 0.020F, {0.95F, 1.0F, 0.5F}},
    {Stuff::gravel, "gravel", {0.165F, 0.155F, 0.120F}, layer_of(StuffPicture::gravel), SurfaceKind::verge, 0.012F, {1.0F, 0.96F, 0.75F}},
    {Stuff::stubble, "stubble", {0.23F, 0.18F, 0.10F}, layer_of(StuffPicture::field), SurfaceKind::terrain, 0.020F, {1.0F, 0.8F, 0.45F}},
    {Stuff::soil, "soil", {0.13F, 0.095F, 0.065F}, layer_of(StuffPicture::field), SurfaceKind::terrain, 0.006F, {1.0F, 0.75F, 0.5F}},
    {Stuff::patch, "new patch", glm::vec3(0.05F)},
    {Stuff::old_patch, "old patch", glm::vec3(0.10F)},
    {Stuff::seam, "bitumen", glm::vec3(0.04F)},
    {Stuff::iron, "iron", glm::vec3(0.06F)},
    {Stuff::lid, "lid", glm::vec3(0.20F)},
    {Stuff::crossing, "crossing", glm::vec3(0.50F)},
    {Stuff::ditch, "ditch", {0.120F, 0.125F, 0.060F}, layer_of(StuffPicture::meadow), SurfaceKind::object, 0.020F, {0.95F, 1.0F, 0.5F}},
}};

/// By RA2's values for white, as the plain board: a few per cent of 20' are left at 2 degrees.
constexpr double sheeting_falloff_deg = 0.45, sheeting_reference_deg = 20.0 / 60.0;
/// Leaves hide the shadows that they cast as long as eye and lamp see them from within some degrees of one another.
constexpr double ground_falloff_deg = 7.0, ground_reference_deg = 1.05;

/// What lies on the road returns light as the road does, as much more or less of it as it is lighter or darker.
Material as_road(const Scene& scene, RoadMaterial road, const char* name, double reflectance) {
    const Material plain = road_materials()[index_of(road)];
    Material material = scene.materials.size() > index_of(road) ? scene.materials[index_of(road)] : plain;
    const float share = static_cast<float>(reflectance) / plain.albedo.g;
    material.name = name;
    material.albedo *= share;
    material.retro_rl *= share;
    return material;
}

/// Of luminance 1: a black body of 2700 K, x 0.4599, y 0.4106 (CIE 15), in linear sRGB.
const glm::vec3 light_of_2700_k{1.935F, 0.804F, 0.192F};

} // namespace

std::vector<Material> dressing_materials() {
    std::vector<Material> all;
    for (const DressedStuff& row : dressed_stuff) {
        const bool ground = is_ground(row.kind) || row.stuff == Stuff::grass || row.stuff == Stuff::ditch;
        all.push_back({.name = row.name,
                       .kind = row.kind,
                       .albedo = row.reflectance,
                       .retro_rl = row.retro,
                       .retro_reference_rad = static_cast<float>(radians(ground ? ground_reference_deg : sheeting_reference_deg)),
                       .retro_falloff_rad = static_cast<float>(radians(ground ? ground_falloff_deg : sheeting_falloff_deg)),
                       .retro_rgb = row.retro_rgb});
    }
    // A living room of 100 lx with walls of 0.5: 100 * 0.5 / pi = 16 cd/m2, through glass of 0.8 and, where drawn, a curtain of 0.25.
    all[index_of(Stuff::room)].emission_cdm2 = 12.73F * light_of_2700_k;
    all[index_of(Stuff::curtain)].emission_cdm2 = 3.18F * light_of_2700_k;
    return all;
}

std::uint32_t add_dressing_materials(Scene& scene, bool textures, std::uint64_t seed) {
    const auto first = static_cast<std::uint32_t>(scene.materials.size());
    std::vector<Material> all = dressing_materials();
    if (textures) {
        const auto layer = static_cast<int>(scene.textures.size());
        for (SurfaceTexture (*make)(std::uint64_t) :
             {plaster_picture, brick_picture, tile_picture, bark_picture, leaf_picture, meadow_picture, gravel_picture, field_picture})
            scene.textures.push_back(make(seed));
        for (std::size_t i = 0; i < all.size(); ++i)
            if (dressed_stuff[i].picture >= 0) {
                all[i].texture = layer + dressed_stuff[i].picture;
                const SurfaceTexture& texture = scene.textures[static_cast<std::size_t>(all[i].texture)];
                const glm::vec3 mean(mean_reflectance(texture, TextureMode::modulate, glm::dvec3(1.0), glm::dvec3(0.0)));
                all[i].albedo /= mean;
                all[i].retro_rl /= mean.g; // it goes with the picture's luminance
            }
    }
    for (const Stuff stuff : {Stuff::patch, Stuff::old_patch, Stuff::seam, Stuff::iron, Stuff::lid})
        all[index_of(stuff)] =
            as_road(scene, RoadMaterial::asphalt, dressed_stuff[index_of(stuff)].name, dressed_stuff[index_of(stuff)].reflectance.g);
    all[index_of(Stuff::crossing)] = as_road(scene, RoadMaterial::marking_white, "crossing", 0.50);
    scene.materials.insert(scene.materials.end(), all.begin(), all.end());
    return first;
}

Dice::Dice(std::uint64_t seed, std::string_view name) : state_(0xCBF29CE484222325ULL ^ (seed * mixing_step)) {
    for (const char c : name) // FNV-1a (Fowler, Noll, Vo)
        state_ = (state_ ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
}

double Dice::share() { return static_cast<double>(next_mixed(state_) >> 11) * 0x1.0p-53; }

} // namespace fernlicht
