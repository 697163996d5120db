#include "scenarios/roads/mesh/mesh_materials.h"

#include "scenarios/photometry.h"
#include "scenarios/roads/mesh/road_mesh.h"
#include "scenarios/values/mixed_bits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace fernlicht {
namespace {

// EN 1436's 30 m geometry: light arrives 1.24 degrees and is seen 2.29 degrees above the surface [M], so 1.05 degrees between them.
constexpr double en1436_illumination_deg = 1.24;
constexpr double en1436_observation_deg = 2.29;

double luminance_of(const glm::vec3& rgb) { // Y of linear sRGB, IEC 61966-2-1
    return 0.2126 * static_cast<double>(rgb.r) + 0.7152 * static_cast<double>(rgb.g) + 0.0722 * static_cast<double>(rgb.b);
}

Material diffuse(const char* name, SurfaceKind kind, const glm::vec3& albedo) { return {.name = name, .kind = kind, .albedo = albedo}; }

glm::dvec3 raised_by(double degrees) { return {-std::cos(radians(degrees)), 0.0, std::sin(radians(degrees))}; }

/// A surface whose R_L in EN 1436's geometry is `total_mcd` (mcd/m2/lx) in all: the diffuse part has rho sin(1.24 deg) / pi of it,
/// since E on the surface is E_perp times that sine; the facets have their part, and the retroreflecting part has what is left.
Material road_surface(const char* name, SurfaceKind kind, const glm::vec3& albedo, double total_mcd, double gloss = 0.0,
                      double roughness = 0.5) {
    const double diffuse_rl = luminance_of(albedo) * std::sin(radians(en1436_illumination_deg)) / pi;
    const double facets_rl = gloss > 0.0
                                 ? gloss * photometry::facet_mirrored({0.0, 0.0, 1.0}, raised_by(en1436_illumination_deg),
                                                                      raised_by(en1436_observation_deg), roughness, photometry::facet_index)
                                 : 0.0;
    Material material = diffuse(name, kind, albedo);
    material.retro_rl = static_cast<float>(std::max(0.0, total_mcd * 1e-3 - diffuse_rl - facets_rl));
    material.retro_reference_rad = static_cast<float>(radians(en1436_observation_deg - en1436_illumination_deg));
    material.gloss = static_cast<float>(gloss);
    material.gloss_roughness = static_cast<float>(roughness);
    return material;
}

/// Gloss and roughness: fitted to the r-table (CIE 144:2001, dry, 1 degree of observation) by the logarithm, over light from up to 10
/// degrees beside the mirror's plane that falls on the road at 9.5 degrees or less (tan gamma 6 to 12); no neighbour fits better
/// (tests/scenarios/roads/mesh/road_surface_test.cpp). Exchanging light and eye, such a table says what an oncoming driver sees.
/// Albedo: r at tan gamma 0, where light falls straight down, less what the facets mirror there. R_L: worn as before; new asphalt at the
/// lower end of 10..20 [M].
Material pavement(Pavement which) {
    using enum Pavement;
    switch (which) {
    case asphalt_worn:
        return road_surface("asphalt", SurfaceKind::road, glm::vec3(0.077F), 15.0, 0.51, 0.44); // R3
    case asphalt_new:
        return road_surface("asphalt", SurfaceKind::road, glm::vec3(0.065F), 10.0, 0.65, 0.36); // R4
    case concrete:
        return road_surface("concrete-pavement", SurfaceKind::road, glm::vec3(0.192F), 20.0, 0.42, 0.54); // R1
    case standard:
        break;
    }
    // Dry asphalt 10..20 mcd/m2/lx [M]; rho 0.08 alone gives 0.55 of them.
    return road_surface("asphalt", SurfaceKind::road, glm::vec3(0.08F), 15.0);
}

/// EN 1436:2018 [M], mcd/(m2 lx), by class from 1: tables of R_L dry, R_L wet, Qd.
constexpr std::array<double, 5> r_classes{80.0, 100.0, 150.0, 200.0, 300.0};
constexpr std::array<double, 6> rw_classes{25.0, 35.0, 50.0, 75.0, 100.0, 150.0};
constexpr std::array<double, 5> q_classes{80.0, 100.0, 130.0, 160.0, 200.0};

/// Paint at the lower bound of its classes: Qd is its albedo over pi; wet, R_L is what the film leaves of the diffuse light, and beads.
Material paint(const char* name, const glm::vec3& hue, double of_class, const Markings& markings) {
    const auto figure = [of_class](const auto& classes, int number) { return of_class * classes.at(static_cast<std::size_t>(number - 1)); };
    const double albedo = 1e-3 * pi * figure(q_classes, markings.q_class);
    const glm::vec3 colour = hue * static_cast<float>(albedo / luminance_of(hue));
    Material material = road_surface(name, SurfaceKind::marking, colour, figure(r_classes, markings.r_class));
    if (markings.type == MarkingType::type_1)
        return material;
    const glm::dvec3 up(0.0, 0.0, 1.0), in = raised_by(en1436_illumination_deg), out = raised_by(en1436_observation_deg);
    const double film_rl = photometry::wet_mirrored(up, in, out, wet_roughness) +
                           in.z / pi *
                               photometry::wet_albedo(albedo, photometry::facet_cosine(in.z, wet_roughness),
                                                      photometry::facet_cosine(out.z, wet_roughness)),
                 beads_rl = 1e-3 * figure(rw_classes, markings.rw_class) - film_rl;
    material.retro_wet = static_cast<float>(std::clamp(beads_rl / static_cast<double>(material.retro_rl), 0.0, 1.0));
    return material;
}

/// Polish in quarters of its peak, at the middle of each step.
constexpr double polish_of(int level) { return level / (track_levels - 1.0); }
// What tyres do at the peak, against a lane between its tracks: estimates. They grind the texture that retroreflects and bare the stones.
constexpr double track_rl = -0.20, track_gloss = 0.50;
constexpr double tyres_beside_m = 0.75, tyres_wander_m = 0.254, common_lane_m = 3.5;

/// Mean polish of a lane 3.5 m wide.
double mean_polish() {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < track_borders().size(); ++i)
        sum += polish_of(track_borders()[i].level) * (track_borders()[i + 1].from_middle_m - track_borders()[i].from_middle_m);
    return sum / common_lane_m;
}

