// Lamps made from the shipped tables, with what was done to them known: each change found and named, nothing else claimed.
#include "metrics/beam/lamp_difference.h"

#include "metrics/regulation/named_places.h"
#include "scenarios/lamps/lamp_model.h"
#include "tests/metrics/changed_lamps.h"
#include "tests/metrics/measured_lamps.h"
#include "tests/trial.h"

#include <cmath>
#include <gtest/gtest.h>

namespace fernlicht {
namespace {

/// Every second row and column.
CandelaTable thinned(const CandelaTable& table) {
    CandelaTable out{.rule = table.rule};
    for (std::size_t h = 0; h < table.h_deg.size(); h += 2)
        out.h_deg.push_back(table.h_deg[h]);
    for (std::size_t v = 0; v < table.v_deg.size(); v += 2) {
        out.v_deg.push_back(table.v_deg[v]);
        for (std::size_t h = 0; h < table.h_deg.size(); h += 2)
            out.cd.push_back(table.at(v, h));
    }
    return out;
}

/// The lamp turned on its mount, upwards, measured over the same angles again.
CandelaTable pitched(const CandelaTable& table, double up_deg) {
    CandelaTable out = table;
    for (std::size_t v = 0; v < table.v_deg.size(); ++v)
        for (std::size_t h = 0; h < table.h_deg.size(); ++h) {
            const double pitch = up_deg * 0.017453292519943295, a = table.h_deg[h] * 0.017453292519943295,
                         b = table.v_deg[v] * 0.017453292519943295;
            const double x = std::cos(b) * std::sin(a), y = std::sin(b), z = std::cos(b) * std::cos(a);
            const double y_back = y * std::cos(pitch) - z * std::sin(pitch), z_back = y * std::sin(pitch) + z * std::cos(pitch);
            out.at(v, h) = intensity_cd(table, std::atan2(x, z_back) / 0.017453292519943295, std::asin(y_back) / 0.017453292519943295);
        }
    return out;
}

std::string said(const LampDifference& difference) {
    std::string text;
    for (const std::string& sentence : sentences_of(difference))
        text += sentence + "\n";
    return text;
}

/// What is claimed: "aim", "cut-off", "level", "2 zones", with spaces between.
std::string claims(const LampDifference& found) {
    return std::string(found.aim_up_deg ? "aim " : "") + (found.cut_off_up_deg ? "cut-off " : "") + (found.level ? "level " : "") +
           (found.zones.empty() ? "" : std::to_string(found.zones.size()) + " zones");
}

constexpr unsigned seeds[] = {0, 1};                              // hundreds: ci/calibrate
double noise_of(unsigned seed) { return seed == 0 ? 0.0 : 0.01; } ///< seed 0: none

class LampDifferenceOf : public testing::TestWithParam<const char*> {};

TEST_P(LampDifferenceOf, AnEqualLampIsNone) {
    const CandelaTable lamp = shipped(GetParam());
    EXPECT_FALSE(compare_lamps(lamp, lamp).any());
}

TEST_P(LampDifferenceOf, AZoneFivePercentDimmerIsFoundWithinADegree) {
    const CandelaTable lamp = shipped(GetParam());
    const Zone zone{-8.0, -3.0, -4.0, -1.5};
    for (const unsigned seed : seeds) {
        const LampDifference found = compare_lamps(with_noise(dimmed(lamp, zone, 0.95), noise_of(seed), seed), lamp);
        ASSERT_EQ(claims(found), "1 zones") << "seed " << seed << "\n" << said(found);
        const BeamZone& got = found.zones.front();
        EXPECT_NEAR(got.h_from_deg, zone.left, 1.0);
        EXPECT_NEAR(got.h_to_deg, zone.right, 1.0);
        EXPECT_NEAR(got.v_from_deg, zone.bottom, 1.0);
        EXPECT_NEAR(got.v_to_deg, zone.top, 1.0);
        EXPECT_NEAR(got.share, -0.05, 0.003);
    }
}

TEST_P(LampDifferenceOf, AnAimIsFoundAndNothingElse) {
    const CandelaTable lamp = shipped(GetParam());
    for (const unsigned seed : seeds) {
        const LampDifference found = compare_lamps(with_noise(aimed(lamp, 0.0, 0.3), noise_of(seed), seed), lamp);
        ASSERT_EQ(claims(found), "aim ") << "seed " << seed << "\n" << said(found);
        EXPECT_NEAR(found.aim_up_deg->value, 0.3, 0.01); // asked for: 0.05
        EXPECT_NEAR(found.aim_right_deg->value, 0.0, 0.02);
    }
}

TEST_P(LampDifferenceOf, ALampTurnedOnItsMountIsAnAim) {
    const CandelaTable lamp = shipped(GetParam());
    const LampDifference found = compare_lamps(with_noise(pitched(lamp, -0.3), 0.01, 5), lamp);
    ASSERT_EQ(claims(found), "aim ") << said(found);
    EXPECT_NEAR(found.aim_up_deg->value, -0.3, 0.01);
}

TEST_P(LampDifferenceOf, AnAimAndADimmerZoneAreBothFound) {
    const CandelaTable lamp = shipped(GetParam());
    const LampDifference found = compare_lamps(with_noise(aimed(dimmed(lamp, {-8.0, -3.0, -4.0, -1.5}, 0.95), 0.2, -0.1), 0.01, 6), lamp);
    ASSERT_TRUE(found.aim_up_deg) << said(found);
    EXPECT_NEAR(found.aim_up_deg->value, -0.1, 0.01);
    EXPECT_NEAR(found.aim_right_deg->value, 0.2, 0.02);
    ASSERT_EQ(found.zones.size(), 1U) << said(found);
    EXPECT_NEAR(found.zones.front().share, -0.05, 0.005);
}

/// Another laboratory's angles: a coarser or finer table of the same lamp.
TEST_P(LampDifferenceOf, OtherAnglesOfTheSameLampAreNone) {
    const CandelaTable lamp = shipped(GetParam()), coarse = thinned(lamp);
    for (const LampDifference& found :
         {compare_lamps(lamp, coarse), compare_lamps(coarse, lamp), compare_lamps(with_noise(lamp, 0.01, 7), coarse)})
        EXPECT_FALSE(found.any()) << said(found);
}

TEST_P(LampDifferenceOf, ARaisedCutOffIsNoAim) {
    const CandelaTable lamp = shipped(GetParam());
    for (const unsigned seed : seeds) {
        const LampDifference found = compare_lamps(with_noise(raised_cut_off(lamp, 0.2), noise_of(seed), seed), lamp);
        ASSERT_EQ(claims(found), "cut-off ") << "seed " << seed << "\n" << said(found);
        EXPECT_NEAR(found.cut_off_up_deg->value, 0.2, 0.05);
    }
}

TEST_P(LampDifferenceOf, MoreLightAllOverIsALevel) {
    const CandelaTable lamp = shipped(GetParam());
    const LampDifference found = compare_lamps(with_noise(scaled(lamp, 1.03), 0.01, 4), lamp);
    ASSERT_EQ(claims(found), "level ") << said(found);
    EXPECT_NEAR(found.level->value, 0.03, 0.001);
}

INSTANTIATE_TEST_SUITE_P(Shipped, LampDifferenceOf, testing::Values("halogen-low", "xenon-low"),
                         [](const auto& lamp) { return std::string(lamp.param).substr(0, std::string(lamp.param).find('-')); });

// At most 1 % of pairs may have a claim. Were it just that, 200 pairs would have more than 7 with a chance of 0.1 % (binomial).
#ifdef __SANITIZE_ADDRESS__
constexpr unsigned draws = 10; // enough to meet a memory error
#else
constexpr unsigned draws = 200;
#endif
TEST(LampDifference, NoiseAloneIsNoDifferenceAndMovesNoNamedPlace) {
    const CandelaTable lamp = thinned(shipped("halogen-low")); // a quarter of the time
    int claims = 0, places = 0, beyond_two = 0, beyond_noise = 0;
    std::string what;
    for (unsigned seed = 0; seed < draws; ++seed) {
        const LampDifference found = compare_by_name(with_noise(lamp, 0.01, seed), lamp);
        if (found.any()) {
            ++claims;
            what += said(found);
        }
        for (const PlaceChange& change : found.places) {
            ++places;
            beyond_noise += change.is_beyond_noise;
            beyond_two += std::abs(*change.change()) > 2.0 * *change.uncertainty;
        }
    }
    EXPECT_LE(claims, draws < 200 ? 2 : 7) << what; // with 10 the chance is 0.01 %
    EXPECT_EQ(beyond_noise, 0) << what;
    // A normal error lies beyond two standard errors in 4.6 % of cases. The ± is not too small; that it errs to the large side, for it
    // adds what interpolation of noise leaves open, keeps 0.2 % beyond it: at most 1.6 times too large.
    if (draws == 200) {
        EXPECT_LE(beyond_two, places * 6 / 100);
        EXPECT_GE(beyond_two, places * 2 / 1000);
    }
}

/// Two measurements of one lamp, 1 % of noise on each sample, through files.
class TwoFilesOf : public testing::TestWithParam<measured::Kind> {};

TEST_P(TwoFilesOf, OneLampDifferByNothing) {
    const auto beam = [](double h, double v) {
        const double light = 30000.0 * std::exp(-0.5 * (std::pow(h / 6.0, 2) + std::pow((v + 1.5) / 2.0, 2)));
        return 60.0 + light / (1.0 + std::exp((v + 0.57) / 0.12));
    };

    const auto written = [&](unsigned seed, double level) {
        const LampFile lamp = measured::lamp(GetParam(), 0.5, [&](double h, double v) { return level * beam(h, v); }, {0.01, seed});
        const char* const name = GetParam() == measured::Kind::eulumdat ? "lamp.ldt" : "lamp.ies";
        LampFile read = read_lamp(tests::written(name, measured::file_text(GetParam(), lamp)));
        // What was read is what was measured, in its own order.
        const CandelaTable &own = SampledBeam(lamp).samples(), &again = SampledBeam(read).samples();
        EXPECT_EQ(again.h_deg.size(), own.h_deg.size());
        EXPECT_EQ(again.cd, own.cd);
        return read;
    };
    const LampFile first = written(1, 1.0);
    for (const unsigned seed : {2U, 3U}) {
        const LampDifference found = compare_lamps(written(seed, 1.0), first);
        EXPECT_FALSE(found.any()) << said(found);
        EXPECT_NEAR(found.noise_relative, 0.01 * std::sqrt(2.0), 0.002);
    }
    const LampDifference brighter = compare_lamps(written(4, 1.03), first);
    ASSERT_TRUE(brighter.level) << said(brighter);
    EXPECT_NEAR(brighter.level->value, 0.03, 0.002);
    EXPECT_TRUE(brighter.zones.empty() && !brighter.aim_up_deg) << said(brighter);
}

INSTANTIATE_TEST_SUITE_P(Kinds, TwoFilesOf, testing::ValuesIn(measured::kinds), [](const auto& kind) {
    std::string name = measured::name_of(kind.param);
    std::erase(name, ' ');
    return name;
});

// A file of half the planes stands for both sides: its samples count once, whichever directions they stand for.
TEST(LampDifference, TheHalfOfASymmetricFileThatIsNotStoredSaysNothingNew) {
    const auto beam = [](double h, double v) { return 5000.0 * std::exp(-0.5 * (std::pow(h / 6.0, 2) + std::pow(v / 4.0, 2))) + 50.0; };
    int claims = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        const auto half = [&](unsigned s) {
            CandelaTable t = measured::lamp(measured::Kind::type_a, 1.0, beam, {0.02, s}).table;
            for (std::size_t v = 0; v < t.v_deg.size(); ++v)
                for (std::size_t h = 0; h < t.h_deg.size() / 2; ++h)
                    t.at(v, h) = t.at(v, t.h_deg.size() - 1 - h);
            return t;
        };
        claims += compare_lamps(half(2 * seed), half(2 * seed + 1)).any();
    }
    EXPECT_LE(claims, 3);
}

} // namespace
} // namespace fernlicht
