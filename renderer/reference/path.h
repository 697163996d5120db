// Light that comes over other surfaces, and from the sky that is not hidden: path tracing, unbiased.
//
// From a surface a path goes on in a direction drawn from the Lambert lobe (density cos / pi) or from the retroreflecting one
// (surface_response.h), each with the probability of its share of the reflectance, or ends: the path's weight stays at most about 1, and no
// bound on its length is needed. At each surface that it meets, every lamp is asked directly (next-event estimation); lamps are points or
// discs that no path meets by itself. The sky, L = E_h / pi from every direction above the horizon, and surfaces' own light count where a
// path meets them, and are never asked directly; sun and moon are asked as lamps are. So each way that light can take is counted once. A
// surface met from behind, on the side that is not lit, is black. A wet surface sends paths on below its film and off it (scattering.h);
// fog turns them (scattering.h).
//
// Whitted's ray tracing (T. Whitted, "An Improved Illumination Model for Shaded Display", CACM 23(6), 1980): at each surface one feeler to
// each lamp, and where it is smooth one ray on by mirroring and one by refraction.
//
// Fog on each way from surface to surface is that of direct light (scattering.h). Bias: light that has left a rough surface lights no
// other; the sky's share on a surface is (1 + n_z) / 2, hidden by nothing; feelers end at glass as at any surface, and lamps light nothing
// by way of mirrors; after ReferenceSettings::max_smooth smooth surfaces there is no light. No noise but that of the pixel's footprint and
// of lamps with an area. Where nothing is smooth it is the same picture as direct light. Shares of mirroring and refraction are Fresnel's,
// not the constants of 1980.
#pragma once

#include "renderer/reference/shot.h"

#include <functional>

namespace fernlicht::reference {

/// Radiance in linear sRGB with Y in cd/m2 that arrives along a ray from where it points, drawn from the point's pairs from `pair` on. Adds
/// the rays it cast to `rays`. `lane` is that of the packet, which is the replicate's number, too.
using Arriving =
    std::function<glm::dvec3(std::size_t lane, const SamplePoint& point, std::size_t pair, const Ray& ray, std::uint64_t& rays)>;

/// Adds to a packet that light_packet has lit without the sky's share what arrives over at least one other surface, and the sky as things
/// let it through. One path a lane, a second one where the surface retroreflects and luminance is wanted.
void add_bounced_light(const Shot& shot, const std::array<SamplePoint, packet_size>& points, const Arriving& arriving, PacketLight& light);

/// What is seen in the packet's mirrors and through its glass, both ways that glass sends it. Luminance only.
void add_smooth_light(const Shot& shot, const std::array<SamplePoint, packet_size>& points, const Arriving& arriving, PacketLight& light);

/// Both, by paths, and where there is fog what it sends towards the eye (scattering.h).
void add_path_light(const Shot& shot, const std::array<SamplePoint, packet_size>& points, const std::array<Ray, packet_size>& eye_rays,
                    LaneMask lanes, PacketLight& light);

/// Adds to a packet lit by light_packet what its mirrors and glass show.
void add_whitted_light(const Shot& shot, const std::array<SamplePoint, packet_size>& points, PacketLight& light);

} // namespace fernlicht::reference
