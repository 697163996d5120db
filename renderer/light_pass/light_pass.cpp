#include "renderer/light_pass/light_pass.h"

#include "renderer/light_pass/light_pass_packs.h"
#include "scenarios/light/light.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace fernlicht {
namespace {

constexpr int rows_at_once = 8;
constexpr int timed = 5; ///< where what lighting takes is asked for

template <class To> void put(const glm::dvec3& from, To* to) {
    for (int i = 0; i < 3; ++i)
        to[i] = static_cast<To>(from[i]);
}

packs::PassMaterial material_of(const Material& m, bool sources) {
    packs::PassMaterial to{};
    put(glm::dvec3(m.albedo), to.albedo);
    put(glm::dvec3(m.blend_colour), to.blend);
    put(glm::dvec3(m.emission_cdm2), to.emission);
    put(retro_tint(m), to.tint);
    to.rl = m.retro_rl;
    const float own_y = glm::dot(m.albedo, glm::vec3(0.2126F, 0.7152F, 0.0722F));
    to.rl_per_y = own_y > 0.0F ? m.retro_rl / own_y : 0.0F;
    to.retro_reference = m.retro_reference_rad;
    to.retro_inverse_falloff = 1.0F / m.retro_falloff_rad;
    to.texture_mode = m.texture < 0 ? -1 : static_cast<std::int32_t>(m.texture_mode);
    to.gloss = m.gloss;
    to.roughness = m.gloss_roughness;
    to.glossy = m.gloss > 0.0F;
    to.retroreflecting = m.retro_rl > 0.0F;
    to.emissive = sources && m.emission_cdm2 != glm::vec3(0.0F);
    return to;
}

/// From places relative to the car to camera space.
class ToCamera {
  public:
    explicit ToCamera(const Camera& camera)
        : axes_(glm::transpose(glm::dmat3(camera.right, camera.up, camera.axis))), eye_m_(camera.eye_m) {}
    glm::dvec3 direction(const glm::dvec3& v) const { return axes_ * v; }
    glm::dvec3 place(const glm::dvec3& p) const { return axes_ * (p - eye_m_); }

  private:
    glm::dmat3 axes_;
    glm::dvec3 eye_m_;
};

/// Triangles as a picture shows them, made when a pixel asks; a thread's own.
class Triangles {
  public:
    Triangles(const DrawnPicture& picture, const DrawnSurfaces& surfaces, const std::vector<packs::PassMaterial>& materials,
              const ToCamera& to_camera)
        : picture_(picture), surfaces_(surfaces), materials_(materials), to_camera_(to_camera), kept_(kept_count) {}

    static const packs::PassTriangle& of(void* triangles, std::int32_t id) {
        return static_cast<Triangles*>(triangles)->find(static_cast<std::uint32_t>(id));
    }

  private:
    static constexpr std::size_t kept_count = 256;
    struct Kept {
        std::uint32_t id = 0;
        packs::PassTriangle triangle{};
    };
    const packs::PassTriangle& find(std::uint32_t id) {
        Kept& kept = kept_[id % kept_count];
        if (kept.id != id) {
            kept.id = id;
            make(id, kept.triangle);
        }
        return kept.triangle;
    }
    void make(std::uint32_t id, packs::PassTriangle& to) const;