/// The mean over a lane of 3.5 m is the pavement itself.
Material polished(const Material& pavement, int level) {
    Material material = pavement;
    material.name = "asphalt-track-" + std::to_string(level);
    const auto changed = [&](float mean, double at_peak) {
        return static_cast<float>(static_cast<double>(mean) * (1.0 + at_peak * polish_of(level)) / (1.0 + at_peak * mean_polish()));
    };
    material.retro_rl = changed(pavement.retro_rl, track_rl);
    material.gloss = changed(pavement.gloss, track_gloss);
    return material;
}

/// Sheeting by its coefficient R' at an observation angle of 0.33 degrees (EN 12899-1's 20 minutes, entrance 5 degrees).
Material sheeting(const char* name, const glm::vec3& albedo, float ra) {
    Material material = diffuse(name, SurfaceKind::board, albedo);
    material.retro_rl = ra;
    material.retro_reference_rad = static_cast<float>(radians(0.33));
    // RA2 falls from 180 at 0.33 degrees to a few per cent of it at 2 degrees [M: EN 12899-1's tables]; one exponential through both.
    material.retro_falloff_rad = static_cast<float>(radians(0.45));
    return material;
}

} // namespace

std::vector<Material> road_materials(const RoadSurface& surface) {
    std::vector<Material> all(static_cast<std::size_t>(RoadMaterial::count));
    const auto set = [&](RoadMaterial which, Material material) { all[index_of(which)] = std::move(material); };
    using enum RoadMaterial;
    set(asphalt, pavement(surface.pavement));
    set(concrete, road_surface("concrete", SurfaceKind::road, glm::vec3(0.25F, 0.25F, 0.24F), 20.0)); // brighter than asphalt [M]
    set(kerb, road_surface("kerb", SurfaceKind::road, glm::vec3(0.30F), 20.0));                       // granite or concrete stone [M]
    // EN 1436 classes R2..R5 are 100, 150, 200, 300 [M]: white in service R3; yellow lies about a fifth lower.
    set(marking_white, road_surface("marking-white", SurfaceKind::marking, glm::vec3(0.50F), 150.0));
    set(marking_yellow, road_surface("marking-yellow", SurfaceKind::marking, glm::vec3(0.45F, 0.35F, 0.05F), 120.0));
    if (surface.markings.type != MarkingType::standard) {
        set(marking_white, paint("marking-white", glm::vec3(1.0F), 1.0, surface.markings));
        set(marking_yellow, paint("marking-yellow", glm::vec3(0.45F, 0.35F, 0.05F), 0.8, surface.markings));
    }
    // Grass: about 0.12 in the visible [M]; blades have a weak opposition peak, here 5 mcd/m2/lx [estimate].
    set(verge, road_surface("verge", SurfaceKind::verge, glm::vec3(0.105F, 0.130F, 0.060F), 5.0));
    set(terrain, road_surface("terrain", SurfaceKind::terrain, glm::vec3(0.105F, 0.130F, 0.060F), 5.0));
    // RA2: R' >= 180 cd/lx/m2 for white at 0.33 / 5 degrees [S: photometric class RA2 of EN 12899-1].
    set(board, sheeting("board", glm::vec3(0.40F), 180.0F));
    set(board_back, diffuse("board-back", SurfaceKind::object, glm::vec3(0.20F)));
    set(post, diffuse("post", SurfaceKind::object, glm::vec3(0.30F)));             // galvanised steel [estimate]
    set(delineator, diffuse("delineator", SurfaceKind::object, glm::vec3(0.70F))); // white plastic [estimate]
    set(object, diffuse("object", SurfaceKind::object, glm::vec3(0.30F)));
    set(trunk, diffuse("trunk", SurfaceKind::object, glm::vec3(0.12F, 0.09F, 0.06F)));   // bark [estimate]
    set(leaves, diffuse("leaves", SurfaceKind::object, glm::vec3(0.06F, 0.12F, 0.04F))); // green canopy, about 0.1 [M]
    for (int level = 0; surface.wheel_tracks && level < track_levels; ++level)
        all.push_back(polished(all[index_of(asphalt)], level));
    return all;
}

