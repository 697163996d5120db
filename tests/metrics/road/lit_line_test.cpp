#include "metrics/road/extent.h"
#include "metrics/road/lit_line.h"
#include "metrics/road/lux_near_thresholds.h"
#include "scenarios/drives/play/advance.h"
#include "tests/metrics/straight_grid.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <numeric>
#include <random>
#include <tuple>

namespace fernlicht {
namespace {

using testing::HasSubstr;
using tests::straight_grid;

TEST(Crossing, IsStraightInTheLogarithmAndFallsBackWhereItIsDark) {
    EXPECT_DOUBLE_EQ(crossing_share(100.0, 1.0, 10.0), 0.5);
    EXPECT_DOUBLE_EQ(crossing_share(1.0, 100.0, 10.0), 0.5);
    EXPECT_DOUBLE_EQ(crossing_share(10.0, 0.0, 4.0), 0.6);
    EXPECT_DOUBLE_EQ(crossing_share(5.0, 1.0, 5.0), 0.0);
    EXPECT_DOUBLE_EQ(between_samples(100.0, 1.0, 0.5), 10.0);
    EXPECT_DOUBLE_EQ(between_samples(10.0, 0.0, 0.25), 7.5);
}

TEST(LitLine, AddsUpWhatIsLitBetweenCrossings) {
    const std::tuple<const char*, std::vector<LineSample>, double, LitLine> cases[] = {
        {"nothing lit", {{0.0, 0.5}, {1.0, 0.9}, {2.0, 0.0}}, 1.0, {}},
        // Dark to 1.5, lit to 3.5, dark to 5.5, lit to 6.5: crossings half way, 100 : 1 about 10.
        {"gaps before the reach",
         {{0.0, 1.0}, {1.0, 1.0}, {2.0, 100.0}, {3.0, 100.0}, {4.0, 1.0}, {5.0, 1.0}, {6.0, 100.0}, {7.0, 1.0}, {8.0, 1.0}},
         10.0,
         {true, 1.5, 6.5, 3.0, 3.5, false}},
        {"exactly the limit is lit", {{0.0, 5.0}, {1.0, 5.0}, {2.0, 1.0}}, 5.0, {true, 0.0, 1.0, 1.0, 0.0, false}},
        {"a lit sample between dark ones", {{0.0, 0.0}, {1.0, 10.0}, {2.0, 0.0}}, 5.0, {true, 0.5, 1.5, 1.0, 0.5, false}},
        {"what was not looked at is neither lit nor dark",
         {{0.0, 9.0}, {1.0, 9.0}, {2.0, std::nullopt}, {3.0, 9.0}, {4.0, 9.0}, {5.0, std::nullopt}},
         5.0,
         {true, 0.0, 4.0, 2.0, 0.0, true}},
        {"nothing at all", {}, 1.0, {}},
        {"one sample", {{3.0, 2.0}}, 1.0, {true, 3.0, 3.0, 0.0, 0.0, true}}};
    for (const auto& [what, samples, threshold_lx, expected] : cases) {
        const LitLine line = lit_line(samples, threshold_lx);
        EXPECT_EQ(std::tuple(line.lit, line.lit_at_end), std::tuple(expected.lit, expected.lit_at_end)) << what;
        EXPECT_DOUBLE_EQ(line.first_m, expected.first_m) << what;
        EXPECT_DOUBLE_EQ(line.last_m, expected.last_m) << what;
        EXPECT_DOUBLE_EQ(line.lit_m, expected.lit_m) << what;
        EXPECT_DOUBLE_EQ(line.unlit_before_last_m, expected.unlit_before_last_m) << what;
    }
}

/// d figure / d value by central differences, value by value.
template <class Samples, class Figure> void expect_shares(const Samples& samples, const ValueShares& shares, double step, auto member,
                                                          const Figure& figure, const std::string& what) {
    std::vector<double> told(samples.size());
    for (const ValueShare& one : shares)
        told[one.index] += one.by_value;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (!(samples[i].*member))
            continue;
        Samples more = samples, less = samples;
        *(more[i].*member) += step * *(samples[i].*member);
        *(less[i].*member) -= step * *(samples[i].*member);
        const double found = *(samples[i].*member) > 0.0 ? (figure(more) - figure(less)) / (2.0 * step * *(samples[i].*member)) : told[i];
        EXPECT_NEAR(told[i], found, 1e-6 * std::max(std::abs(found), 1e-3)) << what << ", sample " << i;
    }
}

TEST(LitLine, MovesItsEndsWithItsSamplesAsTheSlopeSays) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> lx(0.1, 12.0), chance(0.0, 1.0);
    int moved = 0;
    for (int draw = 0; draw < 50; ++draw) {
        std::vector<LineSample> line;
        for (int i = 0; i < 9; ++i) {
            const double e = chance(random) < 0.1 ? 0.0 : lx(random);
            line.push_back({0.7 * i, chance(random) < 0.1 ? std::nullopt : std::optional(e)});
        }
        const LitLineShares shares = lit_line_shares(line, 5.0);
        moved += shares.last.empty() ? 0 : 1;
        const std::string what = "line " + std::to_string(draw);
        expect_shares(
            line, shares.last, 1e-5, &LineSample::lx, [](const auto& of) { return lit_line(of, 5.0).last_m; }, what + ", last");
        expect_shares(
            line, shares.lit, 1e-5, &LineSample::lx, [](const auto& of) { return lit_line(of, 5.0).lit_m; }, what + ", lit");
    }
    EXPECT_GT(moved, 10); // many lines end lit, or in the dark
}

