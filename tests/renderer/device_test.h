// What tests that draw share: the device, all pictures at once, and two that must be the same to the byte.
#pragma once

#include "renderer/renderer.h"
#include "tests/renderer/views.h"

#include <string>

namespace fernlicht {

inline constexpr FrameOutputs all_results{
    .colour = true, .illuminance = true, .target = true, .luminance = true, .depth = true, .ids = true};

class DeviceTest : public testing::Test {
  protected:
    Device device_ = open_device("auto");
    double place_px_ = device_.info().software ? 0.0 : sanity_place_px; ///< for the twin's bounds
};

inline void expect_same_frames(const Frame& a, const Frame& b, const std::string& what) {
    EXPECT_EQ(a.colour, b.colour) << what;
    EXPECT_EQ(a.illuminance_lx, b.illuminance_lx) << what;
    EXPECT_EQ(a.target_lx, b.target_lx) << what;
    EXPECT_EQ(a.luminance_cdm2, b.luminance_cdm2) << what;
    EXPECT_EQ(a.depth_m, b.depth_m) << what;
    EXPECT_EQ(a.ids, b.ids) << what;
}

} // namespace fernlicht
