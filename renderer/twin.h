// The technique `photometric` on the CPU in double precision: the same equations (scenarios/photometry.glsl), a ray per pixel in place
// of the rasteriser, a ray to each lamp in place of its shadow map. Slow and exact: the measure of what the GPU's floats cost.
#pragma once

#include "scenarios/drives/play/camera.h"
#include "scenarios/drives/play/frame.h"
#include "scenarios/values/scene.h"

#include <optional>

namespace fernlicht {

struct TwinPixel {
    std::uint32_t id = 0; ///< mesh index + 1; 0: nothing seen
    double illuminance_lx = 0.0, luminance_cdm2 = 0.0, depth_m = 0.0;
    glm::dvec3 point_m{0.0}; ///< relative to the car
    glm::dvec3 normal{0.0, 0.0, 1.0};
    /// How far a float evaluation may lie from illuminance_lx: see float_bound_lx().
    double bound_lx = 0.0;
};

class Twin {
  public:
    /// `shadows`: cast a ray to each lamp. `place_px`: how far beside its centre a pixel's place may lie (sanity_place_px on GPUs); its
    /// bound has what the light changes by on the way. The scene must outlive the twin.
    Twin(const Scene& scene, bool shadows, double place_px = 0.0) : scene_(scene), shadows_(shadows), place_px_(place_px) {}

    /// What the pixel with centre (x + 0.5, y + 0.5) shows. Maps see ground surfaces only, as the renderer's do.
    TwinPixel pixel(const Moment& moment, const View& view, double x_px, double y_px) const;

    struct Hit {
        double distance_m = 0.0; ///< along the ray's unit direction
        std::uint32_t mesh = 0, material = 0;
        glm::dvec3 normal;
    };
    enum class Met { all, ground, casters }; ///< casters: what stands in light's way
    /// The nearest triangle of these, both sides, from `from_m` on.
    std::optional<Hit> cast(const Moment& moment, const Ray& ray, double from_m, Met met) const;

  private:
    TwinPixel at(const Moment& moment, const View& view, double x_px, double y_px) const;

    const Scene& scene_;
    bool shadows_;
    double place_px_;
};

/// Bound on |float - double| of one lamp's illuminance at a point, given the intensity's logarithmic gradient per radian there:
/// E (rounding + gradient * angle). rounding: 24 operations of half a unit in the last place of a float (6e-8) each, and the position's
/// error of 1e-6 of the distance, which enters E with the power of about 3 and, at grazing incidence, divided by the cosine. angle: atan's
/// measured 2.2e-6 rad of Mesa doubled, and the position's error seen from the lamp.
double float_bound_lx(double illuminance_lx, double cosine, double log_gradient_per_rad);

} // namespace fernlicht
