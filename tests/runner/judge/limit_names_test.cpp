// A limit on a reading that cannot exist is found before a drive is played, not after.
#include "runner/judge/limits.h"

#include "scenarios/values/errors.h"

#include <gtest/gtest.h>

namespace fernlicht {
namespace {

Drive limited_by(const std::string& reading) {
    Drive drive;
    drive.file = "night.yaml";
    drive.probes = {{"kerb-30m", 30.0, 0.0, 0.0}};
    drive.limits = {{reading, 1.0, std::nullopt}};
    return drive;
}

TEST(LimitNames, WhatARunCanMeasureIsKnown) {
    for (const char* name : {"reach_5lx_road_own_m", "reach_0.5lx_target_left_1_min_m", "width_3lx_road_all_at_50m_m",
                             "area_1lx_target_own_m2", "unlit_before_reach_1lx_road_own_m", "reach_1lx_target_own_per_tenth_degree_m",
                             "probe_kerb-30m_lx", "probe_kerb-30m_twin_lx", "frame_time_median_ms"})
        EXPECT_NO_THROW(check_limit_names(limited_by(name))) << name;
}

TEST(LimitNames, WhatNoRunCanMeasureIsRefused) {
    for (const char* name : {"reach_1lx_rod_own_m", "reach_road_own_m", "width", "probe_kerb_lx", "probe_kerb-30m", "frame_time_ms", ""})
        EXPECT_THROW(check_limit_names(limited_by(name)), InputError) << name;
}

} // namespace
} // namespace fernlicht