/// 10 m/s from 40 m away to the place: 1, 2, 8, 2, 0 lx.
const Approach course{{0.0, 40.0, 1.0}, {1.0, 30.0, 2.0}, {2.0, 20.0, 8.0}, {3.0, 10.0, 2.0}, {4.0, 0.0, 0.0}};

TEST(Approach, TellsWhichValuesAFigureFollowsFrom) {
    for (const double at_m : {30.0, 26.0, 3.0, 50.0}) {
        const auto figure = [&](const Approach& of) { return value_at(of, at_m).number().value_or(0.0); };
        expect_shares(course, value_at_shares(course, at_m), 1e-5, &ApproachSample::value, figure, std::to_string(at_m));
    }
    EXPECT_EQ(reached_from_shares(course, 5.0).size(), 2U);
    expect_shares(
        course, reached_from_shares(course, 5.0), 1e-5, &ApproachSample::value,
        [](const Approach& of) { return reached_from_m(of, 5.0, true).number().value(); }, "reached from");
}

TEST(Approach, RunsStraightInTheLogarithmAndIsReachedFromFarthestAway) {
    EXPECT_DOUBLE_EQ(value_at(course, 30.0).number().value(), 2.0);
    EXPECT_NEAR(value_at(course, 25.0).number().value(), 4.0, 1e-12); // half way from 2 to 8
    EXPECT_NEAR(value_at(course, 5.0).number().value(), 1.0, 1e-12) << "towards the dark in the value itself";
    EXPECT_DOUBLE_EQ(value_at(course, 0.0).number().value(), 0.0);
    EXPECT_THAT(value_at(course, 41.0).reason(), HasSubstr("from 40.0 m away to 0.0 m"));
    EXPECT_FALSE(value_at(Approach{}, 5.0).measured());
    EXPECT_EQ(unknown_at(course, 30.0), 0.0) << "a sample";
    EXPECT_FALSE(unknown_at(course, 41.0));
    EXPECT_NEAR(reached_from_m(course, 4.0, false).number().value(), 25.0, 1e-12); // between 2 and 8
    EXPECT_NEAR(reached_from_m(course, 2.0, false).number().value(), 30.0, 1e-12);
    EXPECT_EQ(reached_from_m(course, 9.0, false).number().value(), 0.0) << "nowhere";
    EXPECT_EQ(reached_from_m(course, 1.0, false), Value::at_least(40.0)) << "from the first moment on";
    EXPECT_FALSE(reached_from_m({}, 1.0, false).measured());
    const Approach cut(course.begin(), course.begin() + 2); // ends 30 m before the place with 2 lx
    EXPECT_EQ(cut_short(cut, false), "the drive comes from 40.0 m to 30.0 m before it");
    EXPECT_EQ(reached_from_m(cut, 9.0, false), Value::at_most(30.0)) << "what is nearer was not driven";
    EXPECT_EQ(reached_from_m(cut, 9.0, true), Value(0.0)) << "the next moment was beyond the place";
    EXPECT_NEAR(reached_from_m(cut, std::sqrt(2.0), false).number().value(), 35.0, 1e-12) << "it came far enough to know this";
    EXPECT_EQ(cut_short(Approach(course.begin(), course.begin() + 4), false), "") << "10 m are near enough";
    EXPECT_EQ(cut_short({}, false), "");
}

