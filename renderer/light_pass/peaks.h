// What this machine's cores could do at best, with the packs and the number of threads of the light pass.
#pragma once

#include "scenarios/packs/level.h"

namespace fernlicht {

/// Of each thread while all run, a second of its CPU time; the best of five times.
struct Peaks {
    packs::Level level = packs::Level::plain;
    int threads = 0;
    double bytes_per_s = 0.0;      ///< read and written one behind another, of more than the last cache holds
    double look_ups_per_s = 0.0;   ///< of two neighbours, one place behind another
    double operations_per_s = 0.0; ///< multiplications and additions, of independent numbers
    double divisions_per_s = 0.0;
};

/// In less than a second. `table_texels`: of the table that is looked up, as of a beam.
Peaks measure_peaks(packs::Level level, long long table_texels);

} // namespace fernlicht
