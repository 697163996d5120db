#include "runner/experiments/stability/trial.h"

#include "scenarios/drives/play/camera.h"
#include "scenarios/lamps/beam_files.h"
#include "scenarios/light/light.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht::stability {
namespace {

/// Of a float: half a unit in the last place, relative.
constexpr double rounding = 0x1p-24;
constexpr double light_roundings = 24.0, place_roundings = 16.0;
/// Of quick_atan and quick_asin_half in float, with the texel's position.
constexpr double angle_error_rad = 1e-6;

template <class T> std::size_t bad_pixels(const Image<T>& image) {
    return static_cast<std::size_t>(std::ranges::count_if(image.pixels(), [](T value) { return !std::isfinite(value); }));
}

/// Change of I per radian, the larger of across and up, over a hundredth of a degree; cd.
double gradient_cd(const CandelaTable& table, double h_deg, double v_deg) {
    const double step = 0.01, here = intensity_cd(table, h_deg, v_deg);
    double across = 0.0, up = 0.0;
    for (const double s : {-step, step}) {
        across = std::max(across, std::abs(intensity_cd(table, h_deg + s, v_deg) - here));
        up = std::max(up, std::abs(intensity_cd(table, h_deg, v_deg + s) - here));
    }
    return (across + up) / radians(step);
}

double reach_of(const Scene& scene, const Moment& moment, const View& view) {
    double reach = glm::length(view.position_m);
    for (const Mesh& mesh : scene.meshes)
        for (const Vertex& vertex : mesh.vertices)
            reach = std::max(reach, glm::length(mesh.origin_m - moment.ego.position_m + glm::dvec3(vertex.position_m)));
    for (const LitLamp& lamp : moment.lamps)
        reach = std::max(reach, glm::length(lamp.pose.position_m - moment.ego.position_m));
    return reach;
}

/// `wrong`: it shows another surface, or none.
void add_pixel(AgainstTwin& result, float drawn_lx, double truth_lx, double bound_lx, bool wrong, const std::string& where) {
    ++result.compared;
    const double off = std::abs(static_cast<double>(drawn_lx) - truth_lx), ratio = wrong ? unbounded : off / bound_lx;
    if (truth_lx > 0.0)
        result.worst_relative = std::max(result.worst_relative, off / truth_lx);
    if (result.where.empty() || ratio > result.of_bound) {
        result.of_bound = ratio;
        result.where = where;
    }
}

} // namespace

RendererSettings unshadowed() {
    RendererSettings settings;
    settings.shadows.method = ShadowMethod::none;
    return settings;
}

Scene scene_of_sheet(const std::string& name, std::uint32_t material, const glm::dvec3& corner_m, const glm::dvec3& edge_a,
                     const glm::dvec3& edge_b) {
    Scene scene = empty_scene();
    add_sheet(scene, name, material, corner_m, edge_a, edge_b);
    return scene;
}

Moment moment_of(LitLamp lamp) {
    Moment moment;
    moment.lamps.push_back(std::move(lamp));
    return moment;
}

std::size_t not_finite(const Frame& frame) {
    return bad_pixels(frame.illuminance_lx) + bad_pixels(frame.target_lx) + bad_pixels(frame.luminance_cdm2) + bad_pixels(frame.depth_m);
}

double AgainstTwin::error() const { return not_finite > 0 || compared == 0 ? unbounded : of_bound; }

double rounding_bound_lx(const LitLamp& lamp, const glm::dvec3& to_lamp, const glm::dvec3& normal, double reach_m) {
    const double d = glm::length(to_lamp), cosine = glm::dot(normal, to_lamp) / d;
    const double moved = place_roundings * rounding * reach_m / d, cosine_error = moved + 4.0 * rounding;
    if (!(cosine > -cosine_error))
        return 0.0; // surely behind the surface: exactly dark
    const glm::dvec3 w = photometry::lamp_space(-to_lamp, -lamp.pose.left(), lamp.pose.up(), lamp.pose.forward());
    const glm::dvec2 angles = photometry::goniometer_angles(w);
    const double h = degrees(angles.x), v = degrees(angles.y), scale = lamp.intensity_factor / (d * d), lit = std::max(cosine, 0.0);
    const double facing = w.z > 0.0 ? scale * intensity_cd(lamp.file->table, h, v) : 0.0;
    return facing * (lit * (light_roundings * rounding + 3.0 * moved) + cosine_error) +
           scale * gradient_cd(lamp.file->table, h, v) * lit * (angle_error_rad + moved);
}

