// Where light goes on from a wet surface: into the road below the film (wet_light.h's diffuse part) or off the film's facets. Sampled so
// that paths see the same water as light that comes straight from lamps.
#pragma once

#include "renderer/reference/shot.h"

namespace fernlicht::reference {

/// 0 dry .. 1 under water, of the place with this response.
inline double wetness_at(const Shot& shot, const SurfaceResponse& response) {
    return response.gets_wet ? shot.moment.weather.wetness : 0.0;
}

/// pi times the diffuse reflectance function between two directions, dry and wet shares together: exactly the albedo where it is dry.
glm::dvec3 diffuse_reflectance(const glm::dvec3& albedo, double wetness, double cosine_in, double cosine_out);

/// A direction off the film's facets, drawn by those that are seen from `out` (GGX: Heitz 2018), and reflectance times cosine over its
/// density, which is Fresnel's reflectance times what other facets leave of it: below 1. Weight 0 below the surface.
struct FilmSample {
    glm::dvec3 direction{0.0, 0.0, 1.0};
    double weight = 0.0;
};
FilmSample sample_film(const glm::dvec3& normal, const glm::dvec3& out, const glm::dvec2& square);

/// About the share of light that the film sends on, by which a path chooses it; 0..1.
double film_share(const glm::dvec3& normal, const glm::dvec3& out);

} // namespace fernlicht::reference
