// How this program was compiled and runs: arithmetic as IEEE 754 has it, or faster and looser.
#pragma once

#include <string>
#include <vector>

namespace fernlicht {

/// On the calling thread: each rule of IEEE 754 that does not hold, in words; empty where all do. Tried are NaN, signed zeros, infinities,
/// the order of sums, products that are not fused into sums, denormals, and where there is one, the control register (MXCSR).
std::vector<std::string> broken_float_rules();

} // namespace fernlicht