const Material& pavement_material(Pavement which) {
    static const std::vector<Material> all{pavement(Pavement::standard), pavement(Pavement::asphalt_worn), pavement(Pavement::asphalt_new),
                                           pavement(Pavement::concrete)};
    return all[static_cast<std::size_t>(which)];
}

const std::vector<TrackBorder>& track_borders() {
    static const std::vector<TrackBorder> all = [] {
        std::vector<TrackBorder> borders;
        for (const double middle : {-tyres_beside_m, tyres_beside_m})
            for (int k = 1 - track_levels; k < track_levels - 1; ++k) { // up to the peak and down again
                const int level = k < 0 ? track_levels + k : track_levels - 2 - k;
                const double halfway = polish_of(k < 0 ? level : level + 1) - 0.5 * polish_of(1); // between two levels
                const double beside = tyres_wander_m * std::sqrt(-2.0 * std::log(halfway));
                borders.push_back({middle + (k < 0 ? -beside : beside), level});
            }
        return borders;
    }();
    return all;
}

RoadMaterial lane_material(const std::string& lane_type) {
    using enum RoadMaterial;
    static constexpr std::pair<std::string_view, RoadMaterial> rows[]{{"none", verge},       {"median", verge}, {"sidewalk", concrete},
                                                                      {"walking", concrete}, {"curb", kerb},    {"tram", concrete},
                                                                      {"rail", terrain}};
    for (const auto& [type, material] : rows)
        if (lane_type == type)
            return material;
    return asphalt;
}

RoadMaterial marking_material(const std::string& colour) {
    return colour == "yellow" || colour == "orange" ? RoadMaterial::marking_yellow : RoadMaterial::marking_white;
}

