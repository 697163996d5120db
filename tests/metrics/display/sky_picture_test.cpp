#include "metrics/display/sky_picture.h"

#include "scenarios/drives/play/camera.h"
#include "scenarios/values/pose.h"

#include <gtest/gtest.h>

namespace fernlicht {
namespace {

/// A lamp above the horizon stands in a pixel where nothing else is seen (ids 0): its light is added to the sky's, which takes the even
/// sky's place.
TEST(SkyPicture, LampsBeforeTheSkyKeepTheirLight) {
    const double even_cdm2 = 0.01;
    const NightSky sky;
    View view;
    view.width_px = view.height_px = 8;
    Moment moment;
    moment.daylight.horizontal_illuminance_lx = even_cdm2 * pi;
    const glm::vec3 even(static_cast<float>(even_cdm2)), lamp(30.0F, 20.0F, 10.0F), wall(1.0F, 2.0F, 3.0F);
    Frame frame;
    frame.light = Image<glm::vec3>(8, 8, even);
    frame.ids = Image<std::uint32_t>(8, 8, 0U);
    frame.light.at(4, 1) = even + lamp;
    frame.ids.at(2, 1) = 7;
    frame.light.at(2, 1) = wall;
    const Image<glm::vec3> lit = with_night_sky(frame, moment, view, sky);
    const Camera camera = camera_of(moment, view);
    const auto sky_at = [&](int x, int y) { return night_sky_cdm2(sky, {}, pixel_ray(camera, view, x + 0.5, y + 0.5).direction); };
    ASSERT_GT(sky_at(4, 1), 0.0);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(static_cast<double>(lit.at(4, 1)[i]), static_cast<double>(lamp[i]) + sky_at(4, 1), 1.0e-5) << i;
        EXPECT_NEAR(static_cast<double>(lit.at(6, 1)[i]), sky_at(6, 1), 1.0e-7) << i;
        EXPECT_EQ(lit.at(2, 1)[i], wall[i]) << i;
    }
}

} // namespace
} // namespace fernlicht