    const DrawnPicture& picture_;
    const DrawnSurfaces& surfaces_;
    const std::vector<packs::PassMaterial>& materials_;
    const ToCamera& to_camera_;
    std::vector<Kept> kept_;
};

/// With corners v and the place t (X, Y, 1), barycentric weights over t are e . (X, Y, 1) / det, e of the first corner v1 x v2, and so on.
/// In a map, with places (X, Y, t), all of it is linear in X and Y.
void Triangles::make(std::uint32_t id, packs::PassTriangle& to) const {
    const DrawnPiece& piece = *std::prev(std::ranges::upper_bound(picture_.pieces, id, {}, &DrawnPiece::first_id));
    const std::uint32_t last = piece.first_corner + (id - piece.first_id);
    const std::uint32_t numbers[3] = {surfaces_.others[last][0], surfaces_.others[last][1], last};
    glm::dvec3 v[3], n[3];
    for (int i = 0; i < 3; ++i) {
        const DrawnSurfaces::Corner& corner = surfaces_.corners[numbers[i]];
        v[i] = to_camera_.place(piece.origin_m + piece.turn * glm::dvec3(corner.position_m));
        n[i] = to_camera_.direction(piece.turn * glm::dvec3(corner.normal));
    }
    const bool map = picture_.camera.is_map;
    glm::dmat3 weights(0.0); // columns: what X, Y and 1 bring to each corner's weight
    if (map) {
        const glm::dvec2 a(v[0]), b(v[1]), c(v[2]);
        const double det = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
        const auto row = [&](int i, const glm::dvec2& p, const glm::dvec2& q) {
            weights[0][i] = (p.y - q.y) / det;
            weights[1][i] = (q.x - p.x) / det;
            weights[2][i] = (p.x * q.y - q.x * p.y) / det;
        };
        row(0, b, c);
        row(1, c, a);
        row(2, a, b);
        put(glm::transpose(weights) * glm::dvec3(v[0].z, v[1].z, v[2].z), to.nearness);
    } else {
        const glm::dvec3 across = glm::cross(v[1] - v[0], v[2] - v[0]);
        const double det = glm::dot(across, v[0]);
        const glm::dvec3 e[3] = {glm::cross(v[1], v[2]), glm::cross(v[2], v[0]), glm::cross(v[0], v[1])};
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k)
                weights[k][i] = e[i][k] / det;
        put(across / det, to.nearness);
    }
    to.flat = n[0] == n[1] && n[0] == n[2];
    if (to.flat) {
        n[0] = glm::normalize(n[0]);
        for (int i = 0; i < 3; ++i) {
            to.normal[3 * i] = to.normal[3 * i + 1] = 0.0F;
            to.normal[3 * i + 2] = static_cast<float>(n[0][i]);
        }
    } else {
        const glm::dmat3 normal = glm::dmat3(n[0], n[1], n[2]) * weights;
        for (int i = 0; i < 3; ++i)
            put({normal[0][i], normal[1][i], normal[2][i]}, to.normal + 3 * i);
    }
    // Pixels on an edge may lie beside the triangle, and their ray far from it.
    to.nearest = static_cast<float>(std::min({v[0].z, v[1].z, v[2].z}));
    to.farthest = static_cast<float>(std::max({v[0].z, v[1].z, v[2].z}));
    to.material = &materials_[surfaces_.corners[last].material];
    to.mesh = static_cast<std::int32_t>(piece.mesh + 1);
    to.ground = piece.ground;
    to.lit = piece.lit;
    to.shadowed = piece.shadowed;
}

packs::PassShadow shadow_of(const ShadowLookUp& from, const Camera& camera, std::vector<float>& shifts) {
    packs::PassShadow to{};
    const glm::dmat4& m = from.texture_from_ego;
    for (int row = 0; row < 4; ++row) {
        const glm::dvec3 of(m[0][row], m[1][row], m[2][row]);
        put({glm::dot(of, camera.right), glm::dot(of, camera.up), glm::dot(of, camera.axis)}, to.rows + 4 * row);
        to.rows[4 * row + 3] = static_cast<float>(m[3][row] + glm::dot(of, camera.eye_m));
    }
    to.near = static_cast<float>(from.near_m);
    to.tolerance = static_cast<float>(from.tolerance_m);
    to.width = from.width;
    to.height = from.height;
    to.layers = static_cast<std::int32_t>(from.shifts.size());
    for (const glm::dvec2& shift : from.shifts)
        shifts.insert(shifts.end(), {static_cast<float>(shift.x), static_cast<float>(shift.y)});
    to.shifts = shifts.data();
    to.depth = from.depth;
    to.target_depth = from.target_depth != nullptr ? from.target_depth : from.depth;
    std::ranges::transform(from.box, to.box, [](double texels) { return static_cast<float>(texels); });
    return to;
}

