#include "metrics/display/display_colour.h"
#include "metrics/display/night_vision.h"
#include "metrics/display/scatter.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <tuple>

namespace fernlicht {
namespace {

constexpr double pixel_deg = 0.05;

TEST(NightVision, AcuityConesAndRodsAreThePublishedFits) {
    EXPECT_NEAR(acuity_cycles_per_deg(1.0), 17.25 * 0.336675 + 25.72, 1.0e-4); // atan(0.35)
    EXPECT_NEAR(acuity_cycles_per_deg(0.01), 5.31, 0.01);
    EXPECT_NEAR(acuity_cycles_per_deg(100.0), 17.25 * std::atan(3.15) + 25.72, 1.0e-12);
    EXPECT_EQ(acuity_cycles_per_deg(1.0e-9), acuity_cycles_per_deg(1.0e-3));
    EXPECT_NEAR(acuity_cycles_per_deg(0.0), 3.0, 0.01);
    EXPECT_EQ(cone_share(0.0), 0.0);
    EXPECT_EQ(cone_share(0.004), 0.0);
    EXPECT_EQ(cone_share(5.5), 1.0);
    EXPECT_EQ(cone_share(1.0e6), 1.0);
    EXPECT_NEAR(cone_share(1.0), 0.7670, 1.0e-4); // S/P 1: Lmes = Lp, so m = 0.7670 + 0.3334 lg Lp
    EXPECT_NEAR(cone_share(0.1), 0.4336, 1.0e-4);
    double last = -1.0;
    for (double l = 1.0e-5; l < 20.0; l *= 1.01) {
        EXPECT_GE(cone_share(l), last);
        last = cone_share(l);
    }
    EXPECT_NEAR(rod_luminance_cdm2(glm::dvec3(3.0)), 3.0, 1.0e-12);
    // By hand: red has X 0.4124, Y 0.2126, Z 0.0193: 0.2126 (1.33 * 1.5623 - 1.68) / 2.573 = 0.0329.
    EXPECT_NEAR(rod_luminance_cdm2({1.0, 0.0, 0.0}), 0.0329, 1.0e-4);
    EXPECT_GT(rod_luminance_cdm2({0.0, 0.0, 1.0}), 2.0 * 0.0722);
    EXPECT_EQ(rod_luminance_cdm2(glm::dvec3(0.0)), 0.0);
}

TEST(NightVision, AdaptsToOneDegreeAround) {
    Image<glm::vec3> light(101, 101, glm::vec3(0.0F));
    light.at(50, 50) = glm::vec3(441.0F); // 21 x 21 pixels are 1.05 degrees
    const Image<float> adapted = adaptation_cdm2(light, pixel_deg);
    EXPECT_NEAR(adapted.at(50, 50), 1.0F, 1.0e-4F);
    EXPECT_NEAR(adapted.at(60, 40), 1.0F, 1.0e-4F);
    EXPECT_EQ(adapted.at(61, 50), 0.0F);
    light = Image<glm::vec3>(30, 20, glm::vec3(2.0F));
    EXPECT_NEAR(adaptation_cdm2(light, pixel_deg).at(0, 0), 2.0F, 1.0e-5F); // cut at the edge, not darker there
}

TEST(NightVision, BrightPicturesKeepTheirBytesAndDarkRedIsGreyAndDarker) {
    Image<glm::vec3> light(64, 48);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x)
            light.at(x, y) = glm::vec3(20.0F + static_cast<float>(x), 30.0F, 10.0F + static_cast<float>(y));
    EXPECT_EQ(colours_at_night(light, pixel_deg), light);
    EXPECT_EQ(sharpness_at_night(light, pixel_deg), light); // 50 cycles a degree: sigma 0.007 degrees, 0.14 pixels
    EXPECT_TRUE(sharpness_at_night(Image<glm::vec3>(), pixel_deg).empty());
    const Image<glm::vec3> dark(40, 40, glm::vec3(0.004F, 0.0F, 0.0F));
    const glm::vec3 seen = colours_at_night(dark, pixel_deg).at(20, 20);
    EXPECT_EQ(std::tuple(seen.x, seen.y), std::tuple(seen.y, seen.z));
    EXPECT_NEAR(seen.x, 0.004F * 0.0329F, 1.0e-6F);
}

/// A grating of the finest period that the eye resolves keeps a tenth of its contrast; one three times as coarse nearly all of it.
TEST(NightVision, GratingsAtTheLimitKeepATenth) {
    const double mean_cdm2 = 0.01, finest = acuity_cycles_per_deg(mean_cdm2), fine_pixel_deg = 0.01;
    for (const auto& [coarser, kept] : {std::pair(1.0, 0.1), std::pair(3.0, std::pow(0.1, 1.0 / 9.0))}) {
        const int width = 400;
        Image<glm::vec3> light(width, 200);
        for (int y = 0; y < 200; ++y)
            for (int x = 0; x < width; ++x)
                light.at(x, y) = glm::vec3(
                    static_cast<float>(mean_cdm2 * (1.0 + 0.5 * std::sin(2.0 * std::numbers::pi * x * fine_pixel_deg * finest / coarser))));
        const Image<glm::vec3> seen = sharpness_at_night(light, fine_pixel_deg);
        float most = 0.0F, least = 1.0F;
        for (int x = 100; x < 300; ++x) {
            most = std::max(most, seen.at(x, 100).x);
            least = std::min(least, seen.at(x, 100).x);
        }
        EXPECT_NEAR(static_cast<double>((most - least) / (most + least)) / 0.5, kept, 0.06) << coarser;
    }
}

constexpr double fov_rad = 0.7;

glm::dvec3 pixel_direction(const Image<glm::vec3>& picture, int x, int y) {
    const double step = 2.0 * std::tan(0.5 * fov_rad) / picture.height();
    return glm::normalize(glm::dvec3((x - 0.5 * (picture.width() - 1)) * step, (0.5 * (picture.height() - 1) - y) * step, 1.0));
}

/// lx at the eye, across the direction: luminance times solid angle, step^2 cos^3.
double pixel_lx(const Image<glm::vec3>& picture, int x, int y) {
    const double step = 2.0 * std::tan(0.5 * fov_rad) / picture.height(), cosine = pixel_direction(picture, x, y).z;
    return static_cast<double>(picture.at(x, y).y) * step * step * cosine * cosine * cosine;
}

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / std::numbers::pi;
}

