// What making a drive's scene says of the drive.
#include "scenarios/drives/play/staged_scene.h"
#include "scenarios/roads/road_network.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

TEST(StagedScene, SaysWhichSceneryStandsBeyondTheRoute) {
    Drive drive = read_drive(FERNLICHT_SOURCE_DIR "/scenarios/library/drives/shelter.yaml");
    const RoadNetwork network = read_opendrive(drive.road_file);
    const Route route(network, drive.start, drive.via);
    ASSERT_FALSE(drive.scenery.empty());
    ASSERT_TRUE(drive.scenery.front().along_route);
    const auto told = [&] {
        Drive copy = drive;
        staged_scene(copy, network, route);
        return copy.notes;
    };
    EXPECT_THAT(told(), testing::Not(testing::Contains(testing::HasSubstr("along the route"))));
    drive.scenery.front().position_m.x = route.length_m() + 1.0;
    EXPECT_THAT(told(), testing::Contains(testing::HasSubstr("m along the route, which ends at")));
}

} // namespace
} // namespace fernlicht
