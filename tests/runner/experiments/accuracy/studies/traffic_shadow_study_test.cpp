// Shadows in the light of others, error against run time: maps bring the picture nearer to the rays, and finer ones nearer still.
#include "runner/experiments/accuracy/studies/traffic_shadow_study.h"

#include <gtest/gtest.h>

namespace fernlicht {
namespace {

TEST(TrafficShadowStudy, MapsBringStreetLampsShadowsNearerToTheRays) {
    Drive drive = read_drive(FERNLICHT_SOURCE_DIR "/scenarios/library/drives/village-lit.yaml");
    for (View& view : drive.views) { // times are of no matter here
        view.width_px = 160;
        view.height_px = 120;
    }
    const Stage stage(drive);
    Device device = open_device("auto");
    const WorkPrecision diagram = traffic_shadow_study(stage, stage.drive.variants.front(), device, [] { return true; });
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
    EXPECT_TRUE(traffic_shadow_study(stage, stage.drive.variants.front(), device, [] { return true; }).rows.empty());
}

} // namespace
} // namespace fernlicht