/// A sum over all pairs, as it stands on paper.
double veil_by_hand(const Image<glm::vec3>& picture, const ScatterFunction& f, int x, int y) {
    const glm::dvec3 eye = pixel_direction(picture, x, y);
    double sum = 0.0;
    for (int k = 0; k < picture.height(); ++k)
        for (int i = 0; i < picture.width(); ++i)
            if (i != x || k != y) {
                const glm::dvec3 there = pixel_direction(picture, i, k);
                sum += f.at(angle_deg(eye, there)) * std::max(glm::dot(eye, there), 0.0) * pixel_lx(picture, i, k);
            }
    return sum;
}

Image<glm::vec3> night_picture(int width, int height) {
    Image<glm::vec3> picture(width, height, glm::vec3(0.0F));
    std::mt19937 random(1);
    const int horizon = height / 2;
    for (int y = horizon; y < height; ++y)
        for (int x = 0; x < width; ++x)
            picture.at(x, y) = glm::vec3(6.0F * static_cast<float>(y - horizon) / static_cast<float>(height));
    for (int i = 0; i < 12; ++i) {
        const auto y = static_cast<int>(random() % static_cast<unsigned>(height)); // one after the other: compilers order arguments freely
        picture.at(static_cast<int>(random() % static_cast<unsigned>(width)), y) = glm::vec3(3000.0F, 2500.0F, 2000.0F);
    }
    return picture;
}

TEST(Scatter, FunctionIsTheGlareEquation) {
    const GlareEye eye{60.0, 1.0};
    const ScatterFunction f = eye_scatter(eye);
    for (const double theta : {0.1, 0.3, 1.0, 5.0, 30.0, 100.0}) {
        const Value veil = veiling_luminance_cdm2(VeilingEquation::cie_general, {{2.0, theta}}, eye);
        ASSERT_TRUE(veil.number());
        EXPECT_NEAR(2.0 * f.at(theta), *veil.number(), 1.0e-12 * *veil.number()) << theta;
    }
    EXPECT_EQ(f.at(0.0999), 0.0);
    EXPECT_EQ(f.at(100.1), 0.0);
}

