#include "scenarios/display/display_profile.h"
#include "scenarios/display/white_adaptation.h"
#include "scenarios/drives/edits/adapting_white.h"
#include "tests/trial.h"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace fernlicht {
namespace {

const glm::dvec3 equal_energy(100.0), d65_white(95.047, 100.0, 108.883), warm_white(109.85, 100.0, 35.585);

void expect_xyz(const glm::dvec3& value, const glm::dvec3& wanted, double within) {
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(value[i], wanted[i], within) << i;
}

/// The two-step transform of Zhai and Luo 2018 (doi:10.1364/OE.26.007724): each white to a baseline, by its own degree.
glm::dvec3 by_baseline(const glm::dvec3& xyz, const glm::dvec3& from, double from_degree, const glm::dvec3& to, double to_degree,
                       const glm::dvec3& baseline) {
    return glm::inverse(cat16(to, baseline, to_degree)) * (cat16(from, baseline, from_degree) * xyz);
}

// Values that the colour-science package (0.4) publishes for CAT16.
TEST(WhiteAdaptation, Cat16GivesThePublishedCorrespondingColours) {
    expect_xyz(by_baseline({48.9, 43.62, 6.25}, warm_white, 0.9407, d65_white, 0.98, equal_energy), {40.37398343, 43.69426311, 20.51733764},
               1.0e-7);
    expect_xyz(
        by_baseline({52.034, 58.824, 23.703}, {92.288, 100.0, 38.775}, 0.6709, {105.432, 100.0, 137.392}, 0.5331, {97.079, 100.0, 141.798}),
        {56.77130011, 58.81317888, 64.66922808}, 1.0e-7);
}

TEST(WhiteAdaptation, WhitesMeetAtDegreeOneAndNothingMovesAtZero) {
    expect_xyz(cat16(warm_white, d65_white, 1.0) * warm_white, d65_white, 1.0e-10);
    expect_xyz(cat16(warm_white, d65_white, 0.0) * glm::dvec3(20.0, 30.0, 40.0), {20.0, 30.0, 40.0}, 1.0e-12);
    EXPECT_NEAR((cat16(warm_white, d65_white, 0.66) * warm_white).y, 100.0, 1.0e-10); // white keeps its luminance by any degree
}

/// Of the purple the middle receptors get -0.25 14 + 1.204 + 0.046 5 < 0; of the deepest red of the spectrum they still get something.
TEST(WhiteAdaptation, NoEyeAdaptsToLightThatAReceptorGetsLessThanNothingOf) {
    EXPECT_FALSE(can_adapt_to({0.7, 0.05}));
    EXPECT_FALSE(can_adapt_to({0.3, 0.0}));
    for (const glm::dvec2& light : {glm::dvec2(0.3127, 0.329), glm::dvec2(0.7347, 0.2653), glm::dvec2(0.15, 0.06)})
        EXPECT_TRUE(can_adapt_to(light)) << light.x << ", " << light.y;
}

// D = 0.8 (1 - exp(-(L_A + 42) / 92) / 3.6), by hand: exp(-42/92) = 0.633484, exp(-43/92) = 0.626635, exp(-(64 + 42)/92) = 0.315953.
TEST(WhiteAdaptation, DegreeIsThatOfADarkSurround) {
    EXPECT_NEAR(adaptation_degree(0.0), 0.8 * (1.0 - 0.633484 / 3.6), 1.0e-6);
    EXPECT_NEAR(adaptation_degree(1.0), 0.8 * (1.0 - 0.626635 / 3.6), 1.0e-6);
    EXPECT_NEAR(adaptation_degree(64.0), 0.8 * (1.0 - 0.315953 / 3.6), 1.0e-6);
    EXPECT_NEAR(adaptation_degree(1.0e5), 0.8, 1.0e-12);
}

/// Chromaticity of a lamp's own light, as it is shown to an eye that is adapted to it.
glm::dvec2 shown_white(double kelvin, double degree) {
    const glm::dvec3 lamp = colour_of_temperature(kelvin).linear_srgb;
    const WhiteAdaptation white{degree, chromaticity_of(xyz_from_light() * lamp)};
    return chromaticity_of(xyz_from_light() * (light_adaptation(white).value_or(glm::dmat3(1.0)) * lamp));
}

TEST(WhiteAdaptation, HalogenBecomesNeutralWhollyAndWarmByTheUsualDegree) {
    const glm::dvec2 d65 = chromaticity_of(xyz_from_light() * glm::dvec3(1.0));
    EXPECT_LT(glm::distance(shown_white(3200.0, 1.0), d65), 1.0e-9);
    const glm::dvec2 as_it_is = shown_white(3200.0, 0.0), usual = shown_white(3200.0, 0.66);
    EXPECT_NEAR(as_it_is.x, 0.4234, 5.0e-4); // Planck's locus
    EXPECT_NEAR(usual.x, 0.3457, 5.0e-4);    // near 5000 K: warm, not orange
    EXPECT_NEAR(usual.y, 0.3499, 5.0e-4);
    EXPECT_LT(shown_white(4300.0, 0.66).x, usual.x); // xenon stays the cooler one
    EXPECT_GT(shown_white(4300.0, 0.66).x, d65.x);
}

LampSet set_of(const std::string& name, double kelvin, double level = 1.0) {
    LampSet set{name, {}, {}};
    set.lamps.emplace_back();
    set.lamps.back().name = "left";
    set.lamps.back().level = level;
    set.lamps.back().colour = colour_of_temperature(kelvin);
    return set;
}

glm::dvec2 white_found(Drive drive) {
    close_white(drive, white_of_lamps(drive));
    return *drive.display.white.chromaticity;
}

TEST(WhiteAdaptation, OfTheDriveNotOfOneLampSetWhenSeveralAreCompared) {
    Drive halogen, xenon, both, dark;
    halogen.lamp_sets = {set_of("halogen", 3200.0)};
    xenon.lamp_sets = {set_of("xenon", 4300.0)};
    both.lamp_sets = {halogen.lamp_sets[0], xenon.lamp_sets[0]};
    dark.lamp_sets = {set_of("off", 3200.0, 0.0)};
    const glm::dvec2 warm = white_found(halogen), cool = white_found(xenon), mean = white_found(both);
    EXPECT_NEAR(warm.x, 0.4234, 5.0e-4);
    EXPECT_GT(warm.x, mean.x + 0.01);
    EXPECT_GT(mean.x, cool.x + 0.01);
    EXPECT_LT(glm::distance(white_found(dark), glm::dvec2(0.3127, 0.3290)), 2.0e-4);
    halogen.lamp_sets[0].lamps.push_back(xenon.lamp_sets[0].lamps[0]);
    halogen.lamp_sets[0].lamps.back().name = "high-left";
    EXPECT_EQ(white_found(halogen), warm); // by its low beams
    close_white(halogen, white_of_lamps(halogen));
    EXPECT_EQ(*halogen.display.white.degree, 0.66);
}

TEST(WhiteAdaptation, ByDayTheSkyIsWhiteAndWhatIsGivenStays) {
    Drive day;
    day.lamp_sets = {set_of("halogen", 3200.0)};
    day.daylight.horizontal_illuminance_lx = 1.0e4;
    close_white(day, white_of_lamps(day));
    EXPECT_LT(glm::distance(*day.display.white.chromaticity, glm::dvec2(0.3127, 0.3290)), 1.0e-3);
    EXPECT_NEAR(*day.display.white.degree, 0.79, 0.011); // L_A = 254 cd/m2
    Drive given;
    given.lamp_sets = {set_of("halogen", 3200.0)};
    given.display.white = {0.3, glm::dvec2(0.35, 0.36)};
    close_white(given, white_of_lamps(given));
    EXPECT_EQ(given.display.white, (WhiteAdaptation{0.3, glm::dvec2(0.35, 0.36)}));
    EXPECT_EQ(adaptation_text(given.display.white), "white adapted 0.3 to x=0.3500 y=0.3600");
    EXPECT_EQ(adaptation_text({0.0, glm::dvec2(0.35, 0.36)}), "");
    EXPECT_FALSE(light_adaptation({}));
}

} // namespace
} // namespace fernlicht
