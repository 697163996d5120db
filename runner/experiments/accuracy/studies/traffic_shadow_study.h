// Error against run time of shadows in the light of other road users' lamps and of street lamps.
#pragma once

#include "runner/experiments/accuracy/studies/studies.h"

namespace fernlicht {

/// Without them, and with maps of some sizes: the share of the driver's view, lit by others, that is wrongly lit or dark against a ray from
/// each pixel to each lamp, over the time of a frame in colour with all lamps. Error: of five moments evenly spread over the drive
/// together; time: of the middle one and the one before it, in turn. No rows without lamps of others, and for drives without shadows.
WorkPrecision traffic_shadow_study(const Stage& stage, const Variant& variant, Device& device, const StudyGoesOn& go_on);

} // namespace fernlicht
