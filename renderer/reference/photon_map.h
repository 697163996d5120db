// Photon mapping (H. W. Jensen, "Global Illumination using Photon Maps", Rendering Techniques 1996).
//
// Photons go from lamps, sky and shining surfaces (photon_emission.h) from surface to surface as paths do (scattering.h), with Russian
// roulette, and leave their flux at every surface within reach that is not glass. Illuminance at a point is
//     E = sum 2 / (pi r^2) (1 - d^2 / r^2) flux    over photons closer than r,
// a kernel whose integral over a flat disc is 1 (Epanechnikov), of those that lie within 0.3 r of the surface's plane on a surface that
// faces the same way (cosine above 0.7). Sixteen maps, each of a sixteenth of the photons, from independent scrambled nets.
//
// Bias: what varies over the radius r is smoothed (by the Laplacian of E times r^2 / 12, and a shadow's edge over 2 r); nearer than r to
// the surface's end photons are missing, down to a half of the light on its edge and a quarter in its corner; light from beyond the reach,
// and the sky's that things beyond it would hide. All of it goes to 0 with r and the reach, and noise goes with 1 / (r sqrt(photons)).
#pragma once

#include "renderer/reference/solved_light.h"

namespace fernlicht::reference {

class PhotonMap : public SolvedLight {
  public:
    PhotonMap(const Shot& shot, Preparation& preparation);

    glm::dvec3 irradiance(const SurfaceHit& hit, Part part, std::size_t replicate) const override;

    /// Flux that photons left, direct and all, mean of the replicates, linear sRGB with Y in lm: what the surfaces get per second.
    glm::dvec3 flux_lm(Part part) const;

  private:
    enum class Way : std::uint8_t { lamp, caustic, other };
    struct Photon {
        glm::vec3 place_m, normal, flux_lm;
        Way way;
    };
    struct Map {
        std::vector<Photon> photons;      ///< in the order of their cells
        std::vector<std::uint64_t> cells; ///< of each
        std::uint64_t rays = 0;
    };
    static bool counts(Way way, Part part);
    std::uint64_t cell_of(const glm::ivec3& cell) const;
    Map sent_out(const Shot& shot, const class PhotonEmission& emission, std::size_t replicate, std::uint32_t count) const;

    double radius_m_, reach_m_;
    std::vector<Map> maps_; ///< of each replicate
};

} // namespace fernlicht::reference
