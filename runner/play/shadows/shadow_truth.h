// A scene's true shadows, by a ray from each pixel's centre to each lamp: what shadow methods are compared with.
#pragma once

#include "metrics/shadows/shadow_errors.h"
#include "renderer/reference/reference.h"
#include "renderer/renderer.h"
#include "runner/play/stage.h"

#include <optional>
#include <utility>
#include <vector>

namespace fernlicht {

class ShadowTruth {
  public:
    /// `unshadowed` draws the scene without shadows, but for that as the ways that are held against it. `lamp_radius_m`: 0 for points, else
    /// discs (area lamps), whose half shadows are estimated with some noise. `floor_lx`: below this without shadows nothing counts. All
    /// must outlive it. Rays are cast when a moment is first asked for.
    ShadowTruth(const Reference& rays, Renderer& unshadowed, const std::vector<Moment>& moments, const View& view,
                double lamp_radius_m = 0.0, double floor_lx = shadow_floor_lx);

    const View& view() const { return view_; }
    /// What the renderer, which draws the same scene and light, makes of the moment. Pixels in which it sees another mesh than the rays, or
    /// none, do not count, nor do those below the floor and those whose light without shadows as drawn is off by more than a fifth. Throws
    /// DeviceError, InputError.
    ShadowImages images(Renderer& renderer, std::size_t moment);

    struct Found {
        Image<float> true_lx, unshadowed_lx, drawn_unshadowed_lx;
        Image<std::uint32_t> ids;
    };
    const Found& of(std::size_t moment);

  private:
    const Reference& rays_;
    Renderer& unshadowed_;
    const std::vector<Moment>& moments_;
    View view_;
    double lamp_radius_m_, floor_lx_;
    std::vector<std::optional<Found>> found_;
};

/// Degree of shadow of each pixel, 0..1; -1 where it does not count.
Image<float> true_degrees(const ShadowTruth::Found& truth, double floor_lx = shadow_floor_lx);

/// The same settings without shadows and clocks.
RendererSettings without_shadows(RendererSettings settings);

/// Columns of the picture on which errors of shadows are counted; rows as the view's ratio has it.
inline constexpr int shadow_error_width_px = 160;

} // namespace fernlicht
