#include "metrics/display/scatter.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace fernlicht {
namespace {

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
    for (int y = height / 2; y < height; ++y)
        for (int x = 0; x < width; ++x)
            picture.at(x, y) = glm::vec3(6.0F * static_cast<float>(y - height / 2) / static_cast<float>(height));
    for (int i = 0; i < 12; ++i)
        picture.at(static_cast<int>(random() % static_cast<unsigned>(width)), static_cast<int>(random() % static_cast<unsigned>(height))) =
            glm::vec3(3000.0F, 2500.0F, 2000.0F);
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

/// Where all round is as bright, nothing is gained or lost; what lies within a pixel counts as kept.
TEST(Scatter, EvenLightStaysEven) {
    for (const int height : {60, 150, 300, 600}) {
        const Image<glm::vec3> even(height, height, glm::vec3(5.0F));
        ScatterFunction f = eye_scatter({});
        f.to_deg = 15.0; // so that all of it comes from within the picture
        EXPECT_NEAR(scattered(even, fov_rad, f).at(height / 2, height / 2).y, 5.0F, 0.02F) << height;
    }
}

TEST(Scatter, NothingScatteredIsTheSamePicture) {
    const Image<glm::vec3> picture = night_picture(40, 30);
    EXPECT_EQ(scattered(picture, fov_rad, windscreen_scatter(0.0)), picture);
    EXPECT_TRUE(scattered(Image<glm::vec3>(), fov_rad, eye_scatter({})).empty());
}

} // namespace
} // namespace fernlicht
