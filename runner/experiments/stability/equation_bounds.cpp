// The figures that stand beside the equations in photometry.glsl. u is half a unit in the last place of a float, 6.0e-8. GLSL 4.5, section
// 4.7.1, promises sums, products and differences to u, quotients to 2.5 units (5 u), inversesqrt to 2 units.
#include "runner/experiments/stability/equations.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr EquationBound bounds[] = {
    {"lamp_space", 2e-7, "of |v|", 1.0, "three products and two sums: 3 u of the sum of their sizes, which is at most |v|"},
    {"goniometer_angles", 5e-6, "rad", 0.6,
     "GLSL promises nothing of atan; Mesa's is off by up to 4e-6, which is why shaders take quick_atan"},
    {"quick_atan_unit", 2e-7, "relative", 1.0,
     "the last factor's sum and product count in full, the powers above by a third and less: 3 u"},
    {"quick_atan", 5e-7, "relative", 1.0, "GLSL's quotient 5 u, the polynomial 3 u"},
    {"quick_asin_half", 4e-7, "relative", 2.0, "as the polynomial of quick_atan_unit, with a slope of up to 2 beyond 30 degrees"},
    {"quick_goniometer_angles", 5e-7, "rad", 0.6,
     "inversesqrt 4 u and a dot product 3 u, through an arc of slope 1.16 at most; else quick_atan"},
    {"beam_position", 2e-7, "of angle plus first sample in steps", 1.0, "a difference and a product: 2 u"},
    {"beam_known", 0.0, "of 1", 0.0, "comparisons, and count - 1, which is exact: a step from 0 to 1 at the table's edge"},
    {"bilinear", 3e-7, "of the largest sample", 1.0, "two differences, products and sums in a row, weighted by at most 1: 5 u"},
    {"facing_illuminance", 4.8e-7, "relative", 2.0, "a sum of squares 3 u, GLSL's quotient 5 u"},
    {"facing_illuminance_at", 1.3e-7, "relative", 2.0, "two products, each rounded once: 2 u"},
    {"incidence", 6e-7, "of 1", 1.0, "two dot products 3 u and, under the root, 1.5 u; inversesqrt 4 u, a product"},
    {"diffuse_luminance", 2e-7, "relative", 1.0, "two products and the rounding of 1 / pi: 3 u"},
    {"combined_reflectance", 2e-7, "of 1", 1.0, "a difference, a product and a sum of terms that together are at most 1: 3 u"},
    {"textured_rl", 9e-7, "relative", 1.0, "two weighted sums, each 4 u with the rounding of the weights, a product, GLSL's quotient 5 u"},
    {"textured_rl_at", 3e-7, "relative", 1.0, "a weighted sum 4 u, a product"},
    {"observation_angle", 5e-6, "rad", 0.6, "atan as in goniometer_angles"},
    {"quick_observation_angle", 8e-7, "rad", 0.6,
     "cross and dot product 3 u of |a| |b| each, which is 6 u of an angle; quick_atan 8 u over up to 45 degrees"},
    {"retro_luminance", 4e-5, "relative while exp is above 1e-37", 111.0,
     "GLSL's exp is exact to 3 + 2 |x| units, |x| to 85 here, and denormals may be 0; its argument's 2 u count |x| times"},
    {"height_above_plane", 3e-7, "of the two points' distance", 0.0,
     "a difference, three products and two sums: 4 u of the distance. The difference itself may cancel: unbounded against the places"},
    {"tone_linear", 3.1e-7, "relative", 1.0, "GLSL's quotient is exact to 5 u"},
    {"tone_rational", 6e-7, "relative", 1.0, "no term of the sum is negative: 4 u and GLSL's quotient 5 u; nothing cancels at s = 1"},
    {"tone_logarithmic", 2e-6, "of 1", 1.0, "GLSL's log is exact to 2^-21 near 1, over log(2) at least, twice"},
    {"srgb_encoded", 1e-6, "of 1", 0.5, "GLSL's pow by way of log2 and exp2: 2^-21 / 2.4, and 3 units"},
    {"quick_srgb_encoded", 1e-6, "of 1", 0.5, "GLSL's roots 4.5 units each, in terms whose sizes add up to 1.8"},
    {"directional_illuminance", 4e-7, "of perpendicular_lx", 1.0, "a dot product of unit vectors 3 u and their own rounding, a product"},
    {"sky_illuminance", 3e-7, "of horizontal_lx", 1.0, "a sum and two products: 3 u"},
    {"transmittance", 3e-5, "relative while exp is above 1e-35", 80.0,
     "GLSL's exp is exact to 3 + 2 |x| units, |x| to 80 here; its argument's u counts |x| times"},
    {"henyey_greenstein", 3e-6, "relative", 271.0,
     "sums of terms of one sign for g >= 0: 4 u, times 3/2, a root and GLSL's quotient 5 u; 1 - g and 1 - cosine are exact near 1. The "
     "condition is that of the forward peak at g = 0.9"},
    {"scattered_towards_eye", 2e-5, "relative to optical depths of 10", 500.0,
     "henyey_greenstein, exp to 23 units, its argument's 5 u ten times, and the sine's rounding in 1 - sine. The condition is the forward "
     "peak's, and the way's at sines of 0.99"},
    {"facet_cosine", 3e-7, "of 1", 1.0, "a sum of products that is at most 1, 4 u, and a root"},
    {"water_reflectance", 3e-6, "of 1", 2.0, "differences of cosine and index, which stay apart, GLSL's quotient 5 u, squared: 30 u"},
    {"wet_albedo", 3e-5, "relative", 4.0, "1 - F is 0.05 at a cosine of 0.01, for two directions: 20 times what water_reflectance rounds"},
    {"wet_mirrored", 5e-4, "relative", 1000.0,
     "the facet's sine by a cross product, 6 u of 1 over a lobe of width 0.1, to the fourth power; dot products of 0.001 with 3 u"},
};

} // namespace

std::span<const EquationBound> equation_bounds() { return bounds; }

std::string EquationBound::comment() const {
    return fmt::format("Float: {:g} {}, condition {}.", error, of, condition > 0.0 ? fmt::format("{:g}", condition) : "unbounded");
}

} // namespace fernlicht
