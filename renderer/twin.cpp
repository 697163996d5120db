#include "renderer/twin.h"

#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

constexpr double sky_m = 5000.0; // as far as the air before the sky is drawn
constexpr double angle_error_rad = 6e-6, position_error = 1e-6, operations = 24.0, half_ulp = 6e-8;

bool stands_on_ground(const Scene& scene, const Mesh& mesh) {
    return std::ranges::any_of(mesh.batches, [&](const Batch& batch) { return !is_ground(scene.materials[batch.material].kind); });
}

/// Moeller and Trumbore 1997, both sides; distance and barycentric u, v.
std::optional<glm::dvec3> intersect(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 ab = b - a, ac = c - a, p = glm::cross(ray.direction, ac);
    const double determinant = glm::dot(ab, p);
    if (std::abs(determinant) < 1e-300)
        return std::nullopt;
    const glm::dvec3 s = ray.origin_m - a;
    const double u = glm::dot(s, p) / determinant;
    if (u < 0.0 || u > 1.0)
        return std::nullopt;
    const glm::dvec3 q = glm::cross(s, ab);
    const double v = glm::dot(ray.direction, q) / determinant;
    if (v < 0.0 || u + v > 1.0)
        return std::nullopt;
    return glm::dvec3(glm::dot(ac, q) / determinant, u, v);
}

/// d ln I / d angle at a direction, the larger of across and up, by central differences over a hundredth of a degree.
double log_gradient_per_rad(const CandelaTable& table, double h_deg, double v_deg) {
    const double step = 0.01, i = intensity_cd(table, h_deg, v_deg);
    if (i <= 0.0)
        return 0.0;
    const double across =
        std::max(std::abs(intensity_cd(table, h_deg + step, v_deg) - i), std::abs(intensity_cd(table, h_deg - step, v_deg) - i));
    const double up =
        std::max(std::abs(intensity_cd(table, h_deg, v_deg + step) - i), std::abs(intensity_cd(table, h_deg, v_deg - step) - i));
    return (across + up) / (i * radians(step));
}

} // namespace

double float_bound_lx(double illuminance_lx, double cosine, double log_gradient) {
    return illuminance_lx *
           (operations * half_ulp + position_error * (3.0 + 1.0 / std::max(cosine, 1e-6)) + log_gradient * angle_error_rad);
}

std::optional<Twin::Hit> Twin::cast(const Moment& moment, const Ray& ray, double from_m, Met met) const {
    std::optional<Hit> nearest;
    for (std::size_t m = 0; m < scene_.meshes.size(); ++m) {
        const Mesh& mesh = scene_.meshes[m];
        if ((met == Met::ground ? stands_on_ground(scene_, mesh) : mesh.measured_alone) || (met == Met::casters && !mesh.casts))
            continue;
        if (mesh.body >= 0 && (static_cast<std::size_t>(mesh.body) >= moment.bodies.size() || met == Met::ground ||
                               !moment.bodies[static_cast<std::size_t>(mesh.body)].visible))
            continue;
        const Pose body = mesh.body >= 0 ? moment.bodies[static_cast<std::size_t>(mesh.body)].pose : Pose{};
        const glm::dvec3 offset = (mesh.body >= 0 ? to_parent(body, mesh.origin_m) : mesh.origin_m) - moment.ego.position_m;
        const auto corner = [&](std::uint32_t index) {
            const glm::dvec3 p(mesh.vertices[index].position_m);
            return offset + (mesh.body >= 0 ? body.axes * p : p);
        };
        for (const Batch& batch : mesh.batches)
            for (std::uint32_t k = batch.first; k + 2 < batch.first + batch.count; k += 3) {
                const std::uint32_t* i = &mesh.indices[k];
                const auto hit = intersect(ray, corner(i[0]), corner(i[1]), corner(i[2]));
                if (!hit || hit->x < from_m || (nearest && hit->x >= nearest->distance_m))
                    continue;
                const glm::dvec3 normal = glm::dvec3(mesh.vertices[i[0]].normal) * (1.0 - hit->y - hit->z) +
                                          glm::dvec3(mesh.vertices[i[1]].normal) * hit->y + glm::dvec3(mesh.vertices[i[2]].normal) * hit->z;
                nearest = Hit{hit->x, static_cast<std::uint32_t>(m), batch.material,
                              glm::normalize(mesh.body >= 0 ? body.axes * normal : normal)};
            }
    }
    return nearest;
}

TwinPixel Twin::pixel(const Moment& moment, const View& view, double x_px, double y_px) const {
    TwinPixel pixel = at(moment, view, x_px, y_px);
    double change_lx = 0.0;
    for (const double dx : {-place_px_, place_px_})
        for (const double dy : {-place_px_, place_px_})
            if (place_px_ > 0.0)
                change_lx = std::max(change_lx, std::abs(at(moment, view, x_px + dx, y_px + dy).illuminance_lx - pixel.illuminance_lx));
    pixel.bound_lx += change_lx;
    return pixel;
}

