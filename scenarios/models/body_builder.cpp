#include "scenarios/models/body_builder.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

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

/// The rest of BodyMaterial. Sources: docs/scenery.md.
std::vector<Material> dressed_materials() {
    const auto sheet = [](const char* name, const glm::vec3& albedo, double ra, double first_deg, double ra_far, double far_deg) {
        Material material{.name = name, .kind = SurfaceKind::vehicle, .albedo = albedo};
        material.retro_rl = static_cast<float>(ra);
        material.retro_reference_rad = static_cast<float>(radians(first_deg));
        material.retro_falloff_rad = static_cast<float>(radians(far_deg - first_deg) / std::log(ra / ra_far));
        return material;
    };
    std::vector<Material> all{sheet("headlamp", glm::vec3(0.30F), 3.0, 20.0 / 60.0, 1.0, 2.0),        // estimate
                              sheet("white tape", glm::vec3(0.40F), 450.0, 20.0 / 60.0, 10.0, 1.5),   // UN R104, class C
                              sheet("red tape", {0.12F, 0.01F, 0.01F}, 120.0, 20.0 / 60.0, 3.0, 1.5), // UN R104, class C
                              sheet("band", glm::vec3(0.25F), 330.0, 0.2, 10.0, 1.5),                 // EN ISO 20471
                              {.name = "hair", .kind = SurfaceKind::vehicle, .albedo = {0.04F, 0.03F, 0.02F}}};
    all[2].retro_rgb = {1.0F, 0.0F, 0.0F};
    return all;
}

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

BodyBuilder::BodyBuilder(std::string name, const BodySize& size) : size_(size) {
    model_.name = std::move(name);
    model_.materials = body_materials(size.paint);
    if (const std::vector<Material> more = dressed_materials(); size.dressed)
        model_.materials.insert(model_.materials.end(), more.begin(), more.end());
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
    append_loft(soup_, stations, index_of(BodyMaterial::paint),
                [&](std::size_t i, std::size_t k) { return index_of(material(i, strip(k))); });
}

void BodyBuilder::box(const glm::dvec3& low_m, const glm::dvec3& high_m, BodyMaterial material) {
    append_box(soup_, low_m, high_m, index_of(material));
}

void BodyBuilder::axle(double x_m, double radius_m, double width_m) {
    for (const double side : {-1.0, 1.0}) {
        append_wheel(soup_, {x_m, side * (y(1.0) - 0.5 * width_m), radius_m}, radius_m, width_m, 0.62, 14, index_of(BodyMaterial::tyre),
                     index_of(BodyMaterial::rim));
        if (dressed()) {
            arch(x_m, radius_m, side);
            spokes(x_m, radius_m, side);
        }
    }
}

void BodyBuilder::flank(double x0_m, double x1_m, double z0_m, double z1_m, double side, BodyMaterial material) {
    const double y_m = side * (y(1.0) - 0.001), a = side > 0.0 ? x1_m : x0_m, b = side > 0.0 ? x0_m : x1_m;
    soup_.add({glm::dvec3(a, y_m, z0_m), {b, y_m, z0_m}, {b, y_m, z1_m}}, index_of(material));
    soup_.add({glm::dvec3(a, y_m, z0_m), {b, y_m, z1_m}, {a, y_m, z1_m}}, index_of(material));
}

/// The dark gap between a wheel and the flank above it.
void BodyBuilder::arch(double x_m, double radius_m, double side) {
    constexpr int steps = 10;
    const auto at = [&](double radius, int k) {
        const double angle = pi * k / steps;
        return glm::dvec3(x_m + side * radius * std::cos(angle), side * (y(1.0) - 0.0005), radius_m + radius * std::sin(angle));
    };
    for (int k = 0; k < steps; ++k) {
        const glm::dvec3 a = at(0.97 * radius_m, k), b = at(1.16 * radius_m, k), c = at(1.16 * radius_m, k + 1),
                         d = at(0.97 * radius_m, k + 1);
        soup_.add({a, d, c}, index_of(BodyMaterial::tyre));
        soup_.add({a, c, b}, index_of(BodyMaterial::tyre));
    }
}

