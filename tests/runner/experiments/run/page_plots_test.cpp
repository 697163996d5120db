// Figures of the page, by what stands on their axes.
#include "runner/experiments/run/run_document.h"
#include "runner/experiments/run/run_plots.h"
#include "runner/findings/extent_keys.h"
#include "runner/write/plots/svg.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <numbers>
#include <tuple>

namespace fernlicht {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Lit as far as 50 m at each moment, a moment a second, at these places.
PlayedCell at(const std::vector<double>& distances_m) {
    PlayedCell played;
    played.lamp_set = "xenon";
    LaneExtent extent;
    extent.lane = "own";
    extent.threshold_lx = 1.0;
    extent.reach_centre_m = 50.0;
    for (const double distance_m : distances_m)
        played.extents.push_back({.tick = static_cast<int>(played.extents.size()),
                                  .time_s = static_cast<double>(played.extents.size()),
                                  .distance_m = distance_m,
                                  .rendered = {extent},
                                  .twin = {},
                                  .grid_errors = {},
                                  .nudged = {}});
    return played;
}

std::string reach_of(const PlayedCell& played) {
    ComparedDrive drive;
    drive.lamp_sets = {&played};
    return plots::svg_of(reach_figure(drive, Surface::road, 1.0).value());
}

TEST(PagePlots, ReachIsOverTimeWhereTheCarStandsStillOrMovesOnSprings) {
    EXPECT_THAT(reach_of(at({0.0, 20.0, 40.0})), HasSubstr("distance along the route"));
    EXPECT_THAT(reach_of(at({0.0, 20.0, 20.0, 40.0})), Not(HasSubstr("distance along the route")));
    EXPECT_THAT(reach_of(at({0.0, 20.0, 20.0, 40.0})), HasSubstr("time [s]"));
    PlayedCell sprung = at({0.0, 20.0, 40.0});
    sprung.car.resize(3);
    EXPECT_THAT(reach_of(sprung), HasSubstr("time [s]"));
}

TEST(PagePlots, ErrorOverTimeHasAPointALampSetAndTheFloor) {
    PlayedCell played = at({0.0, 20.0});
    played.technique = "photometric";
    ComparedDrive drive;
    drive.lamp_sets = {&played};
    EXPECT_FALSE(error_figure(drive)); // neither error nor time
    PixelErrors errors;
    errors.pixels = 100;
    errors.error.p95 = 0.03;
    errors.floor.p95 = 0.01;
    played.error.road = errors;
    played.error.road_p95 = {0.02, 0.04};
    EXPECT_FALSE(error_figure(drive)); // no time
    played.passes = {{"frame", {0.010, 0.012, 0.011}}};
    for (const char* part :
         {"xenon", "time a frame, driver&#39;s view alone [ms]", "lux error on the road, 95 % [%]", "noise", "photometric"})
        EXPECT_THAT(plots::svg_of(error_figure(drive).value()), HasSubstr(part));
}

/// 120 moments, a tenth of a second apart: the body swings by 0.3 degrees, seven times; an eye comes from 120 m away to 1 m, a metre a
/// moment, with 1 lx at every place but 3 lx from 40 to 41 m.
PlayedCell swinging(double swing_deg) {
    PlayedCell played = at(std::vector<double>(120, 0.0));
    SeeingSeries eye{"glare_opposite", "Oncoming driver", "distance", {}, {}, {{"facing_lx", "facing illuminance", "lx", true, true, {}}}};
    for (int tick = 0; tick < 120; ++tick) {
        const double phase = 2.0 * std::numbers::pi * (7 * tick + 0.5) / 120.0, away_m = 120.0 - tick;
        played.car.push_back({0.1 * tick, swing_deg * std::sin(phase), 0.0, std::nullopt, std::nullopt});
        eye.ticks.push_back(tick);
        eye.at_m.push_back(away_m);
        eye.columns[0].values.emplace_back(away_m == 40.0 ? 3.0 : 1.0);
    }
    played.seeing = {eye};
    for (const auto& [from_m, to_m, value] : {std::tuple(15.0, 30.0, Value(1.0)), std::tuple(30.0, 60.0, Value(1.0)),
                                              std::tuple(120.0, 220.0, Value::not_measured("the drive passes 120 m alone"))})
        played.readings.push_back(
            {{.quantity = Quantity::glare_facing, .subject = "opposite", .distance_m = from_m, .to_m = to_m, .statistic = Statistic::p95},
             value});
    ExtentSummary& reach = played.extent_summaries.emplace_back(ExtentSummary{{Surface::target, "own", 1.0}});
    CensoredSamples& samples = reach.moments[extent_reading(reach.key, Quantity::reach)];
    for (const double reach_m : {40.0, 50.0, 60.0, 70.0})
        samples.add(Value(reach_m));
    samples.add(Value::at_least(80.0));
    return played;
}

TEST(PagePlots, ASwayingCarSpreadsItsLight) {
    const PlayedCell played = swinging(0.3), still = swinging(0.001);
    EXPECT_TRUE(spread_figures({"still", {&still}}).empty()) << "nothing disturbs the drive";
    const std::vector<plots::Figure> figures = spread_figures({"rough", {&played}});
    ASSERT_EQ(figures.size(), 3U);
    // The cut-off: half of the moments below rest, 95 % below sin(0.45 pi) of the swing, to one of the 60 values that 120 moments have.
    const auto at_share = [](const plots::Series& series, double percent) {
        for (std::size_t i = 1; i < series.points.size(); ++i)
            if (const plots::Point& a = series.points[i - 1], &b = series.points[i]; b.y >= percent)
                return std::lerp(a.x, b.x, (percent - a.y) / (b.y - a.y));
        return -1.0;
    };
    EXPECT_NEAR(at_share(figures[0].series.at(0), 50.0), 0.0, 1e-9);
    EXPECT_NEAR(at_share(figures[0].series[0], 95.0), 0.3 * std::sin(0.45 * std::numbers::pi), 0.3 * 0.01);
    EXPECT_NEAR(at_share(figures[0].series[0], 5.0), -0.3 * std::sin(0.45 * std::numbers::pi), 0.3 * 0.01);
    // Reach: what lies beyond the grid ends the curve.
    EXPECT_EQ(figures[1].series.at(0).points.size(), 5U);
    EXPECT_DOUBLE_EQ(at_share(figures[1].series[0], 50.0), 60.0);
    EXPECT_TRUE(std::isnan(figures[1].series[0].points.back().x));
    // Light: a bar for each of the two ranges that are passed, the one with the flash told by its dot.
    ASSERT_EQ(figures[2].bands.size(), 2U);
    EXPECT_DOUBLE_EQ(figures[2].bands[1].low.at(0), 1.0);
    EXPECT_DOUBLE_EQ(figures[2].bands[1].high.at(0), 1.0);
    ASSERT_EQ(figures[2].series.size(), 4U);
    EXPECT_DOUBLE_EQ(figures[2].series[2].points.at(0).y, 1.0) << "the median";
    EXPECT_DOUBLE_EQ(figures[2].series[3].points.at(0).y, 3.0) << "the largest";
    for (const auto& [figure, part] : {std::pair(0, "Swing of the cut-off"),
                                       {1, "Reach at 1 lx on a facing target"},
                                       {1, "moments below [%]"},
                                       {2, "Light in the eyes of oncoming driver opposite"}})
        EXPECT_THAT(plots::svg_of(figures[static_cast<std::size_t>(figure)]), HasSubstr(part));
}

class KeySentence : public testing::Test {
  protected:
    KeySentence() {
        a.lamp_set = "A";
        b.lamp_set = "B";
    }
    void read(const char* name, const Value& first, const Value& other) {
        const ReadingKey key = key_of(name).value();
        a.readings.push_back({.key = key, .value = first});
        b.readings.push_back({.key = key, .value = other});
    }
    std::string sentence() const { return key_sentence(ComparedDrive{"drive", {&a, &b}}); }
    std::string of_reach(const Value& first, const Value& other) {
        a.readings.clear();
        b.readings.clear();
        read("reach_5lx_target_own_m", first, other);
        return sentence();
    }

