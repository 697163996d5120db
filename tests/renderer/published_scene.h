// What the tests of the published techniques light: a car far from the map's origin, turned, with two lamps that differ; ground and a
// board.
#pragma once

#include "tests/lamps.h"
#include "tests/renderer/device_test.h"

#include <memory>

namespace fernlicht::tests {

/// A cut-off that is soft enough for a texture of 1024 x 512 to hold it.
inline CandelaTable soft_beam(double peak_cd, double turn_deg) {
    return table_of(steps(-30.0, 30.0, 0.5), steps(-20.0, 10.0, 0.5), [=](double h, double v) {
        return 100.0 +
               peak_cd / (1.0 + std::exp((v + 1.0) / 0.8)) * std::exp(-(h - turn_deg) * (h - turn_deg) / 150.0) * std::exp(-v * v / 60.0);
    });
}

/// `at` in the car's frame.
inline LitLamp mounted(const Pose& ego, const char* name, std::shared_ptr<const LampFile> file, const glm::dvec3& at, double factor) {
    return {.name = name,
            .file = std::move(file),
            .pose = {ego.position_m + ego.axes * at, ego.axes * axes_from_angles(0.02 * at.y, -0.01, 0.0)},
            .intensity_factor = factor};
}

/// The right one stands first, so that a technique cannot take the first one for the left.
inline Moment two_lamps(double sky_lx) {
    Moment moment{.ego = {{4.4e6, -5.2e5, 312.0}, axes_from_angles(0.7, 0.0, 0.0)}};
    moment.daylight.horizontal_illuminance_lx = sky_lx;
    moment.lamps = {mounted(moment.ego, "right", file_of(soft_beam(9000.0, 3.0)), {3.4, -0.6, 0.65}, 0.8),
                    mounted(moment.ego, "left", file_of(soft_beam(14000.0, -2.0)), {3.4, 0.6, 0.7}, 1.0)};
    return moment;
}

/// A grid of quads over corner + i a + k b, facing `normal`; all in the frame of `ego`, whose axes the vertices are turned by.
inline Mesh grid(const Pose& ego, const char* name, std::uint32_t material, glm::dvec3 corner, glm::dvec3 a, glm::dvec3 b,
                 glm::dvec3 normal, int columns, int rows) {
    Mesh mesh{name, ego.position_m, {}, {}, {}};
    for (int k = 0; k <= rows; ++k)
        for (int i = 0; i <= columns; ++i)
            mesh.vertices.push_back({glm::vec3(ego.axes * (corner + a * (1.0 * i / columns) + b * (1.0 * k / rows))),
                                     glm::vec3(ego.axes * normal),
                                     {i % 2, k % 2}});
    for (int k = 0; k < rows; ++k)
        for (int i = 0; i < columns; ++i) {
            const auto at = [&](int x, int y) { return static_cast<std::uint32_t>((k + y) * (columns + 1) + i + x); };
            mesh.indices.insert(mesh.indices.end(), {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)});
        }
    mesh.batches = {{material, 0, static_cast<std::uint32_t>(mesh.indices.size())}};
    return mesh;
}

/// Ground of `cells` quads along and across, 60 m behind the car to 100 m ahead, and a board of sheeting 30 m ahead.
inline Scene ground_and_board(const Pose& ego, int cells) {
    Scene scene;
    Material road{"road", SurfaceKind::road, {0.2F, 0.25F, 0.3F}};
    Material board{"board", SurfaceKind::board, {0.5F, 0.1F, 0.1F}};
    board.retro_rl = 180.0F;
    scene.materials = {road, board};
    scene.meshes = {grid(ego, "ground", 0, {-60, -30, 0}, {160, 0, 0}, {0, 60, 0}, {0, 0, 1}, cells, cells),
                    grid(ego, "board", 1, {30, -1, 0.5}, {0, -2, 0}, {0, 0, 2}, {-1, 0, 0}, 2, 2)};
    return scene;
}

inline View view_towards(double yaw_deg, double pitch_deg) {
    View view = driver_view(96, 64, 30.0, pitch_deg);
    view.yaw_rad = radians(yaw_deg);
    return view;
}

class PublishedTest : public DeviceTest {
  protected:
    Frame drawn(const std::string& technique, const Scene& scene, const Moment& moment, const View& view,
                const FrameOutputs& outputs = {.illuminance = true, .ids = true}) {
        return renderer(technique, scene).draw(moment, view, outputs);
    }
    Renderer renderer(const std::string& technique, const Scene& scene, bool eight_bit = false) {
        RendererSettings settings{.technique = technique};
        if (eight_bit)
            settings.beams = eight_bit_texels;
        return Renderer(device_, scene, settings);
    }
};

} // namespace fernlicht::tests
