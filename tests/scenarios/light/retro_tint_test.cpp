// The colour of retroreflected light keeps the photometric figures that it was measured with.
#include "scenarios/light/light.h"

#include "scenarios/lamps/mounted_lamp.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

const glm::dvec3 weights(0.2126, 0.7152, 0.0722);

double returned(const Material& material, double kelvin) {
    return glm::dot(weights, colour_of_temperature(kelvin).linear_srgb * retro_tint(material));
}

TEST(RetroTint, GreyIsTheLampsOwnColourToTheBit) {
    Material plate{.name = "plate", .retro_rl = 50.0F};
    EXPECT_EQ(retro_tint(plate), glm::dvec3(1.0));
    plate.retro_rgb = glm::vec3(0.3F);
    EXPECT_EQ(retro_tint(plate), glm::dvec3(1.0));
    EXPECT_FALSE(is_tinted(plate));
    const Material dull{.name = "dull", .retro_rgb = {1.0F, 0.0F, 0.0F}};
    EXPECT_FALSE(is_tinted(dull)) << "returns nothing";
}

TEST(RetroTint, LuminanceHoldsInIlluminantAAndFallsInBluerLight) {
    Material reflector{.name = "reflector", .retro_rl = 120.0F, .retro_rgb = {1.0F, 0.0F, 0.0F}};
    EXPECT_NEAR(returned(reflector, 2856.0), 1.0, 1e-12);
    EXPECT_LT(returned(reflector, 3200.0), 0.97);
    EXPECT_LT(returned(reflector, 4300.0), 0.85);
    EXPECT_GT(returned(reflector, 4300.0), 0.6);
    EXPECT_EQ(retro_tint(reflector).g, 0.0);
    const glm::dvec3 full = retro_tint(reflector);
    reflector.retro_rgb *= 0.5F;
    EXPECT_NEAR(glm::length(retro_tint(reflector) - full), 0.0, 1e-12) << "its size says nothing";
    reflector.retro_rgb = {0.8F, 0.55F, 0.0F}; // yellow
    EXPECT_NEAR(returned(reflector, 2856.0), 1.0, 1e-12);
}

} // namespace
} // namespace fernlicht
