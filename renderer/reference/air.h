// Homogeneous fog in the reference: what it takes, what lamps send the eye by way of it.
//
// Direct and Whitted's light have single scattering by quadrature, with nothing in the way between lamp and air, as the technique
// `photometric` and its twin. Paths have it as it is: along each of their segments every lamp is asked at one point, drawn evenly over the
// angle at the lamp (equi-angular: Kulla and Fajardo 2012), with a ray for what stands in the way; and the path goes on from where the air
// turns it, free flights of density exp(-s t) s, directions by Henyey and Greenstein's phase function. So each scattering of each segment
// counts once, however often the light was scattered before.
//
// Light of sun and sky is given as it is below the fog: it reaches surfaces undiminished, and the air glows as the sky does, in balance
// with it: a segment to a surface has (1 - transmittance) of the sky's luminance. It is not scattered again.
#pragma once

#include "renderer/reference/shot.h"

namespace fernlicht::reference {

/// As far as the air before the sky is followed.
inline constexpr double air_end_m = 5000.0;

inline bool is_in_air(const Shot& shot) { return shot.moment.weather.extinction_per_m > 0.0; }
/// Share of light left on the way from a place to the eye; exactly 1 in clear air and in maps, which are seen without the air above them.
double left_on_way_to_eye(const Shot& shot, const glm::dvec3& point_m);

/// Luminance of what a ray meets, with the air before it: by quadrature, or for paths without the lamps' share, which they add.
glm::dvec3 through_air(const Shot& shot, const Ray& ray, const glm::dvec3& end_m, const glm::dvec3& light);
/// The lamps' share alone.
glm::dvec3 airlight(const Shot& shot, const glm::dvec3& eye_m, const glm::dvec3& end_m);

/// Pairs of coordinates that a segment's air takes: flight, turn, and two for each lamp.
inline std::size_t air_pairs(const Shot& shot) { return is_in_air(shot) ? 2 + 2 * shot.moment.lamps.size() : 0; }
/// One point a lamp on the first `way_m` metres of a ray of unit direction: scattered once, towards the ray's origin. Draws from two pairs
/// a lamp.
glm::dvec3 lamps_in_air(const Shot& shot, const Ray& ray, double way_m, const SamplePoint& point, std::size_t pair, std::uint64_t& rays);

/// A direction about `along` (unit), of the density of Henyey and Greenstein's phase function; -1 < g < 1.
glm::dvec3 sample_henyey_greenstein(const glm::dvec3& along, double g, const glm::dvec2& square);

} // namespace fernlicht::reference
