#include "tests/scenarios/openscenario/story_text.h"

#include "scenarios/values/errors.h"

#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <functional>
#include <gmock/gmock.h>

namespace fernlicht::osc {
namespace {

using testing::HasSubstr;

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
    const auto played_to = [](int lane) {
        const std::string action = fmt::format(
            R"(<PrivateAction><LateralAction><LaneChangeAction><LaneChangeActionDynamics dynamicsShape="sinusoidal" dynamicsDimension="time"
value="3"/><LaneChangeTarget><AbsoluteTargetLane value="{}"/></LaneChangeTarget></LaneChangeAction></LateralAction></PrivateAction>)",
            lane);
        return play_text(scenario_text(begin, story(event("e", action, at_time(1.0))) + stop_at(6.0)));
    };
    const PlayedStory nowhere = played_to(-7);
    EXPECT_THAT(nowhere.notes, testing::ElementsAre(testing::AllOf(HasSubstr("s: Ego cannot change to lane -7, road '1' has "),
                                                                   HasSubstr("-1"), HasSubstr(" there; it stays on lane -1"))));
    EXPECT_EQ(nowhere.entities[0].samples[420].lane, -1);
    const PlayedStory played = played_to(1);
    EXPECT_TRUE(played.notes.empty());
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

TEST(Story, InitPlacesEntitiesInTheOrderThatTheirPositionsNeed) {
    const std::string beside = teleport(R"(<RelativeLanePosition entityRef="Ego" dLane="0" ds="30"/>)");
    const std::string added = R"(<GlobalAction><EntityAction entityRef="Other"><AddEntityAction><Position>
<RelativeRoadPosition entityRef="Ego" ds="30" dt="0"/></Position></AddEntityAction></EntityAction></GlobalAction>)";
    for (const std::string& other : {of("Other", beside + speed("3")), added + of("Other", speed("3"))}) {
        const EntitySample at = play_text(scenario_text(other + begin, stop_at(1.0))).entities[1].samples[0];
        EXPECT_TRUE(at.present);
        EXPECT_NEAR(at.s_m, 80.0, 1e-9);
        EXPECT_EQ(at.lane, -1);
        EXPECT_EQ(at.speed_mps, 3.0);
    }
}

TEST(Story, PositionsThatNeedAPlaceWhichIsNotThereAreRefusedWithTheNames) {
    const auto beside = [](const std::string& entity) {
        return teleport(fmt::format(R"(<RelativeObjectPosition entityRef="{}" dx="5" dy="0"/>)", entity));
    };
    const auto refused = [](const std::string& init, const std::string& events) {
        return tests::refusal_of([&] { play_text(scenario_text(init, events + stop_at(1.0))); }, "played");
    };
    const std::string needs = "story.xosc:11: PrivateAction: needs the place of an entity that has none: ";
    EXPECT_THAT(refused(of("Other", beside("Ego")), ""),
                HasSubstr(needs + "'Other' > 'Ego', expected an entity that Init places without it"));
    EXPECT_THAT(refused(of("Ego", beside("Ego")), ""), HasSubstr(needs + "'Ego' > 'Ego'"));
    EXPECT_THAT(refused(of("Ego", beside("Other")) + of("Other", beside("Ego")), ""), HasSubstr(needs + "'Ego' > 'Other' > 'Ego'"));
    EXPECT_THAT(refused(begin, story(event("e", beside("Other"), at_time(0.5)))),
                HasSubstr("story.xosc:11: a: found a position relative to 'Other', which has no place, expected an entity that has one"));
    EXPECT_EQ(refused(begin, story(event("e", beside("Ego"), at_time(0.5)))), "played") << "5 m on from where it is";
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
    EXPECT_EQ(read_storyboard(story_file(text), {.parameters = {{"kmh", "18"}}}).parameters.at("kmh"), "18");
    EXPECT_THROW(read_storyboard(story_file(text), {.parameters = {{"mph", "18"}}}), InputError);
}

