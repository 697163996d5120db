// Small-target visibility after W. Adrian, Visibility of targets: model for calculation, Lighting Research & Technology 21, 1989. A target
// is seen when its luminance differs from its background's by more than a threshold; the visibility level says how many times more.
//
//   dL = k (sqrt(phi)/alpha + sqrt(L))^2 Fcp TF AF,   VL = |Lt - Lb| / dL
//
// The equations and their branches were read in two independent programs of others, k = 2.6 (seen with 99.9 %) is from memory. Luminances
// in cd/m2, alpha in arc minutes, times in s, ages in years. The branches do not meet exactly. Upwards, dL jumps by -1.3 to -2.0 % at Lb =
// 0.6 and by -0.2 to +0.6 % at 0.00418 (targets of 60 to 1 arc minutes), by -1.4 % at an age of 64, and the factor of negative contrast not
// at all at 0.1: tests/metrics/seeing/visibility_test.cpp holds them.
// Mesopic luminance, CIE 191:2010, system MES2: between 0.005 and 5 cd/m2 eyes see by cones and rods, and light with more blue in it (a
// larger ratio S/P of scotopic to photopic) counts for more than its photopic luminance says.
//
//   Lmes = (m Lp + (1 - m) Ls V') / (m + (1 - m) V'),  V' = 683 / 1699,  Ls = S/P Lp,  m = clamp(0.7670 + 0.3334 lg Lmes, 0, 1)
//
// a and b were read in another's program (1 - lg(5)/3 and 1/3), V' and the iteration from m = 0.5 are from memory.
//
// Luminance of a surface in the light of a moment's lamps, by the same equations as every picture (scenarios/photometry.glsl), in double.
#pragma once

#include "metrics/glare/glare.h"
#include "metrics/readings/value.h"
#include "scenarios/drives/play/moment.h"
#include "scenarios/values/scene.h"

#include <vector>

namespace fernlicht {

struct Onlooker {
    double age_years = 25.0; ///< 23 to 75
    double time_s = 0.2;     ///< for which the target shows; from 2 s on its length no longer counts
    double k = 2.6;
};

/// Luminance difference at which a target of this size is just seen. `positive`: lighter than its background.
/// Not measured for a background that is dark (0), ages outside 23 to 75, exposures below 2 s with targets of 60 arc minutes and more,
/// negative contrast on backgrounds of 0.004 cd/m2 and less, and where the correction for negative contrast leaves nothing. Sizes and times
/// not above 0 throw std::invalid_argument.
Value threshold_difference_cdm2(double background_cdm2, double size_arcmin, bool positive, const Onlooker& onlooker);

/// |Lt - Lb| / dL, the threshold that of an eye adapted to `adaptation_cdm2`.
Value visibility_level(double target_cdm2, double background_cdm2, double adaptation_cdm2, double size_arcmin, const Onlooker& onlooker);
/// Adapted to the background.
inline Value visibility_level(double target_cdm2, double background_cdm2, double size_arcmin, const Onlooker& onlooker) {
    return visibility_level(target_cdm2, background_cdm2, background_cdm2, size_arcmin, onlooker);
}

struct Mesopic {
    double luminance_cdm2 = 0.0;
    double m = 0.0;        ///< 0: rods alone (Lmes = Ls), 1: cones alone (Lmes = Lp)
    bool bisected = false; ///< the fixed point went round in circles, m is the one zero of its residual
};

/// Lp > 0 and finite, S/P in [0.01, 100], else std::invalid_argument. The published fixed point is followed until m changes by less than
/// 1e-10. With S/P above 1 larger m means less Lmes, so that the residual has one zero; where the steps there grow instead of shrinking
/// (S/P of 16 and more, Lp of 0.2 to 5), that zero is found by bisection. With S/P below 1 the steps go one way and always arrive; at S/P
/// of 0.1 and less more than one m can solve the equations (Lp of 0.03 to 0.4), and it is the one that the steps from 0.5 meet.
Mesopic mesopic_luminance(double photopic_cdm2, double sp_ratio);

/// Angle under which a length is seen across the line of sight.
double arc_minutes_of(double length_m, double distance_m);

struct SurfaceLuminance {
    double photopic_cdm2 = 0.0;
    double scotopic_cdm2 = 0.0; ///< lamps alone, by their ratios S/P; of daylight nothing is known
};

/// What leaves the surface towards the eye: diffuse and retroreflected light of the material's own colour, without textures, whose mean it
/// is. Luminance as of a grey of the same Y: lamps' colours change it by what colour and surface have in common, which rendered pictures
/// know. Sky included. The air takes its part from lamp to surface; under a film of water road and markings return what light.h says, the
/// rest of them stays dry. `by_road`: what a wet road mirrors of each lamp (metrics/glare/wet_road.h) onto what stands upright.
SurfaceLuminance surface_luminance(const Moment& moment, const glm::dvec3& point_m, const glm::dvec3& normal, const Material& material,
                                   const glm::dvec3& eye_m, const std::vector<SeenLamp>& by_road = {});

/// d surface_luminance() / d intensity towards the point, by lamp of the moment, 1/m2: luminance is linear in it. Photopic, without light
/// by way of the road.
std::vector<double> luminance_per_cd(const Moment& moment, const glm::dvec3& point_m, const glm::dvec3& normal, const Material& material,
                                     const glm::dvec3& eye_m);

/// Points of a ray at which lamps' light in the air is asked for: as many as pictures have.
inline constexpr int airlight_samples = 32;
/// What the air adds between eye and point: the light of the moment's lamps, scattered once, as pictures have it (fog_light.h).
SurfaceLuminance lamps_airlight(const Moment& moment, const glm::dvec3& point_m, const glm::dvec3& eye_m);
/// The surface as an eye so far away sees it: less what the air takes on the way, with what lamps and sky put in its place.
SurfaceLuminance seen_through_air(const Moment& moment, const SurfaceLuminance& surface, const SurfaceLuminance& airlight,
                                  double distance_m);
/// surface_luminance() as the eye sees it through the air.
SurfaceLuminance seen_luminance(const Moment& moment, const glm::dvec3& point_m, const glm::dvec3& normal, const Material& material,
                                const glm::dvec3& eye_m, const std::vector<SeenLamp>& by_road = {});

/// E = sum of E_perp cos(alpha) of patches of the road on a surface of unit `normal`, lx.
double illuminance_by_road_lx(const std::vector<SeenLamp>& by_road, const glm::dvec3& point_m, const glm::dvec3& normal);

/// Y of a linear sRGB reflectance.
double reflectance_of(const glm::vec3& linear_srgb);

} // namespace fernlicht
