// Two pictures that must be the same to the byte.
#pragma once

#include "renderer/renderer.h"

#include <gtest/gtest.h>
#include <string>

namespace fernlicht {

inline void expect_same_frames(const Frame& a, const Frame& b, const std::string& what) {
    EXPECT_EQ(a.colour, b.colour) << what;
    EXPECT_EQ(a.illuminance_lx, b.illuminance_lx) << what;
    EXPECT_EQ(a.target_lx, b.target_lx) << what;
    EXPECT_EQ(a.luminance_cdm2, b.luminance_cdm2) << what;
    EXPECT_EQ(a.depth_m, b.depth_m) << what;
    EXPECT_EQ(a.ids, b.ids) << what;
}

} // namespace fernlicht
