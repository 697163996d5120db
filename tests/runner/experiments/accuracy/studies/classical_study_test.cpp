// The diagram of global methods, on a room whose light bounces.
#include "runner/experiments/accuracy/studies/classical_study.h"
#include "tests/renderer/reference/rooms.h"

#include <algorithm>
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

} // namespace
} // namespace fernlicht