TEST(Approach, CountsTimeAndLengthOfWhatWasMeasured) {
    const Stretch lit = at_or_above(course, 4.0); // from 25 m to 15 m
    EXPECT_NEAR(lit.length_m, 10.0, 1e-12);
    EXPECT_NEAR(lit.time_s, 1.0, 1e-12);
    EXPECT_NEAR(below(course, 4.0).time_s, 3.0, 1e-12);
    EXPECT_NEAR(below(course, 4.0).length_m, 30.0, 1e-12);
    Approach away = course; // distances gone instead of those to go
    for (ApproachSample& sample : away)
        sample.distance_m = 100.0 - sample.distance_m;
    EXPECT_NEAR(at_or_above(away, 4.0).length_m, 10.0, 1e-12);
    Approach gap = course;
    gap[3].value.reset();
    EXPECT_NEAR(at_or_above(gap, 4.0).time_s, 0.5, 1e-12) << "from 25 m to 20 m; nothing runs through the gap";
    EXPECT_NEAR(below(gap, 4.0).time_s, 1.5, 1e-12);
    EXPECT_FALSE(value_at(gap, 15.0).measured());
    EXPECT_EQ(largest(gap), 8.0);
    EXPECT_EQ(smallest(gap), 0.0);
    EXPECT_EQ(smallest({{0.0, 1.0, std::nullopt}}), std::nullopt);
}

// Lines of sight over a lane: a level road by similar triangles, a crest by its radius.

const std::filesystem::path roads = std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/roads";

glm::dvec3 over(const Route& route, double at_m, double height_m) {
    const Pose pose = route.pose(at_m);
    return pose.position_m + height_m * pose.up();
}

TEST(LaneAhead, MeetsTheRoadBehindATarget) {
    const RoadNetwork network = read_opendrive(roads / "straight.xodr");
    const Route route(network, {});
    const LaneAhead lane(route, 10.0, 200.0, 1.0);
    // From 1.2 m over 10 m through 0.09 m over 62.3 m: the ground is met 1.2 / 1.11 times as far away.
    const std::optional<Pose> met = lane.behind(over(route, 10.0, 1.2), over(route, 62.3, 0.09));
    ASSERT_TRUE(met);
    EXPECT_NEAR(met->position_m.x, 10.0 + 52.3 * 1.2 / 1.11, 1e-9);
    EXPECT_NEAR(met->position_m.z, 0.0, 1e-12);
    EXPECT_FALSE(lane.behind(over(route, 10.0, 1.2), over(route, 62.3, 1.2))) << "level: meets nothing";
    EXPECT_FALSE(lane.behind(over(route, 10.0, 1.2), over(route, 205.0, 0.3))) << "beyond what is known";
    EXPECT_FALSE(lane.hides(over(route, 10.0, 0.65), over(route, 200.0, 0.09)));
}

