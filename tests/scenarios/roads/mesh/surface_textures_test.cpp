// The textures repeat without a seam, keep the means of what they lie on, and give nothing away from afar.
#include "scenarios/photometry.h"
#include "scenarios/roads/mesh/mesh_builder.h"
#include "scenarios/roads/mesh/mesh_materials.h"
#include "scenarios/roads/mesh/road_mesh.h"
#include "tests/scenarios/roads/mesh_checks.h"
#include "tests/scenarios/roads/opendrive_text.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <set>
#include <tuple>

namespace fernlicht {
namespace {

/// Averages of one channel over blocks of `block` x `block` texels, 0..255.
struct Blocks {
    int side = 0;
    std::vector<double> values;
    double at(int x, int y) const { return values[static_cast<std::size_t>(y * side + x)]; }
};

Blocks blocks(const SurfaceTexture& texture, std::size_t channel, int block) {
    Blocks out{.side = texture.width / block};
    out.values.assign(static_cast<std::size_t>(out.side) * static_cast<std::size_t>(out.side), 0.0);
    for (int y = 0; y < texture.height; ++y)
        for (int x = 0; x < texture.width; ++x)
            out.values[static_cast<std::size_t>((y / block) * out.side + x / block)] +=
                texture.rgba[4 * static_cast<std::size_t>(y * texture.width + x) + channel] / static_cast<double>(block * block);
    return out;
}

/// Mean squared step from block column `left` to column `right`, or between rows.
double step(const Blocks& b, int left, int right, bool rows) {
    double sum = 0.0;
    for (int i = 0; i < b.side; ++i) {
        const double d = rows ? b.at(i, left) - b.at(i, right) : b.at(left, i) - b.at(right, i);
        sum += d * d;
    }
    return sum / b.side;
}

std::size_t varying_channel(const SurfaceTexture& texture) { return texture.name == "paint-wear" ? 3 : 1; }

const SurfaceTexture& named(const std::vector<SurfaceTexture>& all, const std::string& name) {
    return *std::ranges::find(all, name, &SurfaceTexture::name);
}

Scene textured_materials() {
    Scene scene{.materials = road_materials()};
    add_road_textures(scene, 1);
    return scene;
}

TEST(TilingNoise, RepeatsIsContinuousAndBounded) {
    TilingNoise noise(5, 1);
    for (int i = 0; i < 64; ++i) {
        const double v = (i + 0.3) / 64.0;
        for (const int cells : {1, 7, 16}) {
            EXPECT_EQ(noise.gradient(0.25, v, cells), noise.gradient(1.25, v, cells));
            EXPECT_EQ(noise.gradient(v, 0.25, cells), noise.gradient(v, 2.25, cells));
            EXPECT_NEAR(noise.gradient(0.0, v, cells), noise.gradient(1.0 - 1e-9, v, cells), 1e-7);
            EXPECT_NEAR(noise.gradient(v, 0.0, cells), noise.gradient(v, 1.0 - 1e-9, cells), 1e-7);
        }
    }
    double greatest = 0.0;
    for (int i = 0; i < 8; ++i)
        EXPECT_EQ(noise.gradient(i / 8.0, 0.375, 8), 0.0);
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x)
            greatest = std::max(greatest, std::abs(noise.gradient(x / 128.0, y / 128.0, 16)));
    EXPECT_LE(greatest, 1.0);
    EXPECT_GT(greatest, 0.3);
}

TEST(TilingNoise, UniformHasMeanAndVarianceOfItsLaw) {
    const TilingNoise noise(5, 1);
    double sum = 0.0, squares = 0.0;
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x) {
            const double value = noise.uniform(x, y);
            ASSERT_TRUE(value >= 0.0 && value < 1.0);
            sum += value;
            squares += value * value;
        }
    EXPECT_NEAR(sum / 65536.0, 0.5, 0.005); // 4 sigma: 4 sqrt(1 / 12 / 65536) = 0.0045
    EXPECT_NEAR(squares / 65536.0 - sum * sum / 65536.0 / 65536.0, 1.0 / 12.0, 0.002);
    EXPECT_NE(noise.uniform(3, 4), noise.uniform(4, 3));
    EXPECT_NE(noise.uniform(3, 4), TilingNoise(5, 2).uniform(3, 4));
}

