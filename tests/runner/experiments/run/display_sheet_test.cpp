// The sheet of tone mappers and eyes: each stage by itself, told apart by what it does.
#include "runner/experiments/run/display_sheet.h"
#include "runner/write/plots/svg.h"

#include "runner/play/preparation.h"
#include "scenarios/drives/play/advance.h"
#include "tests/runner/program.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

int apart_in_tile(const Rgb8& a, const Rgb8& b) { return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}); }

/// Mean distance of a pixel's channels, and of its green from that of the next pixel.
std::pair<double, double> colour_and_detail(const Image<Rgb8>& image) {
    double colour = 0.0, detail = 0.0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x + 1 < image.width(); ++x) {
            const Rgb8 &at = image.at(x, y), &next = image.at(x + 1, y);
            colour += std::max({at.r, at.g, at.b}) - std::min({at.r, at.g, at.b});
            detail += std::abs(at.g - next.g);
        }
    return {colour / static_cast<double>(image.size()), detail / static_cast<double>(image.size())};
}

TEST(DisplaySheets, EveryStageHasATileOfItsOwn) {
    const Stage stage(read_drive(library_file("drives/oncoming.yaml")));
    const LampSet& lamp_set = stage.drive.lamp_sets.front();
    Device device = open_device("auto");
    const DisplaySheet sheet =
        display_sheet(stage, lamp_set, moments_at({20}, stage, lamp_set).front(), device, settings_for(stage.drive, RendererSettings{}));
    std::vector<std::string> names;
    for (const PictureTile& tile : sheet.eyes)
        names.push_back(tile.name);
    ASSERT_THAT(names, testing::ElementsAre("as it is", "windscreen", "veil, 25 years", "veil, 75 years", "colours at night",
                                            "sharpness at night"));
    EXPECT_EQ(sheet.mappers.size() % 3, 0U); // rows of three are full
    const auto [colour, detail] = colour_and_detail(sheet.eyes[0].picture);
    const auto [colour_at_night, detail_of_colours] = colour_and_detail(sheet.eyes[4].picture);
    const auto [colour_of_sharpness, detail_at_night] = colour_and_detail(sheet.eyes[5].picture);
    EXPECT_LT(colour_at_night, 0.95 * colour);
    EXPECT_GT(detail_of_colours, 0.9 * detail);
    EXPECT_LT(detail_at_night, detail);
    EXPECT_NEAR(colour_of_sharpness, colour, 0.01 * colour);
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t k = 0; k < i; ++k) {
            int most = 0;
            for (std::size_t at = 0; at < sheet.eyes[i].picture.size(); ++at)
                most = std::max(most, apart_in_tile(sheet.eyes[i].picture.pixels()[at], sheet.eyes[k].picture.pixels()[at]));
            EXPECT_GT(most, 2) << names[i] << ", " << names[k];
        }
    // 40 degrees on 240 rows: 2 atan(tan(20 degrees) / 240) = 10.43'
    EXPECT_THAT(sheet.eyes[5].words, testing::HasSubstr("10.4\u2032"));
    const std::string svg = plots::svg_of(tiles_of(sheet));
    EXPECT_THAT(svg, testing::AllOf(testing::HasSubstr(">colours at night</text>"), testing::HasSubstr(">sharpness at night</text>")));
}

} // namespace
} // namespace fernlicht