namespace {

constexpr int px = road_texture_px;
constexpr std::size_t texels = static_cast<std::size_t>(px) * px;

/// In the order of road_textures().
enum class RoadTexture { asphalt, concrete, grass, paint_wear };

/// Runs over the texels in rows from below: where in 0..1, and which.
template <class At> std::vector<double> field(const At& at) {
    std::vector<double> values;
    values.reserve(texels);
    for (int y = 0; y < px; ++y)
        for (int x = 0; x < px; ++x)
            values.push_back(at(x, y, (x + 0.5) / px, (y + 0.5) / px));
    return values;
}

/// Writes a channel, scaled so that its mean is `level` exactly: what rounding takes from a texel goes to the next one.
void write_channel(SurfaceTexture& texture, std::size_t channel, const std::vector<double>& values, int level) {
    double sum = 0.0;
    for (const double value : values)
        sum += value;
    const double scale = level * static_cast<double>(values.size()) / sum;
    double carry = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double wanted = values[i] * scale + carry;
        const double written = std::clamp(std::floor(wanted + 0.5), 0.0, 255.0);
        carry = wanted - written;
        texture.rgba[4 * i + channel] = static_cast<std::uint8_t>(written);
    }
}

SurfaceTexture empty(const char* name) {
    SurfaceTexture texture{name, px, px, {}};
    texture.rgba.assign(4 * texels, 255);
    return texture;
}

SurfaceTexture grey(const char* name, const std::vector<double>& values, int level) {
    SurfaceTexture texture = empty(name);
    for (std::size_t channel = 0; channel < 3; ++channel)
        write_channel(texture, channel, values, level);
    return texture;
}

/// A place that was opened and closed again: a rectangle in texels.
struct Patch {
    double x, y, half_width, half_height, tone;
};

/// Signed distance to the patch's border in texels, the nearest repetition counting; negative inside.
double distance_to(const Patch& patch, int x, int y) {
    const auto along = [](double d) { return std::abs(d - px * std::floor(d / px + 0.5)); };
    return std::max(along(x + 0.5 - patch.x) - patch.half_width, along(y + 0.5 - patch.y) - patch.half_height);
}

/// Aggregate in bitumen. A texel of 31 mm holds several stones of 8 to 16 mm: their contrast is averaged already. Light single
/// stones, a mottle of 6 to 50 cm, and three repaired patches, a little darker, in a seam of bitumen.
SurfaceTexture asphalt(std::uint64_t seed) {
    TilingNoise grain(seed, 1), chips(seed, 2), mottle(seed, 3), edge(seed, 4);
    const std::array<Patch, 3> patches{Patch{58.0, 70.0, 15.0, 34.0, 0.93}, Patch{170.0, 150.0, 24.0, 11.0, 0.90},
                                       Patch{216.0, 36.0, 8.0, 9.0, 1.07}};
    return grey("asphalt", field([&](int x, int y, double u, double v) {
                    double tone = 1.0 + 0.26 * (grain.uniform(x, y) + grain.uniform(x + px, y) - 1.0);
                    tone += 0.18 * mottle.octaves(u, v, 16, 4, 1.0);
                    const double chip = chips.uniform(x, y);
                    tone += chip < 0.03 ? 0.40 : chip > 0.97 ? -0.30 : 0.0;
                    const double rough = 1.5 * edge.gradient(u, v, 64);
                    for (const Patch& patch : patches) {
                        const double d = distance_to(patch, x, y) + rough;
                        tone *= d < -0.5 ? patch.tone : d < 0.5 ? 0.80 : 1.0;
                    }
                    return tone;
                }),
                128);
}

/// Slabs of 0.5 m with joints of 1 cm, each slab of its own tone, fine grain and stains.
SurfaceTexture concrete(std::uint64_t seed) {
    constexpr int slab_px = 16;
    TilingNoise grain(seed, 11), slabs(seed, 12), stains(seed, 13);
    return grey("concrete", field([&](int x, int y, double u, double v) {
                    double tone = 1.0 + 0.10 * (grain.uniform(x, y) - 0.5) + 0.08 * (slabs.uniform(x / slab_px, y / slab_px) - 0.5);
                    tone += 0.10 * stains.octaves(u, v, 16, 3, 0.8);
                    return x % slab_px == 0 || y % slab_px == 0 ? 0.72 * tone : tone;
                }),
                190);
}

