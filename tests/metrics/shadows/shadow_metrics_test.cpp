// Errors of shadows against values worked out by hand.
#include "metrics/shadows/shadow_errors.h"
#include "tests/metrics/images/made_pictures.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <tuple>

namespace fernlicht {
namespace {

using tests::picture;

TEST(ShadowArea, CountsByDegree) {
    // Free 2 lx everywhere. Shadow truly 1, 1, 0, 0.5; drawn 1, 0.25, 0.5, 0.5.
    const ShadowImages images{
        picture(4, {0.0F, 1.5F, 1.0F, 1.0F}), picture(4, {0.0F, 0.0F, 2.0F, 1.0F}), picture(4, {2.0F, 2.0F, 2.0F, 2.0F}), {}, {}};
    const ShadowArea area = shadow_area(images, 3.0);
    EXPECT_DOUBLE_EQ(area.counted, 12.0);
    EXPECT_DOUBLE_EQ(area.shadowed, 7.5);
    EXPECT_DOUBLE_EQ(area.wrongly_lit, 2.25);
    EXPECT_DOUBLE_EQ(area.wrongly_dark, 1.5);
    EXPECT_DOUBLE_EQ(area.wrong_share(), 3.75 / 12.0);
    EXPECT_DOUBLE_EQ(area.wrongly_lit_share(), 2.25 / 12.0);
    EXPECT_DOUBLE_EQ(area.wrongly_dark_share(), 1.5 / 12.0);
    const Image<float> differences = shadow_differences(images);
    EXPECT_EQ(differences.pixels(), (std::vector<float>{0.0F, 0.75F, -0.5F, 0.0F}));
}

TEST(ShadowArea, WeighsPixelsByTheirOwnAreasAndLightsErrorsAreNotTheShadows) {
    const ShadowImages images{picture(3, {1.0F, 1.0F, 0.0F}), picture(3, {0.0F, 1.0F, 1.0F}), picture(3, {1.0F, 1.0F, 1.0F}), {}, {}};
    const ShadowArea area = shadow_area(images, picture(3, {2.0F, -1.0F, 5.0F}));
    EXPECT_DOUBLE_EQ(area.counted, 7.0);
    EXPECT_DOUBLE_EQ(area.wrongly_lit, 2.0);
    EXPECT_DOUBLE_EQ(area.wrongly_dark, 5.0);
    EXPECT_THROW(shadow_area(images, picture(2, {1.0F, 1.0F})), std::invalid_argument);
    // Drawn a tenth too bright, with the right shadow.
    ShadowImages other_images{picture(2, {1.1F, 0.55F}), picture(2, {1.0F, 0.5F}), picture(2, {1.0F, 1.0F}), {}, {}};
    EXPECT_NEAR(shadow_area(other_images).wrongly_lit, 0.05, 1e-7);
    other_images.drawn_unshadowed_lx = picture(2, {1.1F, 1.1F});
    EXPECT_NEAR(shadow_area(other_images).wrong(), 0.0, 1e-7);
}

TEST(ShadowArea, LeavesOutWhatIsDarkWithoutShadowsOrOfSomethingElse) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    ShadowImages images{
        picture(4, {0.0F, 0.0F, 0.0F, nan}), picture(4, {0.0009F, 5.0F, 5.0F, 5.0F}), picture(4, {0.0009F, 5.0F, 5.0F, 5.0F}), {}, {}};
    images.counts = Image<std::uint8_t>(4, 1, 1);
    images.counts.at(1, 0) = 0;
    EXPECT_EQ(shadow_area(images), (ShadowArea{1.0, 0.0, 0.0, 1.0}));
    EXPECT_EQ(shadow_area(images, 1.0, 0.0005).wrongly_dark, 2.0);
    EXPECT_EQ(shadow_area({picture(1, {0.0F}), picture(1, {0.0F}), picture(1, {0.0F}), {}, {}}).wrong_share(), 0.0);
    EXPECT_THROW(shadow_area({picture(2, {1.0F, 1.0F}), picture(1, {1.0F}), picture(1, {1.0F}), {}, {}}), std::invalid_argument);
    EXPECT_THROW(shadow_area(images, 1.0, 0.0), std::invalid_argument);
    EXPECT_THROW(shadow_area(images, 0.0), std::invalid_argument);
}

TEST(ShadowEdges, LieWhereHalfTheLightIsAlsoInARowOfPixels) {
    const auto edges = shadow_edges({1.0, 1.0, 0.25, 0.0, 0.0, 1.0, std::nullopt, 0.0}, 0.01);
    ASSERT_EQ(edges.size(), 2U);
    EXPECT_NEAR(edges[0].at_m, 0.01 * (1.0 + 0.5 / 0.75), 1e-15);
    EXPECT_EQ(edges[0].direction, -1);
    EXPECT_NEAR(edges[1].at_m, 0.045, 1e-15);
    EXPECT_EQ(edges[1].direction, 1);
    ShadowImages images{picture(5, {1.0F, 1.0F, 1.0F, 0.0F, 0.0F}),
                        picture(5, {1.0F, 1.0F, 0.0F, 0.0F, 0.0F}),
                        picture(5, {1.0F, 1.0F, 1.0F, 1.0F, 1.0F}),
                        {},
                        {}};
    const EdgeMatch match = section_edges(images, 0, 0.5);
    ASSERT_EQ(match.matched.size(), 1U);
    EXPECT_DOUBLE_EQ(match.matched[0].truth.at_m, 0.75);
    EXPECT_DOUBLE_EQ(match.matched[0].error_m, 0.5);
}

TEST(ShadowEdges, AreMatchedByOrderAndDirection) {
    // A post and a pale; drawn: the post 2 and -1 cm off, the pale lost, a stripe invented 3 m on.
    const EdgeMatch match = match_edges({{1.0, -1}, {1.2, 1}, {2.0, -1}, {2.02, 1}}, {{1.02, -1}, {1.19, 1}, {5.0, -1}, {5.1, 1}});
    ASSERT_EQ(match.matched.size(), 2U);
    EXPECT_NEAR(match.matched[0].error_m, 0.02, 1e-12);
    EXPECT_NEAR(match.matched[1].error_m, -0.01, 1e-12);
    EXPECT_EQ(std::tuple(match.lost, match.invented), std::tuple(2U, 2U));
    // The near one of two of the same direction, and never one of the other.
    const EdgeMatch nearer = match_edges({{1.0, -1}}, {{0.7, -1}, {0.9, 1}, {1.05, -1}});
    ASSERT_EQ(nearer.matched.size(), 1U);
    EXPECT_NEAR(nearer.matched[0].error_m, 0.05, 1e-12);
    EXPECT_EQ(nearer.invented, 2U);
    const EdgeMatch none = match_edges({{1.0, -1}}, {{2.5, -1}});
    EXPECT_EQ(none.lost + none.invented, 2U);
    EXPECT_TRUE(none.matched.empty());
}

TEST(ShadowEdges, ErrorsOfSectionsTogether) {
    const EdgeError error = edge_error({{{{{0.0, 1}, 0.03}, {{1.0, -1}, -0.04}}, 1, 0}, {{}, 0, 2}});
    EXPECT_EQ(std::tuple(error.edges, error.lost, error.invented), std::tuple(2U, 1U, 2U));
    EXPECT_NEAR(error.rms_cm.value(), std::sqrt((9.0 + 16.0) / 2.0), 1e-12);
    EXPECT_NEAR(error.worst_cm.value(), 4.0, 1e-12);
    EXPECT_FALSE(edge_error({}).rms_cm.has_value());
}

TEST(ShadowCrawl, IsTheSpreadOfChanges) {
    const auto step = [](double at, double error) { return EdgeMatch{{{{at, 1}, error}}, 0, 0}; };
    // Errors of 1, 3, 2, 4 cm: changes of 2, -1, 2 cm; their mean is 1, their deviation sqrt((1 + 4 + 1) / 2).
    EXPECT_NEAR(shadow_crawl_cm({step(1.0, 0.01), step(1.02, 0.03), step(1.04, 0.02), step(1.06, 0.04)}).value(), std::sqrt(3.0), 1e-9);
    EXPECT_NEAR(shadow_crawl_cm({step(1.0, 0.02), step(1.1, 0.02), step(1.2, 0.02)}).value(), 0.0, 1e-9);
    EXPECT_FALSE(shadow_crawl_cm({step(1.0, 0.02), step(1.1, 0.02)}).has_value());
    // A step at which an edge more is there, or at which the edge is another one, is compared with nobody.
    const EdgeMatch two{{{{1.0, 1}, 0.5}, {{3.0, -1}, 0.5}}, 0, 0};
    EXPECT_FALSE(shadow_crawl_cm({step(1.0, 0.02), two, step(1.0, 0.02)}).has_value());
    EXPECT_FALSE(shadow_crawl_cm({step(1.0, 0.02), step(2.0, 0.3), step(3.0, 0.02)}).has_value());
}

TEST(ShadowSpots, AreConnectedAndFarFromEdges) {
    // Left half lit, right half shadowed, 12 x 5. Two spots of acne (one of them across a corner), one leak, and a wrong pixel at the edge.
    constexpr int width = 12, height = 5;
    ShadowImages images{Image<float>(width, height), Image<float>(width, height), Image<float>(width, height, 1.0F), {}, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < 6; ++x)
            images.true_lx.at(x, y) = images.drawn_lx.at(x, y) = 1.0F;
    images.drawn_lx.at(0, 0) = images.drawn_lx.at(1, 1) = images.drawn_lx.at(0, 4) = 0.0F;
    images.drawn_lx.at(10, 2) = images.drawn_lx.at(11, 2) = 1.0F;
    images.drawn_lx.at(6, 2) = 0.6F;
    const ShadowSpots near = shadow_spots(images, 0), far = shadow_spots(images, 2);
    EXPECT_EQ(near, (ShadowSpots{2, 3, 2, 3, 60}));
    EXPECT_EQ(far, (ShadowSpots{2, 3, 1, 2, 40})); // four columns are in doubt
    EXPECT_THROW(shadow_spots(images, -1), std::invalid_argument);
}

TEST(ShadowSpots, HalfShadowsLeaveDoubt) {
    const ShadowImages images{picture(3, {0.0F, 0.0F, 0.0F}), picture(3, {1.0F, 0.85F, 1.0F}), picture(3, {1.0F, 1.0F, 1.0F}), {}, {}};
    EXPECT_EQ(shadow_spots(images, 0), (ShadowSpots{2, 2, 0, 0, 2}));
    EXPECT_EQ(shadow_spots(images, 1), (ShadowSpots{0, 0, 0, 0, 0}));
}

} // namespace
} // namespace fernlicht
