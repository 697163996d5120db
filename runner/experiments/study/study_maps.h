// Lux from above in a study: which stored moment of each cell is shown, and where its lanes and the car lie.
#pragma once

#include "runner/experiments/study/study_result.h"

namespace fernlicht {

/// Lux of the middle one of the stored frames from above, with the cell's `map_edges`, read below `folder`. nullopt where there is no such
/// frame, or no lux in it.
std::optional<LuxMap> map_of(const CellResult& cell, const std::filesystem::path& folder);

/// Lanes and car on the shown maps of cells that are played over the same road from the same drive; `drive` is one of theirs.
void add_map_edges(const Drive& drive, std::vector<CellResult*> cells);

} // namespace fernlicht
