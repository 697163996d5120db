// A drive played by many cars of one series: how tolerances spread its readings.
#pragma once

#include "metrics/tolerances/cars_readings.h"
#include "runner/play/play.h"

namespace fernlicht {

/// By the twin; where the tolerances ask for it, reach and width of the cars in full by `draw`. Medians of 10 moments, evenly
/// spaced; glare and what else is followed of all. No smallest or largest values of reach, width and visibility: they want all moments.
/// `played`: readings of the car as designed. `go_on`: told how many cars of how many are done, by the calling thread; false stops, and
/// nothing is found. The same bytes for any number of threads.
SeriesFindings play_series(const Drive& drive, const Route& route, const LampSet& lamp_set, const TickRange& ticks, const Readings& played,
                           const Draw& draw, const std::function<bool(std::size_t done, std::size_t all)>& go_on);

} // namespace fernlicht
