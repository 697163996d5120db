// The studies' figures, which reports show: errors fall as theory says. The extremes are held to their bounds as cases of `fernlicht
// stability`.
#include "scenarios/vehicle/solver_study.h"
#include "scenarios/vehicle/stability_study.h"

#include <cmath>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

std::vector<SolverRow> rows_of(const std::vector<SolverRow>& all, const std::string& problem, Solver solver, bool by_steps) {
    std::vector<SolverRow> rows;
    for (const SolverRow& row : all)
        if (row.problem == problem && row.solver == solver && (row.step_s > 0.0) == by_steps)
            rows.push_back(row);
    return rows;
}

TEST(SolverStudy, ErrorsFallWithTheWorkAsTheorySays) {
    SolverStudy quick;
    quick.repetitions = 1;
    quick.tolerances = {1e-4, 1e-6, 1e-8};
    const std::vector<SolverRow> all = study_solvers(quick);
    for (const SolverRow& row : all) {
        EXPECT_EQ(row.not_measured, "") << row.problem;
        EXPECT_GT(row.seconds, 0.0);
        EXPECT_GT(row.steps, 0U);
        EXPECT_LT(row.floor, 1e-10) << row.problem << ": two methods that share nothing agree";
        const double allowed = row.tolerance > 0.0 ? 5.0 * row.tolerance : 1.0; // the worst: an explicit method at its limit of stability
        EXPECT_LT(row.error, allowed + 2.0 * row.floor) << row.problem << ' ' << name(row.solver) << ' ' << row.tolerance;
    }
    // Order from the second and the last of the steps; local errors between steps, of order 5 and 4, show beside the methods' own.
    for (const auto& [solver, order] : {std::pair(Solver::dormand_prince, 5.0), std::pair(Solver::rosenbrock, 4.0)}) {
        const auto rows = rows_of(all, "actuator of 5 Hz", solver, true);
        ASSERT_EQ(rows.size(), 5U);
        EXPECT_NEAR(std::log(rows[1].error / rows[4].error) / std::log(rows[1].step_s / rows[4].step_s), order, 0.4) << name(solver);
    }
    const auto forced = rows_of(all, "actuator of 50 kHz", Solver::dormand_prince, false);
    const auto chosen = rows_of(all, "actuator of 50 kHz", Solver::automatic, false);
    EXPECT_GT(forced[1].steps, 50U * chosen[1].steps) << "the choice saves the steps that stability would ask for";
    EXPECT_EQ(rows_of(all, "actuator of 5 Hz", Solver::automatic, false)[1].jacobians, 0U) << "and costs nothing where nothing is stiff";
}

TEST(StabilityStudy, TheoryIsThatOfTheBooks) {
    EXPECT_NEAR(dormand_prince_limit(0.0), 3.3066, 1e-4); // Hairer & Wanner II, IV.2: 3.3
}

} // namespace
} // namespace fernlicht
