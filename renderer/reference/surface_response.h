// How a surface returns light at the place where a ray met it: its material with the texture applied, in double.
//
// Retroreflection inside paths of light.
//
// A material's retroreflection is defined by a measurement: L = g(gamma) E_perp with g(gamma) = R_L exp((reference - gamma) / falloff),
// where gamma is the angle between the directions to light and eye and E_perp is on a plane perpendicular to the light. As a reflectance
// function f, with dE_perp = L_i d omega_i and L_o = integral of f L_i cos(theta_i) d omega_i, this is f = g(gamma) / cos(theta_i). Two
// things keep it from serving between surfaces: it is not reciprocal, f(i, o) != f(o, i), and what it returns of light from i,
//     integral of f cos(theta_o) d omega_o = (integral of g cos(theta_o) d omega_o) / cos(theta_i),
// grows without bound for grazing light. Where light bounces,
//     f = s g(gamma) / max(cos(theta_i), cos(theta_o))
// is used instead. It is symmetric, equal to the measured one within the lobe's width of the incoming direction when s = 1, and returns at
// most
//     s G,   G = integral of g over the sphere = 2 pi R_L exp(k reference) (1 + exp(-k pi)) / (1 + k^2),   k = 1 / falloff,
// from either side, since cos / max <= 1. With s = min(1, (1 - albedo) / G) no more leaves a surface than arrives.
//
// Nothing is counted twice: light from a lamp over one surface to the eye takes the measured g and no path; light over two and more
// surfaces takes f at each surface, and lamps are reached by a ray towards them only, never by a path that happens to meet one.
#pragma once

#include "renderer/reference/embree_scene.h"
#include "scenarios/light/light.h"

#include <glm/vec4.hpp>

namespace fernlicht::reference {

struct SurfaceResponse {
    glm::dvec3 albedo{0.0}; ///< linear sRGB reflectances, 0..1
    double retro_rl = 0.0;  ///< cd/(m2 lx) at the reference observation angle
    double retro_reference_rad = 0.0, retro_inverse_falloff = 0.0;
    glm::dvec3 emission_cdm2{0.0};
    bool gets_wet = false;
    glm::dvec3 retro_tint{1.0}; ///< of retroreflected light
    Facets facets;              ///< while it is dry
    double retro_wet = 0.0;     ///< share of retroreflection that is left under water
};

/// A texture between its texels: bilinear, repeating, texel centres at (i + 0.5) / width, as OpenGL's GL_LINEAR. No mipmaps: the average
/// over a footprint is the average over its samples. 0..1.
glm::dvec4 texel_at(const SurfaceTexture& texture, const glm::dvec2& uv);

/// Equations of photometry.glsl (combined_reflectance, textured_rl).
SurfaceResponse response_at(const Scene& scene, const SurfaceHit& hit);

/// Luminance of linear sRGB.
inline double luminance(const glm::dvec3& rgb) { return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z; }

struct RetroLobe {
    double at_zero = 0.0;  ///< s g(0), cd/(m2 lx); 0: no lobe
    double k = 1.0;        ///< 1 / falloff
    double returned = 0.0; ///< s G: greatest share of light that the lobe returns, 0..1

    bool is_there() const { return returned > 0.0; }
};

/// `albedo`: the greatest of the surface's three. What is returned is that of the tint's greatest channel.
RetroLobe retro_lobe(const SurfaceResponse& response, double albedo);

/// f cos(theta_i); all cosines against the surface's normal, cos_in > 0.
double retro_times_cosine(const RetroLobe& lobe, double angle_rad, double cos_in, double cos_out);

/// A direction about `towards` (unit), of density k^2 gamma exp(-k gamma) / (2 pi sin gamma), and f cos(theta_i) over that density.
/// Weight 0 for a direction below the surface.
struct RetroSample {
    glm::dvec3 direction{0.0, 0.0, 1.0};
    double weight = 0.0;
};
RetroSample sample_retro(const RetroLobe& lobe, const glm::dvec3& towards, const glm::dvec3& normal, const glm::dvec2& radial,
                         double around);

/// Two unit vectors that with `axis` (unit) make a right-handed frame (Duff and others 2017).
struct Across {
    glm::dvec3 u, v;
};
Across across(const glm::dvec3& axis);

/// Unit, of density cos / pi about the normal.
glm::dvec3 sample_cosine(const glm::dvec3& normal, const glm::dvec2& square);

} // namespace fernlicht::reference