TEST(SurfaceTextures, HaveOneSizeAndTheBytesOfTheirSeed) {
    const std::vector<SurfaceTexture> all = road_textures(1);
    std::set<std::string> names;
    for (const SurfaceTexture& texture : all) {
        EXPECT_EQ(std::tuple(texture.width, texture.height), std::tuple(256, 256));
        EXPECT_EQ(texture.rgba.size(), 4U * 256U * 256U);
        names.insert(texture.name);
    }
    EXPECT_EQ(names, (std::set<std::string>{"asphalt", "concrete", "grass", "paint-wear"}));
    const std::vector<SurfaceTexture> a = road_textures(7), b = road_textures(7), c = road_textures(8);
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].rgba, b[i].rgba) << a[i].name;
        EXPECT_NE(a[i].rgba, c[i].rgba) << a[i].name;
    }
}

TEST(SurfaceTextures, ModulatingOnesHaveTheirStatedMeanExactly) {
    for (const std::uint64_t seed : {1ULL, 2ULL, 0xFFFFFFFFFFFFFFFFULL})
        for (const auto& [name, level] : {std::pair{"asphalt", 128U}, std::pair{"concrete", 190U}, std::pair{"grass", 112U}}) {
            const std::vector<SurfaceTexture> all = road_textures(seed);
            const SurfaceTexture& texture = named(all, name);
            for (std::size_t channel = 0; channel < 3; ++channel) {
                std::uint64_t sum = 0;
                for (std::size_t i = channel; i < texture.rgba.size(); i += 4)
                    sum += texture.rgba[i];
                EXPECT_EQ(sum, level * 65536ULL) << name << " channel " << channel;
            }
        }
}

/// A border is a seam if it is rougher than all borders within the texture.
TEST(SurfaceTextures, HaveNoSeam) {
    for (const SurfaceTexture& texture : road_textures(1)) {
        const Blocks b = blocks(texture, varying_channel(texture), 4);
        for (const bool rows : {false, true}) {
            double roughest = 0.0;
            for (int i = 0; i + 1 < b.side; ++i)
                roughest = std::max(roughest, step(b, i, i + 1, rows));
            EXPECT_LE(step(b, b.side - 1, 0, rows), roughest) << texture.name;
        }
    }
}

TEST(SurfaceTextures, AverageOutOverHalfAMetre) {
    const std::vector<SurfaceTexture> all = road_textures(1);
    for (const char* name : {"asphalt", "concrete", "grass"})
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const Blocks b = blocks(named(all, name), channel, 16);
            double sum = 0.0, squares = 0.0;
            for (const double value : b.values) {
                sum += value / 256.0;
                squares += value * value / 256.0;
            }
            const double contrast = std::sqrt(squares - sum * sum) / sum;
            EXPECT_LE(contrast, name == std::string("grass") ? 0.065 : 0.03) << name << " channel " << channel;
            EXPECT_GT(contrast, 0.005) << name << " is more than white noise";
        }
}

TEST(SurfaceTextures, WornPaintIsAsphaltInPlaces) {
    const std::vector<SurfaceTexture> all = road_textures(1);
    const SurfaceTexture& texture = named(all, "paint-wear");
    double opacity = 0.0;
    std::size_t whole = 0;
    for (std::size_t i = 0; i < texture.rgba.size(); i += 4) {
        for (std::size_t channel = 0; channel < 3; ++channel)
            ASSERT_EQ(texture.rgba[i + channel], 20);
        opacity += texture.rgba[i + 3] / 255.0 / 65536.0;
        whole += texture.rgba[i + 3] == 0 ? 1U : 0U;
    }
    EXPECT_GT(opacity, 0.03);
    EXPECT_LT(opacity, 0.12);
    EXPECT_GT(whole, 52000U) << "most of it is paint";
}

