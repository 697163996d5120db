// Glare and reach as distributions over a drive: against a swinging cut-off whose quantiles are known by hand, and rough roads.
#include "metrics/folds/sensitivity_fold.h"
#include "metrics/road/extent.h"
#include "runner/findings/summary.h"
#include "tests/metrics/folds/one_lamp_straight.h"
#include "tests/scenarios/drives/play/staged_drive.h"
#include "tests/shipped.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gmock/gmock.h>
#include <numbers>

namespace fernlicht {
namespace {

using testing::HasSubstr;

constexpr int swing_moments = 120, whole_swings = 7; ///< without a common divisor: phases 3 degrees apart, each once
constexpr double swing_deg = 0.3;

double swing_at_deg(int tick) {
    return swing_deg * std::sin(2.0 * std::numbers::pi * (whole_swings * tick + 0.5) / static_cast<double>(swing_moments));
}

/// Quantile of a sine's values over its time: the arcsine distribution's, in degrees.
double arcsine_deg(double share) { return swing_deg * std::sin(std::numbers::pi * (std::clamp(share, 0.0, 1.0) - 0.5)); }

/// The sine meets each value on its way up and down: 120 moments have 60 values, and a quantile of theirs lies less than one of them off.
constexpr double sampling_share = 1.0 / 60.0;

/// Holds a reading between the quantiles beside it, of a figure that rises with the swing. `exactness`: its own, in its unit.
void expect_arcsine(const Readings& readings, const std::string& name, double share, const std::function<double(double)>& of_swing_deg,
                    double exactness) {
    const double found = value(readings, name);
    EXPECT_GE(found, of_swing_deg(arcsine_deg(share - sampling_share)) - exactness) << name;
    EXPECT_LE(found, of_swing_deg(arcsine_deg(share + sampling_share)) + exactness) << name;
    testing::Test::RecordProperty(name, fmt::format("{:.4f}, by hand {:.4f}", found, of_swing_deg(arcsine_deg(share))));
}

/// Its lamp has cd(v), v in degrees up, the same to all sides, and swings.
struct SwingingStraight : OneLampStraight {
    template <class Intensity> explicit SwingingStraight(Intensity cd) {
        const std::vector<double> v_deg = tests::steps(-6.0, 6.0, 0.02);
        drive.lamp_sets.front().lamps.front().file =
            tests::file_of(tests::table_of({-90.0, 90.0}, v_deg, [&](double, double v) { return cd(v); }));
    }
    template <class Take> void play(const Take& take) const {
        State state = start(drive);
        for (int tick = 0; tick < swing_moments; ++tick, state = advance(state, drive))
            take(nudged(moment_at(state, drive, route, drive.lamp_sets.front()), {.pitch_rad = radians(swing_at_deg(tick))}));
    }
};

// In a mirror 30 m ahead, straight before the lamp and 0.35 m higher, light goes with the swing: I = 1000 - 150 v.
TEST(Spread, LightOnAMirrorThatACutOffSwingsOverHasTheArcsineDistributionsQuantiles) {
    SwingingStraight straight([](double v) { return 1000.0 - 150.0 * v; });
    GlareParameters& glare = straight.drive.seeing.glare.emplace();
    glare.adaptation_cdm2 = 1.0;
    glare.mirrors = MirrorParameters{{30.0}, {1.3, 0.35, 1.2}, 0.5, {{"middle", {1.9, 0.0, 1.0}}}};
    SeeingFold fold(straight.drive, straight.route);
    straight.play([&](const Moment& moment) { fold.add(moment, straight.drive.lamp_sets.front()); });
    const Readings readings = fold.readings();
    const double square = 31.9 * 31.9 + 0.35 * 0.35, up_deg = degrees(std::atan(0.35 / 31.9));
    const auto lx = [&](double swing) { return (1000.0 - 150.0 * (up_deg - swing)) / square; };
    for (const std::string name : {"mirror_middle_at_30m", "glare_mirrors_at_30m_facing"}) {
        EXPECT_NEAR(value(readings, name + "_lx"), lx(0.0), 1e-9) << "as much above as below";
        expect_arcsine(readings, name + "_p95_lx", 0.95, lx, 1e-9);
        EXPECT_NEAR(value(readings, name + "_max_lx"), lx(swing_deg * std::sin(radians(88.5))), 1e-9);
    }
    EXPECT_LT(value(readings, "glare_mirrors_at_30m_de_boer_min"), value(readings, "glare_mirrors_at_30m_de_boer_p05"));
    EXPECT_LT(value(readings, "glare_mirrors_at_30m_de_boer_p05"), value(readings, "glare_mirrors_at_30m_de_boer"));
    EXPECT_THAT(named(readings, "glare_mirrors_at_30m_veiling_p95_cdm2").where,
                HasSubstr("veiling luminance, cie-general, 95th percentile"));
}

// Targets 0.25 m above the road, the lamp at 0.65 m: at x metres v is atan(-0.4 / x) less the swing, and 5 lx are there where I = 5 d^2.
TEST(Spread, ReachUnderASwingingCutOffHasTheArcsineDistributionsQuantiles) {
    const auto cd = [](double v) { return 2.0e4 / (1.0 + std::exp((v + 0.57) / 0.12)) + 20.0; };
    SwingingStraight straight(cd);
    straight.drive.extent->ahead_m = 120.0;
    straight.drive.extent->beside_m = 2.0;
    PlayedCell played;
    straight.play([&](const Moment& moment) {
        const ExtentGrid grid = make_extent_grid(straight.route, moment, straight.drive.bumper_m, *straight.drive.extent);
        ExtentRow row;
        row.tick = moment.tick;
        row.rendered = measure_extent(grid, twin_illuminance_lx(grid, moment, Surface::target), Surface::target, {5.0}, {});
        played.extents.push_back(std::move(row));
    });
    played.extent_summaries = summarise_extents(played, *straight.drive.extent);
    const Readings readings = extent_readings(played);
    const auto reach_m = [&](double swing) {
        double lit_m = 5.0, dark_m = 200.0;
        for (int i = 0; i < 60; ++i) {
            const double x = 0.5 * (lit_m + dark_m);
            (cd(degrees(std::atan(-0.4 / x)) - swing) >= 5.0 * (x * x + 0.16) ? lit_m : dark_m) = x;
        }
        return lit_m;
    };
    EXPECT_GT(reach_m(swing_deg) - reach_m(-swing_deg), 10.0);
    const double of_grid_m = 0.05; // half a metre apart, and the table 0.02 degrees
    expect_arcsine(readings, "reach_5lx_target_own_m", 0.5, reach_m, of_grid_m);
    expect_arcsine(readings, "reach_5lx_target_own_p05_m", 0.05, reach_m, of_grid_m);
    expect_arcsine(readings, "reach_5lx_target_own_p95_m", 0.95, reach_m, of_grid_m);
    expect_arcsine(readings, "reach_5lx_target_own_min_m", 0.0, reach_m, of_grid_m);
}

// An eye at 100 m along: metre by metre it is 59.4, 58.4 ... 30.4 m before the bumper, 30 moments of the range; all light goes by distance.
TEST(Spread, EachRangeHasTheQuantilesOfItsMoments) {
    OneLampStraight straight;
    GlareParameters& glare = straight.drive.seeing.glare.emplace();
    glare.oncoming = {{"eye", 100.0, 1.1}};
    glare.adaptation_cdm2 = 1.0;
    const auto lx = [](double d) { return 1000.0 / (d * d + 3.5 * 3.5 + 0.45 * 0.45); };
    const Readings even = straight.played().readings();
    EXPECT_NEAR(value(even, "glare_eye_facing_from_30_to_60m_lx"), 0.5 * (lx(45.4) + lx(44.4)), 1e-9);
    EXPECT_NEAR(value(even, "glare_eye_facing_from_30_to_60m_p95_lx"), std::lerp(lx(32.4), lx(31.4), 0.55), 1e-9) << "place 27.55 of 0..29";
    EXPECT_GT(value(even, "glare_eye_facing_from_30_to_60m_max_lx"), value(even, "glare_eye_facing_from_30_to_60m_p95_lx"));
    EXPECT_THAT(named(even, "glare_eye_facing_from_60_to_120m_lx").value.reason(), HasSubstr("the drive covers only 60.0 to 96.4 m"));
    EXPECT_THAT(named(even, "glare_eye_facing_from_120_to_220m_p95_lx").value.reason(), HasSubstr("the drive comes from 96.4 m away"));
    for (const Reading& reading : even) // an approach as a whole mixes distances
        EXPECT_TRUE(reading.key.to_m || (reading.key.statistic != Statistic::p95 && reading.key.statistic != Statistic::p05))
            << reading.name();
    // By time: from 45 m on at half the speed, 3 s after 1.5 s; their middle is 3.75 m on from there.
    straight.drive.speed = {{0.0, 10.0}, {5.139, 10.0}, {5.141, 5.0}};
    const Readings slower = straight.played().readings();
    EXPECT_NEAR(value(slower, "glare_eye_facing_from_30_to_60m_lx"), lx(41.25), lx(41.0) - lx(41.5))
        << "half a moment's way to either side";
    // What comes between two moments has ends, which are interpolated, and no moment.
    glare.ranges_m = {30.5, 31.3};
    straight.drive.speed = {{0.0, 10.0}};
    const Readings between = straight.played().readings();
    EXPECT_TRUE(named(between, "glare_eye_facing_from_30.5_to_31.3m_max_lx").value.measured());
    EXPECT_EQ(named(between, "glare_eye_facing_from_30.5_to_31.3m_lx").value.reason(), "no moment lies within that range");
    // A moment that lacks the figure: its own range alone is not measured.
    glare.equation = VeilingEquation::age_adjusted;
    glare.oncoming = {{"eye", 300.0, 1.1}};
    glare.ranges_m = {190.0, 200.0, 250.0};
    const Readings far = straight.played().readings();
    EXPECT_TRUE(named(far, "glare_eye_veiling_from_190_to_200m_p95_cdm2").value.measured());
    EXPECT_THAT(named(far, "glare_eye_veiling_from_200_to_250m_p95_cdm2").value.reason(), HasSubstr("in some moment: a source 0."));
}

TEST(Spread, WhereNothingChangesMedianPercentileAndLargestAreOne) {
    OneLampStraight straight;
    GlareParameters& glare = straight.drive.seeing.glare.emplace();
    glare.adaptation_cdm2 = 1.0;
    glare.mirrors = MirrorParameters{{30.0}, {1.3, 0.35, 1.2}, 0.5, {{"left", {1.9, 0.95, 1.0}}}};
    const Readings readings = straight.played().readings();
    for (const std::string name : {"mirror_left_at_30m", "glare_mirrors_at_30m_facing"}) {
        const double median = value(readings, name + "_lx");
        EXPECT_NEAR(value(readings, name + "_p95_lx"), median, 1e-12 * median);
        EXPECT_NEAR(value(readings, name + "_max_lx"), median, 1e-12 * median);
    }
    EXPECT_NEAR(value(readings, "glare_mirrors_at_30m_de_boer_p05"), value(readings, "glare_mirrors_at_30m_de_boer_min"), 1e-12);
}

TEST(Spread, QuantilesMoveWithTheLampsAsTheLargestDo) {
    OneLampStraight straight;
    GlareParameters& glare = straight.drive.seeing.glare.emplace();
    glare.oncoming = {{"eye", 100.0, 1.1}};
    glare.adaptation_cdm2 = 1.0;
    glare.mirrors = MirrorParameters{{30.0}, {1.3, 0.35, 1.2}, 0.5, {{"left", {1.9, 0.95, 1.0}}}};
    const LampSet& lamp_set = straight.drive.lamp_sets.front();
    SensitivityFold sensitivity(straight.drive, straight.route, lamp_set);
    State state = start(straight.drive);
    for (int tick = 0; tick < tick_count(straight.drive); ++tick, state = advance(state, straight.drive))
        sensitivity.add(moment_at(state, straight.drive, straight.route, lamp_set), tells_sensitivity(tick, tick_count(straight.drive)));
    Readings readings = straight.played().readings();
    sensitivity.tell(readings);
    for (const std::string stem : {"glare_eye_facing_from_30_to_60m", "mirror_left_at_30m", "glare_mirrors_at_30m_facing"})
        for (const char* end : {"_lx", "_p95_lx", "_max_lx"}) {
            const Reading reading = named(readings, stem + end);
            EXPECT_NEAR(reading.sensitivity.brighter.value(), 0.1 * *reading.value.number(), 1e-9) << reading.name();
            EXPECT_TRUE(reading.sensitivity.aim_up && reading.sensitivity.aim_down && reading.sensitivity.higher) << reading.name();
        }
}

struct RoughPlayed {
    double pitch_deg = 0.0; ///< standard deviation
    Readings readings;
};

/// The shipped drive's readings of glare; `roughness`: nullopt for the smooth road.
RoughPlayed rough_played(std::optional<RoadClass> roughness, bool load) {
    Drive drive = read_drive(shipped_drives / "rough-road.yaml");
    drive.traffic.clear();
    drive.seeing.glare->adaptation_cdm2 = 0.7;
    drive.vehicle->roughness = roughness ? std::optional(Roughness{*roughness, 1}) : std::nullopt;
    if (!load)
        drive.vehicle->load_steps.clear();
    const StagedDrive played(std::move(drive));
    SeeingFold fold(played.drive, played.route);
    double sum = 0.0, squares = 0.0;
    const int moments = tick_count(played.drive);
    for (int tick = 0; tick < moments; ++tick) {
        const Moment moment = played.at_tick(tick, 0);
        const double pitch_deg = degrees(played.drive.lamp_sets[0].motion->car->at(moment.time_s).pitch_rad);
        sum += pitch_deg;
        squares += pitch_deg * pitch_deg;
        fold.add(moment, played.drive.lamp_sets[0]);
    }
    return {std::sqrt(squares / moments - sum * sum / moments / moments), fold.readings()};
}

TEST(Spread, ARoadRougherByAClassSwingsTwiceAsFarAndSpreadsTheLightMore) {
    const std::optional<RoadClass> classes[] = {std::nullopt, RoadClass::A, RoadClass::B, RoadClass::C, RoadClass::D};
    double before = 0.0, before_deg = 0.0;
    for (const auto& road_class : classes) {
        const RoughPlayed found = rough_played(road_class, false);
        const double median = value(found.readings, "mirror_right_at_60m_lx"), p95 = value(found.readings, "mirror_right_at_60m_p95_lx");
        RecordProperty(road_class ? std::string(1, "ABCD"[static_cast<int>(*road_class)]) : "smooth",
                       fmt::format("pitch {:.3f} degrees; {:.4f} and {:.4f} lx", found.pitch_deg, median, p95));
        if (!road_class) {
            EXPECT_LT(p95 / median, 1.001) << "nothing swings";
        } else {
            EXPECT_GT(p95 / median, 1.02 * before);
            if (before_deg > 0.0) {
                EXPECT_NEAR(found.pitch_deg / before_deg, 2.0, 0.06) << "a class has four times the power";
            }
            before_deg = found.pitch_deg;
        }
        before = p95 / median;
    }
}

TEST(Spread, TheShippedRoughRoadTellsEachRangeAndSaysMoreThanTheSmoothOne) {
    const RoughPlayed rough = rough_played(RoadClass::C, true), smooth = rough_played(std::nullopt, false);
    for (const char* range : {"15_to_30", "30_to_60", "60_to_120", "120_to_220"})
        for (const char* statistic : {"", "_p95", "_max"}) {
            const std::string name = fmt::format("glare_opposite_facing_from_{}m{}_lx", range, statistic);
            EXPECT_GT(value(rough.readings, name), 0.0);
        }
    EXPECT_GT(value(rough.readings, "glare_opposite_facing_from_60_to_120m_p95_lx"),
              1.5 * value(smooth.readings, "glare_opposite_facing_from_60_to_120m_p95_lx"));
}

} // namespace
} // namespace fernlicht
