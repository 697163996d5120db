// Error against run time of drawing lamps of others as coarsely as their light allows.
#pragma once

#include "runner/experiments/accuracy/studies/studies.h"

namespace fernlicht {

/// Least lux of others' light: worst and 95 % error of illuminance in the driver's view against every lamp with its own beam and nothing
/// left out, over the time of a frame in colour; and every lamp with its own beam at the drive's least lux. The drive's middle moment. No
/// rows without lamps of others.
WorkPrecision traffic_study(const Stage& stage, const Variant& variant, Device& device, const StudyGoesOn& go_on);

} // namespace fernlicht