TEST(SurfaceTextures, MeanReflectanceByHand) {
    SurfaceTexture two{"two", 2, 1, {255, 0, 51, 0, 0, 255, 51, 255}};
    const glm::dvec3 own(0.5, 0.25, 1.0), blend_colour(1.0, 1.0, 0.0);
    const auto mean = [&](TextureMode mode) { return mean_reflectance(two, mode, own, blend_colour); };
    const auto near = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b) < 1e-15; };
    EXPECT_TRUE(near(mean(TextureMode::modulate), {0.25, 0.125, 0.2}));
    EXPECT_TRUE(near(mean(TextureMode::replace), {0.5, 0.5, 0.2}));
    EXPECT_TRUE(near(mean(TextureMode::decal), {0.25, 0.625, 0.6})); // half own, half the second texel
    EXPECT_TRUE(near(mean(TextureMode::blend), {0.75, 0.625, 0.8})); // (1 + 0.5) / 2, (0.25 + 1) / 2, 0.8
}

TEST(SurfaceTextures, MaterialsKeepTheirMeanReflectance) {
    const std::vector<Material> plain = road_materials();
    const Scene scene = textured_materials();
    ASSERT_EQ(scene.materials.size(), plain.size());
    std::size_t textured = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
        const Material& material = scene.materials[i];
        if (material.texture < 0) {
            EXPECT_EQ(material, plain[i]);
            continue;
        }
        ++textured;
        const SurfaceTexture& texture = scene.textures.at(static_cast<std::size_t>(material.texture));
        const glm::dvec3 mean =
            mean_reflectance(texture, material.texture_mode, glm::dvec3(material.albedo), glm::dvec3(material.blend_colour));
        for (glm::length_t c = 0; c < 3; ++c)
            EXPECT_NEAR(mean[c], static_cast<double>(plain[i].albedo[c]), 1e-7) << material.name; // single precision of the albedo
    }
    EXPECT_EQ(textured, 7U);
}

/// The mean over the texels of L / E_perp in EN 1436's geometry, as mesh_cross_section_test.cpp has it for plain materials.
TEST(SurfaceTextures, RoadSurfacesKeepTheirRl) {
    const Scene scene = textured_materials();
    for (const auto& [which, rl_mcd] : {std::pair{RoadMaterial::asphalt, 15.0}, std::pair{RoadMaterial::marking_white, 150.0},
                                        std::pair{RoadMaterial::marking_yellow, 120.0}, std::pair{RoadMaterial::verge, 5.0}}) {
        const Material& material = scene.materials[index_of(which)];
        const SurfaceTexture& texture = scene.textures.at(static_cast<std::size_t>(material.texture));
        const glm::dvec3 own(material.albedo);
        double sum = 0.0;
        for (std::size_t i = 0; i < texture.rgba.size(); i += 4) {
            const glm::dvec4 texel(texture.rgba[i], texture.rgba[i + 1], texture.rgba[i + 2], texture.rgba[i + 3]);
            const glm::dvec3 reflectance =
                photometry::combined_reflectance(static_cast<int>(material.texture_mode), own, texel / 255.0, glm::dvec3(0.0));
            for (glm::length_t c = 0; c < 3; ++c)
                ASSERT_TRUE(reflectance[c] >= 0.0 && reflectance[c] <= 1.0) << material.name;
            const double y = 0.2126 * reflectance.r + 0.7152 * reflectance.g + 0.0722 * reflectance.b;
            sum += y * std::sin(1.24 * pi / 180.0) / pi + photometry::textured_rl(static_cast<double>(material.retro_rl), own, reflectance);
        }
        EXPECT_NEAR(1000.0 * sum / 65536.0, rl_mcd, 1e-4 * rl_mcd) << material.name;
    }
}

// Where in its texture a vertex lies: by hand, across meshes, and on whole roads.

glm::vec2 at(const glm::dvec3& origin, const glm::vec3& position, const glm::vec3& normal) {
    return texture_position(origin, {position, normal});
}

void expect_uv(const glm::vec2& found, float u, float v) { EXPECT_EQ(std::tuple(found.x, found.y), std::tuple(u, v)); }

/// 0: seen from the side along x, 1: along y, 2: from above.
int axis_of(const glm::vec3& n) {
    const glm::vec3 a = glm::abs(n);
    return a.z >= std::max(a.x, a.y) ? 2 : a.x >= a.y ? 0 : 1;
}