AgainstTwin against_plane(const Frame& frame, const Moment& moment, const View& view, double reach_m,
                          const std::function<bool(const glm::dvec3&)>& inside) {
    const Camera camera = camera_of(moment, view);
    AgainstTwin result;
    result.not_finite = not_finite(frame);
    for (int y = 0; y < view.height_px; ++y)
        for (int x = 0; x < view.width_px; ++x) {
            const Ray ray = pixel_ray(camera, view, x + 0.5, y + 0.5);
            const glm::dvec3 point = ray.origin_m - ray.direction * (ray.origin_m.z / ray.direction.z);
            if (!(ray.direction.z < 0.0) || !inside(point))
                continue;
            double bound = 1e-30, truth = 0.0;
            for (const LitLamp& lamp : moment.lamps) {
                const glm::dvec3 to_lamp = lamp.pose.position_m - moment.ego.position_m - point, up(0.0, 0.0, 1.0);
                truth += intensity_towards_cd(lamp, moment.ego.position_m + point) * photometry::incidence(up, to_lamp) /
                         glm::dot(to_lamp, to_lamp);
                bound += rounding_bound_lx(lamp, to_lamp, up, reach_m);
            }
            const bool hole = frame.ids.at(x, y) == 0;
            add_pixel(result, frame.illuminance_lx.at(x, y), truth, bound, hole,
                      fmt::format("{} {} {}", hole ? "hole at pixel" : "pixel", x, y));
        }
    return result;
}

AgainstTwin against_twin(Renderer& renderer, const Scene& scene, const Moment& moment, const View& view) {
    const Frame frame = renderer.draw(moment, view, everything);
    const Twin twin(scene, false);
    const double reach = reach_of(scene, moment, view);
    AgainstTwin result;
    result.not_finite = not_finite(frame);
    for (int y = 0; y < view.height_px; ++y)
        for (int x = 0; x < view.width_px; ++x) {
            const TwinPixel truth = twin.pixel(moment, view, x + 0.5, y + 0.5);
            bool inner = truth.id != 0;
            for (const double dx : {0.4, 0.6})
                for (const double dy : {0.4, 0.6})
                    inner = inner && twin.pixel(moment, view, x + dx, y + dy).id == truth.id;
            if (!inner)
                continue;
            double bound = 1e-30 + truth.illuminance_lx * light_roundings * rounding;
            for (const LitLamp& lamp : moment.lamps)
                bound += rounding_bound_lx(lamp, lamp.pose.position_m - moment.ego.position_m - truth.point_m, truth.normal, reach);
            add_pixel(result, frame.illuminance_lx.at(x, y), truth.illuminance_lx, bound, frame.ids.at(x, y) != truth.id,
                      fmt::format("pixel {} {}", x, y));
        }
    return result;
}

std::filesystem::path write_matrix(StabilityBench& bench, const std::string& name, const CandelaTable& table) {
    LampFile lamp;
    lamp.table = table;
    return bench.write(name, beam_matrix_text(lamp));
}

std::string lane_text(int id, double width_m, const std::string& more) {
    return fmt::format(R"(<lane id="{}" type="driving"><width sOffset="0" a="{}" b="0" c="0" d="0"/>{}</lane>)", id, width_m, more);
}

std::string road_text(double length_m, const std::string& plan, const std::string& lanes, const std::string& profiles) {
    return fmt::format(R"(<?xml version="1.0"?>
<OpenDRIVE><header revMajor="1" revMinor="7"/>
<road name="trial" length="{}" id="1" junction="-1">
<planView>{}</planView>{}
<lanes><laneSection s="0"><center><lane id="0"/></center><right>{}</right></laneSection></lanes></road></OpenDRIVE>
)",
                       length_m, plan, profiles, lanes);
}

double area_of(const Scene& scene, const std::set<SurfaceKind>& kinds) {
    double area_m2 = 0.0;
    for (const Mesh& mesh : scene.meshes)
        for (const Batch& batch : mesh.batches)
            for (std::uint32_t i = batch.first; i + 2 < batch.first + batch.count; i += 3) {
                const auto corner = [&](std::uint32_t k) { return glm::dvec3(mesh.vertices[mesh.indices[i + k]].position_m); };
                if (kinds.contains(scene.materials[batch.material].kind))
                    area_m2 += 0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
            }
    return area_m2;
}

std::filesystem::path write_drive_file(StabilityBench& bench, const std::string& name, const std::string& more, const std::string& time) {
    bench.write("straight.xodr", road_text(600.0, line_of_600_m, lane_text(-1, 3.5)));
    const CandelaTable table{{-40.0, 40.0}, {-20.0, 20.0}, {5000.0, 5000.0, 5000.0, 5000.0}, {}, BetweenSamples::linear_cd};
    write_matrix(bench, "even.csv", table);
    return bench.write(name, fmt::format("fernlicht: 1\nname: trial\nroad: straight.xodr\n{}\ncar:\n  lamps:\n    right: {{file: even.csv, "
                                         "position_m: [3.5, -0.6, 0.65]}}\n{}\n",
                                         time.empty() ? "speed_kmh: 60\nstep_s: 0.1\nduration_s: 8" : time, more));
}

} // namespace fernlicht::stability
