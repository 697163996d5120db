// A limit on a reading that cannot exist is found before a drive is played, not after.
#include "metrics/folds/reading_names.h"
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

TEST(ReadingNames, WhatARunCanMeasureIsKnown) {
    for (const char* name : {"reach_5lx_road_own_m", "reach_0.5lx_target_left_1_min_m", "width_3lx_road_all_at_50m_m",
                             "area_1lx_target_own_m2", "unlit_before_reach_1lx_road_own_m", "reach_1lx_target_own_per_tenth_degree_m",
                             "probe_kerb-30m_lx", "probe_kerb-30m_twin_lx", "frame_time_median_ms"})
        EXPECT_NO_THROW(check_names(limited_by(name))) << name;
}

TEST(ReadingNames, WhatNoRunCanMeasureIsRefused) {
    for (const char* name : {"reach_1lx_rod_own_m", "reach_road_own_m", "width", "probe_kerb_lx", "probe_kerb-30m", "frame_time_ms", ""})
        EXPECT_THROW(check_names(limited_by(name)), InputError) << name;
}

TEST(ReadingNames, ANameThatReadingsWouldTakeForTheirOwnIsRefused) {
    Drive drive = limited_by("probe_kerb-30m_lx");
    drive.probes.push_back({"kerb-30m_max", 30.0, 1.0, 0.0});
    EXPECT_THROW(check_names(drive), InputError) << "its median would be the largest of kerb-30m";
    drive.probes.back().name = "kerb-31m";
    EXPECT_NO_THROW(check_names(drive));
    drive.seeing.glare.emplace().oncoming.push_back({.name = "own"});
    EXPECT_THROW(check_names(drive), InputError) << "the own driver's eyes";
}

} // namespace
} // namespace fernlicht
