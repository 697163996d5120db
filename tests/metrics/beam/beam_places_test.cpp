// What two lamps give at a place, and how sure that is, worked out by hand.
#include "metrics/beam/lamp_difference.h"
#include "tests/lamps.h"

#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

CandelaTable every_degree(const std::function<double(double, double)>& cd) {
    return tests::table_of(tests::steps(-20.0, 20.0, 1.0), tests::steps(-10.0, 10.0, 1.0), cd, BetweenSamples::linear_cd);
}

std::vector<Direction> box(double left, double right, double bottom, double top) {
    return {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
}

/// The first place of two lamps, noise of 1 % said.
PlaceChange found_at(const std::vector<Direction>& corners, const CandelaTable& now, const CandelaTable& before) {
    return compare_lamps(now, before, {.noise_relative = 0.01, .places = {{"here", "a test", corners, "ours"}}}).places.at(0);
}

// 3000 cd and 100 cd a degree to the right more: 3350 cd over 2 to 5 degrees right.
TEST(BeamPlaces, MeanOverARegionByHand) {
    const CandelaTable old_lamp = every_degree([](double h, double) { return 3000.0 + 100.0 * h; }),
                       new_lamp = every_degree([](double h, double v) { return (3000.0 + 100.0 * h) * (1.05 + 0.01 * v); });
    const PlaceChange found = found_at(box(2.0, 5.0, -3.0, 1.0), new_lamp, old_lamp);
    EXPECT_NEAR(*found.old_cd, 3350.0, 1e-6);
    EXPECT_NEAR(*found.new_cd, 3350.0 * 1.04, 1e-6) << "at the middle, 1 degree down";
    EXPECT_NEAR(*found.change(), 0.04, 1e-9);
    // A triangle: the mean of a plane over it is its value at the centroid, 1/3 of the way.
    EXPECT_NEAR(*found_at({{0.0, 0.0}, {6.0, 0.0}, {0.0, 3.0}}, new_lamp, old_lamp).old_cd, 3200.0, 15.0);
}

// At a sample each lamp's noise counts once. Over 2 x 2 cells of Catmull-Rom's cubic, whose integral over a cell is (-1, 13, 13, -1) / 24,
// five samples a side count (-1, 12, 26, 12, -1) / 48, and their squares sum to 966 / 2304.
TEST(BeamPlaces, NoiseAveragesOverARegionByHand) {
    // Columns that are alike to the last digit would count as one that a symmetric file stores once.
    const CandelaTable lamp = every_degree([](double h, double) { return 1234.5 + 0.1 * h; });
    const double at_sample = 0.01 * std::sqrt(2.0);
    EXPECT_NEAR(*found_at({{3.0, -1.0}}, lamp, lamp).uncertainty, at_sample, 1e-5);
    EXPECT_NEAR(*found_at(box(2.0, 4.0, -2.0, 0.0), lamp, lamp).uncertainty, at_sample * 966.0 / 2304.0, 1e-5);
    // In the middle of a cell: (-1, 9, 9, -1) / 16 a side, squares 164 / 256.
    EXPECT_NEAR(*found_at({{3.5, -1.5}}, lamp, lamp).uncertainty, at_sample * 164.0 / 256.0, 1e-5);
}

// Whoever measured on other angles leaves open how light runs between them.
TEST(BeamPlaces, OtherAnglesLeaveInterpolationOpen) {
    const auto bell = [](double h, double v) { return 9876.5 * std::exp(-(h * h + v * v) / 18.0) + 100.0; };
    const CandelaTable lamp = every_degree(bell), offset = tests::table_of(tests::steps(-20.5, 20.5, 1.0), tests::steps(-10.5, 10.5, 1.0),
                                                                           bell, BetweenSamples::linear_cd);
    const PlaceChange same = found_at({{0.0, 0.0}}, lamp, lamp), other = found_at({{0.0, 0.0}}, lamp, offset);
    EXPECT_GT(*other.uncertainty, *same.uncertainty);
    EXPECT_GT(*other.uncertainty, std::abs(*other.change())) << "one lamp";
    EXPECT_FALSE(other.is_beyond_noise);
}

TEST(BeamPlaces, WhatCannotBeComparedSaysWhy) {
    const CandelaTable lamp = every_degree([](double h, double) { return h < 10.0 ? 1234.5 : 0.0; });
    const PlaceChange outside = found_at(box(15.0, 40.0, -3.0, 1.0), lamp, lamp);
    EXPECT_EQ(outside.not_measured, "outside a table");
    EXPECT_FALSE(outside.old_cd || outside.new_cd || outside.change() || outside.uncertainty || outside.is_beyond_noise);
    const PlaceChange dark = found_at(box(12.0, 18.0, -3.0, 1.0), lamp, lamp);
    EXPECT_EQ(dark.not_measured, "too faint to compare");
    const CandelaTable lit = every_degree([](double, double) { return 1234.5; });
    const PlaceChange new_light = found_at(box(12.0, 18.0, -3.0, 1.0), lit, lamp);
    EXPECT_EQ(new_light.not_measured, "dark in the old lamp");
    EXPECT_TRUE(new_light.is_beyond_noise);
    EXPECT_FALSE(new_light.change());
}

} // namespace
} // namespace fernlicht