std::string light(const std::string& action, const std::string& state) {
    return "<PrivateAction><AppearanceAction><LightStateAction " + action +
           "><LightType><VehicleLight vehicleLightType=\"lowBeam\"/></LightType><LightState " + state +
           "/></LightStateAction></AppearanceAction></PrivateAction>";
}

std::string vertex(double time) {
    return "<Vertex time=\"" + std::to_string(time) + "\"><Position>" + on_lane(-1, 50.0 + time) + "</Position></Vertex>";
}

std::string refusal_of(const std::filesystem::path& path) {
    return tests::refusal_of([&] { read_storyboard(path); }, "read");
}

/// A scenario that takes its route from a catalog in the folder.
class Catalogs : public testing::Test {
  protected:
    const std::filesystem::path folder_ = tests::new_folder();
    void write_catalog(const std::string& file, const std::string& name, const std::string& entries) const {
        std::ofstream(folder_ / file) << R"(<OpenSCENARIO><FileHeader revMajor="1" revMinor="0"/><Catalog name=")" << name << "\">"
                                      << entries << "</Catalog></OpenSCENARIO>";
    }
    static std::string reference(const std::string& catalog, const std::string& entry) {
        return "<CatalogReference catalogName=\"" + catalog + "\" entryName=\"" + entry + "\"/>";
    }
    static std::string way(const std::string& position) {
        return "<Waypoint routeStrategy=\"shortest\"><Position>" + position + "</Position></Waypoint>";
    }
    static std::string on_route(const std::string& catalog, const std::string& entry) {
        return "<RoutePosition><RouteRef>" + reference(catalog, entry) +
               "</RouteRef><InRoutePosition><FromLaneCoordinates pathS=\"1\" laneId=\"-1\"/></InRoutePosition></RoutePosition>";
    }
    /// What reading says of an Ego that is assigned this route.
    std::string told(const std::string& catalog, const std::string& entry) const {
        std::string text = scenario_text(of("Ego", teleport(on_lane(-1, 50.0)) + "<PrivateAction><RoutingAction><AssignRouteAction>" +
                                                       reference(catalog, entry) + "</AssignRouteAction></RoutingAction></PrivateAction>"),
                                         stop_at(1.0));
        const std::string none = "<CatalogLocations/>";
        text.replace(text.find(none), none.size(),
                     "<CatalogLocations><RouteCatalog><Directory path=\"" + folder_.string() + "\"/></RouteCatalog></CatalogLocations>");
        return refusal_of(story_file(text));
    }
};

TEST_F(Catalogs, AreFoundByTheirNameAndBehindItByTheirFiles) {
    const std::string ways = way(on_lane(-1, 10.0)) + way(on_lane(-1, 90.0));
    write_catalog("Ways.xosc", "Other", "<Route name=\"a\" closed=\"false\">" + ways + "</Route>");
    write_catalog("Zoo.xosc", "Routes", "<Route name=\"b\" closed=\"false\">" + ways + "</Route>");
    EXPECT_EQ(told("Other", "a"), "read");
    EXPECT_EQ(told("Ways", "a"), "read");
    EXPECT_EQ(told("Zoo", "b"), "read");
    EXPECT_THAT(told("Wegs", "a"),
                HasSubstr("found 'Wegs', expected a catalog in the folders of CatalogLocations: 'Other', 'Routes', 'Ways', 'Zoo'"));
    EXPECT_THAT(told("Ways", "b"), HasSubstr("entryName: found 'b'"));
    write_catalog("Aaa.xosc", "Ways", "<Route name=\"a\" closed=\"false\"/>");
    EXPECT_THAT(told("Ways", "a"), HasSubstr("has 0 waypoints")) << "its own name comes before a file's";
}

