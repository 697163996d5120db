#include "metrics/strictness/strictness.h"

#include "tests/metrics/images/made_pictures.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <tuple>

namespace fernlicht {
namespace {

using Kind = StrictnessNode::Kind;
using ::testing::HasSubstr;

Image<float> row(const std::vector<float>& values) { return tests::picture(static_cast<int>(values.size()), values); }

StrictnessResult judged(const StrictnessNode& node, const Image<float>& tested, const Image<float>& reference) {
    return judge_strictness(node, {tested}, {reference}, "lx");
}

// Differences 0, 1, 3 of 10, 20, 30.
const auto reference = row({10, 20, 30}), tested = row({10, 21, 33});

TEST(Strictness, EveryPixelWithinAnAbsoluteBound) {
    const StrictnessResult passed = judged({.kind = Kind::every, .bound = {4.0}}, tested, reference);
    EXPECT_TRUE(passed.passed);
    EXPECT_DOUBLE_EQ(passed.found, 3.0);
    EXPECT_DOUBLE_EQ(passed.threshold, 4.0);
    EXPECT_DOUBLE_EQ(*passed.margin, 0.25);
    EXPECT_EQ(std::tuple(passed.worst_x, passed.pixels), std::tuple(2, 3U));
    EXPECT_TRUE(judged({.kind = Kind::every, .bound = {3.0}}, tested, reference).passed); // the threshold itself passes
    const StrictnessResult failed = judged({.kind = Kind::every, .bound = {2.0}}, tested, reference);
    EXPECT_FALSE(failed.passed);
    EXPECT_DOUBLE_EQ(*failed.margin, -0.5);
}

// 5 % of 20 is 1, just kept; 10 % of 30 is 3. With 6 %: 1 of 1.2 and 3 of 1.8. The second is farthest.
TEST(Strictness, RelativeBoundsArePixelsOwnAndPercentagesCountThem) {
    EXPECT_TRUE(judged({.kind = Kind::every, .bound = {0.0, 0.1}}, tested, reference).passed);
    const StrictnessResult failed = judged({.kind = Kind::every, .bound = {0.0, 0.06}}, tested, reference);
    EXPECT_FALSE(failed.passed);
    EXPECT_DOUBLE_EQ(failed.found, 3.0);
    EXPECT_NEAR(failed.threshold, 1.8, 1e-12);
    EXPECT_TRUE(judged({.kind = Kind::every, .bound = {1.2, 0.06}}, tested, reference).passed);
    const StrictnessNode node{.kind = Kind::percentage, .bound = {2.0}, .percent = 40.0};
    const StrictnessResult passed = judged(node, tested, reference);
    EXPECT_TRUE(passed.passed);
    EXPECT_NEAR(passed.found, 100.0 / 3.0, 1e-12);
    EXPECT_NEAR(*passed.margin, (40.0 - 100.0 / 3.0) / 40.0, 1e-12);
    EXPECT_FALSE(judged({.kind = Kind::percentage, .bound = {0.5}, .percent = 40.0}, tested, reference).passed);
}

TEST(Strictness, NoThresholdHasNoMargin) {
    const StrictnessResult same = judged({.kind = Kind::every}, reference, reference),
                           other = judged({.kind = Kind::every}, tested, reference);
    EXPECT_TRUE(same.passed);
    EXPECT_EQ(same.margin, 0.0);
    EXPECT_FALSE(other.passed || other.margin);
}

// A bright column moved by one pixel; and by two.
TEST(Strictness, OnePixelShiftIsForgiven) {
    Image<float> before(7, 3, 1.0F), by_one = before, by_two = before;
    for (int y = 0; y < 3; ++y) {
        before.at(2, y) = 50.0F;
        by_one.at(3, y) = 50.0F;
        by_two.at(4, y) = 50.0F;
    }
    const StrictnessNode strict{.kind = Kind::every, .bound = {1.0}}, moving{.kind = Kind::every, .bound = {1.0}, .one_pixel_shift = true};
    EXPECT_FALSE(judged(strict, by_one, before).passed);
    EXPECT_TRUE(judged(moving, by_one, before).passed);
    EXPECT_FALSE(judged(moving, by_two, before).passed);
    // A hard limit forgives nothing.
    EXPECT_FALSE(judged({.kind = Kind::hard_limit, .bound = {1.0}, .one_pixel_shift = true}, by_one, before).passed);
}

// All three channels of one pixel must find their value at the same neighbour: a green and a blue neighbour do not make a cyan one.
TEST(Strictness, ShiftTakesAPixelAsAWhole) {
    const StrictnessNode moving{.kind = Kind::every, .bound = {1.0}, .one_pixel_shift = true};
    const std::vector<Image<float>> before{row({9, 0, 0}), row({0, 0, 9})}, after{row({9, 9, 0}), row({0, 9, 9})};
    EXPECT_FALSE(judge_strictness(moving, after, before, "levels").passed);
}

TEST(Strictness, MasksChooseThePixelsAndTheWorstChannelDecides) {
    PixelMask mask(3, 1, 255);
    mask.at(2, 0) = 0;
    const StrictnessResult masked = judged({.kind = Kind::every, .bound = {1.0}, .mask = mask, .mask_name = "sky.png"}, tested, reference);
    EXPECT_TRUE(masked.passed);
    EXPECT_EQ(masked.pixels, 2U);
    EXPECT_THAT(masked.statement, HasSubstr("sky.png"));
    EXPECT_FALSE(judged({.kind = Kind::hard_limit, .bound = {1.0}, .mask = mask}, tested, reference).passed); // anywhere
    const StrictnessResult worst =
        judge_strictness({.kind = Kind::every, .bound = {2.0}}, {reference, row({1, 2, 3})}, {reference, row({1, 2, 8})}, "levels");
    EXPECT_FALSE(worst.passed);
    EXPECT_DOUBLE_EQ(worst.found, 5.0);
}

// Margins 0.25 (3 of 4) and -0.5 (3 of 2).
TEST(Strictness, TreesPassByAllAndAny) {
    const StrictnessNode loose{.kind = Kind::every, .bound = {4.0}}, tight{.kind = Kind::every, .bound = {2.0}};
    const StrictnessResult all = judged({.kind = Kind::all, .children = {loose, tight}}, tested, reference);
    EXPECT_FALSE(all.passed);
    EXPECT_DOUBLE_EQ(*all.margin, -0.5);
    ASSERT_EQ(all.children.size(), 2U);
    EXPECT_TRUE(all.children[0].passed);
    EXPECT_FALSE(all.children[1].passed);
    const StrictnessResult any = judged({.kind = Kind::any, .children = {loose, tight}}, tested, reference);
    EXPECT_TRUE(any.passed);
    EXPECT_DOUBLE_EQ(*any.margin, 0.25);
    const StrictnessNode nested{.kind = Kind::all, .children = {{.kind = Kind::any, .children = {loose, tight}}, loose}};
    EXPECT_TRUE(judged(nested, tested, reference).passed);
}

TEST(Strictness, WrongInputIsRefused) {
    const StrictnessNode every{.kind = Kind::every, .bound = {1.0}};
    EXPECT_THROW(judged(every, row({1, 2}), reference), std::invalid_argument);
    EXPECT_THROW(judged(every, {}, {}), std::invalid_argument);
    EXPECT_THROW(judged({.kind = Kind::any}, tested, reference), std::invalid_argument);
    EXPECT_THROW(judged({.kind = Kind::every, .bound = {-1.0}}, tested, reference), std::invalid_argument);
    EXPECT_THROW(judged({.kind = Kind::percentage, .percent = 101.0}, tested, reference), std::invalid_argument);
    EXPECT_THROW(judged({.kind = Kind::every, .mask = PixelMask(3, 2, 255)}, tested, reference), std::invalid_argument);
    EXPECT_THROW(judged({.kind = Kind::every, .mask = PixelMask(3, 1, 0)}, tested, reference), std::invalid_argument);
    EXPECT_THROW(judged(every, row({1, 2, std::numeric_limits<float>::infinity()}), reference), std::invalid_argument);
}

TEST(ErrorHistogram, CountsByThirdsOfADecade) {
    EXPECT_NEAR(ErrorHistogram::edge(18), 1.0, 1e-12);
    EXPECT_NEAR(ErrorHistogram::edge(19), std::cbrt(10.0), 1e-12);
    // Differences 0, 1, 3 and 1e-9, 1e9 in the end bins.
    const ErrorHistogram h = error_histogram({row({10, 21, 33, 1e-9F, 1e9F})}, {row({10, 20, 30, 0, 0})});
    EXPECT_EQ(std::tuple(h.equal, h.counts[18]), std::tuple(1U, 1U));
    EXPECT_EQ(h.counts[19], 1U); // 2.15 to 4.64
    EXPECT_EQ(h.counts.front(), 1U);
    EXPECT_EQ(h.counts.back(), 1U);
    EXPECT_EQ(h.pixels(), 5U);
}

/// Squares of 10 x 10 pixels with light from 0.01 to 100 lx, no two alike.
Image<float> night() {
    Image<float> image(100, 100);
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 100; ++x)
            image.at(x, y) = static_cast<float>(0.01 * std::pow(1e4, (x / 10 + y / 10 * 10) * 37 % 100 / 99.0));
    return image;
}

Image<float> brighter(const Image<float>& image, float factor) {
    Image<float> out = image;
    for (float& v : out.pixels())
        v *= factor;
    return out;
}

// 2 % more light is never the same light, 0.5 % is, and 20 % is not the same picture.
TEST(StrictnessClasses, LightByHowMuchItIsOff) {
    for (const auto& [name, factor, passes] :
         {std::tuple("identical", 1.0F, true), std::tuple("identical", 1.00001F, false), std::tuple("same-driver", 1.0005F, true),
          std::tuple("same-driver", 1.005F, false), std::tuple("same-light", 1.005F, true), std::tuple("same-light", 1.02F, false),
          std::tuple("same-picture", 1.08F, true), std::tuple("same-picture", 1.2F, false)}) {
        const auto one = std::ranges::find(strictness_classes(), std::string_view(name), &StrictnessClass::name);
        EXPECT_EQ(judged(one->linear, brighter(night(), factor), night()).passed, passes) << name << ' ' << factor;
    }
}

// Every class that passes lets the looser ones pass.
TEST(StrictnessClasses, AreOrdered) {
    for (const float factor : {1.0F, 1.0005F, 1.005F, 1.02F, 1.08F, 1.2F}) {
        bool passed = false;
        for (const StrictnessClass& one : strictness_classes()) {
            const bool now = judged(one.linear, brighter(night(), factor), night()).passed;
            EXPECT_TRUE(now || !passed) << one.name << " " << factor;
            passed = now;
        }
    }
}

TEST(StrictnessClasses, LevelsOfDisplays) {
    const Image<float> levels(100, 100, 100.0F);
    for (const auto& [number, by, passes] :
         {std::tuple(0U, 1.0F, false), std::tuple(1U, 1.0F, true), std::tuple(1U, 2.0F, false), std::tuple(2U, 2.0F, true),
          std::tuple(2U, 3.0F, false), std::tuple(3U, 8.0F, true), std::tuple(3U, 9.0F, false)})
        EXPECT_EQ(judged(strictness_classes()[number].display, Image<float>(100, 100, 100.0F + by), levels).passed, passes)
            << number << ' ' << by;
}

} // namespace
} // namespace fernlicht
