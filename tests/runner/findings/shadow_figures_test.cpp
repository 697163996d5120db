// Figures of shadows for people, and what sheets show.
#include "runner/findings/figures.h"
#include "runner/write/document.h"

#include "runner/experiments/shadows/moment_sheet.h"
#include "runner/experiments/shadows/shadow_result.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(ShadowFigures, HaveTwoDigitsAndNoExponent) {
    EXPECT_EQ(shadow_figure(0.0532, 1e-4), "0.053");
    EXPECT_EQ(shadow_figure(1e-4, 1e-4), "0.0001");
    EXPECT_EQ(shadow_figure(7.0, 1e-4), "7");
    EXPECT_EQ(shadow_figure(99.4, 1e-4), "99");
    EXPECT_EQ(shadow_figure(99.6, 1e-4), "100");
    EXPECT_EQ(shadow_figure(264.4, 1e-4), "264");
    EXPECT_EQ(shadow_figure(1.2e6, 1e-4), "1200000");
    EXPECT_EQ(shadow_figure(-0.5, 1e-4), "-0.5");
}

TEST(ShadowFigures, BelowWhatCanBeMeasuredAreZero) {
    EXPECT_EQ(shadow_percent(1.8e-9), "0");
    EXPECT_EQ(shadow_percent(0.99e-6), "0"); // of 1: 0.99e-4 %
    EXPECT_EQ(shadow_percent(1.01e-6), "0.0001");
    EXPECT_EQ(shadow_cm(4.9e-13), "0");
    EXPECT_EQ(shadow_cm(0.0099), "0");
    EXPECT_EQ(shadow_cm(0.011), "0.011");
    EXPECT_EQ(shadow_m2(4e-4), "0");
    EXPECT_EQ(shadow_m2(0.0063), "0.0063");
}

/// Rows as `--markdown` prints them, whatever is measured.
TEST(ShadowFigures, MarkdownHasTheFormOfTheTables) {
    ShadowResult result;
    ShadowSceneResult& scene = result.scenes.emplace_back();
    scene.name = "post";
    ShadowRow row;
    row.method = ShadowMethod::map;
    row.ground_m2 = {2000.0, 70.0, 4.9e-12, 101.4};
    row.wrong_by_moment = {row.ground_m2.wrong_share()};
    row.view_px = {1000.0, 30.0, 3.6e-9, 0.0};
    row.edges[0] = {18, 2, 1, 4.9e-13, 1.0};
    row.edges[1].rms_cm = 2.0;
    row.spots.acne = 1;
    row.spots.acne_px = 182;
    row.texture_bytes = 4 << 20;
    scene.rows.push_back(row);
    row = {};
    row.method = ShadowMethod::planar;
    row.why_not = "the ground is not one plane";
    scene.rows.push_back(row);
    const std::string text = document_markdown(shadow_paper(result));
    EXPECT_THAT(text, HasSubstr("\n| post | map | 5.1 | 0 | 101 | 0 | - | 0 \xE2\x88\x92"
                                "2 +1 | 2 | - | 1 (182 px) | 0 | - | - | - | 4.0 | - | - |\n"));
    EXPECT_THAT(text, HasSubstr("\n| post | planar | refused | | | | | | | | | | | | | | | |\n"));
    EXPECT_THAT(document_text(document(result)), Not(HasSubstr("e-")));
}

TEST(ShownPicture, IsShadedByTheRaysShareOfTheLight) {
    Image<float> free(2, 2, 8.0F), degree(2, 2, -1.0F);
    degree.at(0, 0) = 0.0F;
    degree.at(1, 0) = 0.25F;
    degree.at(0, 1) = 1.0F;
    const Image<float> shaded = shaded_by_rays(free, degree);
    EXPECT_THAT(shaded.pixels(), testing::ElementsAre(8.0F, 6.0F, 0.0F, 8.0F));
}

/// A bright car before a dark road: white is the road's.
TEST(ShownPicture, WhiteIsTheGrounds) {
    Scene scene;
    scene.materials = {{.name = "road", .kind = SurfaceKind::road}, {.name = "car", .kind = SurfaceKind::vehicle}};
    for (const std::uint32_t material : {0U, 1U})
        scene.meshes.push_back({"mesh", {}, {}, {}, {{material, 0, 0}}});
    Image<float> seen(20, 10, 260.0F);
    Image<std::uint32_t> ids(20, 10, 2);
    for (int i = 0; i < 100; ++i) { // 0.01 to 1 cd/m2
        seen.pixels()[static_cast<std::size_t>(i)] = 0.01F * static_cast<float>(i + 1);
        ids.pixels()[static_cast<std::size_t>(i)] = 1;
    }
    EXPECT_NEAR(white_of_ground(seen, ids, scene), 1.0, 1e-6);
    EXPECT_NEAR(white_of_ground(seen, Image<std::uint32_t>(20, 10, 2), scene), 260.0, 1e-4) << "no ground: all pixels";
}

} // namespace
} // namespace fernlicht