TEST_F(Catalogs, AnEntryThatNeedsItselfIsRefusedWithTheWayBack) {
    write_catalog(
        "R.xosc", "R",
        "<Route name=\"a\" closed=\"false\">" + way(on_lane(-1, 1.0)) + way(on_route("R", "b")) + "</Route>" +
            "<Route name=\"b\" closed=\"false\">" + way(on_lane(-1, 1.0)) + way(on_route("R", "a")) + "</Route>" +
            R"(<Trajectory name="t" closed="false"><Shape><Polyline><Vertex time="0"><Position><TrajectoryPosition s="1" t="0">
<TrajectoryRef>)" +
            reference("R", "t") + "</TrajectoryRef></TrajectoryPosition></Position></Vertex></Polyline></Shape></Trajectory>" +
            "<Route name=\"c\" closed=\"false\">" + way(on_lane(-1, 1.0)) +
            way("<TrajectoryPosition s=\"1\" t=\"0\"><TrajectoryRef>" + reference("R", "t") + "</TrajectoryRef></TrajectoryPosition>") +
            "</Route>");
    EXPECT_THAT(told("R", "a"), HasSubstr("R.xosc:1: Route: leads back to itself: 'a' > 'b' > 'a'"));
    EXPECT_THAT(told("R", "c"), HasSubstr("leads back to itself: 't' > 't'"));
}

/// Each route leads over `waypoints` places on the next.
std::string routes_in_a_row(int count, int waypoints, const std::function<std::string(const std::string&)>& way_to,
                            const std::string& last) {
    std::string entries;
    for (int i = 0; i < count; ++i) {
        entries += fmt::format("<Route name=\"r{}\" closed=\"false\">", i) + last;
        for (int k = 0; k < waypoints; ++k)
            entries += i + 1 < count ? way_to(fmt::format("r{}", i + 1)) : last;
        entries += "</Route>";
    }
    return entries;
}