TwinPixel Twin::at(const Moment& moment, const View& view, double x_px, double y_px) const {
    const Camera camera = camera_of(moment, view);
    const Ray ray = pixel_ray(camera, view, x_px, y_px);
    TwinPixel pixel;
    const std::optional<Hit> hit = cast(moment, ray, 0.0, camera.is_map ? Met::ground : Met::all);
    const double sky_lx = moment.daylight.horizontal_illuminance_lx;
    const Weather& weather = moment.weather;
    const bool through_air = weather.extinction_per_m > 0.0 && !camera.is_map; // maps show the ground without the air above it
    const glm::dvec3 ego_m = moment.ego.position_m, weights(0.2126, 0.7152, 0.0722);
    const auto airlight = [&](const glm::dvec3& end_m) {
        glm::dvec3 sum(0.0);
        if (through_air)
            for (const auto* lamps : {&moment.lamps, &moment.other_lamps})
                for (const LitLamp& lamp : *lamps)
                    sum += lamp.colour.linear_srgb * airlight_cdm2(lamp, weather, ego_m + camera.eye_m, ego_m + end_m);
        return sum;
    };
    if (!hit) {
        pixel.luminance_cdm2 = sky_lx / pi + glm::dot(weights, airlight(ray.origin_m + ray.direction * sky_m));
        return pixel;
    }
    const Material& material = scene_.materials[hit->material];
    pixel.id = hit->mesh + 1;
    pixel.point_m = ray.origin_m + ray.direction * hit->distance_m;
    pixel.normal = hit->normal;
    pixel.depth_m = glm::dot(pixel.point_m - camera.eye_m, camera.axis);
    const glm::dvec3 to_eye = camera.is_map ? -camera.axis : camera.eye_m - pixel.point_m;
    const glm::dvec3 albedo(material.albedo), eye_direction = glm::normalize(to_eye);
    const double wet = gets_wet(material.kind) ? weather.wetness : 0.0;
    const Facets facets = facets_of(material);
    glm::dvec3 light(0.0);
    const auto add_light = [&](const LitLamp& lamp) {
        const glm::dvec3 lamp_m = lamp.pose.position_m - moment.ego.position_m, to_lamp = lamp_m - pixel.point_m;
        const double cosine = photometry::incidence(pixel.normal, to_lamp);
        if (!(cosine > 0.0)) // NaN at the lamp itself
            return;
        double e_perp = photometry::facing_illuminance(intensity_towards_cd(lamp, moment.ego.position_m + pixel.point_m), to_lamp);
        if (shadows_ && e_perp > 0.0) {
            const double distance = glm::length(to_lamp);
            const auto blocker = cast(moment, {pixel.point_m + pixel.normal * 1e-3, to_lamp / distance}, 1e-3, Met::casters);
            if (blocker && blocker->distance_m < distance)
                e_perp = 0.0;
        }
        e_perp *= air_transmittance(weather, glm::length(to_lamp));
        const double e = e_perp * cosine;
        pixel.illuminance_lx += e;
        const glm::dvec2 angles =
            photometry::goniometer_angles(photometry::lamp_space(-to_lamp, -lamp.pose.left(), lamp.pose.up(), lamp.pose.forward()));
        pixel.bound_lx += float_bound_lx(e, cosine, log_gradient_per_rad(lamp.file->table, degrees(angles.x), degrees(angles.y)));
        glm::dvec3 returned = albedo * e / pi, beads(0.0);
        const glm::dvec3 lamp_direction = glm::normalize(to_lamp);
        if (material.retro_rl > 0.0F)
            beads = retro_tint(material) * photometry::retro_luminance(static_cast<double>(material.retro_rl), e_perp, cosine,
                                                                       photometry::observation_angle(to_lamp, to_eye),
                                                                       static_cast<double>(material.retro_reference_rad),
                                                                       1.0 / static_cast<double>(material.retro_falloff_rad));
        returned += beads + gloss_light(facets, pixel.normal, lamp_direction, eye_direction, e_perp);
        if (wet > 0.0)
            returned = partly_wet(returned,
                                  wet_light(albedo, pixel.normal, lamp_direction, eye_direction, e_perp) +
                                      static_cast<double>(material.retro_wet) * beads,
                                  wet);
        light += lamp.colour.linear_srgb * returned;
    };
    std::ranges::for_each(moment.lamps, add_light);
    std::ranges::for_each(moment.other_lamps, add_light);
    const double e_sky = sky_lx * 0.5 * (1.0 + pixel.normal.z);
    pixel.illuminance_lx += e_sky;
    pixel.bound_lx += e_sky * operations * half_ulp;
    glm::dvec3 returned = albedo * e_sky / pi + gloss_sky_light(facets, pixel.normal, eye_direction, sky_lx / pi);
    if (wet > 0.0)
        returned = partly_wet(returned, wet_sky_light(albedo, pixel.normal, eye_direction, e_sky, sky_lx / pi), wet);
    light += returned;
    if (const DirectLight* direct = moment.daylight.direct()) {
        const glm::dvec3 towards = direct->towards();
        double e_sun = photometry::directional_illuminance(direct->illuminance_lx, pixel.normal, towards);
        if (e_sun > 0.0 && shadows_ && cast(moment, {pixel.point_m + pixel.normal * 1e-3, towards}, 1e-3, Met::casters))
            e_sun = 0.0;
        pixel.illuminance_lx += e_sun;
        pixel.bound_lx += direct->illuminance_lx * operations * half_ulp;
        returned =
            albedo * e_sun / pi + gloss_light(facets, pixel.normal, towards, eye_direction, e_sun > 0.0 ? direct->illuminance_lx : 0.0);
        if (wet > 0.0)
            returned = partly_wet(returned,
                                  wet_light(albedo, pixel.normal, towards, eye_direction, e_sun > 0.0 ? direct->illuminance_lx : 0.0), wet);
        light += returned;
    }
    light += glm::dvec3(material.emission_cdm2);
    if (through_air) {
        const double way = glm::length(camera.eye_m - pixel.point_m);
        light = light * air_transmittance(weather, way) + sky_airlight_cdm2(moment.daylight, weather, way) + airlight(pixel.point_m);
    }
    pixel.luminance_cdm2 = glm::dot(weights, light);
    return pixel;
}

} // namespace fernlicht
