// The intake check of lamp files: each planted fault is named, and a sound lamp has none.
#include "metrics/beam/intake.h"
#include "metrics/regulation/regulation.h"
#include "scenarios/lamps/goniometer.h"
#include "scenarios/lamps/lamp_model.h"
#include "tests/lamps.h"
#include "tests/metrics/regulation/generated_lamp.h"
#include "tests/shipped.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <iterator>
#include <random>
#include <stdexcept>

namespace fernlicht {
namespace {

using testing::ElementsAre, testing::HasSubstr, testing::IsEmpty;

constexpr bool left_hand = true, right_hand = false;

LampFile lamp_with(CandelaTable table) {
    LampFile lamp;
    lamp.name = "test";
    lamp.table = std::move(table);
    return lamp;
}

LampFile model(const std::string& name) {
    for (const LampModel& one : lamp_models())
        if (one.name == name)
            return lamp_of_model(one);
    throw std::logic_error(name);
}

const std::vector<std::string> low_models{"halogen-low", "xenon-low"}, all_models{"halogen-low", "xenon-low", "halogen-high", "xenon-high"};

/// What of a beam lies at (h, v) of another table, on even steps.
template <class From> LampFile resampled(const LampFile& lamp, double h_deg, double v_deg, double h_step, double v_step, From from) {
    return lamp_with(tests::table_of(tests::steps(-h_deg, h_deg, h_step), tests::steps(-v_deg, v_deg, v_step), [&](double h, double v) {
        const TwoAngles d = from(h, v);
        return intensity_cd(lamp.table, d.h_deg, d.v_deg);
    }));
}

LampFile shifted(const LampFile& lamp, double right_deg, double up_deg) {
    LampFile out = lamp;
    for (double& h : out.table.h_deg)
        h += right_deg;
    for (double& v : out.table.v_deg)
        v += up_deg;
    return out;
}

LampFile scaled_by(LampFile lamp, double factor) {
    lamp.table = scaled(std::move(lamp.table), factor);
    return lamp;
}

/// The part of the table within these angles.
LampFile cut(const LampFile& lamp, double left, double right, double bottom, double top) {
    std::vector<double> h, v;
    std::ranges::copy_if(lamp.table.h_deg, std::back_inserter(h), [&](double x) { return x >= left && x <= right; });
    std::ranges::copy_if(lamp.table.v_deg, std::back_inserter(v), [&](double y) { return y >= bottom && y <= top; });
    return lamp_with(tests::table_of(h, v, [&](double x, double y) { return intensity_cd(lamp.table, x, y); }));
}

std::vector<IntakeFault> faults_of(const LampFile& lamp, const IntakeContext& context = {}) {
    std::vector<IntakeFault> faults;
    for (const IntakeFinding& finding : check_intake(lamp, context).findings)
        faults.push_back(finding.fault);
    return faults;
}

std::string told(const Intake& intake) {
    std::string text = fmt::format("{}, peak {:.0f} cd at {:.2f}, {:.2f}, {:.0f} lm", name_of(intake.function), intake.peak.cd,
                                   intake.peak.h_deg, intake.peak.v_deg, intake.flux_lm);
    if (intake.cut_off_v_deg)
        text += fmt::format(", cut-off {:.2f}, rise {:.2f}, step {:.2f}", *intake.cut_off_v_deg, intake.rise_deg.value_or(0.0),
                            intake.step_deg.value_or(0.0));
    for (const IntakeFinding& finding : intake.findings)
        text += fmt::format("\n  {}{}: {}", name_of(finding.fault), finding.meaningless ? "" : "?", finding.text);
    return text;
}

IntakeFinding only_finding(const LampFile& lamp, const IntakeContext& context = {}) {
    const Intake intake = check_intake(lamp, context);
    EXPECT_EQ(intake.findings.size(), 1u) << told(intake);
    return intake.findings.empty() ? IntakeFinding{} : intake.findings.front();
}

// ---- sound lamps

struct SoundTable {
    const char* regulation;
    BeamFunction function;
};
constexpr SoundTable sound_tables[]{
    {"r149-c", BeamFunction::low},          {"r112-a", BeamFunction::low},          {"r112-b", BeamFunction::low},
    {"r98-d", BeamFunction::low},           {"r123-c", BeamFunction::low},          {"r149-driving-a", BeamFunction::high},
    {"r149-driving-b", BeamFunction::high}, {"r112-driving-a", BeamFunction::high}, {"r112-driving-b", BeamFunction::high},
    {"r98-driving-d", BeamFunction::high},
};

TEST(Intake, NothingIsClaimedOnTwentySoundLampsOfTheGenerator) {
    for (const SoundTable& sound : sound_tables)
        for (const bool left : {right_hand, left_hand}) {
            const CandelaTable table = generated::Lamp(regulation(sound.regulation)).table;
            const LampFile lamp = lamp_with(left ? mirrored(table) : table);
            const Intake recognised = check_intake(lamp, {.left_hand_traffic = left});
            EXPECT_THAT(recognised.findings, IsEmpty()) << sound.regulation << ", left-hand " << left << ": " << told(recognised);
            EXPECT_EQ(recognised.function, sound.function) << sound.regulation << ": " << told(recognised);
            EXPECT_FALSE(recognised.function_stated);
            const Intake stated = check_intake(lamp, {.function = sound.function, .left_hand_traffic = left});
            EXPECT_THAT(stated.findings, IsEmpty()) << sound.regulation << ", left-hand " << left << ": " << told(stated);
            EXPECT_TRUE(stated.function_stated);
        }
}

/// Low beams of our model with other cut-offs, on the steps of files, with noise.
LampFile drawn_low_beam(unsigned seed) {
    std::mt19937 random(seed);
    const auto between = [&](double from, double to) { return std::uniform_real_distribution(from, to)(random); };
    LampModel made = lamp_models()[seed % 2 == 0 ? 0 : 2];
    made.cut_off->level_deg = between(-0.75, -0.35);
    made.cut_off->kink_h_deg = between(-0.7, 0.7);
    made.cut_off->rise_slope = std::tan(between(10.0, 45.0) * 0.0174532925);
    made.cut_off->top_deg = between(0.5, 1.5);
    made.cut_off->softness_deg = between(0.05, 0.2);
    const double noise = between(0.0, 0.02), level = between(0.6, 1.5), step = std::vector{0.05, 0.1, 0.2}[seed % 3];
    std::normal_distribution<double> normal;
    return lamp_with(tests::table_of(tests::steps(-40.0, 40.0, between(0.2, 0.5)), tests::steps(-12.0, 8.0, step), [&](double h, double v) {
        return std::max(0.0, level * model_intensity_cd(made, h, v) * (1.0 + noise * normal(random)));
    }));
}

TEST(Intake, NothingIsClaimedOnLowBeamsWithOtherCutOffsStepsAndNoise) {
    ASSERT_TRUE(lamp_models()[0].cut_off && lamp_models()[2].cut_off);
    for (unsigned seed = 0; seed < 60; ++seed) {
        LampFile lamp = drawn_low_beam(seed);
        const bool left = seed % 4 > 1;
        if (left)
            mirror(lamp);
        const Intake intake = check_intake(lamp, {.left_hand_traffic = left});
        EXPECT_THAT(intake.findings, IsEmpty()) << seed << ": " << told(intake);
        EXPECT_EQ(intake.function, BeamFunction::low) << seed;
        ASSERT_TRUE(intake.rise_deg) << seed;
        EXPECT_EQ(*intake.rise_deg > 0.0, !left) << seed << ": " << told(intake);
    }
}

TEST(Intake, ShippedLampsAreSoundAndTheirCutOffsFound) {
    for (const auto& [file, function] :
         {std::pair{"halogen-low.ies", BeamFunction::low}, std::pair{"xenon-low.ies", BeamFunction::low},
          std::pair{"halogen-high.ies", BeamFunction::high}, std::pair{"xenon-high.ies", BeamFunction::high},
          std::pair{"street-6000lm.ies", BeamFunction::other}, std::pair{"even-0.33lx.csv", BeamFunction::other}}) {
        const Intake intake = check_intake(read_lamp(shipped_library / "lamps" / file));
        EXPECT_THAT(intake.findings, IsEmpty()) << file << ": " << told(intake);
        EXPECT_EQ(intake.function, function) << file << ": " << told(intake);
        if (function == BeamFunction::low) {
            EXPECT_NEAR(intake.cut_off_v_deg.value_or(0.0), -0.57, 0.02) << file;
            EXPECT_NEAR(intake.step_deg.value_or(0.0), 0.05, 1e-6) << file;
        }
    }
}

// ---- nine faults, each on several lamps

TEST(Intake, ACutOffOnTheHorizonOrAboveIsNamed) {
    for (const std::string& name : low_models)
        for (const bool left : {right_hand, left_hand})
            for (const double up : {0.55, 0.57, 0.8, 2.0}) {
                LampFile lamp = shifted(model(name), 0.0, up);
                if (left)
                    mirror(lamp);
                const IntakeFinding finding = only_finding(lamp, {.left_hand_traffic = left});
                EXPECT_EQ(finding.fault, IntakeFault::cut_off_high) << name << " " << up;
                EXPECT_TRUE(finding.meaningless);
                EXPECT_EQ(faults_of(lamp, {.left_hand_traffic = left, .turned_up_deg = -0.57}).empty(), up < 1.0) << "as mounted";
                EXPECT_THAT(faults_of(lamp, {.left_hand_traffic = left, .turned_up_deg = std::nullopt}), IsEmpty())
                    << "aimed by its cut-off";
            }
    EXPECT_THAT(only_finding(shifted(model("xenon-low"), 0.0, 0.57)).text, HasSubstr("on the horizon or above"));
}

TEST(Intake, ALowBeamForAHighBeamAndTheOtherWayRoundIsNamed) {
    for (const std::string& name : all_models) {
        const bool low = std::ranges::find(low_models, name) != low_models.end();
        const BeamFunction own = low ? BeamFunction::low : BeamFunction::high, other = low ? BeamFunction::high : BeamFunction::low;
        for (const bool left : {right_hand, left_hand}) {
            LampFile lamp = model(name);
            if (left)
                mirror(lamp);
            for (const IntakeContext& wrong : {IntakeContext{.function = other, .left_hand_traffic = left},
                                               IntakeContext{.function = {}, .left_hand_traffic = left, .mount = other}}) {
                const IntakeFinding finding = only_finding(lamp, wrong);
                EXPECT_EQ(finding.fault, IntakeFault::function) << name;
                EXPECT_TRUE(finding.meaningless);
                EXPECT_THAT(finding.text, HasSubstr(low ? "it is a low beam by its light" : "it is a high beam by its light"));
                EXPECT_THAT(finding.text, HasSubstr(wrong.mount ? "on the mount of a" : "and is stated to be a"));
            }
            EXPECT_THAT(faults_of(lamp, {.function = {}, .left_hand_traffic = left, .mount = own}), IsEmpty()) << name;
            EXPECT_THAT(faults_of(lamp, {.function = own, .left_hand_traffic = left, .mount = other}), IsEmpty())
                << "what is stated is believed: " << name;
        }
    }
    for (const SoundTable& sound :
         sound_tables) // their own mount is right; the other one is claimed where the light is clear, or not at all
        EXPECT_THAT(faults_of(lamp_with(generated::Lamp(regulation(sound.regulation)).table), {.function = {}, .mount = sound.function}),
                    IsEmpty())
            << sound.regulation;
    for (unsigned seed = 0; seed < 12; ++seed)
        EXPECT_THAT(faults_of(drawn_low_beam(seed), {.function = {}, .mount = BeamFunction::high}), ElementsAre(IntakeFault::function));
    for (const BeamFunction mount :
         {BeamFunction::low, BeamFunction::high}) { // an adaptive beam with a dark tunnel is taken for a low beam; two of neither kind
        const LampFile high = model("xenon-high");
        const LampFile tunnel = resampled(high, 50.0, 20.0, 0.5, 0.2, [](double h, double v) {
            return std::abs(h) < 2.0 && v > -0.5 ? TwoAngles{180.0, 0.0} : TwoAngles{h, v};
        });
        const BeamFunction other = BeamFunction::other;
        for (const auto& [lamp, function] : {std::pair(tunnel, BeamFunction::low), std::pair(lamp_with(tests::even_table(100.0)), other),
                                             std::pair(read_lamp(shipped_library / "lamps/street-6000lm.ies"), other)}) {
            const Intake found = check_intake(lamp, {.function = {}, .mount = mount});
            ASSERT_EQ(found.function, function);
            ASSERT_EQ(found.findings.size(), function == other ? 1U : 0U) << told(found);
            if (function == other) {
                EXPECT_THAT(found.findings[0].text, HasSubstr("is neither a low nor a high beam's, and it is on the mount of a"));
                EXPECT_FALSE(found.findings[0].meaningless);
            }
        }
    }
}

TEST(Intake, ALowBeamAimedAsideOrFarDownIsDoubtful) {
    for (const std::string& name : low_models)
        for (const bool left : {right_hand, left_hand})
            for (const auto& [right, up] : {std::pair{3.0, 0.0}, std::pair{-3.0, 0.0}, std::pair{4.0, 0.0}, std::pair{0.0, -1.15},
                                            std::pair{0.0, -2.5}, std::pair{3.0, -1.5}}) {
                LampFile lamp = shifted(model(name), right, up);
                if (left)
                    mirror(lamp);
                const double aside = left ? -right : right;
                const IntakeContext context{.function = {}, .left_hand_traffic = left};
                const IntakeFinding finding = only_finding(lamp, context);
                EXPECT_EQ(finding.fault, IntakeFault::aim)
                    << name << " " << aside << ", " << up << ": " << told(check_intake(lamp, context));
                EXPECT_FALSE(finding.meaningless);
                EXPECT_THAT(finding.text, HasSubstr("`aim: auto`"));
                EXPECT_EQ(finding.text.find("the cut-off lies") != std::string::npos, up < 0.0) << finding.text;
                EXPECT_EQ(finding.text.find("the elbow lies") != std::string::npos, right != 0.0) << finding.text;
                EXPECT_NEAR(check_intake(lamp, context).elbow_h_deg.value_or(9.0), aside, 0.3) << name;
                EXPECT_THAT(faults_of(lamp, {.function = {}, .left_hand_traffic = left, .turned_up_deg = std::nullopt}), IsEmpty())
                    << "aimed by its cut-off";
                EXPECT_THAT(faults_of(lamp, {.function = {}, .left_hand_traffic = left, .turned_up_deg = -up, .turned_right_deg = -aside}),
                            IsEmpty())
                    << "its mount puts it right";
            }
    EXPECT_THAT(faults_of(model("xenon-low"), {.function = {}, .turned_up_deg = -3.0, .turned_right_deg = 5.0}), IsEmpty())
        << "a sound file that is mounted so is meant so";
}

TEST(Intake, ACutOffSofterThanAnyRegulationHasItIsDoubtful) {
    for (const std::size_t which : {0u, 2u}) {
        LampModel made = lamp_models()[which];
        made.cut_off->softness_deg = 0.4;
        const IntakeFinding finding = only_finding(lamp_of_model(made));
        EXPECT_EQ(finding.fault, IntakeFault::sharpness);
        EXPECT_FALSE(finding.meaningless);
        EXPECT_THAT(finding.text, HasSubstr("G is 0.12 where it is sharpest"));
        made.cut_off->softness_deg = 0.28; // G of 0.16 and 0.17, which regulations allow
        EXPECT_THAT(faults_of(lamp_of_model(made)), IsEmpty()) << made.name;
    }
}

TEST(Intake, LightTenTimesTooWeakIsDoubtful) {
    for (const std::string& name : all_models) {
        const IntakeFinding finding = only_finding(scaled_by(model(name), 0.1));
        EXPECT_EQ(finding.fault, IntakeFault::units) << name;
        EXPECT_FALSE(finding.meaningless) << "a module of several may be so";
        EXPECT_THAT(finding.text, HasSubstr("wrong by a factor"));
    }
    const LampFile flood = lamp_with(tests::table_of(tests::steps(-60.0, 60.0, 1.0), tests::steps(-60.0, 60.0, 1.0),
                                                     [](double h, double v) { return 7400.0 * std::exp(-(h * h + v * v) / 200.0); }));
    EXPECT_EQ(check_intake(flood).function, BeamFunction::high);
    EXPECT_THAT(faults_of(flood), IsEmpty()) << "a spot of " << told(check_intake(flood)) << " is weak, and no headlamp in wrong units";
}

TEST(Intake, ARiseOnTheWrongSideIsNamed) {
    for (const std::string& name : low_models) {
        LampFile lamp = model(name);
        const IntakeFinding on_the_right = only_finding(lamp, {.left_hand_traffic = left_hand});
        EXPECT_EQ(on_the_right.fault, IntakeFault::rise_side);
        EXPECT_THAT(on_the_right.text, HasSubstr("rises to the right"));
        mirror(lamp);
        const IntakeFinding on_the_left = only_finding(lamp);
        EXPECT_EQ(on_the_left.fault, IntakeFault::rise_side);
        EXPECT_TRUE(on_the_left.meaningless);
        EXPECT_THAT(on_the_left.text, HasSubstr("for left-hand traffic, or the table is mirrored"));
    }
    for (unsigned seed = 0; seed < 12; ++seed)
        EXPECT_THAT(faults_of(drawn_low_beam(seed), {.left_hand_traffic = left_hand}), ElementsAre(IntakeFault::rise_side)) << seed;
}

TEST(Intake, FluxBeyondAnyHeadlampIsNamed) {
    for (const std::string& name : all_models)
        for (const double factor : {10.0, 625.0, 1000.0}) {
            const IntakeFinding finding = only_finding(scaled_by(model(name), factor));
            EXPECT_EQ(finding.fault, IntakeFault::flux) << name;
            EXPECT_TRUE(finding.meaningless);
            EXPECT_THAT(finding.text, HasSubstr("no headlamp's beam has so much"));
        }
}

TEST(Intake, APeakWhereNoBeamHasOneIsNamed) {
    for (const std::string& name : all_models)
        for (const auto& [right, up] : {std::pair{20.0, 0.0}, std::pair{-25.0, 0.0}, std::pair{0.0, -8.0}}) {
            const LampFile lamp = shifted(model(name), right, up);
            EXPECT_EQ(only_finding(lamp).fault, IntakeFault::peak) << name << " " << right << " " << up << ": " << told(check_intake(lamp));
        }
    EXPECT_THAT(faults_of(shifted(model("xenon-high"), 0.0, 8.0)), ElementsAre(IntakeFault::peak));
    EXPECT_THAT(faults_of(shifted(model("xenon-low"), 0.0, 12.0)), ElementsAre(IntakeFault::cut_off_high, IntakeFault::peak))
        << "its cut-off is there, too";
}

TEST(Intake, AWrongTypeOrAxisIsNamed) {
    for (const std::string& name : all_models) {
        const LampFile lamp = model(name);
        const LampFile lying = resampled(lamp, 20.0, 50.0, 0.1, 0.1, [](double h, double v) { return TwoAngles{v, h}; });
        EXPECT_EQ(only_finding(lying).fault, IntakeFault::axis) << name << ": " << told(check_intake(lying));
        // As where gamma 0 of type C is the beam's axis and was taken for the nadir.
        const AngleSystem along = beam_along_nadir();
        const LampFile down = resampled(lamp, 180.0, 90.0, 2.0, 0.5, [&](double h, double v) { return along.to_un(h, v); });
        EXPECT_EQ(only_finding(down).fault, IntakeFault::axis) << name << ": " << told(check_intake(down));
        EXPECT_THAT(only_finding(down).text, HasSubstr("--axis"));
    }
    for (const std::string& name : low_models) {
        const LampFile over = resampled(model(name), 50.0, 20.0, 0.2, 0.1, [](double h, double v) { return TwoAngles{h, -v}; });
        EXPECT_THAT(only_finding(over).text, HasSubstr("upside down")) << name;
    }
}

TEST(Intake, CandelaPerThousandLumensAndOtherUnitsAreNamed) {
    for (const std::string name : {"xenon-low", "xenon-high"}) {
        LampFile lamp = scaled_by(model(name), 1.0 / 3.2); // listed per 1000 lm of a D2S, and not multiplied by its flux
        lamp.format = "IES LM-63-2002, type A";
        lamp.declared_flux_lm = 3200.0;
        EXPECT_EQ(only_finding(lamp).fault, IntakeFault::units) << name;
        EXPECT_THAT(only_finding(lamp).text, HasSubstr("multiplied by 3.2"));
        lamp.declared_flux_lm.reset();
        EXPECT_THAT(faults_of(lamp), IsEmpty()) << "nothing tells it from a weak lamp";
        lamp = model(name);
        lamp.declared_flux_lm = 3200.0;
        EXPECT_THAT(faults_of(lamp), IsEmpty()) << "candela, and the source's flux beside them";
    }
    for (const std::string name : {"halogen-low", "halogen-high"}) {
        LampFile lamp = scaled_by(model(name), 1.0 / 1.5);
        lamp.declared_flux_lm = 1000.0;
        EXPECT_EQ(only_finding(lamp).fault, IntakeFault::units) << name;
        EXPECT_FALSE(only_finding(lamp).meaningless) << "H4 has such a source";
    }
    for (const std::string& name : all_models) {
        const LampFile in_lux = scaled_by(model(name), 1.0 / 625.0);
        EXPECT_EQ(only_finding(in_lux).fault, IntakeFault::units) << name;
        EXPECT_TRUE(only_finding(in_lux).meaningless);
        EXPECT_THAT(only_finding(in_lux).text, HasSubstr("lux at 25 m?"));
    }
}

TEST(Intake, CoverageThatCutsTheBeamIsNamed) {
    for (const std::string& name : all_models) {
        const LampFile lamp = model(name);
        for (const LampFile& part : {cut(lamp, -52, 4, -21, 16), cut(lamp, -52, 52, -2, 16)})
            EXPECT_EQ(only_finding(part).fault, IntakeFault::coverage) << name << ": " << told(check_intake(part));
        LampFile with_gap = lamp; // a hole right of the maximum
        CandelaTable& t = with_gap.table;
        t.gaps.assign((t.h_deg.size() - 1) * (t.v_deg.size() - 1), 0);
        for (std::size_t y = 0; y + 1 < t.v_deg.size(); ++y)
            for (std::size_t x = 0; x + 1 < t.h_deg.size(); ++x)
                if (t.h_deg[x] >= 3.0 && t.h_deg[x] < 9.0 && t.v_deg[y] > -3.0 && t.v_deg[y] < 0.0)
                    t.gaps[y * (t.h_deg.size() - 1) + x] = 1;
        EXPECT_EQ(only_finding(with_gap).fault, IntakeFault::coverage) << name;
    }
    EXPECT_TRUE(only_finding(cut(model("halogen-low"), -6, 6, -21, 16)).meaningless);
}

TEST(Intake, StepsTooCoarseForTheCutOffAreNamed) {
    for (const std::string& name : low_models)
        for (const bool left : {right_hand, left_hand})
            for (const double step : {0.25, 0.5, 1.0, 2.0}) {
                LampFile lamp = resampled(model(name), 50.0, 20.0, 0.5, step, [](double h, double v) { return TwoAngles{h, v}; });
                if (left)
                    mirror(lamp);
                const IntakeFinding finding = only_finding(lamp, {.left_hand_traffic = left});
                EXPECT_EQ(finding.fault, IntakeFault::steps)
                    << name << " " << step << ": " << told(check_intake(lamp, {.left_hand_traffic = left}));
                EXPECT_EQ(finding.meaningless, step >= 0.5);
            }
}

TEST(Intake, SwappedSidesAreNamed) {
    for (const std::string& name : all_models)
        for (const bool left_traffic : {right_hand, left_hand}) {
            LampFile left = model(name);
            if (left_traffic)
                mirror(left);
            LampFile right = left;
            const auto tilt = [](LampFile& lamp, double side) { // more wide light to its own side
                for (std::size_t y = 0; y < lamp.table.v_deg.size(); ++y)
                    for (std::size_t x = 0; x < lamp.table.h_deg.size(); ++x)
                        lamp.table.at(y, x) *= 1.0 + 0.3 * std::tanh(side * lamp.table.h_deg[x] / 15.0);
            };
            tilt(left, -1.0);
            tilt(right, 1.0);
            EXPECT_FALSE(swapped_sides(left, right)) << name;
            EXPECT_FALSE(swapped_sides(left, left)) << name;
            const auto by_light = swapped_sides(right, left);
            ASSERT_TRUE(by_light) << name;
            EXPECT_EQ(by_light->fault, IntakeFault::sides);
            EXPECT_FALSE(by_light->meaningless);
            left.name = "beam LH";
            right.name = "beam RH";
            EXPECT_FALSE(swapped_sides(left, right)) << name;
            const auto by_names = swapped_sides(right, left);
            ASSERT_TRUE(by_names) << name;
            EXPECT_TRUE(by_names->meaningless);
            EXPECT_THAT(by_names->text, HasSubstr("the left lamp is called 'beam RH'"));
            std::swap(left.name, right.name);
            EXPECT_FALSE(swapped_sides(right, left)) << "names that agree with where they stand are believed";
            EXPECT_FALSE(swapped_sides(model(name), model(name)));
        }
}

TEST(Intake, ABeamOfAnotherFunctionIsLeftAlone) {
    for (const double peak_h : {0.0, 60.0}) {
        const LampFile wide =
            lamp_with(tests::table_of(tests::steps(-90.0, 90.0, 5.0), tests::steps(-90.0, 90.0, 5.0), [&](double h, double v) {
                return 800.0 * std::exp(-((h - peak_h) * (h - peak_h) + v * v) / 2000.0);
            }));
        EXPECT_EQ(check_intake(wide).function, BeamFunction::other);
        EXPECT_THAT(faults_of(wide), IsEmpty());
    }
    EXPECT_THAT(faults_of(lamp_with(tests::even_table(100.0))), IsEmpty());
    EXPECT_THAT(faults_of(lamp_with(tests::even_table(0.0))), IsEmpty());
    EXPECT_THAT(faults_of(scaled_by(model("xenon-low"), 10.0), {.function = BeamFunction::other}), IsEmpty());
}

} // namespace
} // namespace fernlicht