/// Tufts and blades, some greener and some drier.
SurfaceTexture grass(std::uint64_t seed) {
    TilingNoise tufts(seed, 21), blades(seed, 22), hue(seed, 23);
    const std::vector<double> tone = field([&](int x, int y, double u, double v) {
        return 1.0 + 0.30 * tufts.octaves(u, v, 8, 5, 1.25) + 0.40 * (blades.uniform(x, y) - 0.5);
    });
    const std::vector<double> dry = field([&](int, int, double u, double v) { return hue.octaves(u, v, 8, 4, 1.0); });
    SurfaceTexture texture = empty("grass");
    const std::array<double, 3> share{0.14, 0.0, -0.18}; // of dryness in R, G, B
    for (std::size_t channel = 0; channel < 3; ++channel) {
        std::vector<double> values = tone;
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = std::max(0.1, values[i]) * (1.0 + share[channel] * dry[i]);
        write_channel(texture, channel, values, 112);
    }
    return texture;
}

/// Paint that has come off stone by stone, more in some places than in others.
SurfaceTexture paint_wear(std::uint64_t seed) {
    constexpr std::uint8_t bare = 20; // 0.08 of 255: asphalt
    TilingNoise places(seed, 31), stones(seed, 32), grain(seed, 33);
    SurfaceTexture texture = empty("paint-wear");
    const std::vector<double> opacity = field([&](int x, int y, double u, double v) {
        const double wear = 0.9 * places.octaves(u, v, 16, 2, 0.8) + 0.9 * stones.gradient(u, v, 96) + 0.5 * (grain.uniform(x, y) - 0.5);
        return std::clamp(3.0 * (wear - 0.30), 0.0, 0.9);
    });
    for (std::size_t i = 0; i < texels; ++i) {
        std::fill_n(texture.rgba.begin() + static_cast<std::ptrdiff_t>(4 * i), 3, bare);
        texture.rgba[4 * i + 3] = static_cast<std::uint8_t>(std::floor(255.0 * opacity[i] + 0.5));
    }
    return texture;
}

double luminance(const glm::dvec3& rgb) { return glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722)); } // IEC 61966-2-1

/// A texture as one mode shows it on black and on white.
struct ShownTexture {
    RoadTexture which;
    TextureMode mode;
    glm::vec3 blend_colour;
    glm::dvec3 of_black, of_white;
};

/// The mean reflectance is linear in the own colour: mean(own) = mean(0) + own (mean(1) - mean(0)), channel by channel. `known`: what
/// several materials share.
void put_on(Material& material, const std::vector<SurfaceTexture>& textures, RoadTexture which, TextureMode mode,
            std::vector<ShownTexture>& known) {
    material.texture = static_cast<int>(which);
    material.texture_mode = mode;
    auto shown = std::ranges::find_if(known, [&](const ShownTexture& other) {
        return other.which == which && other.mode == mode && other.blend_colour == material.blend_colour;
    });
    if (shown == known.end()) {
        const SurfaceTexture& texture = textures[static_cast<std::size_t>(which)];
        const glm::dvec3 cc(material.blend_colour);
        shown = known.insert(shown, {which, mode, material.blend_colour, mean_reflectance(texture, mode, glm::dvec3(0.0), cc),
                                     mean_reflectance(texture, mode, glm::dvec3(1.0), cc)});
    }
    const glm::dvec3 wanted(material.albedo), own = (wanted - shown->of_black) / (shown->of_white - shown->of_black);
    material.albedo = glm::vec3(own);
    // R_L goes with the luminance of the reflectance over that of the own colour (textured_rl), whose mean is wanted / own.
    material.retro_rl = static_cast<float>(static_cast<double>(material.retro_rl) * luminance(own) / luminance(wanted));
}

/// Perlin's fade of 2002: first and second derivative are 0 at both ends.
double fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }

} // namespace

std::vector<SurfaceTexture> road_textures(std::uint64_t seed) { return {asphalt(seed), concrete(seed), grass(seed), paint_wear(seed)}; }

