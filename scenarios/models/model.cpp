#include "scenarios/models/model.h"

#include "scenarios/roads/route.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

namespace fernlicht {
namespace {

Mesh moved(const Mesh& mesh, const Pose& pose, double scale, std::uint32_t first_material) {
    Mesh out = mesh;
    out.origin_m = glm::round(to_parent(pose, scale * mesh.origin_m));
    const glm::mat3 turn(pose.axes);
    for (Vertex& vertex : out.vertices) {
        vertex.position_m = glm::vec3(to_parent(pose, scale * (mesh.origin_m + glm::dvec3(vertex.position_m))) - out.origin_m);
        vertex.normal = turn * vertex.normal;
    }
    for (Batch& batch : out.batches)
        batch.material += first_material;
    return out;
}

/// Where a placed model's frame lies in the world.
Pose world_pose(const PlacedModel& placed, const Route& route) {
    const Pose own{{}, axes_from_angles(placed.yaw_rad, placed.pitch_rad, placed.roll_rad)};
    if (!placed.along_route)
        return {placed.position_m, own.axes};
    const Pose there = route.pose(placed.position_m.x, placed.position_m.y);
    return compose(there, {{0.0, 0.0, placed.position_m.z}, own.axes});
}

} // namespace

void add_model(Scene& scene, const Model& model, const Pose& pose, double scale, SurfaceKind kind) {
    const auto first_material = static_cast<std::uint32_t>(scene.materials.size());
    const int first_texture = static_cast<int>(scene.textures.size());
    for (Material material : model.materials) {
        material.kind = kind;
        material.texture += material.texture < 0 ? 0 : first_texture;
        scene.materials.push_back(std::move(material));
    }
    scene.textures.insert(scene.textures.end(), model.textures.begin(), model.textures.end());
    for (const Mesh& mesh : model.meshes)
        scene.meshes.push_back(moved(mesh, pose, scale, first_material));
}

void add_scenery(Scene& scene, const std::vector<PlacedModel>& scenery, const Route& route) {
    for (const PlacedModel& placed : scenery)
        add_model(scene, *placed.model, world_pose(placed, route), placed.scale,
                  placed.ground ? SurfaceKind::terrain : SurfaceKind::object);
    if (!scenery.empty())
        unify_texture_sizes(scene);
}

namespace {

/// Inverse of the sRGB curve, IEC 61966-2-1.
std::array<float, 256> linear_of_srgb() {
    std::array<float, 256> curve{};
    for (std::size_t i = 0; i < curve.size(); ++i) {
        const double c = static_cast<double>(i) / 255.0;
        curve[i] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return curve;
}

/// Shares of `from` samples in each of `to`, by the stretch that both cover.
struct Share {
    std::size_t to, from;
    float weight;
};
std::vector<Share> shares(std::size_t from, std::size_t to) {
    std::vector<Share> all;
    const double ratio = static_cast<double>(from) / static_cast<double>(to);
    for (std::size_t i = 0; i < to; ++i) {
        const double begin = static_cast<double>(i) * ratio, end = begin + ratio;
        for (auto k = static_cast<std::size_t>(begin); k < from && static_cast<double>(k) < end; ++k)
            if (const double covered = std::min(end, static_cast<double>(k) + 1.0) - std::max(begin, static_cast<double>(k));
                covered > 1e-9)
                all.push_back({i, k, static_cast<float>(covered / ratio)});
    }
    return all;
}

/// Four channels a texel, linear, to another size.
std::vector<float> resampled(const std::vector<float>& texels, std::size_t width, std::size_t height, std::size_t to_width,
                             std::size_t to_height) {
    std::vector<float> across(to_width * height * 4), out(to_width * to_height * 4);
    const std::vector<Share> columns = shares(width, to_width), rows = shares(height, to_height);
    for (std::size_t y = 0; y < height; ++y)
        for (const Share& s : columns)
            for (std::size_t c = 0; c < 4; ++c)
                across[(y * to_width + s.to) * 4 + c] += s.weight * texels[(y * width + s.from) * 4 + c];
    for (const Share& s : rows)
        for (std::size_t x = 0; x < to_width * 4; ++x)
            out[s.to * to_width * 4 + x] += s.weight * across[s.from * to_width * 4 + x];
    return out;
}

/// The power of two that is nearest by ratio.
std::size_t side(int px, int max_px) {
    return std::min(std::size_t{1} << std::lround(std::log2(std::max(px, 1))), static_cast<std::size_t>(max_px));
}

} // namespace

SurfaceTexture surface_texture(std::string name, int width, int height, const std::vector<std::uint8_t>& rgba, int max_px) {
    static const std::array<float, 256> curve = linear_of_srgb();
    std::vector<float> linear(rgba.size());
    for (std::size_t i = 0; i < rgba.size(); ++i)
        linear[i] = i % 4 == 3 ? static_cast<float>(rgba[i]) / 255.0F : curve[rgba[i]];
    const std::size_t to_width = side(width, max_px), to_height = side(height, max_px);
    const std::vector<float> fitted =
        resampled(linear, static_cast<std::size_t>(width), static_cast<std::size_t>(height), to_width, to_height);
    SurfaceTexture texture{std::move(name), static_cast<int>(to_width), static_cast<int>(to_height), {}};
    texture.rgba.reserve(fitted.size());
    for (const float value : fitted)
        texture.rgba.push_back(static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F))));
    return texture;
}

void unify_texture_sizes(Scene& scene) {
    int width = 1, height = 1;
    for (const SurfaceTexture& t : scene.textures) {
        width = std::max(width, t.width);
        height = std::max(height, t.height);
    }
    for (SurfaceTexture& t : scene.textures) {
        if (t.width == width && t.height == height)
            continue;
        std::vector<std::uint8_t> rgba(std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const auto from = static_cast<std::size_t>(y * t.height / height * t.width + x * t.width / width) * 4;
                std::copy_n(t.rgba.begin() + static_cast<std::ptrdiff_t>(from), 4,
                            rgba.begin() + static_cast<std::ptrdiff_t>(y * width + x) * 4);
            }
        t.rgba = std::move(rgba);
        t.width = width;
        t.height = height;
    }
}

} // namespace fernlicht
