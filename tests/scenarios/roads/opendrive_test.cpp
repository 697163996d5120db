// What a file says, as numbers: header, profiles, lanes, marks, objects, signals.
#include "scenarios/roads/plan.h"
#include "scenarios/roads/road_network.h"
#include "scenarios/values/errors.h"
#include "tests/scenarios/roads/opendrive_text.h"
#include "tests/trial.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <random>
#include <tuple>

namespace fernlicht {
namespace {

using namespace opendrive_text;
using testing::Contains, testing::HasSubstr;

using opendrive_text::network_of;
RoadNetwork network_of(const RoadText& text) { return network_of(file(road(text))); }

TEST(OpenDrive, CleanFileHasNoWarningsAndGapsAreTold) {
    const RoadNetwork network = network_of(RoadText{});
    EXPECT_TRUE(network.warnings.empty());
    ASSERT_EQ(network.opened.size(), 1U);
    EXPECT_NE(network.find("1"), nullptr);
    EXPECT_EQ(network.find("2"), nullptr);
    RoadText text{.length = "20", .plan = "\n" + geometry(0.0, 0.0, 0.0, 0.0, 10.0) + "\n" + geometry(10.0, 10.0, 0.25, 0.0, 10.0) + "\n"};
    const RoadNetwork other_network = network_of(text);
    ASSERT_EQ(other_network.warnings.size(), 1U);
    EXPECT_THAT(other_network.warnings[0], HasSubstr(":9: road '1': the reference line jumps by 0.250 m at s = 10"));
}

TEST(OpenDrive, HeaderOffsetTurnsThenMoves) {
    const RoadNetwork network = network_of(file(road({}), R"(<header revMajor="1" revMinor="6" name="n">
        <geoReference><![CDATA[+proj=utm +zone=32]]></geoReference><offset x="680000" y="5400000" z="400" hdg="1.5707963267948966"/></header>)"));
    EXPECT_EQ(network.geo_reference, "+proj=utm +zone=32");
    const Pose pose = surface_pose(network, network.roads[0], 10.0, 2.0);
    EXPECT_NEAR(pose.position_m.x, 680'000.0 - 2.0, 1e-9);
    EXPECT_NEAR(pose.position_m.y, 5'400'010.0, 1e-9);
    EXPECT_NEAR(pose.position_m.z, 400.0, 1e-12);
}

TEST(OpenDrive, NamespacesLatin1AndByteOrderMark) {
    const std::string spaced =
        "\xef\xbb\xbf<x:OpenDRIVE xmlns:x=\"http://code.asam.net/simulation/standard/opendrive_schema\">"
        "<x:header revMajor=\"1\" revMinor=\"8\"/><x:road id=\"1\" name=\"B\xc3\xa4umle\" length=\"10\"><x:planView>"
        "<x:geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"10\"><x:line/></x:geometry></x:planView><x:lanes><x:laneSection s=\"0\">"
        "<x:center><x:lane id=\"0\"/></x:center></x:laneSection></x:lanes></x:road></x:OpenDRIVE>";
    EXPECT_EQ(network_of(spaced).roads[0].name, "B\xc3\xa4umle");
    std::string latin = file(road({}));
    latin.replace(latin.find("UTF-8"), 5, "ISO-8859-1");
    latin.replace(latin.find("road id"), 4, "road name=\"B\xe4umle\"");
    EXPECT_EQ(network_of(latin).roads[0].name, "B\xc3\xa4umle");
}

TEST(OpenDrive, GradeAndRoll) {
    const RoadNetwork network = network_of(RoadText{
        .profiles =
            R"(<elevationProfile><elevation s="0" a="10" b="0.1" c="0" d="0"/><elevation s="50" a="15" b="0.1" c="-0.002" d="0"/></elevationProfile>
        <lateralProfile><superelevation s="0" a="0.05" b="0" c="0" d="0"/></lateralProfile>)"});
    const Pose pose = surface_pose(network, network.roads[0], 20.0, 4.0);
    const glm::dmat3 axes = axes_from_angles(0.0, std::atan(0.1), 0.05);
    const glm::dvec3 expected = glm::dvec3(20.0, 0.0, 12.0) + 4.0 * axes[1];
    EXPECT_NEAR(glm::distance(pose.position_m, expected), 0.0, 1e-12);
    EXPECT_GT(pose.position_m.z, 12.0); // positive superelevation lifts the left side
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(glm::distance(pose.axes[i], axes[i]), 0.0, 1e-12);
    EXPECT_NEAR(surface_pose(network, network.roads[0], 60.0, 0.0).position_m.z, 15.0 + 1.0 - 0.2, 1e-12);
}

/// Tangents and normal against differences of positions, with everything bending at once.
TEST(OpenDrive, SurfaceAxesAreTangents) {
    RoadText text;
    text.plan = geometry(0.0, 3.0, 4.0, 0.7, 100.0, R"(<spiral curvStart="0.01" curvEnd="-0.02"/>)");
    text.profiles = R"(<elevationProfile><elevation s="0" a="1" b="0.05" c="0.001" d="-1e-5"/></elevationProfile>
        <lateralProfile><superelevation s="0" a="0.02" b="0.001" c="0" d="0"/>
        <shape s="0" t="-5" a="0.2" b="-0.04" c="0" d="0"/><shape s="0" t="0" a="0" b="0.03" c="0.001" d="0"/>
        <shape s="80" t="-5" a="0.1" b="-0.02" c="0" d="0"/><shape s="80" t="0" a="0" b="0.01" c="0.002" d="0"/></lateralProfile>)";
    const RoadNetwork network = network_of(text);
    const Road& only = network.roads[0];
    for (double s = 5.0; s < 79.0; s += 9.3)
        for (const double t : {-12.0, -3.0, 0.5, 2.0, 20.0}) {
            constexpr double h = 1e-5;
            const Pose pose = surface_pose(network, only, s, t);
            const glm::dvec3 by_s = surface_pose(network, only, s + h, t).position_m - surface_pose(network, only, s - h, t).position_m;
            const glm::dvec3 by_t = surface_pose(network, only, s, t + h).position_m - surface_pose(network, only, s, t - h).position_m;
            EXPECT_NEAR(glm::distance(glm::normalize(by_s), pose.forward()), 0.0, 1e-7) << s << ' ' << t;
            EXPECT_NEAR(glm::distance(glm::normalize(glm::cross(by_s, by_t)), pose.up()), 0.0, 1e-7) << s << ' ' << t;
        }
}

TEST(OpenDrive, ShapeIsLinearInSAndGoesOnStraightBesideTheRoad) {
    const RoadNetwork network = network_of(RoadText{
        .profiles = R"(<lateralProfile><shape s="0" t="-3.5" a="0.1" b="-0.02" c="0" d="0"/><shape s="0" t="0" a="0" b="0" c="0.01" d="0"/>
        <shape s="100" t="-3.5" a="0.3" b="-0.02" c="0" d="0"/><shape s="100" t="0" a="0" b="0" c="0.01" d="0"/></lateralProfile>)"});
    const auto z = [&](double s, double t) { return surface_pose(network, network.roads[0], s, t).position_m.z; };
    EXPECT_NEAR(z(0.0, 2.0), 0.04, 1e-12);
    EXPECT_NEAR(z(50.0, -3.5), 0.2, 1e-12);
    EXPECT_NEAR(z(0.0, 3.5), 0.1225, 1e-12);
    EXPECT_NEAR(z(0.0, 13.5), 0.1225 + 10.0 * 0.07, 1e-12); // slope at the edge of lane 1
    EXPECT_NEAR(z(0.0, -13.5), 0.1 + 10.0 * 0.02, 1e-12);
}

TEST(OpenDrive, WidthsBordersAndOffset) {
    const RoadNetwork network = network_of(RoadText{
        .lanes =
            R"(<laneOffset s="0" a="1" b="0.01" c="0" d="0"/>)" + section(0.0, lane(2, "3") + lane(1), lane(-1) + lane(-2, "-2")) +
            section(
                60.0, "",
                R"(<lane id="-1" type="driving"><width sOffset="0" a="3" b="0" c="0" d="0"/><width sOffset="10" a="3" b="0.1" c="0" d="0"/></lane>)")});
    const Road& only = network.roads[0];
    const LaneSection& first = section_at(only, 20.0);
    EXPECT_NEAR(lane_edges(only, first, 2, 20.0).inner_t_m, 1.2 + 3.5, 1e-12);
    EXPECT_NEAR(lane_edges(only, first, 2, 20.0).outer_t_m, 1.2 + 6.5, 1e-12);
    EXPECT_NEAR(lane_edges(only, first, -2, 20.0).outer_t_m, 1.2 - 3.5, 1e-12); // a width below zero is none
    EXPECT_NEAR(lane_edges(only, first, 0, 20.0).outer_t_m, 1.2, 1e-12);
    EXPECT_NEAR(lane_edges(only, section_at(only, 80.0), -1, 80.0).outer_t_m, 1.8 - 4.0, 1e-12);
    EXPECT_THROW(lane_edges(only, first, 3, 20.0), std::out_of_range);
    EXPECT_THAT(network.warnings, Contains(HasSubstr("lane -2 overlaps its inner neighbour by 2.000 m")));
}

TEST(OpenDrive, MisspeltLaneTypesAndWallsWithoutLengthAreTold) {
    const RoadNetwork network = network_of(RoadText{
        .lanes = section(0.0, lane(1), lane(-1, "3.5", "", "drivng")),
        .rest = R"(<objects><object id="7" type="barrier" s="10" t="-5" zOffset="0" Length="60" width="0.3" height="0.8"/></objects>)"});
    EXPECT_THAT(network.warnings, Contains(HasSubstr("'drivng' is none of OpenDRIVE's (the nearest is 'driving'): nobody drives there")));
    EXPECT_THAT(network.warnings, Contains(HasSubstr("object '7' has no length: it is 0.1 m long")));
    EXPECT_THAT(network.warnings,
                Contains(HasSubstr("the attribute 'Length' of 'object' is not OpenDRIVE's and is not read: is 'length' meant?")));
    EXPECT_EQ(network.warnings.size(), 3U);
}

TEST(OpenDrive, NamesThatAreNearlyRightAreTold) {
    RoadText text;
    text.lanes = section(0.0, lane(1),
                         R"(<lane id="-1" type="driving"><widthh sOffset="0" a="3.5" b="0" c="0" d="0"/>
        <roadMark sOffset="0" type="solid" weight="heavy" colour="white"/><speed sOffset="0" max="50" unit="kph"/><ourOwn myKey="1"/></lane>)");
    const RoadNetwork network = network_of(text);
    EXPECT_THAT(network.warnings,
                Contains(HasSubstr("the element 'widthh' of 'lane' is not OpenDRIVE's and is not read: is 'width' meant?")));
    EXPECT_THAT(network.warnings, Contains(HasSubstr("lane -1 (driving) has neither width nor border: it has no surface")));
    EXPECT_THAT(network.warnings,
                Contains(HasSubstr("the attribute 'colour' of 'roadMark' is not OpenDRIVE's and is not read: is 'color' meant?")));
    EXPECT_THAT(network.warnings, Contains(HasSubstr("the weight 'heavy' of 'roadMark' is not OpenDRIVE's, which has standard, bold")));
    EXPECT_THAT(network.warnings, Contains(HasSubstr("the unit 'kph' of 'speed'")));
    EXPECT_EQ(network.warnings.size(), 5U); // extensions of others are theirs
    EXPECT_THAT(
        tests::refusal_of([] {
            network_of(file(
                R"(<road id="1" length="10"><planView><geometry s="0" x="0" y="0" hdg="0" longth="10"><line/></geometry></planView></road>)"));
        }),
        HasSubstr("geometry@length: is missing (found 'longth')"));
    text.lanes = section(0.0, lane(1), lane(-1, "350"));
    EXPECT_THAT(network_of(text).warnings, Contains(HasSubstr("lane -1 is 350 m wide at s = 0")));
}

TEST(OpenDrive, RoadMarks) {
    RoadText text;
    const std::string centre = R"(<lane id="0"><roadMark sOffset="0" type="solid broken" weight="bold" color="yellow"/>
        <roadMark sOffset="30" type="broken" width="0.15" color="standard"><type name="b" width="0.15"><line length="3" space="9" tOffset="0.1" sOffset="1" width="0.2"/></type></roadMark>
        <roadMark sOffset="60" type="custom"><explicit><line length="2" tOffset="-0.2" sOffset="4" width="0.3"/></explicit><sway ds="0" a="0" b="1" c="0" d="0"/></roadMark></lane>)";
    text.lanes = section(0.0, lane(1), lane(-1), centre);
    const RoadNetwork network = network_of(text);
    const auto& marks = network.roads[0].sections[0].lanes[1].marks;
    ASSERT_EQ(marks.size(), 3U);
    EXPECT_EQ(std::tuple(marks[0].kind, marks[0].width_m, marks[0].colour), std::tuple(MarkKind::solid_broken, 0.25, "yellow"));
    ASSERT_EQ(marks[1].stripes.size(), 1U);
    EXPECT_EQ(marks[1].colour, "white");
    EXPECT_EQ(std::tuple(marks[1].stripes[0].dash_m, marks[1].stripes[0].gap_m, marks[1].stripes[0].t_m, marks[1].stripes[0].width_m),
              std::tuple(3.0, 9.0, 0.1, 0.2));
    ASSERT_EQ(marks[2].stripes.size(), 1U);
    EXPECT_GT(marks[2].stripes[0].gap_m, 1e6); // stands alone
    EXPECT_THAT(network.warnings, Contains(HasSubstr("sway")));
}

TEST(OpenDrive, ObjectsOutlinesAndRepeats) {
    const RoadNetwork network = network_of(RoadText{.rest = R"(<objects>
        <object id="post" type="pole" s="10" t="5" zOffset="0" height="1" radius="0.06"><repeat s="10" length="50" distance="25" tStart="5" tEnd="6" heightStart="1" heightEnd="2" zOffsetStart="0" zOffsetEnd="0"/></object>
        <object id="rail" type="barrier" s="0" t="0" width="0.3" height="0.8"><repeat s="20" length="10" distance="0" tStart="-6" tEnd="-6" heightStart="0.8" heightEnd="0.8" zOffsetStart="0.1" zOffsetEnd="0.1"/></object>
        <object id="local" type="building" s="30" t="10" hdg="1.5707963267948966"><outline><cornerLocal u="0" v="0" z="0" height="3"/><cornerLocal u="2" v="0" z="0.5" height="3"/><cornerLocal u="2" v="1" z="0" height="3"/></outline></object>
        <object id="road" type="island" s="50" t="-8" hdg="1.5707963267948966"><outlines><outline id="1"><cornerRoad s="50" t="-8" dz="0" height="0.2"/><cornerRoad s="52" t="-8" dz="0" height="0.2"/><cornerRoad s="52" t="-7" dz="0.3" height="0.2"/></outline></outlines></object>
        </objects>)"});
    const auto& objects = network.roads[0].objects;
    ASSERT_EQ(objects.size(), 3U + 3U + 2U);
    EXPECT_EQ(std::tuple(objects[1].s_m, objects[1].t_m), std::tuple(35.0, 5.5));
    EXPECT_EQ(objects[2].height_m, 2.0);
    EXPECT_NEAR(objects[3].length_m, 10.0 / 3.0, 1e-12); // continuous: three pieces, end to end
    EXPECT_NEAR(objects[3].s_m, 20.0 + 10.0 / 6.0, 1e-12);
    EXPECT_EQ(objects[3].z_offset_m, 0.1);
    ASSERT_EQ(objects[6].outline_m.size(), 3U);
    EXPECT_EQ(std::tuple(objects[6].outline_m[1], objects[6].outline_base_m[1]), std::tuple(glm::dvec3(2.0, 0.0, 3.0), 0.5));
    // corners on the road, seen from an object that is turned to the left by 90 degrees
    EXPECT_NEAR(glm::distance(objects[7].outline_m[1], glm::dvec3(0.0, -2.0, 0.2)), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(objects[7].outline_m[2], glm::dvec3(1.0, -2.0, 0.2)), 0.0, 1e-12);
    EXPECT_NEAR(objects[7].outline_base_m[2], 0.3, 1e-12);
}

TEST(OpenDrive, Signals) {
    RoadText text;
    text.rest =
        R"(<signals><signal id="7" name="limit" s="40" t="-5" zOffset="2" orientation="-" type="274" subtype="57" country="DE" hOffset="0.1" width="0.6" height="0.7" dynamic="no"/>
        <signal id="8" s="50" t="5" zOffset="3" orientation="none" type="1000001" country="OpenDRIVE" dynamic="yes"/></signals>)";
    const auto signals = network_of(text).roads[0].signals;
    ASSERT_EQ(signals.size(), 2U);
    EXPECT_FALSE(signals[0].facing_forward);
    EXPECT_EQ(std::tuple(signals[0].heading_offset_rad, signals[0].width_m, signals[0].height_m), std::tuple(0.1, 0.6, 0.7));
    EXPECT_TRUE(signals[1].facing_forward && signals[1].dynamic);
}

// Input that cannot be meant: one sentence with file and line, never a crash, a hang or a wrong road.

/// The refusal without the file's name; "" when the file is read.
std::string refusal(const std::string& content) {
    const std::filesystem::path file = tests::written("road.xodr", content);
    std::string sentence = tests::refusal_of([&] { read_opendrive(file); }, "");
    if (sentence.empty())
        return sentence;
    EXPECT_THAT(sentence, testing::StartsWith(file.string()));
    EXPECT_EQ(sentence.find('\n'), std::string::npos);
    return sentence.substr(file.string().size());
}

std::string road_refusal(const RoadText& text) { return refusal(file(road(text))); }
std::string plan_refusal(const std::string& plan) { return road_refusal({.plan = plan}); }
std::string lane_refusal(const std::string& lanes) { return road_refusal({.lanes = lanes}); }

TEST(OpenDriveBadInput, NotAFileAtAll) {
    EXPECT_THROW(read_opendrive("/nowhere/road.xodr"), InputError);
    EXPECT_THROW(read_opendrive("/tmp"), InputError);
    EXPECT_THAT(refusal(""), HasSubstr("is empty"));
    EXPECT_THAT(refusal(std::string(1000, '\0')), HasSubstr(":1: "));
    EXPECT_THAT(refusal(std::string("\xff\xfe<\0O\0", 6)), HasSubstr("UTF-16"));
    EXPECT_THAT(refusal("just text\n"), HasSubstr("is not well-formed XML"));
    EXPECT_THAT(refusal("<?xml version=\"1.0\"?>\n<Envelope/>"), HasSubstr(":2: found root element 'Envelope', expected 'OpenDRIVE'"));
    EXPECT_THAT(refusal("<OpenDRIVE/>"), HasSubstr("holds no road"));
}

TEST(OpenDriveBadInput, TruncatedRandomOrNestedTooDeeply) {
    const std::string whole = file(road({}));
    const std::size_t end = whole.find("</OpenDRIVE>");
    for (std::size_t length = 1; length < end; length += 7)
        EXPECT_NE(refusal(whole.substr(0, length)), "") << length;
    std::mt19937 generator(11);
    for (int i = 0; i < 50; ++i) {
        std::string bytes(200, ' ');
        for (char& c : bytes)
            c = static_cast<char>(generator() % 256);
        EXPECT_NE(refusal(bytes), "");
    }
    std::string deep;
    for (int i = 0; i < 100'000; ++i)
        deep += "<a>";
    for (int i = 0; i < 100'000; ++i)
        deep += "</a>";
    EXPECT_THAT(refusal(file(deep)), HasSubstr("nested too deeply"));
}

TEST(OpenDriveBadInput, NumbersLengthsAndCurvatures) {
    for (const std::string value : {"nan", "inf", "-inf", "1e999", "1e10", "-99999999999", "ten", "", "1,5", "1.5 m", "0x10", "--1"})
        EXPECT_THAT(plan_refusal("\n" + fmt::format(R"(<geometry s="0" x="{}" y="0" hdg="0" length="10"><line/></geometry>)", value)),
                    HasSubstr(fmt::format(":8: geometry@x: found '{}', expected a number", value)));
    EXPECT_EQ(plan_refusal(R"(<geometry s="0" x=" +1.5e0 " y="1e-400" hdg="-0" length="100"><line/></geometry>)"), "");
    EXPECT_THAT(plan_refusal(R"(<geometry s="0" y="0" hdg="0" length="10"><line/></geometry>)"), HasSubstr("geometry@x: is missing"));
    EXPECT_THAT(plan_refusal(geometry(0, 0, 0, 0, -10.0)), HasSubstr("geometry@length: found -10, expected a length, not below 0"));
    EXPECT_THAT(plan_refusal(geometry(0, 0, 0, 0, 0.0)), HasSubstr("has no geometry with a length"));
    EXPECT_THAT(plan_refusal(geometry(0, 0, 0, 0, 1e9)), HasSubstr("expected a road of at most 1000000 m"));
    EXPECT_THAT(plan_refusal(geometry(1e8, 0, 0, 0, 1.0)), HasSubstr("expected a road of at most"));
    EXPECT_THAT(plan_refusal(geometry(0, 0, 0, 0, 100.0, R"(<arc curvature="1e6"/>)")),
                HasSubstr("arc@curvature: found 1000000 over 100 m"));
    EXPECT_THAT(plan_refusal(geometry(0, 0, 0, 0, 100.0, R"(<spiral curvStart="0" curvEnd="-1e8"/>)")), HasSubstr("spiral@curvEnd"));
    EXPECT_THAT(plan_refusal(geometry(0, 0, 0, 0, 100.0, "<userData/>")), HasSubstr("holds no shape"));
    EXPECT_THAT(
        plan_refusal(geometry(0, 0, 0, 0, 100.0, R"(<paramPoly3 pRange="some" aU="0" bU="1" cU="0" dU="0" aV="0" bV="0" cV="0" dV="0"/>)")),
        HasSubstr("paramPoly3@pRange: found 'some'"));
    EXPECT_THAT(plan_refusal(""), HasSubstr("has no geometry"));
}

TEST(OpenDriveBadInput, AGeometryWithoutLengthAmongOthersIsTold) {
    RoadText text{.plan = geometry(0, 0, 0, 0, 50.0) + geometry(50.0, 50.0, 0, 0, 0.0) + geometry(50.0, 50.0, 0, 0, 50.0)};
    const RoadNetwork network = network_of(text);
    EXPECT_EQ(network.roads[0].plan.size(), 2U);
    EXPECT_THAT(network.warnings, testing::ElementsAre(HasSubstr("has no length and is left out")));
}

TEST(OpenDriveBadInput, LanesAndRolls) {
    EXPECT_THAT(lane_refusal(section(0.0, "", lane(-1, "1e9"))), HasSubstr("expected at most 1000 m from the reference line"));
    EXPECT_THAT(lane_refusal(section(0.0, "", R"(<lane id="-1"><width sOffset="0" a="3" b="0" c="0" d="1"/></lane>)")),
                HasSubstr("at most 1000 m"));
    EXPECT_THAT(lane_refusal(section(0.0, "", lane(-1) + lane(-1))), HasSubstr("found lane -1 twice"));
    EXPECT_THAT(lane_refusal(section(0.0, lane(-1), "")), HasSubstr("found lane -1 in 'left', expected an id above 0"));
    EXPECT_THAT(lane_refusal(section(0.0, "", R"(<lane id="x"/>)")), HasSubstr("lane@id: found 'x'"));
    EXPECT_THAT(lane_refusal(section(0.0, "", R"(<lane id="-1.5"/>)")), HasSubstr("expected a whole number"));
    EXPECT_THAT(lane_refusal(section(50.0, "", lane(-1)) + section(0.0, "", lane(-1))),
                HasSubstr("expected lane sections in ascending order"));
    RoadText text;
    text.profiles = R"(<lateralProfile><superelevation s="0" a="0" b="0.05" c="0" d="0"/></lateralProfile>)";
    EXPECT_THAT(road_refusal(text), HasSubstr("road '1' rolls by 1.5 rad at s = 30, expected at most 1.4 rad"));
}

TEST(OpenDriveBadInput, RepeatsWithoutEnd) {
    RoadText text;
    text.rest = R"(<objects><object id="1" s="0" t="0" radius="1"><repeat s="0" length="100" distance="1e-8"/></object></objects>)";
    EXPECT_THAT(road_refusal(text), HasSubstr("repeat@distance: found 1e-08 over 100 m, expected at most 100000 objects"));
}

TEST(OpenDriveBadInput, RoadsTwiceOrWithoutId) {
    EXPECT_THAT(refusal(file(road({}) + road({}))), HasSubstr("found a second road '1'"));
    EXPECT_THAT(refusal(file("<road length=\"1\"/>")), HasSubstr("road@id: is missing"));
    RoadText text;
    text.attributes = R"(rule="XHT")";
    EXPECT_THAT(road_refusal(text), HasSubstr("road@rule: found 'XHT', expected 'RHT' or 'LHT'"));
}

TEST(OpenDriveBadInput, ManyWarningsAreCounted) {
    std::string roads;
    for (int i = 0; i < 1500; ++i) {
        RoadText text{.id = std::to_string(i)};
        text.link = R"(<successor elementType="road" elementId="none" contactPoint="start"/>)";
        roads += road(text);
    }
    const RoadNetwork network = network_of(file(roads)); // 1500 dead ends, and one remark that 1500 roads claim the same end
    ASSERT_EQ(network.warnings.size(), 1001U);
    EXPECT_THAT(network.warnings.back(), HasSubstr("501 further warnings are left out"));
}

} // namespace
} // namespace fernlicht
