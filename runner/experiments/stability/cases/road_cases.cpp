// Roads at the limits of geometry, read from OpenDRIVE as a user's are.
#include "runner/experiments/stability/trial.h"
#include "scenarios/roads/mesh/road_mesh.h"

#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

using namespace stability;

Scene scene_of(StabilityBench& bench, const std::string& name, const std::string& text) {
    return build_scene(read_opendrive(bench.write(name + ".xodr", text)), {.textures = false});
}

/// Vertices that are no place, normals that are not of unit length.
double bad_vertices(const Scene& scene) {
    double bad = 0.0;
    for (const Mesh& mesh : scene.meshes)
        for (const Vertex& vertex : mesh.vertices) {
            const double length = static_cast<double>(glm::length(vertex.normal));
            const bool good =
                std::isfinite(glm::length(mesh.origin_m)) && std::isfinite(glm::length(vertex.position_m)) && std::abs(length - 1.0) < 1e-5;
            bad += good ? 0.0 : 1.0;
        }
    return bad;
}

double paved_m2(const Scene& scene) { return area_of(scene, {SurfaceKind::road, SurfaceKind::marking}); }

constexpr int drawn_px = 2 * 64 * 48;

/// Drawn from above by a lamp: not one pixel without a number.
double bad_pixels(StabilityBench& bench, const Scene& scene, const glm::dvec3& at_m) {
    Renderer renderer(bench.device(), scene, unshadowed());
    Moment moment;
    moment.ego.position_m = at_m;
    moment.lamps = {lamp(constant_table(1000.0), at_m + glm::dvec3(0.0, 0.0, 0.65)),
                    lamp(cut_off_table(), at_m + glm::dvec3(0.5, 0.0, 0.65), 1.0)};
    const double from_car =
        static_cast<double>(not_finite(renderer.draw(moment, camera({0.0, 0.0, 1.2}, 0.0, -0.1, 60.0, 64, 48), everything)));
    return from_car + static_cast<double>(not_finite(renderer.draw(moment, camera({0.0, 0.0, 20.0}, 0.0, -1.5, 60.0, 64, 48), everything)));
}

/// A turn and a half of radius 2 m to the left, the lane outside it: an area in closed form.
void hairpin(StabilityBench& bench, Found& worst) {
    const double radius = 2.0, length = 3.0 * pi;
    for (const double width : {0.5, 1.75, 3.5}) {
        const std::string plan =
            fmt::format(R"(<geometry s="0" x="0" y="0" hdg="0" length="{}"><arc curvature="0.5"/></geometry>)", length);
        const Scene scene = scene_of(bench, "hairpin", road_text(length, plan, lane_text(-1, width)));
        const double truth = length / radius * 0.5 * (std::pow(radius + width, 2.0) - radius * radius);
        worst.add(bad_vertices(scene) > 0.0 ? unbounded
                                            : std::abs(paved_m2(scene) - truth) / (2.0 * 0.005 * length * (1.0 + width / radius)),
                  fmt::format("{} m wide outside: {:.4f} m2 for {:.4f}", width, paved_m2(scene), truth));
        worst.add(bad_pixels(bench, scene, {0.0, 0.0, 0.0}) > 0.0 ? unbounded : 0.0, "rendered, outside", drawn_px);
    }
}

/// The same to the right: a lane of 3.5 m inside a radius of 2 m reaches beyond the centre and folds over.
void folded(StabilityBench& bench, Found& worst) {
    for (const double curvature : {-0.5, -1.0, -10.0}) {
        const double length = 3.0;
        const std::string plan =
            fmt::format(R"(<geometry s="0" x="0" y="0" hdg="0" length="{}"><arc curvature="{}"/></geometry>)", length, curvature);
        const Scene scene = scene_of(bench, "folded", road_text(length, plan, lane_text(-1, 3.5)));
        worst.add(bad_vertices(scene) + bad_pixels(bench, scene, {0.0, -1.0, 0.0}), fmt::format("radius {} m", -1.0 / curvature), drawn_px);
    }
}

