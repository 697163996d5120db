// Whitted's ray tracing (T. Whitted, "An Improved Illumination Model for Shaded Display", CACM 23(6), 1980): at each surface one feeler to
// each lamp, and where it is smooth one ray on by mirroring and one by refraction.
//
// Fog on each way from surface to surface is that of direct light (air.h). Bias: light that has left a rough surface lights no other; the
// sky's share on a surface is (1 + n_z) / 2, hidden by nothing; feelers end at glass as at any surface, and lamps light nothing by way of
// mirrors; after ReferenceSettings::most_smooth smooth surfaces there is no light. No noise but that of the pixel's footprint and of lamps
// with an area. Where nothing is smooth it is the same picture as direct light. Shares of mirroring and refraction are Fresnel's, not the
// constants of 1980.
#pragma once

#include "renderer/reference/shot.h"

namespace fernlicht::reference {

/// Adds to a packet lit by light_packet what its mirrors and glass show.
void add_whitted_light(const Shot& shot, const std::array<SamplePoint, packet_size>& points, PacketLight& light);

} // namespace fernlicht::reference
