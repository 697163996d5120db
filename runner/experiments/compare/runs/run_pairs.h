// Which drive of one run belongs to which of another, and how they differ.
#pragma once

#include "runner/experiments/compare/runs/run_comparison.h"

namespace fernlicht {

/// Fills `drives` (with their settings) and `left_out`.
void pair_drives(RunComparison& runs);

/// Why readings of one name are not the same measurement; "" where they are.
struct MeasureChange {
    std::string extent; ///< of the extents, but for their limits and distances, which the names have
    std::string others;
};
MeasureChange measure_change(const YamlValue& before, const YamlValue& now);

/// Compares the lamps' files as they lie on disk, where they still are what the runs read; says where they are not.
void compare_lamp_files(DriveComparison& drive);

PicturePair frame_pictures(const FramePair& frame, const RunComparison& runs);
/// Pixels per degree; 0 for maps.
double frame_density(const FramePair& frame, const RunCompareOptions& options);

} // namespace fernlicht