TEST(LaneAhead, ACrestHidesWhatLiesBehind) {
    const RoadNetwork network = read_opendrive(roads / "country.xodr");
    const Route route(network, {});
    const LaneAhead lane(route, 420.0, 180.0, 1.0);
    // Over a crest of 2500 m radius 1.2 m and 0.09 m see each other within sqrt(2 r a) + sqrt(2 r b) = 77.5 + 21.2 m.
    EXPECT_FALSE(lane.hides(over(route, 425.0, 1.2), over(route, 520.0, 0.09)));
    EXPECT_TRUE(lane.hides(over(route, 425.0, 1.2), over(route, 530.0, 0.09)));
}

TEST(LaneAhead, IsAskedManyPlacesAtATimeAndAnswersAsOneByOne) {
    for (const char* const file : {"country.xodr", "s-bend.xodr", "village.xodr"}) {
        const RoadNetwork network = read_opendrive(roads / file);
        const Route route(network, {});
        std::mt19937 random(1);
        const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
        int hidden = 0, met = 0;
        for (int i = 0; i < 4000; ++i) {
            const double from_m = between(0.0, route.length_m() - 50.0);
            const LaneAhead lane(route, from_m, between(0.0, 200.0), between(0.5, 4.0));
            const auto point = [&](double low_m, double high_m) {
                const Pose pose = route.pose(from_m + between(low_m, high_m), between(-6.0, 6.0));
                return pose.position_m + between(-0.05, 2.0) * pose.up();
            };
            const glm::dvec3 from = point(-3.0, 3.0), to = point(1.0, 200.0), way = to - from;
            bool hides = false, looked_on = true, beyond = false;
            std::optional<glm::dvec3> ground;
            double height_before = 0.0, share_before = 0.0;
            for (const Pose& place : lane.surface()) {
                const double along = glm::dot(way, place.forward()), share = glm::dot(place.position_m - from, place.forward()) / along;
                if (!(along > 0.0))
                    continue;
                const double height = glm::dot(from + share * way - place.position_m, place.up());
                if (looked_on && share > 0.0 && share < 1.0 && height < 0.0) {
                    hides = true;
                    looked_on = false;
                }
                looked_on = looked_on && share < 1.0;
                if (!(share > 1.0) || ground)
                    continue;
                if (height <= 0.0)
                    ground =
                        from + (beyond ? share_before + height_before / (height_before - height) * (share - share_before) : share) * way;
                beyond = true;
                height_before = height;
                share_before = share;
            }
            EXPECT_EQ(lane.hides(from, to), hides) << file << i;
            const std::optional<Pose> behind = lane.behind(from, to);
            ASSERT_EQ(behind.has_value(), ground.has_value()) << file << i;
            EXPECT_EQ(behind ? behind->position_m : glm::dvec3(0.0), ground.value_or(glm::dvec3(0.0))) << file << i;
            hidden += hides ? 1 : 0;
            met += ground ? 1 : 0;
        }
        EXPECT_GT(hidden, 20);
        EXPECT_GT(met, 20);
    }
}

TEST(LaneAhead, EndsWithTheRoute) {
    const RoadNetwork network = read_opendrive(roads / "straight.xodr");
    const Route route(network, {});
    EXPECT_EQ(LaneAhead(route, route.length_m() - 10.0, 200.0, 1.0).surface().size(), 11U);
    EXPECT_EQ(LaneAhead(route, route.length_m() + 10.0, 200.0, 1.0).surface().size(), 0U);
}

const std::vector<double> thresholds_lx{1.0, 3.0, 5.0, 10.0};

