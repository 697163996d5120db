// Lamps turned by what is found in their tables: planted cut-offs of both hands, rotations by hand, and the light of our own low beam.
#include "metrics/regulation/installed_aim.h"
#include "scenarios/values/pose.h"
#include "tests/lamps.h"
#include "tests/metrics/changed_lamps.h"
#include "tests/metrics/planted_cut_off.h"
#include "tests/metrics/regulation/generated_lamp.h"

#include <cmath>
#include <gmock/gmock.h>
#include <utility>

namespace fernlicht {
namespace {

using testing::HasSubstr;

/// Of the car's axes: cd in a direction that is so far up and to the right.
double on_car_cd(const MountedLamp& lamp, double up_deg, double right_deg) {
    const double v = radians(up_deg), h = radians(right_deg);
    const glm::dvec3 d = glm::dvec3(std::cos(v) * std::cos(h), -std::cos(v) * std::sin(h), std::sin(v)) * lamp.pose().axes;
    return intensity_cd(lamp.file->table, degrees(std::atan2(-d.y, d.x)), degrees(std::asin(d.z)));
}

MountedLamp mounted(CandelaTable table) {
    MountedLamp lamp;
    lamp.name = "left";
    lamp.position_m = {3.4, 0.6, 0.65};
    lamp.file = tests::file_of(std::move(table));
    return lamp;
}

MountedLamp automatic(CandelaTable table, double cut_off_percent = -1.0) {
    MountedLamp lamp = mounted(std::move(table));
    lamp.aligned = turn_to(aim_mark(lamp.file->table, false), cut_off_percent);
    return lamp;
}

TEST(AimMark, LiesWhereItWasPlantedOnEitherHand) {
    for (const auto& [h, v] : {std::pair(0.0, -0.57), {0.0, 0.0}, {0.0, 0.3}, {-0.5, -0.57}, {0.7, -0.9}})
        for (const double noise : {0.0, 0.01})
            for (const bool left_hand : {false, true}) {
                SCOPED_TRACE(testing::Message() << h << ", " << v << ", noise " << noise << (left_hand ? ", left hand" : ""));
                const CandelaTable table =
                    planted::beam({.elbow_h_deg = h, .level_v_deg = v, .softness_deg = 0.15, .noise = noise, .seed = 7});
                const AimMark mark = aim_mark(left_hand ? mirrored(table) : table, false);
                ASSERT_TRUE(mark.v_deg && mark.h_deg) << mark.why_not;
                EXPECT_EQ(mark.left_hand, left_hand);
                EXPECT_NEAR(*mark.v_deg, v, mark.bound.v_deg + 0.01); // the plant's own slope in V moves the inflection by up to 0.01
                EXPECT_NEAR(*mark.h_deg, left_hand ? -h : h, mark.bound.h_deg + 0.05);
                EXPECT_LT(mark.bound.v_deg, 0.1);
                EXPECT_EQ(mark.why_not, "");
            }
}

TEST(AimMark, OfALampInAMirrorIsTheMirrorImage) {
    std::vector<CandelaTable> tables{shipped("halogen-low"), shipped("xenon-low")};
    for (const char* id : {"r112-b", "r149-c"})
        tables.push_back(generated::Lamp(regulation(id)).table);
    for (std::size_t i = 0; i < tables.size(); ++i) {
        SCOPED_TRACE(i);
        const AimMark mark = aim_mark(tables[i], false), image = aim_mark(mirrored(tables[i]), false);
        ASSERT_EQ(mark.v_deg.has_value(), image.v_deg.has_value());
        EXPECT_EQ(mark.v_deg.has_value() && mark.h_deg.has_value(), mark.why_not.empty()) << "what is missing has its reason";
        if (!mark.h_deg)
            continue;
        EXPECT_NEAR(*mark.v_deg, *image.v_deg, 1e-9);
        EXPECT_NEAR(*mark.h_deg, -image.h_deg.value(), 1e-9);
        EXPECT_NE(mark.left_hand, image.left_hand);
    }
}

TEST(AimMark, OfAHighBeamIsItsMiddle) {
    for (const char* name : {"halogen-high", "xenon-high"}) {
        const AimMark mark = aim_mark(shipped(name), true), moved = aim_mark(aimed(shipped(name), 0.5, -0.8), true);
        EXPECT_NEAR(mark.v_deg.value(), 0.0, 0.1) << name << ": they fall more slowly downwards";
        EXPECT_NEAR(mark.h_deg.value(), 0.0, 0.03) << name;
        EXPECT_NEAR(*moved.v_deg - *mark.v_deg, -0.8, 0.03) << name; // found in steps of 0.05
        EXPECT_NEAR(*moved.h_deg - *mark.h_deg, 0.5, 0.03) << name;
    }
    EXPECT_THAT(aim_mark(tests::even_table(0.0), true).why_not, HasSubstr("no light"));
}

TEST(AimMark, SaysWhyThereIsNone) {
    const AimMark even = aim_mark(tests::even_table(1000.0), false);
    EXPECT_FALSE(even.v_deg || even.h_deg);
    EXPECT_THAT(even.why_not, HasSubstr("none that lies within the scan falls"));
    const AimMark high = aim_mark(shipped("halogen-high"), false);
    EXPECT_FALSE(high.v_deg);
    EXPECT_NE(high.why_not, "");
}

TEST(AimMark, OfALevelCutOffHasNoSide) {
    const CandelaTable level = planted::beam({.level_v_deg = -0.2, .angle_deg = 0.0, .softness_deg = 0.15});
    const AimMark mark = aim_mark(level, false);
    EXPECT_NEAR(mark.v_deg.value(), -0.2, mark.bound.v_deg + 0.01);
    EXPECT_FALSE(mark.h_deg);
    EXPECT_NE(mark.why_not, "");
    EXPECT_EQ(turn_to(mark, -1.0).yaw_rad, 0.0) << "what is not found sideways is not turned sideways";
}

TEST(TurnTo, PutsTheMarkStraightAheadAtAnyAngle) {
    for (const auto& [h, v] : {std::pair(0.0, 0.0), {0.4, -0.57}, {-12.0, 7.0}, {35.0, -20.0}})
        for (const double percent : {0.0, -1.0, -2.5}) {
            const AimMark mark{.v_deg = v, .h_deg = h};
            MountedLamp lamp = mounted(tests::even_table(1.0));
            lamp.aligned = turn_to(mark, percent);
            EXPECT_NEAR(mark_on_car(lamp, mark.place()).percent, percent, 1e-9);
            EXPECT_NEAR(mark_on_car(lamp, mark.place()).right_deg, 0.0, 1e-9);
            // On a place that looks 30 degrees aside and leans: level counts from the car, sideways from the place.
            lamp.mount = {radians(30.0), radians(-4.0), radians(3.0)};
            lamp.aligned = turn_within(lamp.mount, turn_to(mark, percent));
            EXPECT_NEAR(mark_on_car(lamp, mark.place()).percent, percent, 1e-7);
            EXPECT_NEAR(mark_on_car(lamp, mark.place()).right_deg, -30.0, 1e-7);
        }
    // By hand: a cut-off on H-H comes down by atan(0.01), and one that holds 1 % is not turned.
    EXPECT_NEAR(turn_to({.v_deg = 0.0, .h_deg = 0.0}, -1.0).pitch_rad, -0.00999967, 1e-8);
    EXPECT_NEAR(turn_to({.v_deg = degrees(std::atan(-0.01)), .h_deg = 0.0}, -1.0).pitch_rad, 0.0, 1e-12);
    // A high beam is level beside a low beam at 1 %, and half a per cent lower beside one at 1.5 %.
    EXPECT_NEAR(turn_to({.high_beam = true, .v_deg = 0.2, .h_deg = 0.0}, -1.0).pitch_rad, radians(-0.2), 1e-12);
    EXPECT_NEAR(turn_to({.high_beam = true, .v_deg = 0.0, .h_deg = 0.0}, -1.5).pitch_rad, std::atan(-0.015) + std::atan(0.01), 1e-12);
}

TEST(TurnTo, WithoutAnElbowLevelsTheCutOffWhereItWasFound) {
    const AimMark mark{.v_deg = 1.2};
    EXPECT_EQ(mark.place(), (Direction{-2.5, 1.2}));
    MountedLamp lamp = mounted(tests::even_table(1.0));
    lamp.aligned = turn_to(mark, -1.0);
    EXPECT_EQ(lamp.aligned.yaw_rad, 0.0);
    EXPECT_NEAR(mark_on_car(lamp, mark.place()).percent, -1.0, 1e-9);
}

/// Nothing is resampled: the table's own samples turn. But a shift of its angles is no rotation: at an angle a from straight ahead a shift
/// s puts a direction s (1 - cos a) beside where a rotation puts it, 0.0022 degrees at 5 degrees for 0.57. The beams fall to a 2.3rd in 0.1
/// degrees at most (G = 0.35), so by 2 % in these; as much again for how near the finder settles, 0.002 degrees.
TEST(AutomaticAim, OfAShiftedFileGivesTheLightOfTheOriginal) {
    for (const char* name : {"halogen-low", "xenon-low"})
        for (const bool left_hand : {false, true}) {
            const CandelaTable own = left_hand ? mirrored(shipped(name)) : shipped(name);
            const MountedLamp original = automatic(own);
            for (const auto& [right, up] : {std::pair(0.0, 0.57), {0.0, 0.3}, {-0.5, 0.0}, {-0.5, 0.57}}) {
                SCOPED_TRACE(testing::Message() << name << (left_hand ? ", mirrored, " : ", ") << right << ", " << up);
                const MountedLamp shifted = automatic(aimed(own, right, up));
                double worst = 0.0;
                for (double v = -6.0; v <= 3.0; v += 0.05)
                    for (double h = -5.0; h <= 5.0; h += 0.25) {
                        const double now = on_car_cd(shifted, v, h), before = on_car_cd(original, v, h);
                        worst = std::max(worst, std::abs(now - before) / std::max(before, 50.0));
                    }
                EXPECT_LT(worst, 0.04);
            }
        }
}

/// As filed, our beams lie within what their marks are known to.
TEST(AutomaticAim, LeavesLampsInRegulationAimWhereTheyAre) {
    for (const char* name : {"halogen-low", "xenon-low"}) {
        const CandelaTable table = shipped(name);
        const AimMark mark = aim_mark(table, false);
        const Turn turn = turn_to(mark, -1.0);
        EXPECT_LT(std::abs(degrees(turn.pitch_rad)), mark.bound.v_deg) << name;
        EXPECT_LT(std::abs(degrees(turn.yaw_rad)), mark.bound.h_deg) << name;
        for (unsigned seed = 1; seed <= 5; ++seed) {
            const AimMark noisy = aim_mark(with_noise(table, 0.02, seed), false);
            ASSERT_TRUE(noisy.v_deg && noisy.h_deg) << name << ": " << noisy.why_not;
            EXPECT_NEAR(*noisy.v_deg, *mark.v_deg, mark.bound.v_deg + noisy.bound.v_deg) << name;
            EXPECT_NEAR(*noisy.h_deg, *mark.h_deg, mark.bound.h_deg + noisy.bound.h_deg) << name;
        }
    }
}

TEST(InclinationBand, IsThatOfR48ByTheHeight) {
    const InclinationBand band = r48_band(0.65).value();
    EXPECT_NEAR(band.lowest_percent, -1.85, 1e-12); // -(0.65 + 1.2)
    EXPECT_EQ(band.highest_percent, -0.5);
    for (const auto& [percent, inside] : {std::pair(-0.3, false), {-1.0, true}, {-2.0, false}, {-0.5, true}, {-1.85, true}, {0.0, false}})
        EXPECT_EQ(band.holds(percent), inside) << percent;
    EXPECT_NEAR(r48_band(0.9)->lowest_percent, -2.1, 1e-12);
    EXPECT_NEAR(r48_band(1.0)->lowest_percent, -2.32, 1e-12);  // -(2.17 + 0.15)
    EXPECT_NEAR(r48_band(1.0)->highest_percent, -0.72, 1e-12); // -(2.17 - 1.45)
    EXPECT_FALSE(r48_band(0.49) || r48_band(1.21)) << "no passing beam of a car may be there";
    EXPECT_TRUE(r48_band(0.5) && r48_band(1.2));
}

} // namespace
} // namespace fernlicht
