#include "runner/experiments/stability/equations.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

using Kind = EquationInput::Kind;

EquationInput linear(std::size_t slot, double low, double high) { return {Kind::linear, slot, low, high}; }
EquationInput logarithmic(std::size_t slot, double low, double high) { return {Kind::logarithmic, slot, low, high}; }
EquationInput either_sign(std::size_t slot, double low, double high) { return {Kind::signed_logarithmic, slot, low, high}; }
EquationInput direction(std::size_t slot) { return {Kind::direction, slot, -1.0, 1.0}; }

/// Three of a kind.
std::vector<EquationInput> three(EquationInput first) {
    std::vector<EquationInput> all;
    for (std::size_t i = 0; i < 3; ++i, ++first.slot)
        all.push_back(first);
    return all;
}
std::vector<EquationInput> operator+(std::vector<EquationInput> a, const std::vector<EquationInput>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

double length(const EquationDoubles& x, std::size_t slot) { return std::hypot(x[slot], x[slot + 1], x[slot + 2]); }

double own(const EquationDoubles&, double value) { return std::abs(value); }
double one(const EquationDoubles&, double) { return 1.0; }

std::vector<Equation> of_sky_and_weather() {
    const auto first = [](const EquationDoubles& x, double) { return x[0]; };
    // What is left of the light lies above 1e-37, and its optical depth within 80.
    const auto not_dark = [](const EquationDoubles& x, const std::array<double, 4>&) { return x[0] * x[1] < 80.0; };
    const auto near_enough = [](const EquationDoubles& x, const std::array<double, 4>&) {
        const double from_lamp = x[2] / std::sqrt(1.0 - x[1] * x[1]);
        return std::abs(x[1]) <= 0.99 && x[4] * (from_lamp + std::abs(x[3]) + from_lamp) < 10.0;
    };
    const auto above = [](const EquationDoubles& x, const std::array<double, 4>&) {
        return x[0] * x[4] + x[1] * x[5] + x[2] * x[6] > 1e-3 && x[0] * x[8] + x[1] * x[9] + x[2] * x[10] > 1e-3;
    };
    return {{29, "directional_illuminance", "", "1e-6 to 150 000 lx, all round",
             std::vector{logarithmic(0, 1e-6, 1.5e5), direction(4), direction(8)}, 1, first},
            {30, "sky_illuminance", "", "1e-6 to 150 000 lx, all slopes", std::vector{logarithmic(0, 1e-6, 1.5e5), direction(4)}, 1, first},
            {31, "transmittance", "", "1e-9 to 10 per metre, 1 mm to 10 km, optical depths to 80",
             std::vector{logarithmic(0, 1e-9, 10.0), logarithmic(1, 1e-3, 1e4)}, 1, own, not_dark},
            {32, "henyey_greenstein", "", "all angles, g 0 to 0.9", std::vector{linear(0, -1.0, 1.0), linear(1, 0.0, 0.9)}, 1, own},
            {33, "scattered_towards_eye", "", "1e-3 to 1e6 cd, angles of sines to 0.99, 1 mm to 100 m, optical depths to 10, g to 0.9",
             std::vector{logarithmic(0, 1e-3, 1e6), linear(1, -0.99, 0.99), logarithmic(2, 1e-3, 100.0), logarithmic(3, 1e-3, 1e3),
                         logarithmic(4, 1e-9, 10.0), linear(5, 0.0, 0.9)},
             1, own, near_enough},
            {34, "facet_cosine", "", "cosines 1e-6 to 1, alpha 0.01 to 1", std::vector{logarithmic(0, 1e-6, 1.0), linear(1, 0.01, 1.0)}, 1,
             one},
            {35, "water_reflectance", "", "cosines 1e-6 to 1", std::vector{logarithmic(0, 1e-6, 1.0)}, 1, one},
            {36, "wet_albedo", "", "albedo 1e-4 to 1, cosines 0.01 to 1",
             std::vector{logarithmic(0, 1e-4, 1.0), linear(1, 0.01, 1.0), linear(2, 0.01, 1.0)}, 1, own},
            {37, "wet_mirrored", "", "alpha 0.1 to 1, both directions above the surface by a sine of 0.001",
             std::vector{direction(0), linear(3, 0.1, 1.0), direction(4), direction(8)}, 1, own, above},
            {39, "dielectric_reflectance", "", "cosines 1e-6 to 1, index 1.2 to 2.5",
             std::vector{logarithmic(0, 1e-6, 1.0), linear(1, 1.2, 2.5)}, 1, one},
            {40, "facet_mirrored", "", "the same, index 1.2 to 2.5",
             std::vector{direction(0), linear(3, 0.1, 1.0), direction(4), direction(8), linear(12, 1.2, 2.5)}, 1, own, above}};
}

std::vector<Equation> make() {
    const auto place = three(either_sign(0, 1e-3, 1e4)), to_lamp = three(either_sign(4, 1e-3, 1e4));
    const auto colour = [](std::size_t slot) { return three(logarithmic(slot, 1e-4, 1.0)); };
    const auto reflectances = colour(0) + colour(4) + std::vector{linear(7, 0.0, 1.0)} + colour(8);
    const std::string of_colours = "reflectances 1e-4 to 1, opacity 0 to 1";
    const auto ahead = [](const EquationDoubles& x, const auto&) { return x[2] > 0.0; };
    const auto ahead_and_flat = [](const EquationDoubles& x, const auto&) { return x[2] > 0.0 && std::abs(x[1]) <= 0.5 * length(x, 0); };
    std::vector<Equation> all{
        {0, "lamp_space", "", "places 1 mm to 10 km, axes of unit length", place + std::vector{direction(4), direction(8), direction(12)},
         3, [](const EquationDoubles& x, double) { return length(x, 0); }},
        {1, "goniometer_angles", "", "places 1 mm to 10 km, all round", place, 2, one},
        {2, "quick_atan_unit", "", "0 to 1", std::vector{logarithmic(0, 1e-30, 1.0)}, 1, own},
        {3, "quick_atan", "", "arguments 1e-10 to 1e10, either sign", std::vector{either_sign(0, 1e-10, 1e10), either_sign(1, 1e-10, 1e10)},
         1, own},
        {4, "quick_asin_half", "", "-1 to 1", std::vector{either_sign(0, 1e-20, 1.0)}, 1, own},
        {5, "quick_goniometer_angles", "flat", "places 1 mm to 10 km ahead, up to 30 degrees up or down", place, 2, one, ahead_and_flat},
        {6, "quick_goniometer_angles", "steep", "places 1 mm to 10 km ahead", place, 2, one, ahead},
        {7, "beam_position", "", "angles to 90 degrees, steps of 0.004 to 5.7 degrees",
         std::vector{linear(0, -1.6, 1.6), linear(1, -1.6, 1.6), linear(4, -1.6, 1.6), linear(5, -1.6, 1.6), logarithmic(6, 10.0, 15000.0),
                     logarithmic(7, 10.0, 15000.0)},
         2, nullptr},
        {8, "beam_known", "", "positions -1 to 4096, 2 to 4096 samples",
         std::vector{linear(0, -1.0, 4096.0), linear(1, -1.0, 4096.0), linear(4, 2.0, 4096.0), linear(5, 2.0, 4096.0)}, 1, one},
        {9, "bilinear", "", "0.001 to 1e6 cd",
         std::vector{logarithmic(0, 1e-3, 1e6), logarithmic(1, 1e-3, 1e6), logarithmic(2, 1e-3, 1e6), logarithmic(3, 1e-3, 1e6),
                     linear(4, 0.0, 1.0), linear(5, 0.0, 1.0)},
         1,
         [](const EquationDoubles& x, double) {
             return std::max({x[0], x[1], x[2], x[3]});
         }},
        {10, "facing_illuminance", "", "0.001 to 1e7 cd, 1 mm to 10 km", std::vector{logarithmic(0, 1e-3, 1e7)} + to_lamp, 1, own},
        {11, "facing_illuminance_at", "", "0.001 to 1e7 cd, 1 mm to 10 km",
         std::vector{logarithmic(0, 1e-3, 1e7), logarithmic(1, 1e-4, 1e3)}, 1, own},
        {12, "incidence", "", "90 degrees to grazing, 1 mm to 10 km", std::vector{direction(0)} + to_lamp, 1, one},
        {13, "diffuse_luminance", "", "1e-6 to 1e6 lx", std::vector{logarithmic(0, 1e-4, 1.0), logarithmic(1, 1e-6, 1e6)}, 1, own},
        {14, "combined_reflectance", "modulate", of_colours, reflectances, 3, one},
        {15, "combined_reflectance", "replace", of_colours, reflectances, 3, one},
        {16, "combined_reflectance", "decal", of_colours, reflectances, 3, one},
        {17, "combined_reflectance", "blend", of_colours, reflectances, 3, one},
        {18, "textured_rl", "", "reflectances 1e-4 to 1", colour(0) + std::vector{logarithmic(3, 1e-3, 1e3)} + colour(4), 1, own},
        {19, "textured_rl_at", "", "reflectances 1e-4 to 1", colour(0) + std::vector{logarithmic(3, 1e-3, 1e6)}, 1, own},
        {20, "observation_angle", "", "places 1 mm to 10 km", place + to_lamp, 1, one},
        {21, "quick_observation_angle", "", "places 1 mm to 10 km", place + to_lamp, 1, one},
        {22, "retro_luminance", "",
         "R_L 0.001 to 1000, 1e-6 to 1e6 lx, 0 to 180 degrees, falling off to 1e-37 and luminances above 1e-30 cd/m2",
         std::vector{logarithmic(0, 1e-3, 1e3), logarithmic(1, 1e-6, 1e6), logarithmic(2, 1e-6, 1.0), logarithmic(3, 1e-6, 3.1415927),
                     logarithmic(4, 1e-3, 0.1), logarithmic(5, 1.0, 200.0)},
         1, own,
         [](const EquationDoubles& x, const std::array<double, 4>& value) { return value[0] > 1e-30 && (x[4] - x[3]) * x[5] > -85.0; }},
        {23, "height_above_plane", "", "places 1 mm to 1 km",
         three(either_sign(0, 1e-3, 1e3)) + three(either_sign(4, 1e-3, 1e3)) + std::vector{direction(8)}, 1,
         [](const EquationDoubles& x, double) { return std::hypot(x[0] - x[4], x[1] - x[5], x[2] - x[6]); }},
        {24, "tone_linear", "", "1e-6 to 1e12 cd/m2, L_max 1e-6 to 1e9", std::vector{logarithmic(0, 1e-6, 1e12), logarithmic(1, 1e-6, 1e9)},
         1, own},
        {25, "tone_rational", "", "the same, s 1 to 1e6",
         std::vector{logarithmic(0, 1e-6, 1e12), logarithmic(1, 1e-6, 1e9), logarithmic(2, 1.0, 1e6)}, 1, own},
        {26, "tone_logarithmic", "", "the same, s 1 to 1e6",
         std::vector{logarithmic(0, 1e-6, 1e12), logarithmic(1, 1e-6, 1e9), logarithmic(2, 1.0, 1e6)}, 1, one},
        {27, "srgb_encoded", "", "0 to 1", std::vector{logarithmic(0, 1e-9, 1.0)}, 1, one},
        {28, "quick_srgb_encoded", "", "0 to 1", std::vector{logarithmic(0, 1e-9, 1.0)}, 1, one},
        {38, "white_adapted", "", "1e-6 to 1e6 cd/m2, entries 0.001 to 10, either sign",
         three(logarithmic(0, 1e-6, 1e6)) + three(either_sign(4, 1e-3, 10.0)) + three(either_sign(8, 1e-3, 10.0)) +
             three(either_sign(12, 1e-3, 10.0)),
         3, [](const EquationDoubles& x, double) {
             return length(x, 0) * std::max({length(x, 4), length(x, 8), length(x, 12)});
         }}};
    for (const Equation& equation : of_sky_and_weather())
        all.push_back(equation);
    // Each position by its own angle, first angle and step; one scale for both is the larger one's.
    all[7].scale = [](const EquationDoubles& x, double) {
        return std::max((std::abs(x[0]) + std::abs(x[4])) * x[6], (std::abs(x[1]) + std::abs(x[5])) * x[7]);
    };
    return all;
}

/// The figures that stand beside the equations in photometry.glsl. u is half a unit in the last place of a float, 6.0e-8. GLSL 4.5, section
/// 4.7.1, promises sums, products and differences to u, quotients to 2.5 units (5 u), inversesqrt to 2 units.
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
    {"white_adapted", 2e-7, "of |light| and the longest row", 1.0, "three products and two sums: 3 u of the sum of their sizes"},
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
    {"dielectric_reflectance", 3e-6, "of 1", 2.0, "as water_reflectance, with an index of 1.2 to 2.5"},
    {"facet_mirrored", 5e-4, "relative", 1000.0, "as wet_mirrored, which calls it with the index of water"},
    {"wet_albedo", 3e-5, "relative", 4.0, "1 - F is 0.05 at a cosine of 0.01, for two directions: 20 times what water_reflectance rounds"},
    {"wet_mirrored", 5e-4, "relative", 1000.0,
     "the facet's sine by a cross product, 6 u of 1 over a lobe of width 0.1, to the fourth power; dot products of 0.001 with 3 u"},
};

} // namespace

std::span<const Equation> equations() {
    static const std::vector<Equation> all = make();
    return all;
}

std::span<const EquationBound> equation_bounds() { return bounds; }

std::string EquationBound::comment() const {
    return fmt::format("Float: {:g} {}, condition {}.", error, of, condition > 0.0 ? fmt::format("{:g}", condition) : "unbounded");
}

const EquationBound& bound_of(const std::string& function) {
    for (const EquationBound& bound : equation_bounds())
        if (bound.function == function)
            return bound;
    throw std::logic_error("no bound is stated for " + function);
}

} // namespace fernlicht
