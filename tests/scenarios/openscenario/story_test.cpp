#include "tests/scenarios/openscenario/story_text.h"

#include "scenarios/values/errors.h"

#include <cmath>

namespace fernlicht::osc {
namespace {

const std::string begin = of("Ego", teleport(on_lane(-1, 50.0)) + speed("20"));

TEST(Story, InitSpeedMovesAlongTheLane) {
    const PlayedStory played = play_text(scenario_text(begin, stop_at(5.0)));
    ASSERT_EQ(played.end, "the stop trigger");
    const auto& ego = played.entities[0].samples;
    ASSERT_GE(ego.size(), 500u);
    EXPECT_NEAR(ego[0].s_m, 50.0, 1e-9);
    EXPECT_NEAR(ego[500].s_m, 150.0, 1e-6); // 5 s at 20 m/s
    EXPECT_EQ(ego[500].lane, -1);
    EXPECT_FALSE(played.entities[1].samples[0].present); // no place was given
}

/// 20 m/s to 10 m/s at a rate of 2 m/s2: 5 s, 75 m. With a sinusoid whose steepest slope is 2: pi/2 times as long, and by symmetry the mean
/// speed too.
TEST(Story, SpeedShapesLastAsTheirLargestRateSays) {
    const auto last = [](const std::string& shape) {
        const std::string action = speed("10", "dynamicsShape=\"" + shape + "\" dynamicsDimension=\"rate\" value=\"2\"");
        return play_text(scenario_text(begin, story(event("e", action, at_time(1.0))) + stop_at(15.0)));
    };
    const auto linear = last("linear").entities[0].samples;
    EXPECT_NEAR(linear[350].speed_mps, 15.0, 0.05);
    EXPECT_NEAR(linear[610].speed_mps, 10.0, 1e-9);
    EXPECT_NEAR(linear[700].s_m, 50.0 + 20.0 + 75.0 + 10.0, 0.25);
    const auto sine = last("sinusoidal").entities[0].samples;
    const double half = 0.5 * pi * 5.0 / 2.0;
    EXPECT_NEAR(sine[static_cast<std::size_t>(100.0 * (1.0 + half))].speed_mps, 15.0, 0.05);
    EXPECT_GT(sine[870].speed_mps, 10.0);
    EXPECT_NEAR(sine[900].speed_mps, 10.0, 1e-9);
    const auto cubic = last("cubic").entities[0].samples;
    EXPECT_NEAR(cubic[100 + 375].speed_mps, 15.0, 0.05); // half of 1.5 * 5 s
    EXPECT_NEAR(cubic[100 + 760].speed_mps, 10.0, 1e-9);
}

TEST(Story, LaneChangeEndsInTheOtherLane) {
    const std::string action =
        "<PrivateAction><LateralAction><LaneChangeAction><LaneChangeActionDynamics dynamicsShape=\"sinusoidal\" dynamicsDimension=\"time\" "
        "value=\"3\"/><LaneChangeTarget><AbsoluteTargetLane "
        "value=\"1\"/></LaneChangeTarget></LaneChangeAction></LateralAction></PrivateAction>";
    const PlayedStory played = play_text(scenario_text(begin, story(event("e", action, at_time(1.0))) + stop_at(6.0)));
    const auto& ego = played.entities[0].samples;
    const double from = ego[0].t_m, to = -from;
    EXPECT_NEAR(ego[252].t_m, 0.5 * (from + to), 0.05); // the middle after 1.5 s
    EXPECT_NEAR(ego[420].t_m, to, 1e-6);
    EXPECT_EQ(ego[420].lane, 1);
    EXPECT_GT(ego[250].heading_rad, 0.05);
    double way = 0.0; // the car's way is 20 m/s all the time, sideways or not
    for (std::size_t i = 1; i <= 500; ++i)
        way += std::hypot(ego[i].position_m.x - ego[i - 1].position_m.x, ego[i].position_m.y - ego[i - 1].position_m.y);
    EXPECT_NEAR(way, 100.0, 0.05);
}

/// A rising edge needs a judgement before it: what is true from the start never rises.
TEST(Story, EdgesAndDelays) {
    const auto changed_at = [](const std::string& trigger) {
        const auto samples = play_text(scenario_text(begin, story(event("e", speed("5"), trigger)) + stop_at(6.0))).entities[0].samples;
        for (std::size_t i = 0; i < samples.size(); ++i)
            if (samples[i].speed_mps < 10.0)
                return static_cast<double>(i) * 0.01;
        return -1.0;
    };
    const std::string two = R"(<SimulationTimeCondition value="2" rule="greaterThan"/>)";
    const std::string always = R"(<SimulationTimeCondition value="-1" rule="greaterThan"/>)";
    EXPECT_NEAR(changed_at(by_value(two)), 2.02, 0.011);
    EXPECT_NEAR(changed_at(by_value(two, R"(delay="0" conditionEdge="rising")")), 2.02, 0.011);
    EXPECT_NEAR(changed_at(by_value(two, R"(delay="1.5" conditionEdge="rising")")), 3.52, 0.011);
    EXPECT_EQ(changed_at(by_value(always, R"(delay="0" conditionEdge="rising")")), -1.0);
    EXPECT_EQ(changed_at(by_value(two, R"(delay="0" conditionEdge="falling")")), -1.0);
    EXPECT_LE(changed_at(by_value(always)), 0.02);
}

TEST(Story, ParametersAndExpressions) {
    const std::string declared = R"(<ParameterDeclaration name="kmh" parameterType="double" value="36"/>)"
                                 R"(<ParameterDeclaration name="twice" parameterType="double" value="${2 * $kmh}"/>)";
    const auto text = scenario_text(of("Ego", teleport(on_lane(-1, 50.0)) + speed("${$twice / 3.6}")), stop_at(1.0), declared);
    EXPECT_NEAR(play_text(text).entities[0].samples[0].speed_mps, 20.0, 1e-12);
    const StoryFile file(text);
    EXPECT_EQ(read_storyboard(file.path(), {.parameters = {{"kmh", "18"}}}).parameters.at("kmh"), "18");
    EXPECT_THROW(read_storyboard(file.path(), {.parameters = {{"mph", "18"}}}), InputError);
}

TEST(Story, RefusesWithFileAndLineWhatItCannotPlay) {
    const auto refusal = [](const std::string& text) {
        try {
            play_text(text);
        } catch (const InputError& error) {
            EXPECT_GT(error.where().line, 0u) << error.what();
            return std::string(error.what());
        }
        return std::string("played");
    };
    EXPECT_NE(refusal(scenario_text(of("Eggo", speed("1")), "")).find("perhaps 'Ego'"), std::string::npos);
    EXPECT_NE(refusal(scenario_text(of("Ego", teleport(on_lane(-7, 50.0))), "")).find("lane -7"), std::string::npos);
    EXPECT_NE(refusal(scenario_text(of("Ego", teleport(on_lane(-1, 1e6))), "")).find("s = 1e+06"), std::string::npos);
    EXPECT_NE(refusal(scenario_text(of("Ego", speed("fast")), "")).find("'fast'"), std::string::npos);
    EXPECT_NE(refusal(scenario_text(of("Ego", speed("$v")), "")).find("unknown parameter 'v'"), std::string::npos);
    const std::string user = "<UserDefinedAction><CustomCommandAction type=\"x\"/></UserDefinedAction>";
    EXPECT_NE(refusal(scenario_text(begin + user, "")).find("not supported"), std::string::npos);
    const StoryFile file(scenario_text(begin + user, stop_at(1.0)));
    EXPECT_FALSE(read_storyboard(file.path(), {.lenient = true}).notes.empty());
}

TEST(Story, SameFileGivesTheSameBytes) {
    const std::string text = scenario_text(
        begin + of("Other", teleport(on_lane(-1, 90.0)) + speed("10")),
        story(event("e", speed("10", R"(dynamicsShape="cubic" dynamicsDimension="distance" value="30")"), at_time(1.0))) + stop_at(6.0));
    const PlayedStory a = play_text(text), b = play_text(text);
    ASSERT_EQ(a.ticks(), b.ticks());
    for (std::size_t e = 0; e < 2; ++e)
        for (std::size_t i = 0; i < a.ticks(); ++i)
            ASSERT_EQ(a.entities[e].samples[i].position_m, b.entities[e].samples[i].position_m);
}

} // namespace
} // namespace fernlicht::osc
