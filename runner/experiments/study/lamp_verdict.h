// What differs between two lamps' tables, in one or two sentences for people who know beams and not statistics.
#pragma once

#include "runner/experiments/study/study_result.h"

namespace fernlicht {

/// "dimmer against production: 5.0 % dimmer at 8.2 to 2.9 degrees left and 4.2 to 1.5 degrees down. Nothing else differs
/// beyond the noise of the tables, 0.82 %." Zones beyond the clearest three are counted. Angles are the goniometer's.
std::string lamp_verdict(const LampComparison& lamps);

} // namespace fernlicht
