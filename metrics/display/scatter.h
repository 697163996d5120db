// Light that goes astray between the scene and the retina: in the eye, in the windscreen. It veils what lies beside bright sources.
#pragma once

#include "metrics/glare/glare.h"
#include "scenarios/values/image.h"

#include <glm/vec3.hpp>

namespace fernlicht {

/// Luminance that a source adds in a direction theta degrees aside, in cd/m2 for 1 lx of it at the eye:
///   f = per_cube / theta^3 + per_square / theta^2 + per_degree / theta + constant, from_deg <= theta <= to_deg, else 0.
struct ScatterFunction {
    double per_cube = 0.0, per_square = 0.0, per_degree = 0.0, constant = 0.0;
    double from_deg = 0.1, to_deg = 100.0; ///< 0 < from < to <= 180

    double at(double theta_deg) const;
    /// Of the light, how much is scattered: the integral of f cos(theta) over the solid angle before the eye (theta < 90).
    double share() const;
};

/// The CIE's general disability glare equation (metrics/glare/glare.h) in its whole domain, 0.1 to 100 degrees. Of brown eyes of 25 years
/// 26 % are scattered, most of it by less than a degree.
ScatterFunction eye_scatter(const GlareEye& eye);

/// A windscreen of this haze, the share of the light that it turns by more than 2.5 degrees (ASTM D1003), 0 to 0.3: f falls with 1 /
/// theta^2 from 0.1 to 30 degrees. The form is ours: scratches and dirt scatter forward, and no measured function of a worn windscreen was
/// at hand.
ScatterFunction windscreen_scatter(double haze);

struct ScatterOptions {
    int near_cells = 2; ///< 1 to 8: cells nearer than this are looked at more finely. Error falls, run time rises (docs/display.md)
};

/// A picture with its scattered light: (1 - share) light + the veil of all its pixels. Perspective with square pixels; light that comes
/// from outside the picture is not known and veils nothing. A pixel's luminance in all channels alike, so that the veil has the sources'
/// colour.
///
/// Sums over all pairs of pixels by a tree: far pixels are taken together, at the centre of their light, in cells that are the smaller the
/// nearer they are. Time grows with the number of pixels. Same bytes whatever the number of threads.
Image<glm::vec3> scattered(const Image<glm::vec3>& light, double vertical_fov_rad, const ScatterFunction& function,
                           const ScatterOptions& options = {});

} // namespace fernlicht
