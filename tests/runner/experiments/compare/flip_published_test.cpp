// FLIP of a pair of pictures of others, against what the published tool says of it.
#include "metrics/images/flip.h"
#include "runner/files/picture_file.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

TEST(FlipPublished, PairOfTrees) {
    const std::filesystem::path folder = std::filesystem::path(FERNLICHT_SHARED_DATA) / "images/gfx-rs__nv-flip-rs/etc";
    if (!std::filesystem::exists(folder / "tree-ref.png"))
        GTEST_SKIP() << "the pair of trees is not in " << folder;
    const Image<float> map = flip_ldr(read_png(folder / "tree-test.png"), read_png(folder / "tree-ref.png"));
    const FlipSummary found = summary_of_flip(map);
    // What the published command-line tool prints for this pair; it sums in floats, which leaves some 1e-5 of each.
    EXPECT_NEAR(found.mean, 0.133285, 1e-4);
    EXPECT_NEAR(found.weighted_first_quartile, 0.184924, 1e-4);
    EXPECT_NEAR(found.weighted_median, 0.333241, 1e-4);
    EXPECT_NEAR(found.weighted_third_quartile, 0.503441, 1e-4);
    EXPECT_NEAR(found.minimum, 0.0, 1e-6);
    EXPECT_NEAR(found.maximum, 0.983044, 1e-4);
    // Its picture of the errors has the brightness of Matplotlib's map `magma`, whose lightness rises with the error: the order of pixels
    // must agree.
    const Image<Rgb8> drawn = read_png(folder / "tree-comparison-cli.png");
    ASSERT_EQ(drawn.width(), map.width());
    ASSERT_EQ(drawn.height(), map.height());
    const auto light = [&](int x, int y) { return 0.2126 * drawn.at(x, y).r + 0.7152 * drawn.at(x, y).g + 0.0722 * drawn.at(x, y).b; };
    int disagreements = 0;
    for (int y = 0; y < map.height(); ++y)
        for (int x = 1; x < map.width(); ++x) {
            const double steps = 255.0 * static_cast<double>(map.at(x, y) - map.at(x - 1, y));
            disagreements += std::abs(steps) > 3.0 && (steps > 0.0) != (light(x, y) > light(x - 1, y)) ? 1 : 0; // 256 colours, rounded
        }
    EXPECT_EQ(disagreements, 0);
}

} // namespace
} // namespace fernlicht
