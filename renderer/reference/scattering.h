// Where light goes from a surface: one place for all methods that follow it, from the eye or from the lamps.
//
// Diffuse light leaves by Lambert's law, retroreflected light by a lobe (surface_response.h). A smooth surface mirrors the share
// Material::mirror; a surface of glass splits light by Fresnel's equations (Born and Wolf, Principles of Optics, 1.5.2) and Snell's law,
// and takes nothing away. Every one of these is symmetric between the two directions, apart from the factor n^2 that radiance carries
// within glass and loses where it leaves: eye, lamps and all other surfaces are in air, so that it always cancels and is left out.
// Where light goes on from a wet surface: into the road below the film (light.h's diffuse part) or off the film's facets. Sampled so
// that paths see the same water as light that comes straight from lamps.
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
#include "renderer/reference/surface_response.h"
#include "scenarios/photometry.h"

namespace fernlicht::reference {

struct Surface {
    SurfaceHit hit;
    SurfaceResponse response;
    RetroLobe lobe;
    double albedo = 0.0;      ///< the greatest of three
    double mirror = 0.0;      ///< share that is mirrored
    double glass_index = 0.0; ///< 0: opaque
    glm::dvec3 out{0.0};      ///< unit, back along the path
    double wetness = 0.0;     ///< 0 dry .. 1 under water
    bool is_glass() const { return glass_index > 0.0; }
    /// Met from the side that is not lit, and nothing passes.
    bool is_dark() const { return hit.from_behind && !is_glass(); }
};

inline bool is_smooth(const Material& material) { return material.mirror > 0.0F || material.glass_index > 0.0F; }

Surface surface_at(const Shot& shot, const SurfaceHit& hit, const glm::dvec3& out);

/// Share of unpolarised light that a smooth boundary reflects, 0..1. `cosine` against the normal on the side that light comes from, 0..1;
/// `ratio` is the refractive index beyond over the one before. 1 for total reflection.
double fresnel_reflectance(double cosine, double ratio);

/// Where smooth surfaces send light; shares 0 where there is none.
struct SpecularSplit {
    glm::dvec3 mirrored{0.0}, refracted{0.0}; ///< unit
    double mirrored_share = 0.0, refracted_share = 0.0;
};
SpecularSplit specular_split(const Surface& surface);

/// A ray from a surface into a direction, to whichever side that is.
Ray leaving(const SurfaceHit& hit, const glm::dvec3& direction);

/// Luminance in linear sRGB that lamps, sun and moon give the surface along the path, over this surface alone. Draws from the point's pairs
/// from `pair` on, one a lamp.
glm::dvec3 lamps_on(const Shot& shot, const Surface& surface, const SamplePoint& point, std::size_t pair, std::uint64_t& rays);

/// Draws where the path goes on from the surface, from two pairs, and multiplies its weight; false where it ends. `specular`: by mirror or
/// glass; a wet surface's film is rough. Russian roulette keeps the weight at about 1/2 or above.
bool go_on_from(const Surface& surface, const SamplePoint& point, std::size_t pair, Ray& ray, glm::dvec3& weight, bool& specular);

/// What a ray meets at last that is neither glass nor, by the throw of a die, mirror: so that light that comes from there is the surface's
/// own, over 1 - mirror. nullopt: nothing, and `ray` is the one that goes there. Draws from the point's pairs from `pair` on.
std::optional<Surface> cast_past_smooth(const Shot& shot, const SamplePoint& point, std::size_t pair, Ray& ray, std::uint64_t& rays);

/// Luminance of the sky from a direction, linear sRGB with Y in cd/m2.
glm::dvec3 sky_luminance(const Moment& moment, const glm::dvec3& direction);

/// 0 dry .. 1 under water, of the place with this response.
inline double wetness_at(const Shot& shot, const SurfaceResponse& response) {
    return response.gets_wet ? shot.moment.weather.wetness : 0.0;
}

/// pi times the diffuse reflectance function between two directions, dry and wet shares together: exactly the albedo where it is dry.
glm::dvec3 diffuse_reflectance(const glm::dvec3& albedo, double wetness, double cosine_in, double cosine_out);

/// A direction off facets, drawn by those that are seen from `out` (GGX: Heitz 2018), and reflectance times cosine over its density, which
/// is Fresnel's reflectance times what other facets leave of it: below 1. Weight 0 below the surface.
struct FacetSample {
    glm::dvec3 direction{0.0, 0.0, 1.0};
    double weight = 0.0;
};
FacetSample sample_facets(const glm::dvec3& normal, const glm::dvec3& out, const glm::dvec2& square, double roughness, double index);
inline FacetSample sample_film(const glm::dvec3& normal, const glm::dvec3& out, const glm::dvec2& square) {
    return sample_facets(normal, out, square, wet_roughness, photometry::water_index);
}

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
