// Radiosity (C. Goral, K. Torrance, D. Greenberg, B. Battaile, "Modeling the Interaction of Light between Diffuse Surfaces", SIGGRAPH
// 1984).
//
// Surfaces within reach are cut into patches (patches.h), over each of which illuminance and reflectance are taken to be constant:
//     E_i = D_i + S_i + sum_j F_ij (rho_j E_j + pi L_j)
// with D the lamps' direct light by feelers, S that of the sky which things let through, L the surface's own light. The form factors F_ij
// are shares of cosine-distributed rays from i that land on j (followed past mirrors and glass); rows add up to at most 1, and to 1 in a
// closed room, so that energy is kept exactly. D, rho and the rays' origins are means over as many points of the patch as it has rays.
// Solved by Gauss-Seidel in the patches' order until sum |change| <= residual * sum E; 16 replicates, each with a sixteenth of the rays.
//
// Bias: the width of patches (light at a shadow's or cut-off's edge is smeared over one), retroreflection from surface to surface, lamps'
// light by mirrors and glass, and all that lies beyond the reach are left out. Rays are independent between replicates; that E depends on F
// not linearly makes an error of second order in their noise, which no error bar knows.
#pragma once

#include "renderer/reference/patches.h"
#include "renderer/reference/solved_light.h"

namespace fernlicht::reference {

class Radiosity : public SolvedLight {
  public:
    /// Throws InputError for more than a million patches or 2^29 rays.
    Radiosity(const Shot& shot, Preparation& preparation);

    glm::dvec3 irradiance(const SurfaceHit& hit, Part part, std::size_t replicate) const override;

  private:
    struct System; ///< of one replicate
    void measure(const Shot& shot, std::uint32_t patch, std::vector<System>& systems, std::uint64_t& rays);

    Patches patches_;
    std::vector<glm::dvec3> reflectance_, emission_lx_; ///< of each patch: rho, pi L; over 1 - mirror
    std::vector<std::vector<glm::dvec3>> all_, lamps_;  ///< by replicate and patch, lx
};

} // namespace fernlicht::reference
