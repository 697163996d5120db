#include "scenarios/models/body_parts.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

constexpr double proud_m = 0.004; ///< plates stand before what carries them

/// From the underside's middle up the left side to the roof's middle.
std::vector<glm::dvec2> half_section(const BodySection& s) {
    const double shoulder = std::clamp(0.38, s.bottom + 0.08, std::max(s.bottom + 0.08, s.belt - 0.02));
    const double glass_top = s.belt + 0.82 * (s.top - s.belt), lean = s.half_roof + 0.25 * (0.985 * s.half_width - s.half_roof);
    return {{0.0, s.bottom},
            {0.82 * s.half_width, s.bottom},
            {0.97 * s.half_width, s.bottom + 0.05},
            {s.half_width, shoulder},
            {0.985 * s.half_width, s.belt},
            {lean, glass_top},
            {0.88 * s.half_roof, s.top - 0.02 * (s.top - s.belt)},
            {0.0, s.top}};
}

} // namespace

std::vector<Material> body_materials(const glm::vec3& paint) {
    // Reflectances of our own choice, as such surfaces look: tyre 4 %, clean glass before a dark inside 3 %.
    std::vector<Material> all{{.name = "paint", .albedo = paint},
                              {.name = "glass", .albedo = glm::vec3(0.03F)},
                              {.name = "trim", .albedo = glm::vec3(0.05F)},
                              {.name = "tyre", .albedo = glm::vec3(0.04F)},
                              {.name = "rim", .albedo = glm::vec3(0.35F)},
                              {.name = "lens", .albedo = glm::vec3(0.45F)},
                              {.name = "red lens", .albedo = {0.20F, 0.015F, 0.015F}},
                              {.name = "amber lens", .albedo = {0.35F, 0.14F, 0.01F}},
                              {.name = "number plate", .albedo = glm::vec3(0.55F)},
                              {.name = "reflector", .albedo = {0.12F, 0.01F, 0.01F}},
                              {.name = "cloth", .albedo = {0.05F, 0.06F, 0.09F}},
                              {.name = "skin", .albedo = {0.40F, 0.27F, 0.20F}}};
    for (Material& material : all)
        material.kind = SurfaceKind::vehicle;
    // EN 12899-1, class RA1, white: 50 cd/(lx m2) at 20', 5 at 2 degrees.
    Material& plate = all[index_of(BodyMaterial::plate)];
    plate.retro_rl = 50.0F;
    plate.retro_reference_rad = static_cast<float>(radians(20.0 / 60.0));
    plate.retro_falloff_rad = static_cast<float>(radians(2.0 - 20.0 / 60.0) / std::log(10.0));
    // UN R3, class IA, red: 300 mcd/lx at 20' and 5 at 1.5 degrees, from 25 cm2.
    Material& reflector = all[index_of(BodyMaterial::reflector)];
    reflector.retro_rl = 0.3F / 25.0e-4F;
    reflector.retro_reference_rad = plate.retro_reference_rad;
    reflector.retro_falloff_rad = static_cast<float>(radians(1.5 - 20.0 / 60.0) / std::log(60.0));
    reflector.retro_rgb = {1.0F, 0.0F, 0.0F}; // the display's red; UN R3's reaches further out than sRGB
    return all;
}

BodyBuilder::BodyBuilder(std::string name, const BodySize& size) : size_(size) {
    model_.name = std::move(name);
    model_.materials = body_materials(size.paint);
}

void BodyBuilder::hull(const std::vector<BodySection>& sections, const SectionMaterial& material) {
    std::vector<Outline> stations;
    for (const BodySection& section : sections) {
        const std::vector<glm::dvec2> half = half_section(section);
        Outline outline; // up the right side, down the left: counter-clockwise seen along x
        for (const glm::dvec2& p : half)
            outline.emplace_back(x(section.along), y(-p.x), z(p.y));
        for (std::size_t k = half.size() - 2; k > 0; --k)
            outline.emplace_back(x(section.along), y(half[k].x), z(half[k].y));
        stations.push_back(std::move(outline));
    }
    const std::size_t points = stations[0].size();
    const auto strip = [&](std::size_t k) { return std::min(k, points - 1 - k); }; // the same on both sides
    append_loft(
        soup_, stations, [&](std::size_t i, std::size_t k) { return index_of(material(i, strip(k))); }, index_of(BodyMaterial::paint));
}