TEST(Scatter, ShareIsTheIntegral) {
    // f = 1 / theta^2 in degrees from a to b: small angles give (180/pi)^-2 * 2 pi ln(b / a).
    const ScatterFunction f{0.0, 1.0, 0.0, 0.0, 0.01, 1.0};
    EXPECT_NEAR(f.share(), 2.0 * std::numbers::pi * std::log(100.0) / std::pow(180.0 / std::numbers::pi, 2.0), 1.0e-6);
    const ScatterFunction even{0.0, 0.0, 0.0, 1.0 / std::numbers::pi, 1.0e-6, 90.0}; // a matt sheet
    EXPECT_NEAR(even.share(), 1.0, 1.0e-4);
    // By hand, small angles: 1.914e-3 (10 (1/0.1 - 1/90) + 5.128 ln(900) + 0.0513 * 90) = 0.267; the cosine takes some off the far end.
    EXPECT_NEAR(eye_scatter({}).share(), 0.26, 0.005);
    const ScatterFunction haze = windscreen_scatter(0.02);
    ScatterFunction counted = haze;
    counted.from_deg = 2.5;
    EXPECT_NEAR(counted.share(), 0.02, 1.0e-9);
    EXPECT_EQ(windscreen_scatter(0.0).share(), 0.0);
}

TEST(Scatter, TreeAgreesWithAllPairs) {
    const Image<glm::vec3> picture = night_picture(96, 72);
    ScatterFunction f = eye_scatter({});
    f.from_deg = 0.4; // beyond a pixel of 0.55 degrees: what lies within one is another test's
    double last = 1.0;
    for (const auto& [cells, bound] : {std::pair(1, 0.04), std::pair(2, 0.008), std::pair(4, 0.0015), std::pair(8, 0.0005)}) {
        const Image<glm::vec3> shown = scattered(picture, fov_rad, f, {cells});
        double worst = 0.0;
        for (int y = 0; y < 72; y += 3)
            for (int x = 0; x < 96; x += 3) {
                if (picture.at(x, y).y == 0.0F) // there is nothing but veil
                    worst = std::max(worst, std::abs(static_cast<double>(shown.at(x, y).y) / veil_by_hand(picture, f, x, y) - 1.0));
            }
        EXPECT_LT(worst, bound) << cells;
        EXPECT_LT(worst, last) << cells;
        last = worst;
    }
}

TEST(Scatter, OneSourceVeilsAsTheEquationSays) {
    Image<glm::vec3> picture(401, 301, glm::vec3(0.0F));
    picture.at(100, 150) = glm::vec3(1.0e5F, 0.0F, 0.0F);
    const ScatterFunction f = eye_scatter({});
    const Image<glm::vec3> shown = scattered(picture, fov_rad, f);
    picture.at(100, 150).y = 1.0e5F; // whose luminance pixel_lx takes
    const double lx = pixel_lx(picture, 100, 150);
    for (const auto& [x, y] : {std::pair(104, 150), std::pair(100, 200), std::pair(300, 20), std::pair(400, 300), std::pair(0, 0)}) {
        const glm::dvec3 a = pixel_direction(picture, 100, 150), b = pixel_direction(picture, x, y);
        EXPECT_NEAR(static_cast<double>(shown.at(x, y).x) / (lx * f.at(angle_deg(a, b)) * glm::dot(a, b)), 1.0, 0.02) << x << ' ' << y;
        EXPECT_EQ(shown.at(x, y).y, 0.0F); // the veil has the source's colour
    }
}

/// A lamp that sends 1 lx to the eye, with pixels of a third and of a 24th of a degree: the veil is that of the equation and of each other.
TEST(Scatter, TheVeilOfALampDoesNotDependOnThePixels) {
    const ScatterFunction f = eye_scatter({25.0, 0.5});
    std::vector<std::vector<double>> veils;
    for (const int a_degree : {3, 24}) {
        const int width = 40 * a_degree + 1, height = 6 * a_degree + 1;
        const double step = std::tan(1.0 * std::numbers::pi / 180.0) / a_degree;
        Image<glm::vec3> picture(width, height, glm::vec3(0.0F));
        picture.at(width / 2, height / 2) = glm::vec3(static_cast<float>(1.0 / (step * step))); // whose solid angle is step^2
        const Image<glm::vec3> shown = scattered(picture, 2.0 * std::atan(0.5 * height * step), f);
        std::vector<double>& found = veils.emplace_back();
        for (const int degrees : {1, 3, 10}) {
            const double theta = std::atan(degrees * a_degree * step);
            found.push_back(static_cast<double>(shown.at(width / 2 + degrees * a_degree, height / 2).y));
            EXPECT_NEAR(found.back() / (f.at(theta * 180.0 / std::numbers::pi) * std::cos(theta)), 1.0, 0.02) << degrees << ' ' << a_degree;
        }
    }
    EXPECT_NEAR(veils[0][0], 15.1805, 0.02 * 15.1805); // by hand (tests/metrics/glare/glare_test.cpp)
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(veils[0][i] / veils[1][i], 1.0, 0.02);
}

