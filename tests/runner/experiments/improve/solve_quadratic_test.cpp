// Quadratic programmes worked out by hand, and the smallest change of a beam where it is known in closed form.
#include "metrics/improve/improve_beam.h"
#include "runner/experiments/improve/solve_quadratic.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/roads/road_network.h"
#include "tests/runner/program.h"

#include <cmath>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

TEST(SolveQuadratic, FindsTheNearestPointOfALine) {
    // Nearest to the origin on x + 2 y >= 5: (1, 2); the price of the bound is its multiplier, d 5/2 / d bound = 1.
    const QuadraticProgramme programme{
        {{0, 0, 1.0}, {1, 1, 1.0}}, {0.0, 0.0}, {-10.0, -10.0}, {10.0, 10.0}, {{{{0, 1.0}, {1, 2.0}}, 5.0, unbounded}}};
    const QuadraticSolution solution = solved_by_ipopt(programme);
    ASSERT_TRUE(solution.solved);
    EXPECT_NEAR(solution.x[0], 1.0, 1e-6);
    EXPECT_NEAR(solution.x[1], 2.0, 1e-6);
    EXPECT_NEAR(solution.prices[0], 1.0, 1e-6);
    EXPECT_THAT(solution.by, testing::StartsWith("Ipopt 3."));
}

TEST(SolveQuadratic, KeepsToBoundsAndRows) {
    // (x - 3)^2 + (y - 2)^2 + x y within x + y <= 3 and y >= 1.5: the gradient (2x - 6 + y, 2y - 4 + x) at (1.5, 1.5) is (-1.5, 0.5):
    // held by the row alone, prices 1.5, and by y's bound, 2.
    QuadraticProgramme programme{{{0, 0, 2.0}, {1, 1, 2.0}, {1, 0, 1.0}},
                                 {-6.0, -4.0},
                                 {-unbounded, 1.5},
                                 {unbounded, unbounded},
                                 {{{{0, 1.0}, {1, 1.0}}, -unbounded, 3.0}, {{{0, 1.0}}, 0.0, 9.0}}};
    const QuadraticSolution solution = solved_by_ipopt(programme);
    ASSERT_TRUE(solution.solved);
    EXPECT_NEAR(solution.x[0], 1.5, 1e-6);
    EXPECT_NEAR(solution.x[1], 1.5, 1e-6);
    EXPECT_NEAR(solution.prices[0], 1.5, 1e-5);
    EXPECT_NEAR(solution.prices[1], 0.0, 1e-6);
    programme.rows[1] = {{{0, 1.0}}, 2.0, 9.0}; // and no x that is 2 or more
    EXPECT_FALSE(solved_by_ipopt(programme).solved);
}

/// The last metres before the sensors of a drive with halogen lamps.
struct Approaching {
    Drive drive = read_drive(library_file("drives/iihs-straight.yaml"));
    RoadNetwork network = read_opendrive(drive.road_file);
    Route route{network, drive.start, drive.via};
    std::vector<Moment> moments;

    Approaching() {
        for (int tick = 0; tick < tick_count(drive); tick += 20)
            moments.push_back(moment_at(state_at(tick, drive), drive, route, drive.lamp_sets.front()));
    }
};

