#include "runner/experiments/improve/solve_quadratic.h"

#include "runner/files/program_module.h"

namespace fernlicht {
namespace {

/// What the module fernlicht-ipopt does.
extern "C" using SolveByIpopt = void(const QuadraticProgramme& programme, QuadraticSolution& solution);

} // namespace

QuadraticSolution solved_by_ipopt(const QuadraticProgramme& programme) {
    static const auto solve = reinterpret_cast<SolveByIpopt*>(module_function("fernlicht-ipopt", "fernlicht_solve_by_ipopt"));
    QuadraticSolution solution;
    solve(programme, solution);
    return solution;
}

} // namespace fernlicht