void BodyBuilder::box(const glm::dvec3& low_m, const glm::dvec3& high_m, BodyMaterial material) {
    append_box(soup_, low_m, high_m, index_of(material));
}

void BodyBuilder::axle(double x_m, double radius_m, double width_m) {
    for (const double side : {-1.0, 1.0})
        append_wheel(soup_, {x_m, side * (y(1.0) - 0.5 * width_m), radius_m}, radius_m, width_m, 0.62, 14, index_of(BodyMaterial::tyre),
                     index_of(BodyMaterial::rim));
}

void BodyBuilder::plate(double x_m, double z_m, double width_m, double height_m, bool faces_forward, BodyMaterial material) {
    append_plate(soup_, {x_m + (faces_forward ? proud_m : -proud_m), 0.0, z_m}, width_m, height_m, faces_forward, index_of(material));
}

void BodyBuilder::pair(double x_m, double beside_m, double z_m, double width_m, double height_m, bool faces_forward,
                       BodyMaterial material) {
    for (const double side : {-1.0, 1.0})
        append_plate(soup_, {x_m + (faces_forward ? proud_m : -proud_m), side * beside_m, z_m}, width_m, height_m, faces_forward,
                     index_of(material));
}

void BodyBuilder::mounts(const std::string& function, double x_m, double beside_m, double z_m, bool forward) {
    const glm::dmat3 axes = axes_from_angles(forward ? 0.0 : pi, 0.0, 0.0);
    if (beside_m == 0.0) {
        model_.mounts.push_back({"lamp." + function + ".centre", {{x_m, 0.0, z_m}, axes}});
        return;
    }
    model_.mounts.push_back({"lamp." + function + ".left", {{x_m, beside_m, z_m}, axes}});
    model_.mounts.push_back({"lamp." + function + ".right", {{x_m, -beside_m, z_m}, axes}});
}

void BodyBuilder::lights(double front_z_m, double rear_z_m, double beside_m, double lens_width_m, double lens_height_m) {
    const double front = front_m(), rear = rear_m();
    pair(front, beside_m, front_z_m, lens_width_m, lens_height_m, true, BodyMaterial::lens);
    pair(front, beside_m - 0.5 * lens_width_m - 0.04, front_z_m, 0.05, lens_height_m, true, BodyMaterial::amber_lens);
    pair(rear, beside_m, rear_z_m, lens_width_m, lens_height_m, false, BodyMaterial::red_lens);
    pair(rear, beside_m - 0.5 * lens_width_m - 0.04, rear_z_m, 0.05, lens_height_m, false, BodyMaterial::amber_lens);
    const double low_z = std::max(0.36, front_z_m - 0.22), plate_m = 0.52;
    plate(front, low_z, plate_m, 0.11, true, BodyMaterial::plate);
    plate(rear, rear_z_m - 0.02, std::min(plate_m, 2.0 * beside_m - lens_width_m - 0.2), 0.11, false, BodyMaterial::plate);
    pair(rear, beside_m, std::max(0.30, rear_z_m - 0.24), 0.10, 0.05, false, BodyMaterial::reflector);
    for (const char* function : {"low", "high", "position", "indicator-front"})
        mounts(function, front + proud_m, beside_m, front_z_m, true);
    for (const char* function : {"tail", "brake", "indicator-rear"})
        mounts(function, rear - proud_m, beside_m, rear_z_m, false);
}

Model BodyBuilder::take() && {
    smooth(soup_, radians(38.0));
    add_meshes(model_, soup_);
    std::ranges::sort(model_.mounts, {}, &Mount::name);
    return std::move(model_);
}

} // namespace fernlicht
