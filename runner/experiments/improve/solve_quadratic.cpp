#include "runner/experiments/improve/solve_quadratic.h"

#include "scenarios/values/program_module.h"

#include <cstdlib>

namespace fernlicht {
namespace {

/// What the module fernlicht-ipopt does.
extern "C" using SolveByIpopt = void(const QuadraticProgramme& programme, QuadraticSolution& solution);

} // namespace

QuadraticSolution solved_by_ipopt(const QuadraticProgramme& programme) {
    static const auto solve = [] {
        // Debian 13 builds Ipopt with Open MPI, which starts as it is loaded and ends a process that has no home. Nobody else takes part.
        ::setenv("HOME", "/", 0);
        ::setenv("OMPI_MCA_btl", "self", 0);
        return reinterpret_cast<SolveByIpopt*>(module_function("fernlicht-ipopt", "fernlicht_solve_by_ipopt"));
    }();
    QuadraticSolution solution;
    solve(programme, solution);
    return solution;
}

} // namespace fernlicht