TEST(ImproveBeam, FindsTheSmallestChangeWhereItIsKnown) {
    const Approaching played;
    const ReadingOfLight light(*key_of("sensor_right-edge_at_50m_lx"), played.drive, played.route, played.moments);
    const double before = *light.value(played.moments).number();
    ImproveProblem problem;
    problem.table = played.moments.front().lamps.front().file->table;
    problem.drives = {played.moments};
    problem.floor_cd = 20.0;
    problem.readings = {{"light", &light, 0, true, before + 1.0, 1.0, true}};
    const ImprovedBeam found = improve_beam(problem, solved_by_ipopt);
    ASSERT_TRUE(found.met[0]);
    EXPECT_NEAR(*found.found[0].number(), before + 1.002, 1e-3); // between two moments it runs in its logarithm
    EXPECT_NEAR(*found.foretold[0].number(), *found.found[0].number(), 1e-3);
    EXPECT_FALSE(found.gain_missed);
    ASSERT_EQ(found.binding.size(), 1U);
    // The change x has H x along the gradient g, as the minimum under one row has: x = H^-1 g a / (g H^-1 g). Its square falls by 2 % for 1
    // %.
    EXPECT_NEAR(found.binding[0].worth, 0.02, 1e-4);
    const BeamGradient gradient = light.gradient(played.moments).gradient;
    std::vector<double> per_cd(problem.table.cd.size());
    for (const LampGradient& one : gradient)
        for (std::size_t i = 0; i < per_cd.size(); ++i)
            per_cd[i] += one.per_cd[i];
    BeamBox box{180.0, -180.0, 90.0, -90.0};
    for (std::size_t i = 0; i < per_cd.size(); ++i)
        if (per_cd[i] != 0.0)
            box.add(problem.table.h_deg[i % problem.table.h_deg.size()], problem.table.v_deg[i / problem.table.h_deg.size()]);
    const BeamBasis basis(problem.table, {box.left_deg - 2.0, box.right_deg + 2.0, box.bottom_deg - 1.0, box.top_deg + 1.0}, 0.5, 0.25,
                          20.0);
    ASSERT_EQ(basis.size(), found.variables);
    std::vector<double> x, along(basis.size()), g(basis.size());
    for (std::size_t k = 0; k < basis.size(); ++k) {
        const Direction knot = basis.knot(k);
        const double there = intensity_cd(problem.table, knot.h_deg, knot.v_deg);
        x.push_back((intensity_cd(found.table, knot.h_deg, knot.v_deg) - there) / (there + 20.0));
    }
    for (const auto& [row, column, value] : basis.size_and_bends(1.0, 0.5)) {
        along[row] += value * x[column];
        if (row != column)
            along[column] += value * x[row];
    }
    for (const auto& [variable, factor] : basis.form(per_cd))
        g[variable] = factor;
    const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i)
            sum += a[i] * b[i];
        return sum;
    };
    EXPECT_NEAR(dot(along, g) / std::sqrt(dot(along, along) * dot(g, g)), 1.0, 1e-6);
}

TEST(ImproveBeam, SaysWhatIsToBeHadWhereNotAllIs) {
    const Approaching played;
    const ReadingOfLight light(*key_of("sensor_right-edge_at_50m_lx"), played.drive, played.route, played.moments);
    const double before = *light.value(played.moments).number();
    ImproveProblem problem;
    problem.table = played.moments.front().lamps.front().file->table;
    problem.drives = {played.moments};
    problem.limits.change_share = 0.1;
    problem.readings = {{"light", &light, 0, true, 2.0 * before, before, true}};
    const ImprovedBeam found = improve_beam(problem, solved_by_ipopt);
    EXPECT_FALSE(found.met[0]);
    EXPECT_TRUE(found.gain_missed);
    EXPECT_NEAR(*found.found[0].number(), 1.1 * before,
                1e-3 * before); // a tenth more of all light, less where a tent reaches into less light
    ASSERT_FALSE(found.binding.empty());
    EXPECT_EQ(found.binding[0].of, "the most that a sample may change");
    EXPECT_NEAR(found.binding[0].worth, 0.001, 1e-5); // 1 % of it: 0.1 % of the light that was asked for
    // And where what must be kept is the very thing.
    const ReadingOfLight same(*key_of("sensor_right-edge_at_50m_lx"), played.drive, played.route, played.moments);
    problem.readings.push_back({"the same", &same, 0, false, 1.05 * before, 0.01 * before, false});
    const ImprovedBeam kept = improve_beam(problem, solved_by_ipopt);
    EXPECT_TRUE(kept.met[1]);
    EXPECT_NEAR(*kept.found[0].number(), 1.05 * before, 1e-3 * before);
    EXPECT_EQ(kept.binding[0].of, "the same");
}

} // namespace
} // namespace fernlicht
