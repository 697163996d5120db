#include "scenarios/models/road_user_bodies.h"

#include "scenarios/models/triangle_soup.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

/// Positions in body_materials().
enum class BodyMaterial : std::uint32_t { paint, glass, trim, tyre, rim, lens, red_lens, amber_lens, plate, reflector, cloth, skin, count };
constexpr std::uint32_t index_of(BodyMaterial material) { return static_cast<std::uint32_t>(material); }
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

constexpr double proud_m = 0.004; ///< plates stand before what carries them

/// A section across a motor vehicle's body, in shares of its length, half width and height.
struct BodySection {
    double along = 0.0;      ///< 0 at the rear, 1 at the front
    double half_width = 1.0; ///< of the body below the windows
    double bottom = 0.12, belt = 0.65, top = 1.0;
    double half_roof = 0.66; ///< half width of the roof
};

/// What lies between two sections: by strip from the underside (0) over sill, flank, shoulder (3), window (4), edge of the roof (5) to roof
/// (6).
using SectionMaterial = std::function<BodyMaterial(std::size_t section, std::size_t strip)>;

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

class BodyBuilder {
  public:
    BodyBuilder(std::string name, const BodySize& size) : size_(size) {
        model_.name = std::move(name);
        model_.materials = body_materials(size.paint);
    }

    double x(double along) const { return size_.rear_m + along * size_.size_m.x; }
    double y(double of_half_width) const { return 0.5 * of_half_width * size_.size_m.y; }
    double z(double of_height) const { return of_height * size_.size_m.z; }
    double front_m() const { return x(1.0); }
    double rear_m() const { return size_.rear_m; }
    TriangleSoup& soup() { return soup_; }