/// The picture's numbers to be written, at its size; nullptr: not wanted.
template <class T> T* wanted(bool is, Image<T>& image, int width, int height) {
    if (!is) {
        image = {};
        return nullptr;
    }
    if (image.width() != width || image.height() != height)
        image = Image<T>(width, height);
    return image.data();
}

} // namespace

CpuLight::CpuLight(const Scene& scene, const ToneMapper& tone, const std::optional<glm::dmat3>& white, double target_height_m, bool sources,
                   packs::Level level)
    : tone_(tone), target_height_m_(target_height_m), level_(level) {
    if (white)
        white_rows_ = glm::mat3(glm::transpose(*white));
    for (const Material& material : scene.materials)
        materials_.push_back(material_of(material, sources));
}

CpuLight::~CpuLight() = default;

const std::vector<float>& CpuLight::padded(const BeamTexture& beam) {
    Padded& padded = beams_[&beam];
    if (!padded.cd.empty() && padded.state == beam.state)
        return padded.cd;
    padded.state = beam.state;
    padded.cd.clear();
    for (int row = 0; row <= beam.height; ++row) {
        const auto from = beam.cd.begin() + std::ptrdiff_t{std::min(row, beam.height - 1)} * beam.width;
        padded.cd.insert(padded.cd.end(), from, from + beam.width);
        padded.cd.push_back(padded.cd.back());
    }
    return padded.cd;
}