void no_width(StabilityBench& bench, Found& worst) {
    const std::string taper =
        R"(<lane id="-2" type="driving"><width sOffset="0" a="3.5" b="-0.035" c="0" d="0"/><width sOffset="100" a="0" b="0" c="0" d="0"/></lane>)";
    const std::string plan = R"(<geometry s="0" x="0" y="0" hdg="0" length="200"><arc curvature="0.002"/></geometry>)";
    const std::pair<const char*, std::string> all_lanes[] = {
        {"one lane of width 0", lane_text(-1, 0.0)},
        {"a lane of width 0 between two", lane_text(-1, 3.5) + lane_text(-2, 0.0) + lane_text(-3, 3.5)},
        {"a lane that narrows to 0", lane_text(-1, 3.5) + taper},
        {"a lane of a micrometre", lane_text(-1, 1e-6) + lane_text(-2, 3.5)},
        {"a lane of 1e-300 m", lane_text(-1, 1e-300) + lane_text(-2, 3.5)}};
    for (const auto& [what, lanes] : all_lanes) {
        const Scene scene = scene_of(bench, "no-width", road_text(200.0, plan, lanes));
        worst.add(bad_vertices(scene) + bad_pixels(bench, scene, {50.0, 0.0, 0.0}), what, drawn_px);
    }
}

/// Kerbs, boxes and a road that leans as far as a road file may.
void walls(StabilityBench& bench, Found& worst) {
    const std::string kerb =
        R"(<lane id="-2" type="sidewalk"><width sOffset="0" a="2" b="0" c="0" d="0"/><height sOffset="0" inner="3" outer="3"/></lane>)";
    for (
        const auto& [what, profiles] :
        {std::pair("a kerb of 3 m", std::string()),
         std::pair("superelevation of 1.39 rad",
                   std::string(R"(<lateralProfile><superelevation s="0" a="1.39" b="0" c="0" d="0"/></lateralProfile>)")),
         std::pair(
             "a climb of 1000 m a metre",
             std::string(
                 R"(<elevationProfile><elevation s="0" a="0" b="0" c="0" d="0"/><elevation s="10" a="0" b="1000" c="0" d="0"/><elevation s="10.01" a="10" b="0" c="0" d="0"/></elevationProfile>)"))}) {
        const Scene scene = scene_of(bench, "walls",
                                     road_text(200.0, R"(<geometry s="0" x="0" y="0" hdg="0" length="200"><line/></geometry>)",
                                               lane_text(-1, 3.5) + kerb, profiles));
        worst.add(bad_vertices(scene) + bad_pixels(bench, scene, {5.0, -1.0, 0.0}), what, drawn_px);
    }
}

/// Light on a vertical wall whose plane passes through the lamp or nearly so, and just before and behind it.
void wall_edge_on(StabilityBench& bench, Found& worst) {
    Scene scene = scene_of_sheet("wall", 0, {5.0, 0.0, 0.0}, {40.0, 0.0, 0.0}, {0.0, 0.0, 3.0}); // in the plane y = 0, faces -y
    Renderer renderer(bench.device(), scene, unshadowed());
    for (const double beside_m : {-1.0, -1e-3, -1e-6, -1e-30, 0.0, 1e-30, 1e-6, 1e-3, 1.0}) {
        Moment moment = moment_of(lamp(constant_table(1000.0), {0.0, beside_m, 0.65}));
        const AgainstTwin found = against_twin(renderer, scene, moment, camera({0.0, -3.0, 1.2}, 0.15, 0.0, 40.0, 48, 32));
        worst.add(found.error(),
                  fmt::format("lamp {} m beside the wall's plane: {}, {:.1e} relative", beside_m, found.where, found.worst_relative),
                  found.compared);
    }
}

} // namespace

std::vector<StabilityCase> road_cases() {
    return {
        {"road", "radius-2m", "a turn of 2 m radius: chords, overlapping turns", 1.0, "of 5 mm along both edges",
         "the mesh keeps within 5 mm of the surface, so its area within 5 mm times its edges", hairpin},
        {"road", "folded", "a lane that reaches beyond its turn's centre: the surface folds over, normals turn round", 0.0,
         "vertices or pixels that are not finite", "a folded surface is rendered as it is; no place or normal of it divides by its extent",
         folded},
        {"road", "width-0", "lanes without width, and of 1e-300 m: triangles without area", 0.0, "vertices or pixels that are not finite",
         "normals come from the surface's equation, not from its triangles", no_width},
        {"road", "walls", "kerbs of 3 m, a lean of 80 degrees, a climb of 1000 m a metre", 0.0, "vertices or pixels that are not finite",
         "tangents of both directions stay apart by at least 10 degrees", walls},
        {"road", "wall-edge-on", "a lamp in the plane of a wall: the cosine's sign is a rounding error", 1.0,
         "of the pixel's rounding bound", "the rounding of a position over the distance to the plane; light through the wall's back is 0",
         wall_edge_on},
    };
}

} // namespace fernlicht
