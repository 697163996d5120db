#include "metrics/images/flip.h"

#include "metrics/images/flip_filters.h"
#include "scenarios/values/pose.h"
#include "tests/metrics/images/direct_flip.h"
#include "tests/metrics/images/made_pictures.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <numeric>
#include <tbb/global_control.h>

namespace fernlicht {
namespace {

using tests::DirectFlip;
using tests::disturbed;
using tests::made_scene;
using tests::shifted;

constexpr Rgb8 black{0, 0, 0}, white{255, 255, 255}, red{255, 0, 0}, green{0, 255, 0}, blue{0, 0, 255}, grey{119, 119, 119};

/// What floats may make of it: cube roots are good to 3e-7, so an a* of 500 times the difference of two is off by up to 2e-4, and near 0
/// such a distance is an error of 0.0576 (2e-4)^0.7 = 1.5e-4. Rounding falls to either side, so the mean is far nearer.
void expect_near(const Image<float>& map, const std::vector<double>& direct) {
    double sum = 0.0;
    for (std::size_t i = 0; i < map.size(); ++i) {
        const double difference = static_cast<double>(map.pixels()[i]) - direct[i];
        ASSERT_LT(std::abs(difference), 1.5e-4) << "pixel " << i << ", " << direct[i];
        sum += difference;
    }
    EXPECT_LT(std::abs(sum / static_cast<double>(map.size())), 5e-6);
}

TEST(Flip, TheSameIsZeroEverywhere) {
    const auto scene = made_scene(150, 40); // two tiles
    for (const auto map = flip_ldr(scene, scene); const float e : map.pixels())
        EXPECT_EQ(e, 0.0F);
}

// By hand. Black to white: HyAB is the difference of L*, 100; 100^0.7 = 25.1189. Green (L* 87.735, a* -86.183, b* 83.179) and blue
// (32.297, 79.188, -107.860), a* and b* times 0.01 L*: -75.612, 72.977 and 25.575, -34.836; HyAB 55.438 + sqrt(101.187^2 + 107.813^2) =
// 203.296; to the 0.7 41.276, 0.4 of it 16.510. 0.95 + 0.05 (25.1189 - 16.510) / (41.276 - 16.510) = 0.96738.
TEST(Flip, BlackAndWhiteByHand) {
    for (const auto map = flip_ldr({20, 20, black}, {20, 20, white}); const float e : map.pixels())
        EXPECT_NEAR(static_cast<double>(e), 0.96738, 1e-5); // the last digit of the sum by hand
}

TEST(Flip, GreenAndBlueAreTheFarthestColours) {
    EXPECT_NEAR(static_cast<double>(flip_ldr({9, 9, green}, {9, 9, blue}).at(4, 4)), 1.0, 1e-6);
    for (const Rgb8& one : {black, white, red, green, blue, grey})
        for (const Rgb8& other : {black, white, red, green, blue, grey})
            EXPECT_LE(flip_ldr({3, 3, one}, {3, 3, other}).at(1, 1), 1.0F);
}

// Even pictures stay even: the filters sum to 1 for every channel, and there are no features.
TEST(Flip, EvenColoursAreAsWithoutFilters) {
    for (const Rgb8& one : {black, white, red, green, blue, grey}) {
        const double direct = DirectFlip::of_even(DirectFlip::linear({1, 1, one})[0], DirectFlip::linear({1, 1, grey})[0]);
        for (const auto map = flip_ldr({30, 30, one}, {30, 30, grey}); const float e : map.pixels())
            EXPECT_NEAR(static_cast<double>(e), direct, 3e-6) << int{one.r} << ' ' << int{one.g} << ' ' << int{one.b};
    }
}

TEST(Flip, SeparableFiltersInFloatsAreTheDirectOnesInDoubles) {
    const struct {
        Image<Rgb8> tested, reference;
        double pixels_per_degree;
    } cases[] = {{disturbed(made_scene(70, 50), 40, 1), made_scene(70, 50), default_pixels_per_degree},
                 {shifted(made_scene(70, 50)), made_scene(70, 50), 40.0},
                 {disturbed(made_scene(48, 33), 3, 2), made_scene(48, 33), 20.0},
                 {shifted(made_scene(7, 5)), made_scene(7, 5), 67.0}}; // smaller than the filters
    for (const auto& c : cases) {
        const auto direct = DirectFlip(c.tested.width(), c.tested.height(), c.pixels_per_degree).errors(c.tested, c.reference);
        EXPECT_GT(*std::ranges::max_element(direct), 0.05);
        expect_near(flip_ldr(c.tested, c.reference, c.pixels_per_degree), direct);
    }
}

// Where tiles meet, nothing shows: the 128th column is calculated in two tiles' ways by two pictures, one starting eight columns later.
TEST(Flip, TilesLeaveNoSeams) {
    const auto reference = made_scene(200, 30), tested = shifted(reference);
    const auto cut = [](const Image<Rgb8>& picture) {
        Image<Rgb8> out(picture.width() - 8, picture.height());
        for (int y = 0; y < out.height(); ++y)
            for (int x = 0; x < out.width(); ++x)
                out.at(x, y) = picture.at(x + 8, y);
        return out;
    };
    const auto whole = flip_ldr(tested, reference), part = flip_ldr(cut(tested), cut(reference));
    for (int y = 0; y < part.height(); ++y)
        for (int x = 20; x < part.width(); ++x) // beyond the left edge's influence
            ASSERT_EQ(part.at(x, y), whole.at(x + 8, y)) << x << ", " << y;
}

TEST(Flip, IsTheSameBothWays) {
    const auto a = made_scene(60, 40), b = disturbed(a, 30, 5);
    EXPECT_EQ(flip_ldr(a, b), flip_ldr(b, a));
}

TEST(Flip, AnyNumberOfThreadsGivesTheSameBytes) {
    const auto a = made_scene(300, 200), b = disturbed(a, 30, 5);
    const auto many = flip_ldr(a, b);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(flip_ldr(a, b), many);
}

// One white pixel on black. Left and right, up and down are the same, and the farther away the less is seen of it.
TEST(Flip, ASinglePixelSpreadsEvenly) {
    Image<Rgb8> dark(41, 41, black), dotted = dark;
    dotted.at(20, 20) = white;
    const auto map = flip_ldr(dotted, dark);
    for (int d = 1; d <= 20; ++d) {
        EXPECT_EQ(map.at(20 - d, 20), map.at(20 + d, 20));
        EXPECT_NEAR(static_cast<double>(map.at(20, 20 - d)), static_cast<double>(map.at(20 - d, 20)), 1e-6);
        EXPECT_LE(map.at(20 + d, 20), map.at(20 + d - 1, 20));
    }
    EXPECT_GT(map.at(20, 20), 0.1F);
    EXPECT_EQ(map.at(0, 0), 0.0F);
}

// An edge from 0 to 1 between columns 9 and 10 has, right on it, the largest slope: at its right column the Gaussian's derivative has all
// of its positive weights and its middle (0) on the bright side, so the sum is 1, and across it nothing: the size of the edge is 1.
TEST(Flip, FilterOfEdgesSumsToOneOnEachSide) {
    const flip::Filters filters = flip::filters_for(default_pixels_per_degree);
    const auto side = [](const flip::HalfFilter& f) {
        return std::accumulate(f.weights.begin() + 1, f.weights.end(), 0.0,
                               [](double sum, float w) { return sum + static_cast<double>(w); });
    };
    EXPECT_NEAR(side(filters.edge), -1.0, 1e-6);
    EXPECT_EQ(filters.edge.weights[0], 0.0F);
    EXPECT_NEAR(static_cast<double>(filters.gaussian.weights[0]) + 2.0 * side(filters.gaussian), 1.0, 1e-6);
    // Positive and negative weights of the filter for points cancel: an even picture has none.
    EXPECT_NEAR(static_cast<double>(filters.point.weights[0]) + 2.0 * side(filters.point), 0.0, 1e-6);
    // Radii by hand: 0.5 * 0.082 * 67.0206 = 2.748 pixels, three of them 8.2; sqrt(0.04 / 2) / pi * 67.0206 = 3.017, three of them 9.05.
    EXPECT_EQ(filters.edge.radius(), 9);
    EXPECT_EQ(filters.radius, 10);
    EXPECT_EQ(filters.cz_wide_down.radius(), 10);
    EXPECT_LT(filters.y.radius(), 8); // the rest weighs less than a float can show
}

TEST(Flip, PixelsPerDegreeOfViews) {
    EXPECT_NEAR(pixels_per_degree_of_view(radians(90.0), 720), 360.0 * pi / 180.0, 1e-12); // tan 45 degrees is 1
}

TEST(Flip, WrongInputIsRefused) {
    EXPECT_THROW(flip_ldr({2, 2, black}, {2, 3, black}), std::invalid_argument);
    EXPECT_THROW(flip_ldr({}, {}), std::invalid_argument);
    EXPECT_THROW(flip_ldr({2, 2, black}, {2, 2, black}, 0.5), std::invalid_argument);
    EXPECT_THROW(flip_ldr({2, 2, black}, {2, 2, black}, std::nan("")), std::invalid_argument);
}

// Errors 0.1, 0.2, 0.3, 0.4: half of their sum, 0.5, is passed by the third (0.6), a quarter (0.25) by the second (0.3), three quarters
// (0.75) by the fourth. By nearest rank the quartiles are the first, second and third.
TEST(Flip, SummaryByHand) {
    Image<float> map(2, 2);
    map.pixels() = {0.4F, 0.1F, 0.3F, 0.2F};
    const FlipSummary s = summary_of_flip(map);
    EXPECT_NEAR(s.mean, 0.25, 1e-8);
    EXPECT_FLOAT_EQ(static_cast<float>(s.minimum), 0.1F);
    EXPECT_FLOAT_EQ(static_cast<float>(s.maximum), 0.4F);
    EXPECT_FLOAT_EQ(static_cast<float>(s.first_quartile), 0.1F);
    EXPECT_FLOAT_EQ(static_cast<float>(s.median), 0.2F);
    EXPECT_FLOAT_EQ(static_cast<float>(s.third_quartile), 0.3F);
    EXPECT_FLOAT_EQ(static_cast<float>(s.weighted_first_quartile), 0.2F);
    EXPECT_FLOAT_EQ(static_cast<float>(s.weighted_median), 0.3F);
    EXPECT_FLOAT_EQ(static_cast<float>(s.weighted_third_quartile), 0.4F);
}

} // namespace
} // namespace fernlicht
