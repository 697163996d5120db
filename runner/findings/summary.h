// A drive's moments folded into readings, which limits are set on. docs/readings.md defines every name.
#pragma once

#include "runner/findings/report.h"

namespace fernlicht {

/// What the extents of all moments add up to, one for each of extent_keys(). The same inputs give the same bytes.
std::vector<ExtentSummary> summarise_extents(const PlayedCell& played, const ExtentParameters& parameters);

/// What nudges move the median reach by, metres: `by_aim`, `by_flux` ... (sensitivity.h). Not measured where the twin does not tell.
Value reach_moved_m(const ExtentSummary& summary, std::optional<double> (*by)(const Sensitivity&), ReadingPlace place = ReadingPlace::none);

/// Readings of the whole drive from `extent_summaries`, with the grid's error in each lane from `extents`.
Readings extent_readings(const PlayedCell& played);

/// How long each pass took: median, 95th percentile and spread. Kept apart from summarise because no two runs agree on them.
Readings times(const PlayedCell& played);

} // namespace fernlicht
