// The lowest and the highest received intensity on a segment or in a polygon, and where.
#pragma once

#include "metrics/beam/received_beam.h"

#include <optional>
#include <vector>

namespace fernlicht {

struct Extreme {
    double cd = 0.0;
    Direction where;
};

struct Extremes {
    std::optional<Extreme> lowest, highest; ///< nullopt: not looked for, or nowhere data
    bool all_covered = true;                ///< data wherever it was looked
};

struct WantedExtremes {
    bool lowest = true, highest = true;
};

/// Samples stand at most ReceivedBeam::step_deg() apart, a third of the receiver. The received beam changes over half of that by at most
/// a sixth of what it differs between the receiver's opposite edges, so nothing narrower hides between samples; the best sample is then
/// followed to its extreme (steps down to 0.001 degrees), which leaves an error of second order only.
Extremes extremes_on(const ReceivedBeam& beam, Direction from, Direction to, WantedExtremes wanted = {});

/// The polygon with its border; corners in order, not crossing itself. Blocks that by the samples around them cannot hold an extreme are
/// left out, which changes no result.
Extremes extremes_in(const ReceivedBeam& beam, const std::vector<Direction>& corners, WantedExtremes wanted = {});

} // namespace fernlicht