void CpuLight::draw(const DrawnPicture& picture, const DrawnSurfaces& surfaces, Frame& frame) {
    const Camera& camera = picture.camera;
    const ToCamera to_camera(camera);
    std::vector<packs::PassLamp> lamps;
    std::vector<packs::PassShadow> shadows(picture.lamps.size());
    std::vector<std::vector<float>> shifts(picture.lamps.size());
    for (const DrawnLamp& drawn : picture.lamps) {
        const Pose& pose = drawn.lamp->pose;
        const BeamTexture& beam = *drawn.beam;
        const glm::dvec3 axes[3] = {-pose.left(), pose.up(), pose.forward()}, raise(0.0, 0.0, target_height_m_);
        packs::PassLamp& lamp = lamps.emplace_back();
        put(to_camera.place(pose.position_m - picture.ego_m), lamp.position);
        put(to_camera.direction(axes[0]), lamp.right);
        put(to_camera.direction(axes[1]), lamp.up);
        put(to_camera.direction(axes[2]), lamp.forward);
        put(drawn.lamp->colour.linear_srgb, lamp.colour);
        lamp.factor = static_cast<float>(drawn.lamp->intensity_factor);
        put({glm::dot(axes[0], raise), glm::dot(axes[1], raise), glm::dot(axes[2], raise)}, lamp.raise);
        put(to_camera.direction(raise), lamp.raise_in_camera);
        const double grid[4] = {beam.h_first_rad, beam.v_first_rad, 1.0 / beam.h_step_rad, 1.0 / beam.v_step_rad};
        std::ranges::transform(grid, lamp.grid, [](double x) { return static_cast<float>(x); });
        lamp.count[0] = static_cast<float>(beam.width);
        lamp.count[1] = static_cast<float>(beam.height);
        lamp.steep = drawn.steep;
        lamp.cd = padded(beam).data();
        const std::size_t i = lamps.size() - 1;
        if (drawn.shadow != nullptr) {
            shadows[i] = shadow_of(*drawn.shadow, camera, shifts[i]);
            lamp.shadow = &shadows[i];
        }
    }
    const int width = picture.width, height = picture.height;
    packs::PassPicture to{};
    to.width = width;
    to.x_step = 2.0 * camera.half_extent.x / width;
    to.x_first = 0.5 * to.x_step - camera.half_extent.x;
    to.y_step = -2.0 * camera.half_extent.y / height;
    to.y_first = 0.5 * to.y_step + camera.half_extent.y;
    to.is_map = camera.is_map;
    to.visible = reinterpret_cast<const std::int32_t*>(picture.visible.data());
    to.lamps = lamps.data();
    const auto shines = [](const DrawnLamp& lamp) { return lamp.lamp->intensity_factor > 0.0; };
    const auto first = std::ranges::find_if(picture.lamps, shines);
    if (first != picture.lamps.end() && std::ranges::all_of(picture.lamps, [&](const DrawnLamp& lamp) {
            return !shines(lamp) || lamp.lamp->colour.linear_srgb == first->lamp->colour.linear_srgb;
        }))
        to.colour_of_all = lamps[static_cast<std::size_t>(first - picture.lamps.begin())].colour;
    to.lamp_count = static_cast<std::int32_t>(lamps.size());
    to.sky_lx = static_cast<float>(picture.sky_lx);
    put(to_camera.direction({0.0, 0.0, 1.0}), to.upwards);
    const FrameOutputs& outputs = picture.outputs;
    to.colour = reinterpret_cast<unsigned char*>(wanted(outputs.colour, frame.colour, width, height));
    to.illuminance = wanted(outputs.illuminance, frame.illuminance_lx, width, height);
    to.target = wanted(outputs.target, frame.target_lx, width, height);
    to.luminance = wanted(outputs.luminance, frame.luminance_cdm2, width, height);
    to.light = reinterpret_cast<float*>(wanted(outputs.light, frame.light, width, height));
    to.depth = wanted(outputs.depth, frame.depth_m, width, height);
    to.ids = reinterpret_cast<std::int32_t*>(wanted(outputs.ids, frame.ids, width, height));
    for (int i = 0; i < 3; ++i)
        to.background[i] = static_cast<unsigned char>(std::lround(255.0F * std::clamp(picture.background[i], 0.0F, 1.0F)));
    to.sky_luminance = picture.sky_luminance_cdm2;
    to.tone_kind = static_cast<std::int32_t>(tone_.kind);
    to.tone_s = static_cast<float>(tone_.s);
    to.tone_l_max = static_cast<float>(tone_.l_max_cdm2);
    to.white_rows = white_rows_ ? &(*white_rows_)[0][0] : nullptr;
    to.triangle = &Triangles::of;
    const auto light = [&] {
        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<int>(0, height, rows_at_once),
                                  [&](const oneapi::tbb::blocked_range<int>& rows) {
                                      Triangles triangles(picture, surfaces, materials_, to_camera);
                                      AT_LEVEL(level_, light_rows)(to, &triangles, rows.begin(), rows.end());
                                  });
    };
    light();
    if (picture.work == nullptr)
        return;
    LightWork& work = *picture.work;
    work.cpu_s = std::numeric_limits<double>::infinity();
    for (int time = 0; time < timed; ++time) {
        const std::clock_t start = std::clock();
        light();
        work.cpu_s = std::min(work.cpu_s, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    Triangles triangles(picture, surfaces, materials_, to_camera);
    const packs::PassCounts counts = packs::counting::count_rows(to, &triangles, 0, height);
    work.operations = counts.operations;
    work.divisions = counts.divisions;
    work.look_ups = counts.look_ups;
    for (std::size_t i = 0; i < picture.visible.size(); i += 2)
        work.pixels += picture.visible[i] != 0 ? 1 : 0;
    const int written = (outputs.colour ? 3 : 0) + (outputs.light ? 12 : 0) +
                        4 * (outputs.illuminance + outputs.target + outputs.luminance + outputs.depth + outputs.ids);
    work.bytes = (8LL + written) * width * height;
    for (const DrawnLamp& lamp : picture.lamps)
        work.beam_texels = std::max(work.beam_texels, static_cast<long long>(padded(*lamp.beam).size()));
}

} // namespace fernlicht