    PlayedCell a, b;
};

TEST_F(KeySentence, SaysBetterOrWorseOnlyOfWhatBoundsLeave) {
    const std::string reach = "Reach at 5 lx on a target, own lane: ";
    EXPECT_EQ(of_reach(Value::at_least(150.0), 160.0), reach + "B and A 160 m and > 150 m");
    EXPECT_EQ(of_reach(150.0, 160.0), reach + "B is better than A: 160 m against 150 m (+10.0 m, +7 %)");
    EXPECT_THAT(of_reach(Value::at_least(150.0), 140.0), testing::StartsWith(reach + "B is worse than A: 140 m against > 150 m"));
    EXPECT_EQ(of_reach(150.0, 150.0), reach + "B and A 150 m");
}

TEST_F(KeySentence, NamesWhatSpeaksAgainstAndTheAim) {
    read("reach_5lx_target_own_m", 60.0, 66.0);
    read("glare_opposite_facing_from_30_to_60m_max_lx", 0.5, 0.6);
    EXPECT_THAT(sentence(), testing::EndsWith("; worse in largest illuminance at 30 to 60 m, eyes of oncoming driver opposite, +20 %"));
    a.aims = {{.lamp = "left", .percent = -1.0}};
    b.aims = {{.lamp = "left", .percent = -0.5}};
    EXPECT_THAT(sentence(), testing::EndsWith(", +20 %; as mounted, the cut-off of B lies 0.29° higher"));
    b.readings.back().value = 0.4;
    EXPECT_THAT(sentence(), testing::Not(HasSubstr("illuminance"))) << "better in both";
}

} // namespace
} // namespace fernlicht
