// A road network seen in a mirror: what lies left of a road lies right of it, and traffic keeps to the other side.
#pragma once

#include "scenarios/roads/road_network.h"

namespace fernlicht {

/// The same ground with y and -y exchanged (about the x-z plane). Lane ids change sign, as OpenDRIVE counts them from left to right; s, the
/// names of roads and the direction in which lanes are driven along s stay. Every pose on it is the mirror image of one on `network`, to
/// rounding; where a lateral profile has shapes these are written anew, elsewhere numbers only change their sign.
RoadNetwork mirrored(RoadNetwork network);

} // namespace fernlicht
