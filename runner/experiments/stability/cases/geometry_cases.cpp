// Triangles as data bases have them: needles, slivers, coplanar ones, a million, and marks thinner than a pixel.
#include "runner/experiments/stability/trial.h"
#include "scenarios/drives/play/camera.h"
#include "scenarios/roads/mesh/mesh_builder.h"
#include "scenarios/roads/mesh/road_mesh.h"

#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <random>

namespace fernlicht {
namespace {

using namespace stability;

Moment one_lamp() { return moment_of(lamp(cut_off_table(), {3.5, 0.6, 0.65})); }

View driver(int width_px, int height_px) { return camera({1.3, 0.35, 1.2}, 0.0, -0.05, 30.0, width_px, height_px); }

/// A plane of strips of one width, cut across every `length_m`, each part into slivers at points on its edges, with triangles without area
/// among them. Vertices of neighbours agree, so that there are no cracks.
Scene strips(double width_m, double length_m, double half_m) {
    std::mt19937_64 random(StabilityBench::seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    Scene scene = empty_scene();
    Mesh mesh{"strips", {40.0, 0.0, 0.0}, {}, {}, {}};
    const auto vertex = [&](double x, double y) {
        mesh.vertices.push_back({{static_cast<float>(x), static_cast<float>(y), 0.0F}, {0.0F, 0.0F, 1.0F}});
        return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    };
    const int rows = static_cast<int>(std::round(2.0 * half_m / width_m)), parts = static_cast<int>(std::round(120.0 / length_m));
    for (int part = 0; part < parts; ++part) {
        const double from = -60.0 + length_m * part, to = from + length_m;
        double cut =
            from + 0.5 * length_m; // where the strip before was cut: its upper edge is this strip's lower one, with the same points
        for (int row = 0; row < rows; ++row) {
            const double y = -half_m + width_m * row, next = -half_m + width_m * (row + 1), next_cut = from + length_m * share(random);
            const std::uint32_t a = vertex(from, y), p = vertex(cut, y), b = vertex(to, y), c = vertex(to, next),
                                m = vertex(next_cut, next), d = vertex(from, next);
            mesh.indices.insert(mesh.indices.end(), {a, p, d, p, m, d, p, b, m, b, c, m, a, a, m, p, p, p});
            cut = next_cut;
        }
    }
    mesh.batches = {{0, 0, static_cast<std::uint32_t>(mesh.indices.size())}};
    scene.meshes.push_back(std::move(mesh));
    return scene;
}

using Strip = std::pair<double, double>; ///< length and width

/// `amplified`: each rounding of a place counts length over width times where the rasteriser solves for its gradient.
StabilityCase::Measure over_strips(const std::vector<Strip>& all, bool amplified) {
    return [all, amplified](StabilityBench& bench, Found& worst) {
        for (const auto& [length_m, width_m] : all) {
            const double half_m = std::min(19.5, 1000.0 * width_m), reach_m = 102.0 + (amplified ? length_m * length_m / width_m : 0.0);
            const Scene scene = strips(width_m, length_m, half_m);
            Renderer renderer(bench.device(), scene, unshadowed());
            const Moment moment = one_lamp();
            const View view = driver(320, 200);
            const AgainstTwin found = against_plane(renderer.draw(moment, view, everything), moment, view, reach_m,
                                                    [&](const glm::dvec3& p) { return p.x < 99.0 && std::abs(p.y) < 0.99 * half_m; });
            worst.add(found.error(),
                      fmt::format("{} m by {} m: {}; {:.1e} relative over {} pixels", length_m, width_m, found.where, found.worst_relative,
                                  found.compared),
                      found.compared);
        }
    };
}

/// The same road twice at one height, cut into different triangles, and a third time as a mark.
void coplanar(StabilityBench& bench, Found& worst) {
    Scene scene = empty_scene();
    scene.materials[1] = scene.materials[0];
    scene.materials[1].kind = SurfaceKind::marking;
    add_sheet(scene, "road", 0, {-20.0, -20.0, 0.0}, {120.0, 0.0, 0.0}, {0.0, 40.0, 0.0});
    add_sheet(scene, "road again", 0, {-20.0, -20.0, 0.0}, {120.0, 0.0, 0.0}, {0.0, 40.0, 0.0});
    add_sheet(scene, "mark", 1, {-19.0, -3.3, 0.0}, {111.0, 0.0, 0.0}, {0.0, 7.1, 0.0});
    const Moment moment = one_lamp();
    const View view = driver(320, 200);
    const auto drawn = [&] {
        Renderer renderer(bench.device(), scene, unshadowed());
        return renderer.draw(moment, view, everything);
    };
    const Frame frame = drawn();
    const AgainstTwin found =
        against_plane(frame, moment, view, 102.0, [](const glm::dvec3& p) { return p.x < 99.0 && std::abs(p.y) < 19.0; });
    worst.add(found.error(), fmt::format("lux: {}, {:.1e} relative over {} pixels", found.where, found.worst_relative, found.compared),
              found.compared);
    // Which of the surfaces is seen may not depend on anything but the scene.
    worst.add(frame.ids == drawn().ids ? 0.0 : unbounded, "the same surface twice", pixels_in(frame));
}

/// A mark of 1 mm from a road file: its area in triangles, each edge put on the lattice.
void thin_mark_read(StabilityBench& bench, Found& worst) {
    const std::string mark = R"(<roadMark sOffset="0" type="solid" weight="standard" color="standard" width="0.001" laneChange="none"/>)";
    const std::filesystem::path path = bench.write("thin.xodr", road_text(600.0, line_of_600_m, lane_text(-1, 3.5, mark)));
    const Scene scene = build_scene(read_opendrive(path), {.textures = false});
    const double area_m2 = area_of(scene, {SurfaceKind::marking});
    worst.add(std::abs(area_m2 / 0.6 - 1.0), fmt::format("{:.5f} m2 for 0.6 m2", area_m2));
}

/// A mark of 1 mm seen at 150 to 250 m, a sixth of a pixel wide: a pixel shows what is at its centre, so that pixels flicker, but over many
/// the share of the mark must be right.
void thin_mark_seen(StabilityBench& bench, Found& worst) {
    Scene scene = empty_scene();
    const double half_m = 0.0005;
    add_sheet(scene, "left", 0, {-20.0, half_m, 0.0}, {320.0, 0.0, 0.0}, {0.0, 4.0, 0.0});
    add_sheet(scene, "mark", 0, {-20.0, -half_m, 0.0}, {320.0, 0.0, 0.0}, {0.0, 2.0 * half_m, 0.0});
    add_sheet(scene, "right", 0, {-20.0, -4.0, 0.0}, {320.0, 0.0, 0.0}, {0.0, 4.0 - half_m, 0.0});
    Renderer renderer(bench.device(), scene, unshadowed());
    const Moment moment = one_lamp();
    std::size_t seen = 0, expected = 0, holes = 0;
    for (int shot = 0; shot < 48; ++shot) {
        // From the side, so that the mark crosses columns; each shot a little farther on, so that other centres meet it.
        View view = camera({0.01 * shot, 1.7 + 0.0007 * shot, 1.2}, -std::atan(1.7 / 200.0), -std::atan(1.2 / 200.0), 0.6, 512, 256);
        const Frame frame = renderer.draw(moment, view, {.ids = true});
        const Camera axes = camera_of(moment, view);
        for (int y = 0; y < view.height_px; ++y)
            for (int x = 0; x < view.width_px; ++x) {
                const Ray ray = pixel_ray(axes, view, x + 0.5, y + 0.5);
                const glm::dvec3 centre = ray.origin_m - ray.direction * (ray.origin_m.z / ray.direction.z);
                const std::uint32_t id = frame.ids.at(x, y);
                holes += id == 0 && centre.x > 0.0 && centre.x < 299.0 ? 1U : 0U;
                seen += id == 2 ? 1U : 0U;
                expected += std::abs(centre.y) <= half_m && centre.x > 0.0 && centre.x < 300.0 ? 1U : 0U;
            }
    }
    worst.add(holes > 0 || expected == 0 ? unbounded : std::abs(static_cast<double>(seen) / static_cast<double>(expected) - 1.0),
              fmt::format("{} pixels show the mark, {} centres lie on it, {} holes", seen, expected, holes), static_cast<int>(expected));
}

} // namespace

std::vector<StabilityCase> geometry_cases() {
    const std::string of_bound = "of the pixel's rounding bound";
    const std::string flat = "light is computed at each pixel from its place: how the plane is cut into triangles may not show";
    return {
        {"geometry", "marks", "strips of 15 m by 0.1 m and 1 m by 1 mm, slivers, triangles without area: holes, barycentric 0/0", 1.0,
         of_bound, flat, over_strips({{15.0, 1.0}, {15.0, 0.1}, {5.0, 0.03}, {1.0, 0.001}}, false)},
        {"geometry", "needles", "strips of 120 m by 1 cm: the rasteriser's gradients are quotients by a sliver's area", 1.0,
         "of the pixel's rounding bound times length over width",
         "each rounding of a place counts length over width times: single pixels on such needles may have the light of a place metres away",
         over_strips({{120.0, 0.1}, {120.0, 0.01}, {120.0, 0.001}, {15.0, 0.01}, {15.0, 0.001}}, true)},
        {"geometry", "coplanar", "surfaces at one height: which is seen may flicker, its light may not", 1.0, of_bound, flat, coplanar},
        {"geometry", "mark-1mm-read", "a mark of 1 mm is 33 steps of the lattice that vertices lie on", 0.0306, "of the mark's area",
         "each edge moves by at most half a step of 2^-15 m: 15 micrometres of 1 mm, on both sides", thin_mark_read},
        {"geometry", "mark-1mm-seen", "a mark of 1 mm at 200 m is a fraction of a pixel", 0.034, "of the pixels that should show it",
         "the rasteriser puts corners on 1/256 of a pixel: half of it at both edges of a mark 0.12 pixels wide. That pixels show the mark "
         "or not and nothing between is by nature",
         thin_mark_seen},
    };
}

} // namespace fernlicht
