// Error over run time as a plot.
#pragma once

#include "metrics/statistics/work_precision.h"

#include <string>

namespace fernlicht {

/// Both logarithmic: rows with their bars, the front as a line, the floor shaded, dominated rows hollow. The same diagram gives the same
/// bytes.
std::string work_precision_svg(const WorkPrecision& diagram);

} // namespace fernlicht
