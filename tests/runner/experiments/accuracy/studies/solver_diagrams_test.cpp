// The solvers' study as diagrams: every row in its problem's, numbers as they were measured.
#include "runner/experiments/accuracy/studies/solver_diagrams.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

TEST(SolverDiagrams, HoldEveryRowOnce) {
    SolverRow first{"car to rest", Solver::rosenbrock, 1e-6, 0.0, 2e-8, 3e-11, "rad", "a tight run", 4, 1, 30, 5, 0.02, 0.01, 0.05, 5, ""};
    SolverRow second = first;
    second.problem = "actuator of 5 Hz";
    second.solver = Solver::dormand_prince;
    second.tolerance = second.floor = 0.0;
    second.step_s = 0.016;
    SolverRow third = first;
    third.not_measured = "gave up";
    const std::vector<WorkPrecision> diagrams = solver_diagrams({first, second, third});
    ASSERT_EQ(diagrams.size(), 2U);
    EXPECT_EQ(diagrams[0].name, "solvers-car-to-rest");
    EXPECT_EQ(diagrams[0].error_unit, "rad");
    ASSERT_EQ(diagrams[0].rows.size(), 2U);
    const WorkPrecisionRow& row = diagrams[0].rows[0];
    EXPECT_EQ(row.label, "rosenbrock, 1e-06");
    EXPECT_EQ(row.error, (Interval{2e-8, 2e-8, 2e-8}));
    EXPECT_EQ(row.seconds, (Interval{0.02, 0.01, 0.05, 5}));
    EXPECT_EQ(row.floor, 3e-11);
    EXPECT_THAT(row.parameters, testing::Contains(std::pair<std::string, std::string>("evaluations", "30")));
    EXPECT_FALSE(diagrams[0].rows[1].measured());
    EXPECT_EQ(diagrams[0].rows[1].why_not, "gave up");
    EXPECT_EQ(diagrams[1].rows.at(0).label, "dormand-prince, steps of 16 ms");
    EXPECT_EQ(diagrams[1].floor_name, "");
}

} // namespace
} // namespace fernlicht
