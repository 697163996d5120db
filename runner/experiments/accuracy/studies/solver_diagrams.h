// Work-precision diagrams of the solvers that move car and lamps, one for each problem of the study.
#pragma once

#include "metrics/statistics/work_precision.h"
#include "scenarios/vehicle/solver_study.h"

namespace fernlicht {

/// Rows of a study in the form of the other diagrams; their order stays. Bars of the times: least and most of the repetitions.
std::vector<WorkPrecision> solver_diagrams(const std::vector<SolverRow>& rows);

} // namespace fernlicht
