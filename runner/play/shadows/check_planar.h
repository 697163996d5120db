// Whether the drive's ground is the one plane that `shadows: planar` needs, found out before anything is played.
#pragma once

#include "renderer/device.h"
#include "runner/play/play.h"
#include "runner/play/stage.h"

namespace fernlicht {

/// Throws InputError, at the line of the drive's file that asks for it, where ground in the lamps' light is not one plane in one of these
/// moments with any of the drive's lamp sets. Drives that do not draw by `planar` cost nothing.
void check_planar_shadows(const Stage& stage, Device& device, TickRange ticks = {});
/// The same of these moments alone.
void check_planar_shadows(const Stage& stage, Device& device, const std::vector<Moment>& moments);

} // namespace fernlicht