    void hull(const std::vector<BodySection>& sections, const SectionMaterial& material) {
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

    void box(const glm::dvec3& low_m, const glm::dvec3& high_m, BodyMaterial material) {
        append_box(soup_, low_m, high_m, index_of(material));
    }

    /// Two wheels on an axle, flush with the width.
    void axle(double x_m, double radius_m, double width_m) {
        for (const double side : {-1.0, 1.0})
            append_wheel(soup_, {x_m, side * (y(1.0) - 0.5 * width_m), radius_m}, radius_m, width_m, 0.62, 14, index_of(BodyMaterial::tyre),
                         index_of(BodyMaterial::rim));
    }

    void plate(double x_m, double z_m, double width_m, double height_m, bool faces_forward, BodyMaterial material, double y_m = 0.0) {
        append_plate(soup_, {x_m + (faces_forward ? proud_m : -proud_m), y_m, z_m}, width_m, height_m, faces_forward, index_of(material));
    }

    /// Plates on both sides of the middle, at so far to each.
    void pair(double x_m, double beside_m, double z_m, double width_m, double height_m, bool faces_forward, BodyMaterial material) {
        for (const double side : {-1.0, 1.0})
            plate(x_m, z_m, width_m, height_m, faces_forward, material, side * beside_m);
    }

    /// lamp.FUNCTION.left and .right, looking forward or back; only .centre when `beside_m` is 0.
    void mounts(const std::string& function, double x_m, double beside_m, double z_m, bool forward) {
        const glm::dmat3 axes = axes_from_angles(forward ? 0.0 : pi, 0.0, 0.0);
        if (beside_m == 0.0) {
            model_.mounts.push_back({"lamp." + function + ".centre", {{x_m, 0.0, z_m}, axes}});
            return;
        }
        model_.mounts.push_back({"lamp." + function + ".left", {{x_m, beside_m, z_m}, axes}});
        model_.mounts.push_back({"lamp." + function + ".right", {{x_m, -beside_m, z_m}, axes}});
    }

    /// Front lamps, tail lamps, indicators, number plates and reflectors of a motor vehicle with four wheels.
    void lights(double front_z_m, double rear_z_m, double beside_m, double lens_width_m, double lens_height_m) {
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

    Model take() && {
        smooth(soup_, radians(38.0));
        add_meshes(model_, soup_);
        std::ranges::sort(model_.mounts, {}, &Mount::name);
        return std::move(model_);
    }

  private:
    BodySize size_;
    Model model_;
    TriangleSoup soup_;
};

bool is_window(std::size_t strip) { return strip == 4; }
bool is_roof(std::size_t strip) { return strip == 6; }

BodyMaterial below_windows(std::size_t strip) { return strip <= 1 ? BodyMaterial::trim : BodyMaterial::paint; }

void wheel(BodyBuilder& body, double x_m, double radius_m, double width_m, double rim) {
    append_wheel(body.soup(), {x_m, 0.0, radius_m}, radius_m, width_m, rim, 24, index_of(BodyMaterial::tyre), index_of(BodyMaterial::rim));
}

void limb(BodyBuilder& body, const glm::dvec3& from, const glm::dvec3& to, double radius_m, double end_radius_m, BodyMaterial material,
          int sides = 8) {
    append_limb(body.soup(), from, to, radius_m, end_radius_m, sides, index_of(material));
}

/// A rider on a saddle, hands on a bar, up to the height.
void rider(BodyBuilder& body, const glm::dvec3& saddle, const glm::dvec3& bar, double height_m) {
    const double head = 0.12, shoulder_z = height_m - 2.0 * head - 0.12;
    const glm::dvec3 shoulders(saddle.x + 0.45 * (bar.x - saddle.x), 0.0, shoulder_z);
    limb(body, {saddle.x, 0.0, saddle.z + 0.12}, shoulders - glm::dvec3(0, 0, 0.08), 0.15, 0.17, BodyMaterial::cloth, 10);
    limb(body, {shoulders.x + 0.06, 0.0, height_m - head - 0.03}, {shoulders.x + 0.06, 0.0, height_m - head}, head, head,
         BodyMaterial::skin, 10);
    for (const double side : {-1.0, 1.0}) {
        limb(body, shoulders + glm::dvec3(0.0, side * 0.18, 0.0), {bar.x, side * 0.25, bar.z}, 0.055, 0.04, BodyMaterial::cloth);
        const glm::dvec3 knee(saddle.x + 0.42, side * 0.13, 0.5 * saddle.z + 0.18), foot(saddle.x + 0.20, side * 0.12, 0.28);
        limb(body, {saddle.x, side * 0.10, saddle.z + 0.05}, knee, 0.08, 0.065, BodyMaterial::cloth);
        limb(body, knee, foot, 0.06, 0.045, BodyMaterial::cloth);
    }
}

} // namespace

Model car_body(const BodySize& size) {
    BodyBuilder body("car", size);
    const double radius = std::min(0.235 * size.size_m.z, 0.33);
    //                                  along  width bottom belt   top  roof
    const std::vector<BodySection> sections{
        {0.000, 0.80, 0.27, 0.600, 0.610, 0.70}, {0.015, 0.93, 0.20, 0.640, 0.655, 0.74}, {0.050, 0.97, 0.14, 0.655, 0.740, 0.70},
        {0.140, 1.00, 0.12, 0.660, 0.955, 0.65}, {0.200, 1.00, 0.12, 0.658, 0.985, 0.66}, {0.330, 1.00, 0.12, 0.650, 1.000, 0.67},
        {0.355, 1.00, 0.12, 0.648, 1.000, 0.67}, {0.520, 1.00, 0.12, 0.638, 0.985, 0.66}, {0.560, 1.00, 0.12, 0.635, 0.960, 0.65},
        {0.730, 1.00, 0.12, 0.620, 0.672, 0.72}, {0.800, 0.99, 0.12, 0.605, 0.642, 0.75}, {0.940, 0.96, 0.14, 0.540, 0.570, 0.76},
        {0.985, 0.90, 0.17, 0.480, 0.505, 0.72}, {1.000, 0.80, 0.21, 0.440, 0.455, 0.66}};
    body.hull(sections, [](std::size_t i, std::size_t strip) {
        const bool side_window = is_window(strip) && ((i >= 3 && i < 5) || (i >= 6 && i < 8));
        const bool rear_window = is_roof(strip) && i == 2, windscreen = is_roof(strip) && i == 8;
        return side_window || rear_window || windscreen ? BodyMaterial::glass : below_windows(strip);
    });
    body.axle(0.0, radius, 0.21);
    body.axle(0.6 * size.size_m.x, radius, 0.21);
    body.lights(body.z(0.405), body.z(0.545), body.y(0.62), 0.26, 0.10);
    for (const double side : {-1.0, 1.0}) // outside mirrors
        body.box({body.x(0.635), side > 0.0 ? body.y(0.89) : -body.y(1.0), body.z(0.64)},
                 {body.x(0.655), side > 0.0 ? body.y(1.0) : -body.y(0.89), body.z(0.72)}, BodyMaterial::trim);
    return std::move(body).take();
}

Model van_body(const BodySize& size) {
    BodyBuilder body("van", size);
    const std::vector<BodySection> sections{{0.000, 0.94, 0.14, 0.52, 0.970, 0.86}, {0.010, 0.98, 0.12, 0.52, 0.995, 0.90},
                                            {0.600, 1.00, 0.12, 0.52, 1.000, 0.90}, {0.630, 1.00, 0.12, 0.52, 1.000, 0.90},
                                            {0.740, 1.00, 0.12, 0.51, 0.980, 0.88}, {0.880, 0.99, 0.12, 0.47, 0.560, 0.82},
                                            {0.970, 0.94, 0.13, 0.40, 0.440, 0.78}, {1.000, 0.84, 0.15, 0.36, 0.380, 0.72}};
    body.hull(sections, [](std::size_t i, std::size_t strip) {
        const bool side_window = is_window(strip) && i == 3, windscreen = is_roof(strip) && i == 4;
        return side_window || windscreen ? BodyMaterial::glass : below_windows(strip);
    });
    body.axle(0.0, 0.34, 0.23);
    body.axle(0.6 * size.size_m.x, 0.34, 0.23);
    body.lights(std::min(body.z(0.32), 0.75), std::min(body.z(0.45), 0.95), body.y(0.66), 0.22, 0.14);
    body.pair(body.rear_m(), body.y(0.42), body.z(0.72), body.y(0.74), body.z(0.24), false, BodyMaterial::glass);
    return std::move(body).take();
}

Model bus_body(const BodySize& size) {
    BodyBuilder body("bus", size);
    const std::vector<BodySection> sections{{0.000, 0.96, 0.10, 0.42, 0.97, 0.88}, {0.008, 0.99, 0.09, 0.42, 0.995, 0.92},
                                            {0.030, 1.00, 0.09, 0.42, 1.00, 0.93}, {0.900, 1.00, 0.09, 0.42, 1.00, 0.93},
                                            {0.985, 0.99, 0.09, 0.40, 0.99, 0.92}, {1.000, 0.94, 0.10, 0.36, 0.96, 0.86}};
    body.hull(sections, [](std::size_t i, std::size_t strip) {
        return is_window(strip) && i >= 2 && i < 4 ? BodyMaterial::glass : below_windows(strip);
    });
    body.plate(body.front_m(), body.z(0.64), body.y(1.7), body.z(0.50), true, BodyMaterial::glass);
    body.plate(body.rear_m(), body.z(0.72), body.y(1.4), body.z(0.28), false, BodyMaterial::glass);
    body.axle(0.0, 0.48, 0.30);
    body.axle(0.52 * size.size_m.x, 0.48, 0.30);
    body.lights(0.75, 1.0, body.y(0.74), 0.24, 0.16);
    return std::move(body).take();
}

Model truck_body(const BodySize& size) {
    BodyBuilder body("truck", size);
    const double cab_rear = std::max(body.front_m() - 2.2, body.x(0.5)), half = body.y(1.0), top = body.z(1.0);
    const double cab = (cab_rear - body.rear_m()) / size.size_m.x, step = 1.0 - cab;
    const std::vector<BodySection> sections{{cab, 0.96, 0.22, 0.52, 0.86, 0.84},
                                            {cab + 0.35 * step, 0.98, 0.20, 0.52, 0.88, 0.86},
                                            {cab + 0.85 * step, 0.98, 0.14, 0.50, 0.86, 0.85},
                                            {cab + 0.97 * step, 0.96, 0.13, 0.48, 0.80, 0.82},
                                            {1.0, 0.90, 0.13, 0.46, 0.74, 0.78}};
    body.hull(sections, [](std::size_t i, std::size_t strip) {
        return is_window(strip) && (i == 1 || i == 2) ? BodyMaterial::glass : below_windows(strip);
    });
    body.plate(body.front_m(), body.z(0.60), body.y(1.5), body.z(0.20), true, BodyMaterial::glass);
    body.box({body.rear_m(), -half, 1.1}, {cab_rear - 0.25, half, top}, BodyMaterial::paint);                     // what it carries
    body.box({body.rear_m(), -0.45, 0.75}, {cab_rear + 0.3, 0.45, 1.1}, BodyMaterial::trim);                      // frame
    body.box({body.rear_m(), -0.95 * half, 0.45}, {body.rear_m() + 0.12, 0.95 * half, 0.75}, BodyMaterial::trim); // bar under its end
    body.axle(0.0, 0.5, 0.5);
    body.axle(cab_rear + 0.8, 0.5, 0.3);
    body.lights(0.75, 0.62, body.y(0.74), 0.28, 0.14);
    return std::move(body).take();
}

Model motorcycle_body(const BodySize& size) {
    BodyBuilder body("motorcycle", size);
    const double radius = std::min(0.31, 0.2 * size.size_m.z), front_axle = body.front_m() - radius;
    const double saddle_z = std::min(0.8, 0.55 * size.size_m.z);
    wheel(body, 0.0, radius, 0.15, 0.6);
    wheel(body, front_axle, radius, 0.12, 0.6);
    limb(body, {0.15, 0.0, 0.45}, {front_axle - 0.35, 0.0, 0.5}, 0.16, 0.19, BodyMaterial::trim, 10); // engine
    limb(body, {-0.2, 0.0, saddle_z}, {front_axle - 0.45, 0.0, saddle_z + 0.08}, 0.10, 0.15, BodyMaterial::paint, 10);
    limb(body, {front_axle, 0.0, radius}, {front_axle - 0.30, 0.0, saddle_z + 0.2}, 0.06, 0.06, BodyMaterial::rim);
    limb(body, {front_axle - 0.3, -0.36, saddle_z + 0.25}, {front_axle - 0.3, 0.36, saddle_z + 0.25}, 0.025, 0.025, BodyMaterial::trim);
    rider(body, {0.3, 0.0, saddle_z}, {front_axle - 0.3, 0.0, saddle_z + 0.27}, size.size_m.z);
    const double lamp_x = front_axle - 0.05, rear = body.rear_m();
    limb(body, {lamp_x - 0.12, 0.0, saddle_z + 0.1}, {lamp_x - 0.04, 0.0, saddle_z + 0.1}, 0.10, 0.10, BodyMaterial::trim, 12);
    body.plate(lamp_x + 0.06, saddle_z + 0.1, 0.16, 0.14, true, BodyMaterial::lens);
    limb(body, {-0.15, 0.0, saddle_z - 0.05}, {rear + 0.08, 0.0, saddle_z - 0.02}, 0.07, 0.06, BodyMaterial::paint);
    body.plate(rear + 0.01, saddle_z - 0.02, 0.14, 0.07, false, BodyMaterial::red_lens);
    body.plate(rear + 0.01, saddle_z - 0.26, 0.20, 0.18, false, BodyMaterial::plate);
    body.plate(rear + 0.01, saddle_z - 0.13, 0.08, 0.05, false, BodyMaterial::reflector);
    for (const char* function : {"low", "high", "position"})
        body.mounts(function, lamp_x + 0.07, 0.0, saddle_z + 0.1, true);
    for (const char* function : {"tail", "brake"})
        body.mounts(function, rear, 0.0, saddle_z - 0.02, false);
    return std::move(body).take();
}

Model bicycle_body(const BodySize& size) {
    BodyBuilder body("bicycle", size);
    const double radius = std::min(0.34, 0.22 * size.size_m.z), front_axle = std::max(body.front_m() - radius, 0.5);
    const double saddle_z = std::min(0.95, 0.55 * size.size_m.z);
    const glm::dvec3 rear(0.0, 0.0, radius), front(front_axle, 0.0, radius), crank(0.42 * front_axle, 0.0, 0.28);
    const glm::dvec3 saddle(0.28 * front_axle, 0.0, saddle_z), head(front_axle - 0.22, 0.0, saddle_z - 0.05);
    wheel(body, rear.x, radius, 0.04, 0.88);
    wheel(body, front.x, radius, 0.04, 0.88);
    for (const auto& [from, to] : {std::pair(rear, crank), std::pair(rear, saddle), std::pair(crank, saddle), std::pair(crank, head),
                                   std::pair(saddle - glm::dvec3(0, 0, 0.15), head), std::pair(head, front)})
        limb(body, from, to, 0.018, 0.018, BodyMaterial::paint, 6);
    const glm::dvec3 bar(head.x + 0.05, 0.0, saddle_z + 0.1);
    limb(body, head, bar, 0.015, 0.015, BodyMaterial::trim, 6);
    limb(body, bar - glm::dvec3(0, 0.28, 0), bar + glm::dvec3(0, 0.28, 0), 0.015, 0.015, BodyMaterial::trim, 6);
    rider(body, saddle, bar, size.size_m.z);
    body.plate(bar.x + 0.06, bar.z - 0.12, 0.06, 0.06, true, BodyMaterial::lens);
    body.plate(body.rear_m() + 0.01, 0.6, 0.06, 0.06, false, BodyMaterial::reflector);
    limb(body, rear + glm::dvec3(0, 0, 0.02), {body.rear_m() + 0.03, 0.0, 0.6}, 0.012, 0.012, BodyMaterial::trim, 6);
    body.mounts("low", bar.x + 0.07, 0.0, bar.z - 0.12, true);
    body.mounts("tail", body.rear_m(), 0.0, 0.66, false);
    return std::move(body).take();
}

Model pedestrian_body(const BodySize& size) {
    BodyBuilder body("pedestrian", size);
    const double h = size.size_m.z, x = body.x(0.5), half = std::min(0.5 * size.size_m.y, 0.16 * h),
                 step = std::min(0.18, 0.3 * size.size_m.x);
    limb(body, {x, 0.0, 0.90 * h}, {x, 0.0, 0.935 * h}, 0.062 * h, 0.062 * h, BodyMaterial::skin, 10);
    limb(body, {x, 0.0, 0.82 * h}, {x, 0.0, 0.86 * h}, 0.03 * h, 0.03 * h, BodyMaterial::skin);
    for (const double beside : {-0.05, -0.025, 0.0, 0.025, 0.05}) // trunk
        limb(body, {x, beside * h, 0.54 * h}, {x, 1.5 * beside * h, 0.765 * h}, 0.07 * h, 0.068 * h, BodyMaterial::paint, 10);
    for (const double side : {-1.0, 1.0}) {
        limb(body, {x, side * (half - 0.03 * h), 0.78 * h}, {x - side * 0.5 * step, side * (half - 0.02 * h), 0.46 * h}, 0.034 * h,
             0.026 * h, BodyMaterial::paint);
        const glm::dvec3 foot(x + side * step, side * 0.055 * h, 0.035 * h);
        limb(body, {x, side * 0.055 * h, 0.50 * h}, {x + side * 0.6 * step, side * 0.055 * h, 0.28 * h}, 0.058 * h, 0.042 * h,
             BodyMaterial::cloth);
        limb(body, {x + side * 0.6 * step, side * 0.055 * h, 0.28 * h}, foot, 0.042 * h, 0.03 * h, BodyMaterial::cloth);
        limb(body, foot - glm::dvec3(0.03 * h, 0, 0.005 * h), foot + glm::dvec3(0.06 * h, 0, -0.008 * h), 0.028 * h, 0.025 * h,
             BodyMaterial::trim);
    }
    return std::move(body).take();
}

Model plain_body(const BodySize& size) {
    BodyBuilder body("body", size);
    body.box({body.rear_m(), -body.y(1.0), 0.0}, {body.front_m(), body.y(1.0), body.z(1.0)}, BodyMaterial::paint);
    return std::move(body).take();
}

} // namespace fernlicht
