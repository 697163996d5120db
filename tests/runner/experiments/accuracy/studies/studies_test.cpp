// Diagrams of what is no way to light a scene: global methods in a room whose light bounces, solvers, shadows in the light of others.
#include "runner/experiments/accuracy/studies/studies.h"
#include "tests/renderer/reference/rooms.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

TEST(ClassicalStudy, PutsEachMethodWhereItsBiasAndNoiseBelong) {
    const Scene scene = closed_room(lambert(0.5));
    Moment moment;
    moment.lamps = {even_lamp(100.0, looking({-0.6, 0.1, 0.3}, 0, -10))};
    ClassicalStudy study;
    study.truth_samples = 4096;
    study.samples = {128, 1024};
    study.patches_m = {1.0, 0.1};
    study.photons = {1 << 12, 1 << 16};
    study.solver.radius_m = 0.1;
    const WorkPrecision diagram = classical_study(scene, moment, camera({-0.8, 0, 0}, 0, 0, 60, 8), study, [] { return true; });
    ASSERT_EQ(diagram.rows.size(), 3U * 2U + 2U * 2U * 2U);
    const auto error = [&](const std::string& label) {
        const auto row = std::ranges::find(diagram.rows, label, &WorkPrecisionRow::label);
        EXPECT_TRUE(row != diagram.rows.end() && row->measured() && row->seconds->value > 0.0) << label;
        return row == diagram.rows.end() ? -1.0 : row->error->value;
    };
    // Half of what falls on walls goes on: without bounces a third of the light and more is missing, whatever the samples.
    EXPECT_GT(error("direct, 1024 samples"), 25.0);
    EXPECT_EQ(error("whitted, 1024 samples"), error("direct, 1024 samples"));
    EXPECT_LT(error("path, 1024 samples"), error("path, 128 samples"));
    EXPECT_LT(error("path, 1024 samples"), 3.0);
    EXPECT_LT(error("radiosity, 0.1 m patches"), error("radiosity, 1 m patches"));
    EXPECT_LT(error("radiosity with final gathering, 0.1 m patches"), 5.0);
    EXPECT_LT(error("photon-map, 65536 photons"), error("photon-map, 4096 photons"));
    EXPECT_LT(error("photon-map with final gathering, 65536 photons"), 5.0);
    EXPECT_GT(diagram.rows.front().floor, 0.0);
    const WorkPrecision stopped = classical_study(scene, moment, camera({-0.8, 0, 0}, 0, 0, 60, 8), study, [] { return false; });
    EXPECT_TRUE(stopped.rows.empty());
}

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

TEST(TrafficShadowStudy, MapsBringStreetLampsShadowsNearerToTheRays) {
    Drive drive = read_drive(FERNLICHT_SOURCE_DIR "/scenarios/library/drives/village-lit.yaml");
    for (View& view : drive.views) { // times are of no matter here
        view.width_px = 160;
        view.height_px = 120;
    }
    const Stage stage(drive);
    Device device = open_device("auto");
    const WorkPrecision diagram = traffic_shadow_study(stage, stage.drive.lamp_sets.front(), device, [] { return true; });
    ASSERT_EQ(diagram.rows.size(), 4U);
    for (const WorkPrecisionRow& row : diagram.rows)
        ASSERT_TRUE(row.measured()) << row.label;
    EXPECT_EQ(diagram.rows[0].label, "none");
    EXPECT_GT(diagram.rows[0].error->value, 0.5) << "of the light some per cent lie in shadow";
    EXPECT_LT(diagram.rows[2].error->value, 0.6 * diagram.rows[0].error->value);
    EXPECT_LT(diagram.rows[3].error->value, diagram.rows[1].error->value);
}

TEST(TrafficShadowStudy, HasNoRowsWithoutShadows) {
    Drive drive = read_drive(FERNLICHT_SOURCE_DIR "/scenarios/library/drives/village-lit.yaml");
    drive.shadows.method = ShadowMethod::none;
    const Stage stage(drive);
    Device device = open_device("auto");
    EXPECT_TRUE(traffic_shadow_study(stage, stage.drive.lamp_sets.front(), device, [] { return true; }).rows.empty());
}

} // namespace

} // namespace fernlicht
