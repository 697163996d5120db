// A drawn frame of a small scene compared with the double-precision twin; files as users write them.
#pragma once

#include "renderer/renderer.h"
#include "renderer/twin.h"
#include "runner/experiments/stability/stability_case.h"
#include "runner/play/small_scenes.h"
#include "scenarios/drives/drive.h"

#include <limits>
#include <set>

namespace fernlicht::stability {

using namespace small_scenes;

/// Without shadows, which the comparisons with twin and plane leave out; the shadow cases have them.
RendererSettings unshadowed();

/// add_sheet() to an empty scene.
Scene scene_of_sheet(const std::string& name, std::uint32_t material, const glm::dvec3& corner_m, const glm::dvec3& edge_a,
                     const glm::dvec3& edge_b);
/// Lit by this lamp alone.
Moment moment_of(LitLamp lamp);

inline constexpr double unbounded = std::numeric_limits<double>::infinity();
inline constexpr FrameOutputs everything{
    .colour = true, .illuminance = true, .target = true, .luminance = true, .depth = true, .ids = true};

/// Values of the frame's pictures that are NaN or infinite.
std::size_t not_finite(const Frame& frame);
/// Of a frame with an illuminance.
inline int pixels_in(const Frame& frame) { return static_cast<int>(frame.illuminance_lx.size()); }

struct AgainstTwin {
    double of_bound = 0.0;       ///< largest |drawn - twin| of an illuminance over the bound of its pixel
    double worst_relative = 0.0; ///< and over the twin's own value, where that is above 0
    int compared = 0;            ///< pixels that show a surface; those on silhouettes are left out
    std::size_t not_finite = 0;  ///< pixels of any picture
    std::string where;

    /// of_bound; infinite where a pixel is not finite or nothing was compared.
    double error() const;
};

/// Draws and compares pixel by pixel. The bound of a pixel: 24 roundings of light, and what 16 roundings of the largest coordinate among
/// scene, lamp and camera move the point, as seen in 1 / d^2, in the cosine, and in the beam's gradient (twin.h).
AgainstTwin against_twin(Renderer& renderer, const Scene& scene, const Moment& moment, const View& view);

/// The same for a scene that is all one horizontal plane at height 0 of the car, in closed form: for scenes of too many triangles for the
/// twin. `inside` tells which places (relative to the car) must be covered; there a pixel that shows nothing is a hole, and infinitely
/// wrong.
AgainstTwin against_plane(const Frame& frame, const Moment& moment, const View& view, double reach_m,
                          const std::function<bool(const glm::dvec3&)>& inside);

/// The bound for one lamp at one point; `reach_m` is the largest coordinate involved, relative to the car.
double rounding_bound_lx(const LitLamp& lamp, const glm::dvec3& to_lamp, const glm::dvec3& normal, double reach_m);

// Files of a user, as the cases write them: lamps, a road, drives.
/// A beam matrix of this name in the bench's folder.
std::filesystem::path write_matrix(StabilityBench& bench, const std::string& name, const CandelaTable& table);

/// One road of OpenDRIVE. `plan`: its geometry elements; `lanes`: of the right side; `profiles`: elevation and lateral profile.
std::string road_text(double length_m, const std::string& plan, const std::string& lanes, const std::string& profiles = {});
/// A driving lane of even width, with `more` inside.
std::string lane_text(int id, double width_m, const std::string& more = {});
inline const std::string line_of_600_m = R"(<geometry s="0" x="0" y="0" hdg="0" length="600"><line/></geometry>)";

/// Of the triangles of these kinds, m2.
double area_of(const Scene& scene, const std::set<SurfaceKind>& kinds);

/// A drive of one lamp on the straight road, at 60 km/h for 8 s in steps of 0.1 s, with `more` keys of YAML, one a line. `time` replaces
/// the three of speed, step and duration.
std::filesystem::path write_drive_file(StabilityBench& bench, const std::string& name, const std::string& more,
                                       const std::string& time = {});

} // namespace fernlicht::stability
