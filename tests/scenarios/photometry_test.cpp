// Textures and own colours combined: against values worked out by hand from table 3.22 of OpenGL 1.5.
#include "scenarios/photometry.h"
#include "scenarios/values/scene.h"

#include <gtest/gtest.h>

namespace fernlicht {
namespace {

using photometry::combined_reflectance, photometry::textured_rl;

constexpr glm::dvec3 own(0.5, 0.25, 0.125), blend_colour(1.0, 0.5, 0.0);
constexpr glm::dvec4 texel(0.75, 0.5, 0.25, 0.25);

glm::dvec3 combined(TextureMode mode, const glm::dvec4& t = texel) {
    return combined_reflectance(static_cast<int>(mode), own, t, blend_colour);
}

// All numbers are sums of powers of two, so that equality is exact.
TEST(CombinedReflectance, IsThatOfTheTable) {
    EXPECT_EQ(combined(TextureMode::modulate), glm::dvec3(0.375, 0.125, 0.03125));
    EXPECT_EQ(combined(TextureMode::modulate, glm::dvec4(1.0)), own);
    EXPECT_EQ(combined(TextureMode::replace), glm::dvec3(0.75, 0.5, 0.25));
    // 0.75 Cf + 0.25 Ct: 0.375 + 0.1875, 0.1875 + 0.125, 0.09375 + 0.0625.
    EXPECT_EQ(combined(TextureMode::decal), glm::dvec3(0.5625, 0.3125, 0.15625));
    EXPECT_EQ(combined(TextureMode::decal, {0.75, 0.5, 0.25, 0.0}), own);
    EXPECT_EQ(combined(TextureMode::decal, {0.75, 0.5, 0.25, 1.0}), glm::dvec3(0.75, 0.5, 0.25));
    // Cf (1 - Ct) + Cc Ct, channel by channel: 0.5 0.25 + 1 0.75, 0.25 0.5 + 0.5 0.5, 0.125 0.75 + 0.
    EXPECT_EQ(combined(TextureMode::blend), glm::dvec3(0.875, 0.375, 0.09375));
    const glm::dvec4 clear(0.75, 0.5, 0.25, 0.0);
    for (const TextureMode mode : {TextureMode::modulate, TextureMode::replace, TextureMode::blend})
        EXPECT_EQ(combined(mode, clear), combined(mode));
}

TEST(TexturedRl, GoesWithTheLuminanceOfTheReflectanceUnlessTheOwnColourIsBlack) {
    EXPECT_DOUBLE_EQ(textured_rl(0.015, glm::dvec3(0.2), glm::dvec3(0.1)), 0.0075);
    EXPECT_DOUBLE_EQ(textured_rl(0.1, {0.5, 0.5, 0.5}, {0.5, 0.0, 0.0}), 0.1 * 0.2126);
    EXPECT_DOUBLE_EQ(textured_rl(0.1, {0.25, 0.5, 0.0}, {0.25, 0.5, 0.0}), 0.1);
    EXPECT_EQ(textured_rl(0.1, glm::dvec3(0.2), glm::dvec3(0.0)), 0.0);
    EXPECT_EQ(textured_rl(0.1, glm::dvec3(0.0), glm::dvec3(0.3)), 0.1);
}

/// Worst difference over a fine sweep.
template <class Error> double worst(double from, double to, Error error) {
    double most = 0.0;
    constexpr int steps = 200'000;
    for (int i = 0; i <= steps; ++i)
        most = std::max(most, std::abs(error(from + (to - from) * i / steps)));
    return most;
}

TEST(QuickFunctions, StayWithinWhatTheySay) {
    EXPECT_LT(worst(0.0, 1.0, [](double t) { return photometry::quick_atan_unit(t) - std::atan(t); }), 4e-8);
    EXPECT_LT(
        worst(-pi, pi,
              [](double a) { return photometry::quick_atan(std::sin(a) * 3.0, std::cos(a) * 3.0) - std::atan2(std::sin(a), std::cos(a)); }),
        1e-7);
    EXPECT_LT(worst(-0.5, 0.5, [](double s) { return photometry::quick_asin_half(s) - std::asin(s); }), 3e-8);
    EXPECT_LT(worst(0.0, 1.0, [](double c) { return 255.0 * (photometry::quick_srgb_encoded(c) - photometry::srgb_encoded(c)); }), 0.01);
}

TEST(QuickFunctions, AsinBeyondThirtyDegreesStaysBeyondAndNothingIsNaN) {
    double last = photometry::quick_asin_half(0.5);
    EXPECT_NEAR(last, pi / 6.0, 3e-8);
    for (int i = 1; i <= 1000; ++i) {
        const double next = photometry::quick_asin_half(0.5 + 0.0005 * i);
        EXPECT_GT(next, last);
        last = next;
    }
    EXPECT_EQ(photometry::quick_atan(0.0, 0.0), 0.0);
    EXPECT_FALSE(std::isnan(photometry::quick_srgb_encoded(0.0)));
}

TEST(QuickFunctions, AnglesAreThoseOfTheGoniometer) {
    for (const bool steep : {false, true})
        for (int h = -89; h <= 89; ++h)
            for (int v = -29; v <= 29; ++v) {
                const double a = h * pi / 180.0, b = v * pi / 180.0;
                const glm::dvec3 w = 7.0 * glm::dvec3(std::sin(a) * std::cos(b), std::sin(b), std::cos(a) * std::cos(b));
                const glm::dvec2 quick = photometry::quick_goniometer_angles(w, 1.0 / 7.0, steep);
                EXPECT_NEAR(quick.x, a, 1e-7);
                EXPECT_NEAR(quick.y, b, 1e-7);
            }
}

} // namespace
} // namespace fernlicht
