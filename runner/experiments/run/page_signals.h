// Section "Signals" of report.html: what a bus said over the drive, beside reach and glare over the same time.
#pragma once

#include "runner/experiments/run/page_parts.h"

namespace fernlicht {

/// Figures over time: each signal from the bus with bands where it was not fresh, then reach in the own lane and light in oncoming eyes,
/// where they were measured. None without signals from a bus.
std::vector<std::string> signal_svgs(const ComparedDrive& drive);

/// One row for each signal. All lamp sets of a drive hear the same bus.
kainjow::mustache::data signal_table(const ComparedDrive& drive);

/// "5 of 12034 frames of s-bend.log were read ..."; "" without a bus.
std::string signal_sentence(const ComparedDrive& drive);

} // namespace fernlicht
