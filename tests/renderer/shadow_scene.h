// A road, lamps and bodies that tests of shadows share, and what they compare.
#pragma once

#include "renderer/twin.h"
#include "tests/lamps.h"
#include "tests/renderer/device_test.h"

namespace fernlicht {

inline void add_flat(Mesh& mesh, std::uint32_t material, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size()), begin = static_cast<std::uint32_t>(mesh.indices.size());
    const glm::vec3 normal = glm::normalize(glm::cross(b - a, d - a));
    for (const glm::vec3& p : {a, b, c, d})
        mesh.vertices.push_back({p, normal, {0.25F * p.x + 0.1F * p.z, 0.25F * p.y}});
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    mesh.batches.push_back({material, begin, 6});
}

/// A closed box from `low` to `high`, normals outwards.
inline void add_box(Mesh& mesh, std::uint32_t material, glm::vec3 low, glm::vec3 high) {
    const auto at = [&](int x, int y, int z) {
        return glm::vec3(x != 0 ? high.x : low.x, y != 0 ? high.y : low.y, z != 0 ? high.z : low.z);
    };
    add_flat(mesh, material, at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
    add_flat(mesh, material, at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
    add_flat(mesh, material, at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
    add_flat(mesh, material, at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0));
    add_flat(mesh, material, at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
    add_flat(mesh, material, at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
}

inline Mesh thing(const glm::dvec3& origin, const char* name = "thing") { return {name, origin, {}, {}, {}}; }

/// Of material 1.
inline Mesh box(const glm::dvec3& origin, const glm::vec3& low, const glm::vec3& high, const char* name = "thing") {
    Mesh mesh = thing(origin, name);
    add_box(mesh, 1, low, high);
    return mesh;
}

/// A level road of 260 m by 80 m: material 0; what stands on it is of material 1.
inline Scene level_road_for_shadows() {
    Scene scene{.materials = {{"road", SurfaceKind::road, glm::vec3(0.1F)}, {"thing", SurfaceKind::object, glm::vec3(0.3F)}}};
    Mesh road{"road", {0.0, 0.0, 0.0}, {}, {}, {}};
    add_flat(road, 0, {-60, -40, 0}, {200, -40, 0}, {200, 40, 0}, {-60, 40, 0});
    scene.meshes.push_back(std::move(road));
    return scene;
}

/// As bright in every direction within 80 degrees to the sides and 40 degrees up and down.
inline std::shared_ptr<const LampFile> even_beam(double cd = 10000.0) { return tests::file_of(tests::even_table(cd, 80.0, 40.0)); }

inline LitLamp lamp_at(const glm::dvec3& place_m, double yaw_rad = 0.0, double pitch_rad = 0.0) {
    LitLamp lamp;
    lamp.name = "lamp";
    lamp.file = even_beam();
    lamp.pose = {place_m, axes_from_angles(yaw_rad, pitch_rad, 0.0)};
    return lamp;
}

inline View driver_for_shadows() { return driver_view(320, 240, 35.0, -4.0); }

/// `per_m` pixels a metre.
inline View map_for_shadows(double ahead_m, double beside_m, int per_m) {
    return map_view(ahead_m, 0.0, beside_m, static_cast<int>(2.0 * beside_m) * per_m, static_cast<int>(ahead_m) * per_m);
}

/// By the shader, which has all methods: what no shadow falls on is then the same to the byte.
inline Frame drawn_with(Device& device, const Scene& scene, const Moment& moment, const View& view, ShadowMethod method,
                        const char* technique = "photometric") {
    RendererSettings settings{.technique = technique, .shadows = {.method = method}, .light_pass = LightPass::shader};
    Renderer renderer(device, scene, settings);
    return renderer.draw(moment, view, all_results);
}

/// Which pixels of a picture one lamp does not light though without shadows it would: by the renderer and by rays in double precision.
struct HiddenPixels {
    int width = 0, height = 0;
    std::vector<int> drawn, rays; ///< 1 hidden, 0 lit, -1 neither: dark without shadows too, or another surface

    /// Pixels where the two differ though rays say the same of all that lie within one pixel around.
    int wrong_inside() const {
        int wrong = 0;
        for (const auto& [x, y] : each_pixel(width, height)) {
            const int here = at(rays, x, y);
            if (here < 0 || at(drawn, x, y) < 0 || at(drawn, x, y) == here)
                continue;
            bool edge = false;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    edge = edge || x + dx < 0 || y + dy < 0 || x + dx >= width || y + dy >= height || at(rays, x + dx, y + dy) != here;
            wrong += edge ? 0 : 1;
        }
        return wrong;
    }
    int count(int what) const { return static_cast<int>(std::ranges::count(rays, what)); }
    int differ() const {
        int n = 0;
        for (std::size_t i = 0; i < rays.size(); ++i)
            n += rays[i] >= 0 && drawn[i] >= 0 && rays[i] != drawn[i] ? 1 : 0;
        return n;
    }

  private:
    int at(const std::vector<int>& of, int x, int y) const { return of[static_cast<std::size_t>(y * width + x)]; }
};

inline HiddenPixels hidden_pixels(Device& device, const Scene& scene, const Moment& moment, const View& view,
                                  const ShadowSettings& shadows) {
    RendererSettings settings{.shadows = shadows};
    Renderer with(device, scene, settings);
    settings.shadows.method = ShadowMethod::none;
    Renderer without(device, scene, settings);
    const FrameOutputs outputs{.illuminance = true, .ids = true};
    const Frame shaded = with.draw(moment, view, outputs), plain = without.draw(moment, view, outputs);
    const Twin shaded_twin(scene, true), plain_twin(scene, false);
    HiddenPixels out{view.width_px, view.height_px, {}, {}};
    for (const auto& [x, y] : each_pixel(view)) {
        const TwinPixel free = plain_twin.pixel(moment, view, x + 0.5, y + 0.5);
        const bool known =
            free.id != 0 && free.id == plain.ids.at(x, y) && free.illuminance_lx > 1e-6 && plain.illuminance_lx.at(x, y) > 0.0F;
        out.rays.push_back(!known ? -1 : shaded_twin.pixel(moment, view, x + 0.5, y + 0.5).illuminance_lx == 0.0 ? 1 : 0);
        out.drawn.push_back(!known ? -1 : shaded.illuminance_lx.at(x, y) == 0.0F ? 1 : 0);
    }
    return out;
}

} // namespace fernlicht
