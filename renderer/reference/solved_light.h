// Light that was solved for a whole moment before its pictures are drawn, and how pictures use it.
//
// A solution holds 16 replicates: independent estimates of the same light, each from a sixteenth of the rays or photons. Lane i of a packet
// is replicate i of a pixel (pixel_estimate.h) and reads replicate i of the solution, so that a pixel's standard error knows the noise of
// the solution as well as that of its own samples. What all replicates have in common, it does not know: the width of patches and of
// photons' discs.
#pragma once

#include "renderer/reference/shot.h"

namespace fernlicht::reference {

enum class Part {
    all,
    without_lamps, ///< all but what comes straight from a lamp
    caustic        ///< from a lamp by mirrors and glass alone
};

class SolvedLight {
  public:
    SolvedLight() = default;
    SolvedLight(const SolvedLight&) = delete;
    SolvedLight& operator=(const SolvedLight&) = delete;
    virtual ~SolvedLight() = default;
    /// Illuminance on the lit side of a surface, linear sRGB with Y in lx. 0 beyond the reach of the solution.
    virtual glm::dvec3 irradiance(const SurfaceHit& hit, Part part, std::size_t replicate) const = 0;
};

/// Solves as the shot's settings ask; nothing where its integrator needs none. Throws InputError for more patches than can be held,
/// Stopped when that is asked for; cutting surfaces into patches and sorting photons, seconds for the largest, do not ask.
std::shared_ptr<const SolvedLight> solve_light(const Shot& shot, Preparation& preparation);

/// Adds to a packet that light_packet has lit without the sky's share all other light: by final gathering (one ray a sample over the
/// hemisphere; where it lands, what the solution holds) or as the solution holds it.
void add_solved_light(const Shot& shot, const std::array<SamplePoint, packet_size>& points, PacketLight& light);

} // namespace fernlicht::reference
