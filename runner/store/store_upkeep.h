// Repair and pruning of a store of cells.
#pragma once

#include "runner/store/cell_store.h"

namespace fernlicht {

struct StoreDamage {
    std::string what, why; ///< "cell straight_xenon of standard-1"; "its object is missing"
};
/// Reads everything. What is damaged is taken out, so that it is computed anew; a store in which nothing is need not be writable. Throws
/// DeviceError where the disk refuses.
std::vector<StoreDamage> verify_store(const CellStore& store);

struct Pruning {
    std::optional<double> older_than_s = {};         ///< since they were used
    std::optional<std::uint64_t> at_most_bytes = {}; ///< of what stays, input files too; the least recently used go first
    std::string study = {};                          ///< a pattern (glob.h); "": of all studies
    bool dry = false;                                ///< only tell
};
struct Pruned {
    std::size_t cells = 0, cells_left = 0, files = 0; ///< files: objects, and what killed processes left
    std::uint64_t bytes = 0, bytes_left = 0;
};
/// Takes out cells, then what no cell needs, what killed processes left an hour ago or earlier, and why cells failed 30 days ago. `now_s`:
/// seconds since 1970; a cell from the future has no age. Waits for writers. Throws DeviceError.
Pruned prune_store(const CellStore& store, const Pruning& pruning, double now_s);

} // namespace fernlicht
