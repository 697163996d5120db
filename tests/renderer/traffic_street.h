// A street with other vehicles, and how it is drawn.
#pragma once

#include "renderer/reference/reference.h"
#include "renderer/traffic_levels.h"
#include "renderer/twin.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/place_traffic.h"
#include "scenarios/drives/play/staged_scene.h"
#include "scenarios/light/light.h"
#include "scenarios/roads/mesh/road_mesh.h"
#include "scenarios/traffic/road_user_mesh.h"
#include "tests/renderer/device_test.h"
#include "tests/trial.h"

#include <filesystem>
#include <fmt/format.h>

namespace fernlicht {

inline constexpr const char* low_beam = FERNLICHT_SOURCE_DIR "/scenarios/library/lamps/halogen-low.ies";

/// The shipped straight with these road users.
struct Street {
    explicit Street(const std::string& traffic) : drive(read(traffic)) {
        place_traffic(drive, network, route);
        scene = build_scene(network, {.textures = false});
        add_road_users(scene, drive.traffic, drive.opened);
    }
    static Drive read(const std::string& traffic) {
        return read_drive(
            tests::written("traffic.yaml", fmt::format("fernlicht: 1\nroad: {}/scenarios/library/roads/straight.xodr\nroute: {{s_m: 20}}\n"
                                                       "speed_mps: 20\nduration_s: 4\nlamp_sets: {{one: {{file: {}}}}}\n{}",
                                                       FERNLICHT_SOURCE_DIR, low_beam, traffic)));
    }
    Moment at(double time_s) const {
        return moment_at({0, time_s, distance_m(drive.speed, time_s), 20.0}, drive, route, drive.lamp_sets[0]);
    }

    Drive drive;
    RoadNetwork network = read_opendrive(drive.road_file);
    Route route{network, drive.start, drive.via};
    Scene scene;
};

inline std::string oncoming(double gap_m, int count = 1, double every_m = 25.0, const char* more = "") {
    return fmt::format("traffic: {{other: {{file: {}, oncoming: {{gap_m: {}}}, speed_mps: 10, repeat: {{count: {}, every_m: {}}}{}}}}}\n",
                       low_beam, gap_m, count, every_m, more);
}

inline View driver(int width = 240, int height = 160, double fov_deg = 30.0) {
    return {.position_m = {1.3, 0.35, 1.2},
            .pitch_rad = radians(-1.0),
            .vertical_fov_rad = radians(fov_deg),
            .width_px = width,
            .height_px = height};
}

class Traffic : public DeviceTest {
  protected:
    RendererSettings settings(const char* technique = "photometric") { return {.technique = technique}; }
    RendererSettings without_shadows() { return {.technique = "photometric", .traffic_shadows = false}; }
    RendererSettings without_levels() { return {.technique = "photometric", .traffic_levels = false}; }
    Frame draw(const Street& street, const Moment& moment, const View& view, const RendererSettings& s) {
        Renderer renderer(device_, street.scene, s);
        return renderer.draw(moment, view, all_results);
    }
};

inline double max_difference(const Image<float>& a, const Image<float>& b) {
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = std::max(most, std::abs(static_cast<double>(a.pixels()[i]) - static_cast<double>(b.pixels()[i])));
    return most;
}

} // namespace fernlicht