TEST(TexturePosition, FromAboveAndUprightByHand) {
    // 8 m a repetition: 100 m is 12 of them and 4 m, -3 m is -1 of them and 5 m.
    expect_uv(at({100.0, -3.0, 5.0}, {1.5F, 0.25F, 0.0F}, {0.0F, 0.0F, 1.0F}), 5.5F / 8.0F, 5.25F / 8.0F);
    expect_uv(at({0.0, 0.0, 0.0}, {-2.0F, 12.0F, 0.0F}, {0.1F, 0.2F, 0.97F}), -0.25F, 1.5F);
    const glm::vec3 p(1.0F, 2.0F, 4.0F);
    expect_uv(at({}, p, {1.0F, 0.0F, 0.0F}), 0.25F, 0.5F);   // from the east, north is to the right
    expect_uv(at({}, p, {-1.0F, 0.0F, 0.0F}), -0.25F, 0.5F); // from the west, south
    expect_uv(at({}, p, {0.0F, 1.0F, 0.0F}), -0.125F, 0.5F); // from the north, west
    expect_uv(at({}, p, {0.0F, -1.0F, 0.0F}), 0.125F, 0.5F); // from the south, east
}

TEST(TexturePosition, MeshesAgreeExactlyApartFromWholeRepetitions) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> near(-100.0, 100.0);
    const std::array<glm::vec3, 3> normals{glm::vec3(0.0F, 0.0F, 1.0F), glm::vec3(1.0F, 0.0F, 0.0F), glm::vec3(0.0F, -1.0F, 0.0F)};
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 a(680000.0, 5400000.0, 300.0), b = a + glm::round(glm::dvec3(near(random), near(random), near(random)));
        const glm::dvec3 world = on_lattice(a + glm::dvec3(near(random), near(random), near(random)));
        const glm::vec3& normal = normals[static_cast<std::size_t>(i % 3)];
        const glm::dvec2 uv_a(at(a, glm::vec3(world - a), normal)), uv_b(at(b, glm::vec3(world - b), normal)), apart = uv_a - uv_b;
        EXPECT_EQ(apart, glm::round(apart));
    }
}

TEST(TexturePosition, RoadMeshesHaveTheirTexturesInTrueSize) {
    for (const char* name : {"country.xodr", "village.xodr"}) {
        SCOPED_TRACE(name);
        const Scene scene = build_scene(opendrive_text::library_road(name), {.textures = true});
        std::size_t checked = 0;
        for (const Mesh& mesh : scene.meshes)
            for (const Batch& batch : mesh.batches) {
                if (scene.materials[batch.material].texture < 0)
                    continue;
                for (std::uint32_t k = batch.first; k < batch.first + batch.count; k += 3)
                    for (std::uint32_t side = 0; side < 3; ++side) {
                        const Vertex& a = mesh.vertices[mesh.indices[k + side]];
                        const Vertex& b = mesh.vertices[mesh.indices[k + (side + 1) % 3]];
                        ASSERT_EQ(axis_of(a.normal), axis_of(b.normal)) << mesh.name << ": a triangle seen from two sides";
                        const glm::vec3 d = 0.125F * (b.position_m - a.position_m);
                        const glm::vec2 uv = b.uv - a.uv;
                        const int axis = axis_of(a.normal);
                        ASSERT_EQ(std::abs(uv.x), std::abs(axis == 0 ? d.y : d.x)) << mesh.name;
                        ASSERT_EQ(std::abs(uv.y), std::abs(axis == 2 ? d.y : d.z)) << mesh.name;
                        ++checked;
                    }
            }
        EXPECT_GT(checked, 10000U);
    }
}

TEST(TexturePosition, RoadsHaveTexturesOnlyWhenAsked) {
    const RoadNetwork network = opendrive_text::library_road("village.xodr");
    const Scene plain = build_scene(network, {.textures = false}), textured = build_scene(network, {.textures = true});
    EXPECT_TRUE(plain.textures.empty());
    EXPECT_EQ(plain.materials, road_materials());
    for (const Material& material : plain.materials)
        EXPECT_EQ(material.texture, -1);
    EXPECT_EQ(textured.textures.size(), 4U);
    for (const Material& material : textured.materials)
        EXPECT_LT(material.texture, 4);
    ASSERT_EQ(plain.meshes.size(), textured.meshes.size());
    for (std::size_t i = 0; i < plain.meshes.size(); ++i)
        EXPECT_EQ(plain.meshes[i].indices, textured.meshes[i].indices);
}

} // namespace
} // namespace fernlicht
