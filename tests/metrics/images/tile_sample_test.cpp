// Errors of some tiles for those of whole pictures: the order that they are drawn in, and whether the interval holds what it says.
#include "metrics/images/tile_sample.h"

#include "metrics/images/pixel_errors.h"

#include <gtest/gtest.h>
#include <random>
#include <set>

namespace fernlicht {
namespace {

TEST(SampledTiles, EveryRoundHasOneOfEachRowAndAllAreDrawnOnce) {
    const std::vector<SampledTile> order = sampling_order(3, 5, 4, 7);
    ASSERT_EQ(order.size(), 60U);
    std::set<std::tuple<int, int, int>> drawn;
    std::set<int> first_pictures;
    for (std::size_t t = 0; t < order.size(); ++t) {
        EXPECT_EQ(order[t].row, static_cast<int>(t % 4));
        drawn.emplace(order[t].picture, order[t].column, order[t].row);
        if (t < 20)
            first_pictures.insert(order[t].picture);
    }
    EXPECT_EQ(drawn.size(), 60U);
    EXPECT_EQ(first_pictures, (std::set{0, 1, 2}));
    EXPECT_NE(sampling_order(3, 5, 4, 8).front().column * 3 + sampling_order(3, 5, 4, 8).front().picture,
              order.front().column * 3 + order.front().picture);
}

TEST(SampledTiles, RoundsFollowTheSquareOfThePrecision) {
    // Without an end to the rounds, half the width takes four times as many; a tenth is added.
    EXPECT_EQ(rounds_for(0.2, 0.1, 10, 1'000'000), 44);
    // Of 40, 1/10 - 1/40 = 0.075 to a quarter is 1/n = 0.04375, n = 22.86.
    EXPECT_EQ(rounds_for(0.2, 0.1, 10, 40), 26);
    EXPECT_EQ(rounds_for(0.2, 1e-9, 10, 40), 40);
    EXPECT_EQ(rounds_for(0.2, 0.2, 10, 40), 11);
}

// By hand: two rows, three tiles of each drawn from four; the sample's 95 % lies at the errors' 19th of 20 values. Beyond it is one pixel,
// in a tile of four of the first row: k - 0.05 n is -0.15, -0.2, 0.8 there and -0.1, -0.2, -0.15 in the second.
TEST(SampledTiles, IntervalIsWoodruffsByHand) {
    PixelErrorFold fold;
    const std::vector<std::vector<int>> tiles{{1, 2, 3}, {4, 5, 6, 7}, {8, 9, 20, 10}, {11, 12}, {13, 14, 15, 16}, {17, 18, 19}};
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        fold.begin_tile(static_cast<int>(t / 3));
        for (const int percent : tiles[t])
            fold.add({1.0 + 0.01 * percent, 1.0, 0.0, {}, 0, 0, 0});
    }
    const auto squares = [](double a, double b, double c) {
        const double mean = (a + b + c) / 3.0;
        return ((a - mean) * (a - mean) + (b - mean) * (b - mean) + (c - mean) * (c - mean)) / 2.0;
    };
    const double variance = 0.25 * 3.0 * (squares(-0.15, -0.2, 0.8) + squares(-0.1, -0.2, -0.15));
    const double two = 2.0 * std::sqrt(variance) / 20.0;
    const PixelErrors errors = fold.finish(4).value();
    ASSERT_TRUE(errors.p95_between);
    for (const auto& [end, rank] : {std::pair(errors.p95_between->low, 0.95 - two), std::pair(errors.p95_between->high, 0.95 + two)})
        EXPECT_NEAR(end, 0.01 * (1.0 + 19.0 * rank), 1e-7);
    EXPECT_FALSE(fold.finish(3)->p95_between); // none is missing
    EXPECT_FALSE(fold.finish()->p95_between);
}

// 200 samples of one picture whose errors come in clumps: 95 % of their intervals would hold its own 95 %, and hardly fewer than 90 % do.
TEST(SampledTiles, IntervalHoldsThePicturesQuantile) {
    constexpr int across = 30, down = 6, pixels = 16, rounds = 10;
    std::mt19937_64 generator(3);
    std::vector<std::vector<double>> picture(static_cast<std::size_t>(across * down));
    PixelErrorFold all;
    for (std::vector<double>& tile : picture) {
        const double clump = static_cast<double>(generator() % 1000) / 1000.0;
        for (int i = 0; i < pixels; ++i) {
            tile.push_back(0.1 * clump * clump * clump * static_cast<double>(1 + generator() % 1000) / 1000.0);
            all.add({1.0 + tile.back(), 1.0, 0.0, {}, 0, 0, 0});
        }
    }
    const double truth = all.finish()->error.p95;
    int held = 0;
    double width = 0.0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        PixelErrorFold some;
        const std::vector<SampledTile> order = sampling_order(1, across, down, seed);
        for (std::size_t t = 0; t < static_cast<std::size_t>(rounds * down); ++t) {
            some.begin_tile(order[t].row);
            for (const double error : picture[static_cast<std::size_t>(order[t].row * across + order[t].column)])
                some.add({1.0 + error, 1.0, 0.0, {}, 0, 0, 0});
        }
        const QuantileInterval between = some.finish(across)->p95_between.value();
        held += between.low <= truth && truth <= between.high ? 1 : 0;
        width += (between.high - between.low) / 200.0;
    }
    EXPECT_GE(held, 180);
    EXPECT_LT(width, 0.6 * truth); // it says something
}

} // namespace
} // namespace fernlicht