TEST_F(Catalogs, WaysThatDoNotEndAreRefusedWithTheWay) {
    const auto way_to = [](const std::string& name) { return way(on_route("R", name)); };
    write_catalog("R.xosc", "R", routes_in_a_row(64, 1, way_to, way(on_lane(-1, 1.0))));
    EXPECT_EQ(told("R", "r0"), "read");
    write_catalog("R.xosc", "R", routes_in_a_row(20'000, 1, way_to, way(on_lane(-1, 1.0))));
    EXPECT_THAT(told("R", "r0"),
                HasSubstr("R.xosc:1: Route: lies on a way from one to the next: 'r0' > 'r1' > 'r2' > 'r3' > ... > 'r62' > 'r63' "
                          "> 'r64', expected 64 at most"));
    write_catalog("R.xosc", "R", routes_in_a_row(10, 2, way_to, way(on_lane(-1, 1.0))));
    EXPECT_EQ(told("R", "r0"), "read");
    write_catalog("R.xosc", "R", routes_in_a_row(30, 2, way_to, way(on_lane(-1, 1.0)))); // 2^30 were they read
    EXPECT_THAT(told("R", "r0"), HasSubstr("R.xosc:1: Route: is the 10001th route or trajectory that lies within others: 'r0' > 'r1' > "));
}

TEST(Story, LongParametersAreRefusedBeforeTheyFillMemory) {
    std::string declarations = R"(<ParameterDeclaration name="A0" parameterType="string" value=")" + std::string(60'000, 'x') + "\"/>";
    for (int i = 1; i < 3000; ++i)
        declarations += fmt::format("\n<ParameterDeclaration name=\"A{}\" parameterType=\"string\" value=\"$A0\"/>", i);
    EXPECT_THAT(refusal_of(story_file(scenario_text(begin, stop_at(1.0), declarations))),
                HasSubstr("value: gives a text of 60000 bytes, with which parameters fill more than 64 MiB"));
    declarations.clear();
    for (int i = 0; i < 10'000; ++i) // many that are short are read in their time
        declarations += fmt::format("\n<ParameterDeclaration name=\"A{}\" parameterType=\"string\" value=\"$A{}\"/>", i, i - 1);
    declarations.replace(declarations.find("$A-1"), 4, "1");
    EXPECT_EQ(refusal_of(story_file(scenario_text(begin, stop_at(1.0), declarations))), "read");
}

TEST(Story, ParametersThatDoubleAreRefusedBeforeTheyFillMemory) {
    std::string declarations = R"(<ParameterDeclaration name="A0" parameterType="string" value="0123456789"/>)";
    for (int i = 1; i < 60; ++i)
        declarations += fmt::format("\n<ParameterDeclaration name=\"A{}\" parameterType=\"string\" value=\"$A{}$A{}\"/>", i, i - 1, i - 1);
    EXPECT_THAT(refusal_of(story_file(scenario_text(begin, stop_at(1.0), declarations))),
                HasSubstr("found '$A12$A12': its parameters give a text of more than 65536 bytes"));
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
    EXPECT_THAT(refusal(scenario_text(of("Eggo", speed("1")), "")), HasSubstr("perhaps 'Ego'"));
    EXPECT_THAT(refusal(scenario_text(of("Ego", teleport(on_lane(-7, 50.0))), "")), HasSubstr("lane -7"));
    EXPECT_THAT(refusal(scenario_text(of("Ego", teleport(on_lane(-1, 1e6))), "")), HasSubstr("s = 1e+06"));
    EXPECT_THAT(refusal(scenario_text(of("Ego", speed("fast")), "")), HasSubstr("'fast'"));
    EXPECT_THAT(refusal(scenario_text(of("Ego", speed("$v")), "")), HasSubstr("unknown parameter 'v'"));
    const auto refused = [&](const std::string& actions, const std::string& sentence) {
        EXPECT_THAT(refusal(scenario_text(of("Ego", actions), "")), HasSubstr(sentence));
    };
    const auto over = [](const std::string& dimension, const std::string& value) {
        return R"(dynamicsShape="linear" dynamicsDimension=")" + dimension + "\" value=\"" + value + '"';
    };
    refused(speed("1", over("time", "-3")), "SpeedActionDynamics@value: found -3, expected a time not below 0");
    refused(speed("1", over("distance", "-3")), "SpeedActionDynamics@value: found -3, expected a distance not below 0");
    EXPECT_THAT(read_storyboard(story_file(scenario_text(of("Ego", speed("1", over("rate", "-1"))), ""))).notes,
                testing::Contains(HasSubstr("SpeedActionDynamics: the rate -1 in value is taken as 1: start and target say which way")));
    refused(teleport(R"(<WorldPosition x="1" y="1e300"/>)"), "WorldPosition@y: found 1e+300, expected a place within 1e9 m");
    const auto gap = [](const std::string& attributes) {
        return "<PrivateAction><LongitudinalAction><LongitudinalDistanceAction entityRef=\"Other\" freespace=\"false\" "
               "continuous=\"true\" " +
               attributes + "/></LongitudinalAction></PrivateAction>";
    };
    refused(gap(R"(distance="-5")"), "LongitudinalDistanceAction@distance: found -5, expected a distance not below 0");
    refused(gap(R"(timeGap="-5")"), "LongitudinalDistanceAction@timeGap: found -5, expected a time not below 0");
    const auto lateral = [](const std::string& action) {
        return "<PrivateAction><LateralAction>" + action + "</LateralAction></PrivateAction>";
    };
    const auto offset = [&](const std::string& acceleration, const std::string& value) {
        return lateral("<LaneOffsetAction continuous=\"false\"><LaneOffsetActionDynamics dynamicsShape=\"sinusoidal\" maxLateralAcc=\"" +
                       acceleration + "\"/><LaneOffsetTarget><AbsoluteTargetLaneOffset value=\"" + value +
                       "\"/></LaneOffsetTarget></LaneOffsetAction>");
    };
    refused(offset("-2", "1"), "LaneOffsetActionDynamics@maxLateralAcc: found -2, expected an acceleration not below 0");
    refused(offset("2", "1e300"), "AbsoluteTargetLaneOffset@value: found 1e+300, expected a length within 1e9 m");
    refused(lateral(R"(<LateralDistanceAction entityRef="Other" distance="-5"/>)"),
            "LateralDistanceAction@distance: found -5, expected a distance not below 0");
    refused(lateral(R"(<LateralDistanceAction entityRef="Other" distance="5"><DynamicConstraints maxSpeed="-1"/></LateralDistanceAction>)"),
            "DynamicConstraints@maxSpeed: found -1, expected a speed not below 0");
    refused(teleport(R"(<LanePosition roadId="1" laneId="-1" s="50" offset="1e300"/>)"),
            "LanePosition@offset: found 1e+300, expected a length within 1e9 m");
    refused(teleport(R"(<RoadPosition roadId="1" s="50" t="1e300"/>)"), "RoadPosition@t: found 1e+300, expected a length within 1e9 m");
    refused(teleport(R"(<WorldPosition x="1" y="0" h="1e300"/>)"), "WorldPosition@h: found 1e+300, expected an angle within 1e6 rad");
    refused(teleport(R"(<RoadPosition roadId="1" s="50" t="0"><Orientation h="INF"/></RoadPosition>)"),
            "Orientation@h: found inf, expected an angle within 1e6 rad");
    for (const char* kind : {"RelativeWorldPosition", "RelativeObjectPosition"})
        refused(teleport(fmt::format(R"(<{} entityRef="Other" dx="1e300" dy="0"/>)", kind)),
                fmt::format("{}@dx: found 1e+300, expected a length within 1e9 m", kind));
    refused(teleport(R"(<RelativeRoadPosition entityRef="Other" ds="0" dt="-1e300"/>)"),
            "RelativeRoadPosition@dt: found -1e+300, expected a length within 1e9 m");
    refused(teleport(R"(<RelativeLanePosition entityRef="Other" dLane="0" ds="1e300"/>)"),
            "RelativeLanePosition@ds: found 1e+300, expected a length within 1e9 m");
    refused(light("", R"(mode="on" luminousIntensity="-100")"), "LightState@luminousIntensity: found -100, expected candela not below 0");
    refused(light(R"(transitionTime="-1.2")", R"(mode="on")"), "LightStateAction@transitionTime: found -1.2, expected a time not below 0");
    refused(light("", R"(mode="flashing" flashingOnDuration="0")"), "LightState@flashingOnDuration: found 0, expected a time above 0");
    refused(light("", R"(mode="flashing" flashingOffDuration="-1")"), "LightState@flashingOffDuration: found -1, expected");
    refused(light("", R"(mode="flashing" flashingOnDuration="5e-6" flashingOffDuration="5e-6")"),
            "LightState@flashingOnDuration: found a light that flashes every 1e-05 s, expected 0.01 s at least");
    refused(R"(<PrivateAction><RoutingAction><FollowTrajectoryAction><TimeReference><None/></TimeReference><TrajectoryRef>
<Trajectory name="t" closed="false"><Shape><Polyline>)" +
                vertex(0.0) + vertex(2.0) + vertex(1.5) +
                "</Polyline></Shape></Trajectory></TrajectoryRef></FollowTrajectoryAction></RoutingAction></PrivateAction>",
            "Vertex@time: found 1.5 after 2, expected times that do not fall");
    EXPECT_THAT(refusal(scenario_text(begin, story(event("e", speed("1"), at_time(1.0), R"(maximumExecutionCount="-1")")))),
                HasSubstr("Event@maximumExecutionCount: found -1, expected a count not below 0"));
    const std::string user = "<UserDefinedAction><CustomCommandAction type=\"x\"/></UserDefinedAction>";
    EXPECT_THAT(refusal(scenario_text(begin + user, "")), HasSubstr("not supported"));
    EXPECT_FALSE(read_storyboard(story_file(scenario_text(begin + user, stop_at(1.0))), {.lenient = true}).notes.empty());
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
