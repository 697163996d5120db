// How bright a road is in a low beam, against what was measured on one.
#include "metrics/seeing/visibility.h"
#include "scenarios/lamps/lamp_file.h"
#include "scenarios/roads/mesh/mesh_materials.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

struct Measured {
    double ahead_m;
    std::array<double, 4> cdm2; ///< from left to right
};
// Enhanced Night Visibility, volume VII, FHWA-HRT-04-138, appendix I, table 13: from a car's seat. Neither beam nor pavement is told there.
constexpr std::array<Measured, 4> fhwa{{{20.0, {0.20, 0.17, 0.27, 0.33}},
                                        {30.0, {0.09, 0.12, 0.16, 0.19}},
                                        {50.0, {0.04, 0.03, 0.05, 0.11}},
                                        {80.0, {0.02, 0.03, 0.04, 0.06}}}};

/// The halogen low beams of the library, 0.65 m up; the driver sits 2.2 m behind them. Across a lane 3.5 m wide.
std::array<double, 4> seen_cdm2(const Material& material, double ahead_m) {
    const auto lamp = std::make_shared<const LampFile>(
        read_lamp(std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios" / "library" / "lamps" / "halogen-low.ies"));
    Moment moment;
    for (const double side_m : {0.6, -0.6})
        moment.lamps.push_back({"low", lamp, {{0.0, side_m, 0.65}, axes_from_angles(0.0, 0.0, 0.0)}, 1.0, {}, 0.0});
    std::array<double, 4> seen{};
    std::ranges::transform(std::array{1.75, 0.0, -1.0, -1.75}, seen.begin(), [&](double left_m) {
        return surface_luminance(moment, {ahead_m, left_m, 0.0}, {0.0, 0.0, 1.0}, material, {-2.2, 0.35, 1.2}).photopic_cdm2;
    });
    return seen;
}

TEST(RoadLuminance, OfTheHalogenLowBeamIsTwoToFourTimesWhatTheFhwaMeasured) {
    for (const Measured& at : fhwa) {
        const std::array<double, 4> seen = seen_cdm2(pavement_material(Pavement::asphalt_worn), at.ahead_m);
        double ours = 0.0, theirs = 0.0;
        for (std::size_t k = 0; k < 4; ++k) {
            ours += seen.at(k);
            theirs += at.cdm2.at(k);
        }
        EXPECT_GT(ours / theirs, at.ahead_m > 60.0 ? 0.4 : 2.0) << at.ahead_m;
        EXPECT_LT(ours / theirs, at.ahead_m > 60.0 ? 1.0 : 4.0) << at.ahead_m;
    }
    // By a second program, from the file and the equations.
    const std::array<double, 4> at_30 = seen_cdm2(pavement_material(Pavement::asphalt_worn), 30.0), by_hand{0.358, 0.628, 0.607, 0.486};
    for (std::size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(at_30.at(k), by_hand.at(k), 0.001);
    EXPECT_NEAR(seen_cdm2(pavement_material(Pavement::concrete), 30.0)[1] / at_30[1], 1.33, 0.01);
    EXPECT_NEAR(seen_cdm2(pavement_material(Pavement::asphalt_new), 30.0)[1] / at_30[1], 0.67, 0.01);
}

// L = R_L E_perp. A surface that returns 1 cd/(m2 lx) at every angle tells E_perp.
TEST(RoadLuminance, IsRlTimesTheLuxAcrossTheLight) {
    Material plain;
    plain.albedo = glm::vec3(0.0F);
    plain.retro_rl = 1.0F;
    plain.retro_falloff_rad = 1e9F;
    const std::array<double, 4> lx = seen_cdm2(plain, 30.0), seen = seen_cdm2(pavement_material(Pavement::asphalt_worn), 30.0);
    const std::array<double, 4> by_hand_lx{25.2, 44.3, 43.7, 35.0};
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(lx.at(k), by_hand_lx.at(k), 0.2);
        EXPECT_NEAR(1000.0 * seen.at(k) / lx.at(k), 14.0, 0.3) << "15 mcd/(m2 lx) where EN 1436 has light and eye";
    }
    // Theirs falls 3.7-fold from 30 m to 80 m, ours 24-fold: another beam.
    const std::array<double, 4> at_80 = seen_cdm2(pavement_material(Pavement::asphalt_worn), 80.0);
    const auto sum = [](const std::array<double, 4>& of) { return of[0] + of[1] + of[2] + of[3]; };
    EXPECT_NEAR(sum(seen) / sum(at_80), 24.0, 1.0);
    EXPECT_NEAR(sum(fhwa[1].cdm2) / sum(fhwa[3].cdm2), 3.7, 0.05);
}

} // namespace
} // namespace fernlicht
