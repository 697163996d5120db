// What bodies of road users are built from: hull, wheels, plates, lamps, limbs, and the materials of all of them.
#pragma once

#include "scenarios/models/road_user_bodies.h"
#include "scenarios/models/triangle_soup.h"

namespace fernlicht {

/// Positions in a body's materials. Those from plain_count on are there in dressed bodies alone.
enum class BodyMaterial : std::uint32_t {
    paint,
    glass,
    trim,
    tyre,
    rim,
    lens,
    red_lens,
    amber_lens,
    plate,
    reflector,
    cloth,
    skin,
    plain_count,
    headlamp = plain_count, ///< a reflector behind clear glass: some of the light comes back
    white_tape,
    red_tape,
    band, ///< reflecting, on clothing
    hair
};
constexpr std::uint32_t index_of(BodyMaterial material) { return static_cast<std::uint32_t>(material); }

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

inline bool is_window(std::size_t strip) { return strip == 4; }
inline bool is_roof(std::size_t strip) { return strip == 6; }
inline BodyMaterial under_windows(std::size_t strip) { return strip <= 1 ? BodyMaterial::trim : BodyMaterial::paint; }

class BodyBuilder {
  public:
    BodyBuilder(std::string name, const BodySize& size);

    double x(double along) const { return size_.rear_m + along * size_.size_m.x; }
    double y(double of_half_width) const { return 0.5 * of_half_width * size_.size_m.y; }
    double z(double of_height) const { return of_height * size_.size_m.z; }
    double front_m() const { return x(1.0); }
    double rear_m() const { return size_.rear_m; }
    TriangleSoup& soup() { return soup_; }
    bool dressed() const { return size_.dressed; }

    void hull(const std::vector<BodySection>& sections, const SectionMaterial& material);
    void box(const glm::dvec3& low_m, const glm::dvec3& high_m, BodyMaterial material);
    /// Two wheels on an axle, flush with the width; dressed: under arches, with spokes.
    void axle(double x_m, double radius_m, double width_m);
    void plate(double x_m, double z_m, double width_m, double height_m, bool faces_forward, BodyMaterial material, double y_m = 0.0);
    /// Plates on both sides of the middle, at so far to each.
    void pair(double x_m, double beside_m, double z_m, double width_m, double height_m, bool faces_forward, BodyMaterial material);
    /// lamp.FUNCTION.left and .right, looking forward or back; only .centre when `beside_m` is 0.
    void mounts(const std::string& function, double x_m, double beside_m, double z_m, bool forward);
    /// Front lamps, tail lamps, indicators, number plates and reflectors of a motor vehicle with four wheels.
    void lights(double front_z_m, double rear_z_m, double beside_m, double lens_width_m, double lens_height_m);
    void limb(const glm::dvec3& from, const glm::dvec3& to, double radius_m, double end_radius_m, BodyMaterial material, int sides = 8);
    /// Rings of as many points as `sides`, each an ellipse about the body's upright middle: half width, half depth, x and height.
    struct Ring {
        double half_width_m, half_depth_m, x_m, z_m;
    };
    void trunk(const std::vector<Ring>& rings, BodyMaterial material, int sides = 12);
    /// Strips of retroreflecting tape round the rear and along both sides, as UN R48 asks of lorries.
    void contour(double from_x_m, double to_x_m, double low_z_m, double high_z_m);
    /// A single wheel in the body's middle.
    void wheel(double x_m, double radius_m, double width_m, double rim);

    Model take() &&;

  private:
    void arch(double x_m, double radius_m, double side);
    void spokes(double x_m, double radius_m, double side);
    void flank(double x0_m, double x1_m, double z0_m, double z1_m, double side, BodyMaterial material);

    BodySize size_;
    Model model_;
    TriangleSoup soup_;
};

} // namespace fernlicht
