// Small scenes made in code: a few sheets, a lamp, a camera. For trying what a drive would hide.
#pragma once

#include "scenarios/drives/play/moment.h"
#include "scenarios/values/scene.h"

namespace fernlicht::small_scenes {

/// A lamp of `cd` in every direction to +-85 degrees.
CandelaTable constant_table(double cd);
/// A beam with a cut-off: ln I falls by about 500 a radian, 300 to 20 000 cd.
CandelaTable cut_off_table();

LitLamp lamp(CandelaTable table, const glm::dvec3& position_m, double yaw_rad = 0.0, double pitch_rad = 0.0);

/// A parallelogram of one mesh: corner, and the edges from it; faces edge_a x edge_b.
void add_sheet(Scene& scene, const std::string& name, std::uint32_t material, const glm::dvec3& corner_m, const glm::dvec3& edge_a,
               const glm::dvec3& edge_b);
/// Materials 0: plain road, 1: a retroreflecting board.
Scene empty_scene();

View camera(const glm::dvec3& position_m, double yaw_rad, double pitch_rad, double fov_deg, int width_px, int height_px);

} // namespace fernlicht::small_scenes
