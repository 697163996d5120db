#include "metrics/images/flip.h"
#include "metrics/images/flip_tile.h"
#include "metrics/images/image_difference.h"
#include "metrics/images/quick_powers.h"
#include "scenarios/values/pose.h"
#include "tests/metrics/images/direct_flip.h"
#include "tests/metrics/images/made_pictures.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <numeric>
#include <tbb/global_control.h>
#include <tuple>

namespace fernlicht {
namespace {

using tests::DirectFlip, tests::disturbed, tests::made_scene, tests::shifted;

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

TEST(Flip, EvenColoursByHandAndAsWithoutFilters) {
    const auto scene = made_scene(150, 40); // two tiles
    for (const auto map = flip_ldr(scene, scene); const float e : map.pixels())
        EXPECT_EQ(e, 0.0F);
    // By hand. Black to white: HyAB is the difference of L*, 100; 100^0.7 = 25.1189. Green (L* 87.735, a* -86.183, b* 83.179) and blue
    // (32.297, 79.188, -107.860), a* and b* times 0.01 L*: -75.612, 72.977 and 25.575, -34.836; HyAB 55.438 + sqrt(101.187^2 + 107.813^2) =
    // 203.296; to the 0.7 41.276, 0.4 of it 16.510. 0.95 + 0.05 (25.1189 - 16.510) / (41.276 - 16.510) = 0.96738.
    for (const auto map = flip_ldr({20, 20, black}, {20, 20, white}); const float e : map.pixels())
        EXPECT_NEAR(static_cast<double>(e), 0.96738, 1e-5); // the last digit of the sum by hand
    EXPECT_NEAR(static_cast<double>(flip_ldr({9, 9, green}, {9, 9, blue}).at(4, 4)), 1.0, 1e-6);
    for (const Rgb8& one : {black, white, red, green, blue, grey})
        for (const Rgb8& other : {black, white, red, green, blue, grey})
            EXPECT_LE(flip_ldr({3, 3, one}, {3, 3, other}).at(1, 1), 1.0F);
    // Even pictures stay even: the filters sum to 1 for every channel, and there are no features.
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

TEST(Flip, IsTheSameBothWaysByAnyNumberOfThreads) {
    const auto a = made_scene(300, 200), b = disturbed(a, 30, 5);
    const auto many = flip_ldr(a, b);
    EXPECT_EQ(flip_ldr(b, a), many);
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

TEST(Flip, PixelsPerDegreeOfViewsAndWrongInput) {
    EXPECT_NEAR(pixels_per_degree_of_view(radians(90.0), 720), 360.0 * pi / 180.0, 1e-12); // tan 45 degrees is 1
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
    for (const auto& [found, expected] :
         {std::pair(s.minimum, 0.1F), std::pair(s.maximum, 0.4F), std::pair(s.first_quartile, 0.1F), std::pair(s.median, 0.2F),
          std::pair(s.third_quartile, 0.3F), std::pair(s.weighted_first_quartile, 0.2F), std::pair(s.weighted_median, 0.3F),
          std::pair(s.weighted_third_quartile, 0.4F)})
        EXPECT_FLOAT_EQ(static_cast<float>(found), expected);
}

Image<glm::vec3> grey_scene(int width, int height, const std::vector<float>& values) {
    Image<glm::vec3> image(width, height);
    for (std::size_t i = 0; i < image.size(); ++i)
        image.pixels()[i] = glm::vec3(values[i % values.size()]);
    return image;
}

/// The tone mapper by its published coefficients, 0.6 times the exposure going in.
double aces(double x) {
    const double v = 0.6 * x;
    return std::clamp(v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14), 0.0, 1.0);
}

/// Where it is 0.85, by halving.
double shown_as_085() {
    double low = 0.0, high = 10.0;
    for (int i = 0; i < 100; ++i)
        (aces(0.5 * (low + high)) < 0.85 ? low : high) = 0.5 * (low + high);
    return low;
}

// Largest 8, median 0.5: sixteen to one is four stops. Start shows 8 as 0.85, stop 0.5.
TEST(FlipHdr, ExposuresByHand) {
    const ExposureRange range = exposures_for(grey_scene(5, 1, {0.1F, 0.2F, 0.5F, 1.0F, 8.0F}));
    EXPECT_NEAR(aces(8.0 * std::exp2(range.start)), 0.85, 1e-9);
    EXPECT_NEAR(range.start, std::log2(shown_as_085() / 8.0), 1e-9);
    EXPECT_NEAR(range.stop - range.start, 4.0, 1e-6);
    EXPECT_EQ(range.count, 4);
}

// More than half is black, as in most night pictures: the median of the four lit pixels stands in. 32 to 4: three stops.
TEST(FlipHdr, BlackNightsAreExposedForWhatIsLit) {
    const ExposureRange range = exposures_for(grey_scene(10, 1, {0, 0, 0, 0, 0, 0, 1.0F, 2.0F, 4.0F, 32.0F}));
    EXPECT_NEAR(range.stop - range.start, 3.0, 1e-6);
    EXPECT_EQ(range.count, 3);
}

TEST(FlipHdr, ExtremesAreBoundedAndComparedAndTheSameIsZero) {
    const ExposureRange deep = exposures_for(grey_scene(3, 1, {1e-38F, 1e-38F, 1e30F}));
    EXPECT_DOUBLE_EQ(deep.stop - deep.start, max_stops);
    EXPECT_EQ(deep.count, static_cast<int>(max_stops));
    const ExposureRange flat = exposures_for(grey_scene(3, 1, {2.0F}));
    EXPECT_DOUBLE_EQ(flat.start, flat.stop);
    EXPECT_EQ(flat.count, 2);
    const auto bright = grey_scene(4, 4, {1e30F, 1.0F}), dark = grey_scene(4, 4, {1e-30F, 1.0F});
    for (const auto map = flip_hdr(bright, dark, exposures_for(dark)); const float e : map.pixels())
        EXPECT_TRUE(e >= 0.0F && e <= 1.0F) << e;
    // All but dark: exposures of more than 2^127 are no floats.
    const auto faint = grey_scene(4, 4, {0.0F, 1e-40F, 1e-39F}), none = grey_scene(4, 4, {0.0F});
    for (const auto map = flip_hdr(none, faint, exposures_for(faint)); const float e : map.pixels())
        EXPECT_TRUE(e >= 0.0F && e <= 1.0F) << e;
    const auto picture = grey_scene(30, 20, {0.0F, 0.01F, 3.0F, 200.0F, 1e4F});
    for (const auto map = flip_hdr(picture, picture, exposures_for(picture)); const float e : map.pixels())
        EXPECT_EQ(e, 0.0F);
}

constexpr std::pair<int, int> odd_sizes_px[] = {{1, 1}, {1, 40}, {40, 1}, {13, 7}};

bool within(const Image<float>& map, float least, float most) {
    return std::ranges::all_of(map.pixels(), [&](float v) { return v >= least && v <= most; }); // false for NaN
}

/// Every pair of these levels, in stripes over black, so that the picture has edges too.
TEST(FlipHdr, AndTheOthersStayInTheirRangeFromTheLeastToTheGreatestFloat) {
    const float levels[] = {1e-45F, 1e-38F, 1e-6F, 1.0F, 1e6F, 1e30F, std::numeric_limits<float>::max()};
    for (const auto& [width, height] : odd_sizes_px)
        for (const float a : levels)
            for (const float b : levels) {
                Image<float> reference(width, height, 0.0F), tested(width, height, 0.0F);
                for (std::size_t i = 0; i < reference.size(); i += 2) {
                    reference.pixels()[i] = a;
                    tested.pixels()[i] = b;
                }
                const double peak = peak_of(reference);
                const Ssim similarity = ssim(decades_of(tested, peak), decades_of(reference, peak), decades_below_peak);
                const ImageDifference difference = compare_images(tested, reference, 0.0, 0.0);
                EXPECT_TRUE(within(flip_hdr(tested, reference, exposures_for(reference)), 0.0F, 1.0F) && similarity.mean >= -1.0 - 1e-9 &&
                            similarity.mean <= 1.0 + 1e-9 && similarity.minimum >= -1.0 - 1e-9 && std::isfinite(difference.rmse) &&
                            std::isfinite(difference.psnr_db) == (a != b))
                    << width << " x " << height << " pixels of " << b << " against " << a;
            }
}

/// The corners of the display's colours, pictures smaller than the filters; and the same against the same, which is 0 to the bit.
TEST(Flip, AndCiede2000StayInTheirRange) {
    const auto corner = [](int i) {
        const auto level = [i](int bit) { return static_cast<std::uint8_t>((i >> bit & 1) * 255); };
        return Rgb8{level(0), level(1), level(2)};
    };
    for (const auto& [width, height] : odd_sizes_px)
        for (int i = 0; i < 8; ++i)
            for (int k = 0; k < 8; ++k)
                for (const double density : {1.0, default_pixels_per_degree, 1000.0}) {
                    if (density > 100.0 && width * height > 40) // filters of 270 pixels on pictures of ten: once is enough
                        continue;
                    const Image<Rgb8> reference(width, height, corner(i)), tested(width, height, corner(k));
                    EXPECT_TRUE(within(flip_ldr(tested, reference, density), i == k ? 0.0F : 1e-3F, i == k ? 0.0F : 1.0F) &&
                                within(ciede2000_map(tested, reference), i == k ? 0.0F : 1.0F, i == k ? 0.0F : 200.0F))
                        << width << " x " << height << " pixels of colours " << k << " and " << i << " at " << density << " a degree";
                }
}

// Every exposure as the paper writes it, in doubles; the worst of them. Floats as for one exposure (flip_test.cpp), whose largest is taken:
// 3e-4. Without colours no root of one channel is subtracted from another's: 116 times two roots good to 3e-7 is 1e-4 at most, as an error
// 0.0576 (1e-4)^0.7 = 9e-5, and its largest 1.5e-4.
TEST(FlipHdr, IsTheWorstOfAllExposures) {
    const int width = 32, height = 24;
    std::vector<float> lit, other;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double beam = 60.0 * std::exp(-0.01 * ((x - 16) * (x - 16) + 4.0 * (y - 14) * (y - 14))) + 0.02;
            lit.push_back(static_cast<float>(beam));
            other.push_back(static_cast<float>(y > 13 && x > 20 ? 0.5 * beam : beam));
        }
    const auto reference = grey_scene(width, height, lit), tested = grey_scene(width, height, other);
    const ExposureRange range = exposures_for(reference);
    ASSERT_GE(range.count, 3);
    const DirectFlip direct(width, height, default_pixels_per_degree);
    std::vector<double> worst(lit.size(), 0.0);
    for (int i = 0; i < range.count; ++i) {
        const double factor = std::exp2(range.start + (range.stop - range.start) * i / (range.count - 1));
        std::vector<std::array<double, 3>> a, b;
        for (std::size_t k = 0; k < lit.size(); ++k) {
            const double va = aces(factor * static_cast<double>(other[k])), vb = aces(factor * static_cast<double>(lit[k]));
            a.push_back({va, va, va});
            b.push_back({vb, vb, vb});
        }
        const auto errors = direct.errors(a, b);
        for (std::size_t k = 0; k < errors.size(); ++k)
            worst[k] = std::max(worst[k], errors[k]);
    }
    const auto map = flip_hdr(tested, reference, range);
    EXPECT_GT(*std::ranges::max_element(worst), 0.1);
    for (std::size_t k = 0; k < worst.size(); ++k)
        ASSERT_NEAR(static_cast<double>(map.pixels()[k]), worst[k], 3e-4) << k;
    Image<float> tested_grey(width, height), reference_grey(width, height);
    tested_grey.pixels() = other;
    reference_grey.pixels() = lit;
    const auto grey_map = flip_hdr(tested_grey, reference_grey, exposures_for(reference_grey));
    for (std::size_t k = 0; k < worst.size(); ++k)
        ASSERT_NEAR(static_cast<double>(grey_map.pixels()[k]), worst[k], 1.5e-4) << k;
}

TEST(FlipHdr, WrongInputIsRefused) {
    const auto light = grey_scene(2, 2, {1.0F}), none = grey_scene(2, 2, {0.0F}), negative = grey_scene(2, 2, {1.0F, -1.0F}),
               infinite = grey_scene(2, 2, {std::numeric_limits<float>::infinity()});
    EXPECT_THROW(exposures_for(none), std::invalid_argument);
    EXPECT_THROW(exposures_for(Image<float>{}), std::invalid_argument);
    EXPECT_THROW(exposures_for(negative), std::invalid_argument);
    EXPECT_THROW(flip_hdr(infinite, light, exposures_for(light)), std::invalid_argument);
    EXPECT_THROW(flip_hdr(grey_scene(2, 3, {1.0F}), light, exposures_for(light)), std::invalid_argument);
}

TEST(QuickPowers, StayWithinWhatTheySay) {
    const auto relative = [](float found, double exact) { return std::abs(static_cast<double>(found) / exact - 1.0); };
    for (double x = 1e-30; x < 1e30; x *= 1.00037)
        ASSERT_LT(relative(quick_cube_root(static_cast<float>(x)), std::cbrt(static_cast<double>(static_cast<float>(x)))), 3e-7) << x;
    for (double x = 1e-37; x < 1e37; x *= 1.00037) {
        const double exact = std::log2(static_cast<double>(static_cast<float>(x)));
        ASSERT_NEAR(static_cast<double>(quick_log2(static_cast<float>(x))), exact, 3e-7 + 6e-8 * std::abs(exact)) << x;
    }
    for (double x = -126.0; x <= 126.0; x += 0.00137)
        ASSERT_LT(relative(quick_exp2(static_cast<float>(x)), std::exp2(static_cast<double>(static_cast<float>(x)))), 3e-7) << x;
    EXPECT_EQ(quick_log2(1.0F), 0.0F);
    EXPECT_EQ(quick_exp2(0.0F), 1.0F);
}

TEST(DisplayDifference, OfTheSameAndOfBlackAndWhite) {
    const Image<Rgb8> picture(3, 2, {1, 2, 3});
    const DisplayDifference same = compare_displays(picture, picture), whole = compare_displays({2, 2, {255, 255, 255}}, {2, 2, {0, 0, 0}});
    EXPECT_EQ(std::tuple(same.maximum, same.rmse, same.percent_different, same.psnr_db),
              std::tuple(0, 0.0, 0.0, std::numeric_limits<double>::infinity()));
    EXPECT_EQ(std::tuple(whole.maximum, whole.rmse, whole.psnr_db), std::tuple(255, 255.0, 0.0));
}

// Of four pixels one differs by -3 and 4 in two channels: 25 over 12 values, rmse 1.4434, 20 log10(255 / 1.4434) = 44.943 dB.
TEST(DisplayDifference, ByHand) {
    Image<Rgb8> reference(2, 2, {10, 20, 30}), tested = reference;
    tested.at(1, 0) = {7, 24, 30};
    const DisplayDifference found = compare_displays(tested, reference);
    EXPECT_EQ(std::tuple(found.maximum, found.maximum_x, found.maximum_y), std::tuple(4, 1, 0));
    EXPECT_DOUBLE_EQ(found.rmse, std::sqrt(25.0 / 12.0));
    EXPECT_NEAR(found.psnr_db, 44.943, 5e-4);
    EXPECT_DOUBLE_EQ(found.percent_different, 25.0);
    EXPECT_DOUBLE_EQ(found.mean_signed[0], -0.75);
    EXPECT_DOUBLE_EQ(found.mean_signed[1], 1.0);
    EXPECT_DOUBLE_EQ(found.mean_signed[2], 0.0);
}

TEST(DisplayDifference, LumaChannelsAndWrongInput) {
    const Image<Rgb8> picture(1, 1, {255, 0, 100});
    EXPECT_NEAR(static_cast<double>(luma_of(picture).at(0, 0)), 0.2126 * 255 + 0.0722 * 100, 1e-4);
    EXPECT_EQ(channel_of(picture, 0).at(0, 0), 255.0F);
    EXPECT_EQ(channel_of(picture, 1).at(0, 0), 0.0F);
    EXPECT_EQ(channel_of(picture, 2).at(0, 0), 100.0F);
    EXPECT_THROW(compare_displays({2, 2}, {2, 3}), std::invalid_argument);
    EXPECT_THROW(compare_displays({}, {}), std::invalid_argument);
}

} // namespace
} // namespace fernlicht
