// What the levels of a pixel lamp come to: parts lit, flux left, dark boxes, means of columns.
#include "scenarios/lamps/pixel_state.h"
#include "scenarios/values/pose.h"
#include "tests/lamps.h"

#include <cmath>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::ElementsAre;

std::shared_ptr<const PixelLamp> four_by_three(double exponent = 1.0) {
    PixelParts parts;
    parts.raster.push_back({4, 3, {-8.0, 8.0, -3.0, 3.0}, 0.5, 0.25, std::vector<double>(12, 1000.0)});
    parts.answer.exponent = exponent;
    parts.dead = {0};
    return std::make_shared<const PixelLamp>(std::move(parts));
}

TEST(PixelStates, CountsBoxesAndColumnsOfARaster) {
    const PixelStates states(four_by_three());
    EXPECT_THAT(states.columns_deg(), ElementsAre(std::pair(-8.0, -4.0), std::pair(-4.0, 0.0), std::pair(0.0, 4.0), std::pair(4.0, 8.0)));
    // Dark: the two in the middle of the upper rows, and one more beside them below.
    const std::vector<float> levels{1, 0, 0, 1, 1, 0, 0, 1, 1, 1, 0.5F, 0};
    const PixelState state = states.of(levels);
    EXPECT_EQ(state.lit, 6U) << "12 less 5 dark and one dead";
    EXPECT_THAT(state.dark, ElementsAre(AngleBox{-4.0, 4.0, -1.0, 3.0}, AngleBox{4.0, 8.0, -3.0, -1.0}));
    EXPECT_THAT(state.columns, ElementsAre(1.0F, 1.0F / 3.0F, 0.5F / 3.0F, 2.0F / 3.0F));
    // Solid angles of a row each: sin 3 - sin 1 = sin -1 - sin -3, and 2 sin 1.
    const double outer = std::sin(radians(3.0)) - std::sin(radians(1.0)), inner = 2.0 * std::sin(radians(1.0));
    EXPECT_NEAR(state.flux, (outer + 2.0 * inner + 2.5 * outer) / (3.0 * outer + 4.0 * inner + 4.0 * outer), 1e-12);
    EXPECT_EQ(states.of(std::vector<float>(12, 1.0F)).flux, 1.0);
    EXPECT_THAT(states.of(std::vector<float>(12, 0.0F)).dark, ElementsAre(AngleBox{-8.0, 8.0, -3.0, 3.0}));
    EXPECT_LT(PixelStates(four_by_three(2.0)).of(levels).flux, state.flux);
}

TEST(PixelStates, OfAChequeredRasterItKeepsAHundredBoxesAndCountsTheRest) {
    PixelParts parts;
    parts.raster.push_back({20, 20, {-10.0, 10.0, -10.0, 10.0}, 0.5, 0.5, std::vector<double>(400, 1000.0)});
    std::vector<float> levels(400);
    for (std::size_t i = 0; i < levels.size(); ++i)
        levels[i] = (i + i / 20) % 2 == 0 ? 0.0F : 1.0F;
    const PixelState state = PixelStates(std::make_shared<const PixelLamp>(std::move(parts))).of(levels);
    EXPECT_EQ(state.dark.size(), 100U);
    EXPECT_EQ(state.more_dark, 100U);
}

TEST(PixelStates, ItsFluxIsThatOfTheTable) {
    const auto lamp = four_by_three();
    const PixelStates states(lamp);
    const std::vector<float> levels{1, 0, 0.25F, 1, 1, 0, 0, 1, 1, 1, 0.5F, 0};
    const double full_lm = flux_lm(lamp->table(std::vector<float>(12, 1.0F)));
    EXPECT_NEAR(states.of(levels).flux, flux_lm(lamp->table(levels)) / full_lm, 2e-4);
}

TEST(PixelStates, SegmentsMayOverlapAndLeaveGaps) {
    PixelParts parts;
    parts.base.push_back(tests::even_table(100.0, 10.0, 2.0));
    parts.segments.push_back({"a", tests::even_table(300.0, 4.0, 2.0), {-4.0, 1.0, -2.0, 2.0}});
    parts.segments.push_back({"b", tests::even_table(600.0, 4.0, 2.0), {0.0, 4.0 - 1e-9, -2.0, 2.0}});
    parts.segments.push_back({"c", tests::even_table(300.0, 2.0, 2.0), {6.0, 8.0, -1.0, 1.0}});
    const PixelStates states(std::make_shared<const PixelLamp>(std::move(parts)));
    const PixelState state = states.of(std::vector{0.0F, 1.0F, 0.0F});
    EXPECT_EQ(state.lit, 1U);
    EXPECT_THAT(state.dark, ElementsAre(AngleBox{-4.0, 1.0, -2.0, 2.0}, AngleBox{6.0, 8.0, -1.0, 1.0}));
    ASSERT_EQ(states.columns_deg().size(), 5U) << "-4, 0, 1, 4, 6, 8";
    EXPECT_EQ(state.columns[0], 0.0F);
    EXPECT_EQ(state.columns[1], 0.5F);
    EXPECT_EQ(state.columns[2], 1.0F);
    EXPECT_TRUE(std::isnan(state.columns[3])) << "nothing there";
    // Flux by width times intensity: base 20 x 100, a 8 x 300, b 8 x 600, c 4 x 300.
    EXPECT_NEAR(state.flux, (2000.0 + 4800.0) / (2000.0 + 2400.0 + 4800.0 + 1200.0), 1e-9);
}

} // namespace
} // namespace fernlicht
