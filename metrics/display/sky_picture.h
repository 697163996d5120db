// The night's sky behind a picture.
#pragma once

#include "scenarios/display/night_sky.h"
#include "scenarios/drives/play/frame.h"

namespace fernlicht {

/// The frame's coloured light with the sky in the place of the drive's even one where nothing is seen (ids 0), in the sky's white, D65, and
/// the moon's disc in it; lamps that shine before it add to it. Unchanged by day and in twilight (more than 0.5 lx of diffuse light, or a
/// sun), in fog, and for maps. The frame has light and ids.
Image<glm::vec3> with_night_sky(const Frame& frame, const Moment& moment, const View& view, const NightSky& sky);

} // namespace fernlicht
