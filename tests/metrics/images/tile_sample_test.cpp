// Errors of some tiles for those of whole pictures: the order that they are drawn in, and whether the interval holds what it says.
#include "metrics/images/tile_sample.h"

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

// By hand: two rows, three tiles of each drawn from five hundred; 400 pixels' errors, each tile's own, of which 20 are beyond the 95 %.
TEST(SampledTiles, IntervalIsWoodruffsByHand) {
    PixelErrorFold fold;
    const std::vector<std::pair<int, int>> tiles{{50, 3}, {70, 3}, {80, 5}, {60, 3}, {70, 3}, {70, 3}}; // pixels, and those beyond
    int small = 0, large = 0;
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        fold.begin_tile(static_cast<int>(t / 3));
        for (int i = 0; i < tiles[t].first; ++i)
            fold.add({1.0 + 1e-4 * (i < tiles[t].second ? 381 + large++ : 1 + small++), 1.0, 0.0, {}, 0, 0, 0});
    }
    ASSERT_EQ(small, 380);
    const auto squares = [&](std::size_t first) { // of k - 0.05 n
        double sum = 0.0, of_squares = 0.0;
        for (std::size_t t = first; t < first + 3; ++t) {
            const double z = tiles[t].second - 0.05 * tiles[t].first;
            sum += z, of_squares += z * z;
        }
        return (of_squares - sum * sum / 3.0) / 2.0;
    };
    const double two = 2.0 * std::sqrt((1.0 - 3.0 / 500.0) * 3.0 * (squares(0) + squares(3))) / 400.0;
    ASSERT_LT(two, 0.05);
    const PixelErrors errors = fold.finish(500).value();
    ASSERT_TRUE(errors.p95_between);
    for (const auto& [end, rank] : {std::pair(errors.p95_between->low, 0.95 - two), std::pair(errors.p95_between->high, 0.95 + two)})
        EXPECT_NEAR(end, 1e-4 * (1.0 + 399.0 * rank), 1e-8);
    EXPECT_FALSE(fold.finish(3)->p95_between); // none is missing
    EXPECT_FALSE(fold.finish()->p95_between);
}

/// A picture whose errors come in clumps: none in most of its tiles.
struct Clumps {
    static constexpr int across = 60, down = 8, pixels = 16;
    std::vector<std::vector<double>> tiles;
    double p95 = 0.0;

    Clumps() {
        std::mt19937_64 generator(3);
        PixelErrorFold all;
        for (int t = 0; t < across * down; ++t) {
            const double clump = static_cast<double>(generator() % 1000) / 1000.0;
            std::vector<double>& tile = tiles.emplace_back();
            for (int i = 0; i < pixels; ++i) {
                tile.push_back(0.1 * clump * clump * clump * static_cast<double>(1 + generator() % 1000) / 1000.0);
                all.add({1.0 + tile.back(), 1.0, 0.0, {}, 0, 0, 0});
            }
        }
        p95 = all.finish()->error.p95;
    }
    PixelErrors of(const std::vector<SampledTile>& order, int rounds) const {
        PixelErrorFold some;
        for (std::size_t t = 0; t < static_cast<std::size_t>(rounds * down); ++t) {
            some.begin_tile(order[t].row);
            for (const double error : tiles[static_cast<std::size_t>(order[t].row * across + order[t].column)])
                some.add({1.0 + error, 1.0, 0.0, {}, 0, 0, 0});
        }
        return some.finish(across).value();
    }
};

// 300 samples: nominally 95 % of their intervals hold the picture's own 95 %, after so many rounds as after those that the precision took.
TEST(SampledTiles, IntervalHoldsThePicturesQuantile) {
    const Clumps picture;
    constexpr double precision = 0.15;
    int held = 0, held_when_done = 0, some_left_out = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const std::vector<SampledTile> order = sampling_order(1, Clumps::across, Clumps::down, seed);
        const auto holds = [&](const PixelErrors& errors) {
            return errors.p95_between && errors.p95_between->low <= picture.p95 && picture.p95 <= errors.p95_between->high ? 1 : 0;
        };
        held += holds(picture.of(order, 12));
        int rounds = 5;
        PixelErrors errors = picture.of(order, rounds);
        for (int wanted = 0; (wanted = rounds_wanted(errors, precision, rounds, Clumps::across)) > rounds;)
            errors = picture.of(order, rounds = wanted);
        ASSERT_TRUE(errors.p95_between);
        EXPECT_LE(errors.p95_between->high - errors.p95_between->low, 2.0 * precision * errors.error.p95);
        held_when_done += holds(errors);
        some_left_out += rounds < Clumps::across ? 1 : 0;
    }
    EXPECT_GE(held, 276); // 92 %
    EXPECT_GE(held_when_done, 276);
    EXPECT_EQ(some_left_out, 300);
}

} // namespace
} // namespace fernlicht
