// Shadows as drawn against rays, in the scenes that are hard on them.
#include "runner/experiments/shadows/stress_scenes.h"
#include "runner/play/shadows/shadow_truth.h"
#include "tests/runner/program.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

const std::vector<ShadowScene>& scenes() {
    static const std::vector<ShadowScene> all =
        stress_scenes(std::make_shared<const LampFile>(read_lamp(library_file("lamps/xenon-low.ies"))));
    return all;
}

TEST(ShadowTruth, DiscsHaveHalfShadowsThatPointsLack) {
    Device device = open_device("auto");
    const ShadowScene& scene = scenes().front();
    const Reference rays(*scene.scene);
    Renderer unshadowed(device, *scene.scene, without_shadows(scene.light));
    const View view = at_size(scene.view, 160, 120);
    ShadowTruth points(rays, unshadowed, scene.moments, view), discs(rays, unshadowed, scene.moments, view, 0.05);
    const auto halves = [&](ShadowTruth& truth) {
        const ShadowImages images = truth.images(unshadowed, 0);
        int count = 0;
        for (int y = 0; y < 120; ++y)
            for (int x = 0; x < 160; ++x)
                if (const auto degrees = shadow_degrees(images, x, y))
                    count += degrees->truth > 0.05 && degrees->truth < 0.2 ? 1 : 0; // no lamp alone gives so little
        return count;
    };
    EXPECT_GT(halves(discs), halves(points) + 5);
}

TEST(StressScenes, MovingAheadTakesTheLampsAlong) {
    Moment moment = scenes().front().moments.front();
    moment.ego.axes = axes_from_angles(radians(90.0), 0.0, 0.0);
    const Moment moved = moved_ahead(moment, 2.0);
    EXPECT_NEAR(moved.ego.position_m.y, 2.0, 1e-12);
    EXPECT_NEAR(moved.lamps[0].pose.position_m.y, moment.lamps[0].pose.position_m.y + 2.0, 1e-12);
    moment.lamps[0].intensity_factor = 0.0;
    const Moment alone = first_lamp_alone(moment);
    EXPECT_EQ(alone.lamps[0].intensity_factor, 0.0);
    EXPECT_EQ(alone.lamps[1].intensity_factor, 1.0);
    moment.lamps[0].intensity_factor = 0.5;
    EXPECT_EQ(first_lamp_alone(moment).lamps[0].intensity_factor, 0.5);
    EXPECT_LT(first_lamp_alone(moment).lamps[1].intensity_factor, 1e-5);
    EXPECT_GT(first_lamp_alone(moment).lamps[1].intensity_factor, 0.0); // it still shines
}

} // namespace
} // namespace fernlicht