/// Gaps between five spokes, before the rim.
void BodyBuilder::spokes(double x_m, double radius_m, double side) {
    const double y_m = side * (y(1.0) - 0.0008);
    const auto at = [&](double share, double turn) {
        const double angle = 2.0 * pi * turn / 5.0;
        return glm::dvec3(x_m + side * share * radius_m * std::cos(angle), y_m, radius_m + share * radius_m * std::sin(angle));
    };
    for (int k = 0; k < 5; ++k) {
        const glm::dvec3 a = at(0.20, k + 0.5), b = at(0.54, k + 0.78), c = at(0.54, k + 0.22);
        soup_.add({a, b, c}, index_of(BodyMaterial::trim));
    }
}

void BodyBuilder::trunk(const std::vector<Ring>& rings, BodyMaterial material, int sides) {
    std::vector<Outline> outlines;
    for (const Ring& ring : rings) {
        Outline outline;
        for (int k = 0; k < sides; ++k) {
            const double angle = 2.0 * pi * k / sides;
            outline.emplace_back(ring.x_m + ring.half_depth_m * std::cos(angle), ring.half_width_m * std::sin(angle), ring.z_m);
        }
        std::ranges::reverse(outline);
        outlines.push_back(std::move(outline));
    }
    append_loft(soup_, outlines, index_of(material), [&](std::size_t, std::size_t) { return index_of(material); });
}

void BodyBuilder::contour(double from_x_m, double to_x_m, double low_z_m, double high_z_m) {
    constexpr double wide_m = 0.055; // UN R104: 50 to 60 mm
    const double half = y(1.0) - wide_m, rear = rear_m();
    for (const double side : {-1.0, 1.0}) {
        flank(from_x_m, to_x_m, low_z_m, low_z_m + wide_m, side, BodyMaterial::white_tape);
        flank(from_x_m, from_x_m + 0.4, high_z_m - wide_m, high_z_m, side, BodyMaterial::white_tape);
        flank(to_x_m - 0.4, to_x_m, high_z_m - wide_m, high_z_m, side, BodyMaterial::white_tape);
        plate(rear, 0.5 * (low_z_m + high_z_m), wide_m, high_z_m - low_z_m, false, BodyMaterial::red_tape, side * half);
    }
    for (const double z_m : {low_z_m, high_z_m - wide_m})
        plate(rear, z_m + 0.5 * wide_m, 2.0 * half - wide_m, wide_m, false, BodyMaterial::red_tape);
}

void BodyBuilder::plate(double x_m, double z_m, double width_m, double height_m, bool faces_forward, BodyMaterial material, double y_m) {
    append_plate(soup_, {x_m + (faces_forward ? proud_m : -proud_m), y_m, z_m}, width_m, height_m, faces_forward, index_of(material));
}

void BodyBuilder::pair(double x_m, double beside_m, double z_m, double width_m, double height_m, bool faces_forward,
                       BodyMaterial material) {
    for (const double side : {-1.0, 1.0})
        plate(x_m, z_m, width_m, height_m, faces_forward, material, side * beside_m);
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
    pair(front, beside_m, front_z_m, lens_width_m, lens_height_m, true, dressed() ? BodyMaterial::headlamp : BodyMaterial::lens);
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

void BodyBuilder::wheel(double x_m, double radius_m, double width_m, double rim) {
    append_wheel(soup_, {x_m, 0.0, radius_m}, radius_m, width_m, rim, 24, index_of(BodyMaterial::tyre), index_of(BodyMaterial::rim));
}

void BodyBuilder::limb(const glm::dvec3& from, const glm::dvec3& to, double radius_m, double end_radius_m, BodyMaterial material,
                       int sides) {
    append_limb(soup_, from, to, radius_m, end_radius_m, sides, index_of(material));
}

Model BodyBuilder::take() && {
    smooth(soup_, radians(38.0));
    add_meshes(model_, soup_);
    std::ranges::sort(model_.mounts, {}, &Mount::name);
    return std::move(model_);
}

} // namespace fernlicht