TEST(LimitSide, IsTheNumberOfLimitsThatBothBoundsReach) {
    const std::vector<std::pair<LuxBounds, int>> cases{{{0.0, 0.99}, 0},
                                                       {{1.01, 2.99}, 1},
                                                       {{5.1, 9.9}, 3},
                                                       {{11.0, 1e6}, 4},
                                                       {{0.99, 1.01}, undecided_side},
                                                       {{1.0, 1.0}, undecided_side}, // a limit itself lies too near to tell
                                                       {{}, undecided_side},
                                                       {{20.0, NAN}, undecided_side},
                                                       {{NAN, 20.0}, undecided_side}};
    for (const std::size_t count : {1U, 9U, 64U, 1000U}) {
        std::vector<LuxBounds> bounds;
        for (std::size_t i = 0; i < count; ++i)
            bounds.push_back(cases[i * 7 % cases.size()].first);
        std::vector<LimitSide> sides(count);
        std::vector<double> lx(count);
        limit_sides(bounds, thresholds_lx, sides.data(), lx.data());
        for (std::size_t i = 0; i < count; ++i)
            EXPECT_EQ(sides[i], cases[i * 7 % cases.size()].second) << i << " of " << count;
    }
}

// Rows of 4 m by columns of 1 m: no lane's edge moves across columns.
TEST(DecidingPoints, AreBesideADifferenceAndInEverySecondRowAndColumn) {
    const ExtentGrid grid = straight_grid({.ahead_m = 40.0, .beside_m = 6.0, .along_m = 4.0, .across_m = 1.0});
    const std::size_t columns = grid.offset_m.size(), rows = grid.ahead_m.size();
    ASSERT_EQ(columns, 13U);
    ASSERT_EQ(rows, 11U);
    for (const auto& [other, row, column] :
         {std::tuple(LimitSide{2}, 5, 6), std::tuple(undecided_side, 0, 12), std::tuple(LimitSide{0}, 10, 1)}) {
        std::vector<LimitSide> sides(grid.surface.size(), 1);
        sides[static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column)] = other;
        const std::vector<unsigned char> decides = deciding_points(grid, sides);
        for (int r = 0; r < static_cast<int>(rows); ++r)
            for (int c = 0; c < static_cast<int>(columns); ++c)
                EXPECT_EQ(decides[static_cast<std::size_t>(r) * columns + static_cast<std::size_t>(c)] != 0,
                          (std::abs(r - row) <= 1 && std::abs(c - column) <= 1) ||
                              ((r | c | row | column) % 2 == 0 && std::abs(r - row) <= 2 && std::abs(c - column) <= 2))
                    << r << ", " << c;
    }
    const std::vector<unsigned char> none = deciding_points(grid, std::vector<LimitSide>(grid.surface.size(), undecided_side));
    EXPECT_EQ(std::count(none.begin(), none.end(), 1), std::ssize(none)) << "where nothing is known, everything decides";
}

// The right edge of the own lane goes from -1.75 m to -4.25 m between the rows 4 and 5, and from light into the dark: the samples between
// which it crosses the limit are no neighbours. Every second row does so from 4 to 6.
TEST(DecidingPoints, AreWhereALaneWidensAtOnce) {
    ExtentGrid grid = straight_grid({.ahead_m = 40.0, .beside_m = 6.0, .along_m = 4.0, .across_m = 1.0});
    for (std::size_t row = 5; row < grid.sections.size(); ++row)
        grid.sections[row].lanes[1].right_m = -4.25;
    std::vector<LimitSide> sides(grid.surface.size(), 1);
    const auto at = [&](std::size_t row, double offset_m) {
        const auto column = std::ranges::find(grid.offset_m, offset_m) - grid.offset_m.begin();
        return row * grid.offset_m.size() + static_cast<std::size_t>(column);
    };
    for (std::size_t row = 0; row < grid.ahead_m.size(); ++row)
        for (double offset_m = -6.0; offset_m <= -3.0; offset_m += 1.0)
            sides[at(row, offset_m)] = 0;
    const std::vector<unsigned char> decides = deciding_points(grid, sides);
    EXPECT_TRUE(decides[at(4, -2.0)] && decides[at(4, -1.0)]) << "the edge before it";
    EXPECT_TRUE(decides[at(5, -5.0)] && decides[at(5, -4.0)]) << "and behind it";
    EXPECT_TRUE(decides[at(4, 0.0)] && decides[at(6, -6.0)]) << "of every second row";
    EXPECT_FALSE(decides[at(3, -1.0)] || decides[at(6, -5.0)] || decides[at(4, 1.0)] || decides[at(5, -6.0)]);
}