/// Where all round is as bright, nothing is gained or lost; what lies within a pixel counts as kept.
TEST(Scatter, EvenLightStaysEvenAndNothingScatteredIsTheSamePicture) {
    for (const int height : {60, 150, 300, 600}) {
        const Image<glm::vec3> even(height, height, glm::vec3(5.0F));
        ScatterFunction f = eye_scatter({});
        f.to_deg = 15.0; // so that all of it comes from within the picture
        EXPECT_NEAR(scattered(even, fov_rad, f).at(height / 2, height / 2).y, 5.0F, 0.02F) << height;
    }
    const Image<glm::vec3> picture = night_picture(40, 30);
    EXPECT_EQ(scattered(picture, fov_rad, windscreen_scatter(0.0)), picture);
    EXPECT_TRUE(scattered(Image<glm::vec3>(), fov_rad, eye_scatter({})).empty());
}

constexpr double deg = std::numbers::pi / 180.0;

/// By hand: tan 20 degrees = 0.3639702; / 768 = 4.739196e-4 rad, twice that 3.25841'; 2.1 mm / 2.5 m = 8.4e-4 rad = 2.88771';
/// 768 * 2.1 mm / 0.7279405 = 2.21556 m.
TEST(SeenSize, OfTheProjectorByHandAndOfTheEyeHalfAPeriod) {
    const SeenSize seen = seen_size(40.0 * deg, 768, 2.1, 2.5);
    EXPECT_NEAR(seen.scene_pixel_arcmin, 3.25841, 1.0e-4);
    EXPECT_NEAR(seen.display_pixel_arcmin, 2.88771, 1.0e-4);
    EXPECT_NEAR(seen.magnification(), 0.88624, 1.0e-4);
    EXPECT_NEAR(seen.life_size_m, 2.21556, 1.0e-4);
    for (const double fov : {0.01 * deg, 40.0 * deg, 120.0 * deg, 179.0 * deg})
        for (const int rows : {64, 768, 16384}) {
            const double from_m = seen_size(fov, rows, 0.27, 1.0).life_size_m;
            EXPECT_NEAR(seen_size(fov, rows, 0.27, from_m).magnification(), 1.0, 1.0e-12) << fov << ' ' << rows;
        }
    EXPECT_NEAR(seen_size(40.0 * deg, 768, 0.27, 2.0 * seen_size(40.0 * deg, 768, 0.27, 1.0).life_size_m).magnification(), 0.5, 1.0e-6);
    EXPECT_NEAR(seen_size(40.0 * deg, 1, 0.27, 1.0).scene_pixel_arcmin, 40.0 * 60.0, 1.0e-9); // one row sees it all
    /// 30 cycles a degree are a minute of arc to half a period. Of Larson, Rushmeier and Piatko's fit: 17.25 atan(0.35) + 25.72 = 31.53 at
    /// 1 cd/m2, 5.31 at 0.01.
    EXPECT_NEAR(resolved_arcmin(1.0), 30.0 / 31.5276, 1.0e-4);
    EXPECT_NEAR(resolved_arcmin(0.01), 5.65, 0.01);
    EXPECT_NEAR(resolved_arcmin(1.0e-6), 9.975, 0.001);
    for (double l = 1.0e-3; l < 1.0e4; l *= 1.5)
        EXPECT_GT(resolved_arcmin(l), resolved_arcmin(1.5 * l));
}

TEST(SeenSize, MeanLuminanceIsThatOfTheCodes) {
    DisplayProfile profile = srgb_display();
    profile.black_cdm2 = 0.5;
    Image<glm::u16vec3> codes(2, 1);
    codes.at(0, 0) = {255, 255, 255};
    EXPECT_NEAR(mean_shown_cdm2(profile, codes), 0.5 + 40.0, 1.0e-9); // white 80 cd/m2, and black
    codes.at(0, 0) = {188, 0, 0};                                     // sRGB 188: 0.502886 of the light
    EXPECT_NEAR(mean_shown_cdm2(profile, codes), 0.5 + 0.5 * 0.2126 * 80.0 * 0.502886, 1.0e-4);
    profile.bits = 16;
    codes.at(0, 0) = codes.at(1, 0) = {65535, 65535, 65535};
    EXPECT_NEAR(mean_shown_cdm2(profile, codes), 80.5, 1.0e-9);
}

} // namespace
} // namespace fernlicht