glm::dvec3 mean_reflectance(const SurfaceTexture& texture, TextureMode mode, const glm::dvec3& own, const glm::dvec3& blend_colour) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i + 3 < texture.rgba.size(); i += 4) {
        const glm::dvec4 texel(texture.rgba[i], texture.rgba[i + 1], texture.rgba[i + 2], texture.rgba[i + 3]);
        sum += photometry::combined_reflectance(static_cast<int>(mode), own, texel / 255.0, blend_colour);
    }
    return sum / (static_cast<double>(texture.rgba.size()) / 4.0);
}

void add_road_textures(Scene& scene, std::uint64_t seed) {
    scene.textures = road_textures(seed);
    std::vector<ShownTexture> known;
    const auto put = [&](RoadMaterial material, RoadTexture texture, TextureMode mode) {
        put_on(scene.materials[index_of(material)], scene.textures, texture, mode, known);
    };
    const RoadTexture paved =
        scene.materials[index_of(RoadMaterial::asphalt)].name == "asphalt" ? RoadTexture::asphalt : RoadTexture::concrete;
    put(RoadMaterial::asphalt, paved, TextureMode::modulate);
    for (int level = 0; index_of(track_material(level)) < scene.materials.size() && level < track_levels; ++level)
        put(track_material(level), paved, TextureMode::modulate);
    put(RoadMaterial::concrete, RoadTexture::concrete, TextureMode::modulate);
    put(RoadMaterial::object, RoadTexture::concrete, TextureMode::modulate);
    put(RoadMaterial::verge, RoadTexture::grass, TextureMode::modulate);
    put(RoadMaterial::terrain, RoadTexture::grass, TextureMode::modulate);
    put(RoadMaterial::marking_white, RoadTexture::paint_wear, TextureMode::decal);
    put(RoadMaterial::marking_yellow, RoadTexture::paint_wear, TextureMode::decal);
}

TilingNoise::TilingNoise(std::uint64_t seed, std::uint64_t stream) : key_(mixed(mixed(seed + mixing_step) + stream * mixing_step)) {}

double TilingNoise::uniform(int x, int y) const {
    const std::uint64_t place = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32) | static_cast<std::uint32_t>(y);
    return static_cast<double>(mixed(key_ ^ mixed(place + mixing_step)) >> 11) * 0x1p-53;
}

double TilingNoise::gradient(double u, double v, int cells) {
    std::vector<glm::dvec2>& lattice = lattices_[cells];
    if (lattice.empty())
        for (int iy = 0; iy < cells; ++iy)
            for (int ix = 0; ix < cells; ++ix)
                lattice.emplace_back(2.0 * uniform(2 * ix, iy) - 1.0, 2.0 * uniform(2 * ix + 1, iy) - 1.0);
    const double x = u * cells, y = v * cells, x0 = std::floor(x), y0 = std::floor(y);
    const double fx = x - x0, fy = y - y0;
    const auto wrapped = [cells](double i) { return ((static_cast<int>(i) % cells) + cells) % cells; };
    const int ix[]{wrapped(x0), wrapped(x0 + 1)}, iy[]{wrapped(y0), wrapped(y0 + 1)};
    const auto corner = [&](int dx, int dy) {
        const glm::dvec2& g = lattice[static_cast<std::size_t>(iy[dy] * cells + ix[dx])];
        return g.x * (fx - dx) + g.y * (fy - dy);
    };
    const double left_below = corner(0, 0), left_above = corner(0, 1), wx = fade(fx), wy = fade(fy);
    const double below = left_below + (corner(1, 0) - left_below) * wx, above = left_above + (corner(1, 1) - left_above) * wx;
    return below + (above - below) * wy;
}

double TilingNoise::octaves(double u, double v, int cells, int count, double gain) {
    double sum = 0.0, strength = 1.0;
    for (int i = 0; i < count; ++i, cells *= 2, strength *= gain)
        sum +=
            strength * gradient(u + 0.5 / cells, v + 0.5 / cells, cells); // gradient noise is 0 on its lattice: octaves must not share one
    return sum;
}

} // namespace fernlicht
