// Quadratic programmes by Ipopt, through a module that is opened when it is needed.
#pragma once

#include "metrics/improve/quadratic_programme.h"

namespace fernlicht {

/// To about nine digits; the same bytes every time. Not `solved` where no x keeps to all bounds. Throws DeviceError where the module is
/// missing.
QuadraticSolution solved_by_ipopt(const QuadraticProgramme& programme);

} // namespace fernlicht
