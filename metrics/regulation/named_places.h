// The trade's names for where two lamps differ: test points and zones of our tables, and regions of our own where no
// text has one.
#pragma once

#include "metrics/beam/lamp_difference.h"

namespace fernlicht {

/// For right-hand traffic; for `left` names and places are mirrored ("75R" is "75L"), as the regulations do it.
std::vector<BeamPlace> low_beam_places(TrafficSide side = TrafficSide::right);
std::vector<BeamPlace> high_beam_places();

/// compare_lamps by the places of high beams where both have at least half their peak at HV and neither has an elbow, else by those of low
/// beams, on the side of the road that `against` is for; if that is unknown, that `tested` is for, else the right.
LampDifference compare_by_name(const SampledBeam& tested, const SampledBeam& against, LampDifferenceOptions options = {});

} // namespace fernlicht