/// A library drive at one of its moments.
struct Played {
    Drive drive;
    RoadNetwork network = read_opendrive(drive.road_file);
    Route route{network, drive.start, drive.via};

    Moment at(int tick, std::size_t lamp_set) const {
        State state = start(drive);
        while (state.tick < tick)
            state = advance(state, drive);
        return moment_at(state, drive, route, drive.lamp_sets.at(lamp_set));
    }
    ExtentGrid grid(const Moment& moment) const { return make_extent_grid(route, moment, drive.bumper_m, *drive.extent); }
};

Played played(const std::string& name) { return {read_drive(FERNLICHT_SOURCE_DIR "/scenarios/library/drives/" + name + ".yaml")}; }

// Straight ahead, a bend, high beams, a parking lane that opens at once.
TEST(DecidingTwin, GivesTheExtentsOfTheTwin) {
    for (const auto& [name, tick] : {std::pair("first-light", 0), std::pair("first-light", 200), std::pair("s-bend", 120),
                                     std::pair("village", 180), std::pair("village", 240), std::pair("motorway", 60)}) {
        const Played drive = played(name);
        for (const std::size_t lamp_set : {0U, 1U}) {
            const Moment moment = drive.at(tick, lamp_set);
            const ExtentGrid grid = drive.grid(moment);
            for (const Surface surface : {Surface::road, Surface::target}) {
                const std::vector<double> exact = twin_illuminance_lx(grid, moment, surface);
                const std::vector<double> deciding = twin_lux_near_thresholds(grid, moment, surface, thresholds_lx);
                const auto extents = [&](const std::vector<double>& lx) {
                    return measure_extent(grid, lx, surface, thresholds_lx, {20.0, 50.0, 33.3});
                };
                EXPECT_EQ(extents(deciding), extents(exact)) << name << " " << tick;
                const auto errors = [&](const std::vector<double>& lx) {
                    return grid_errors(grid, lx, surface, thresholds_lx, extents(lx));
                };
                const std::vector<GridError> from_deciding = errors(deciding), from_exact = errors(exact);
                ASSERT_EQ(from_deciding.size(), from_exact.size());
                for (std::size_t i = 0; i < from_exact.size(); ++i)
                    for (const auto figure : {&GridError::reach, &GridError::edge, &GridError::unlit, &GridError::area})
                        EXPECT_EQ(from_deciding[i].*figure, from_exact[i].*figure) << name << " " << tick << " " << from_exact[i].lane;
                const std::size_t same = static_cast<std::size_t>(
                    std::inner_product(exact.begin(), exact.end(), deciding.begin(), std::ptrdiff_t{0}, std::plus<>(), std::equal_to<>()));
                EXPECT_LT(same, exact.size() / 2) << "most points decide nothing";
            }
        }
    }
}

// A lamp of which nothing quick is known is calculated everywhere.
TEST(DecidingTwin, IsTheTwinForATableInTheLogarithm) {
    const Played drive = played("first-light");
    Moment moment = drive.at(0, 0);
    for (LitLamp& lamp : moment.lamps) {
        auto file = std::make_shared<LampFile>(*lamp.file);
        file->table.rule = BetweenSamples::log_cd;
        lamp.file = file;
    }
    const ExtentGrid grid = drive.grid(moment);
    EXPECT_EQ(twin_lux_near_thresholds(grid, moment, Surface::target, thresholds_lx), twin_illuminance_lx(grid, moment, Surface::target));
}

} // namespace
} // namespace fernlicht
