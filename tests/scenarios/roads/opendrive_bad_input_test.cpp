// Input that cannot be meant: one sentence with file and line, never a crash, a hang or a wrong road.
#include "scenarios/roads/road_network.h"
#include "scenarios/values/errors.h"
#include "tests/scenarios/roads/opendrive_text.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

namespace fernlicht {
namespace {

using namespace opendrive_text;
using testing::HasSubstr;

/// The refusal without the file's name; "" when the file is read.
std::string refusal(const std::string& content) {
    const TemporaryFile written(content);
    try {
        read_opendrive(written.path());
    } catch (const InputError& error) {
        const std::string sentence = error.what();
        EXPECT_THAT(sentence, testing::StartsWith(written.path().string()));
        EXPECT_EQ(sentence.find('\n'), std::string::npos);
        return sentence.substr(written.path().string().size());
    }
    return "";
}

std::string road_refusal(const RoadText& text) { return refusal(file(road(text))); }

std::string plan_refusal(const std::string& plan) {
    RoadText text;
    text.plan = plan;
    return road_refusal(text);
}

std::string lane_refusal(const std::string& lanes) {
    RoadText text;
    text.lanes = lanes;
    return road_refusal(text);
}

TEST(OpenDriveBadInput, NotAFileAtAll) {
    EXPECT_THROW(read_opendrive("/nowhere/road.xodr"), InputError);
    EXPECT_THROW(read_opendrive("/tmp"), InputError);
    EXPECT_THAT(refusal(""), HasSubstr("is empty"));
    EXPECT_THAT(refusal(std::string(1000, '\0')), HasSubstr(":1: "));
    EXPECT_THAT(refusal("\xff\xfe<\0O\0"), HasSubstr("UTF-16"));
    EXPECT_THAT(refusal("just text\n"), HasSubstr("is not well-formed XML"));
    EXPECT_THAT(refusal("<?xml version=\"1.0\"?>\n<Envelope/>"), HasSubstr(":2: found root element 'Envelope', expected 'OpenDRIVE'"));
    EXPECT_THAT(refusal("<OpenDRIVE/>"), HasSubstr("holds no road"));
}

TEST(OpenDriveBadInput, TruncatedAnywhere) {
    const std::string whole = file(road({}));
    const std::size_t end = whole.find("</OpenDRIVE>");
    for (std::size_t length = 1; length < end; length += 7)
        EXPECT_NE(refusal(whole.substr(0, length)), "") << length;
}

TEST(OpenDriveBadInput, RandomBytes) {
    std::mt19937 generator(11);
    for (int i = 0; i < 50; ++i) {
        std::string bytes(200, ' ');
        for (char& c : bytes)
            c = static_cast<char>(generator() % 256);
        EXPECT_NE(refusal(bytes), "");
    }
}

TEST(OpenDriveBadInput, NestedTooDeeply) {
    std::string deep;
    for (int i = 0; i < 100'000; ++i)
        deep += "<a>";
    for (int i = 0; i < 100'000; ++i)
        deep += "</a>";
    EXPECT_THAT(refusal(file(deep)), HasSubstr("nested too deeply"));
}

TEST(OpenDriveBadInput, NumbersThatAreNone) {
    for (const std::string value : {"nan", "inf", "-inf", "1e999", "1e10", "-99999999999", "ten", "", "1,5", "1.5 m", "0x10", "--1"})
        EXPECT_THAT(plan_refusal("\n" + fmt::format(R"(<geometry s="0" x="{}" y="0" hdg="0" length="10"><line/></geometry>)", value)),
                    HasSubstr(fmt::format(":8: geometry@x: found '{}', expected a number", value)));
    EXPECT_EQ(plan_refusal(R"(<geometry s="0" x=" +1.5e0 " y="1e-400" hdg="-0" length="100"><line/></geometry>)"), "");
    EXPECT_THAT(plan_refusal(R"(<geometry s="0" y="0" hdg="0" length="10"><line/></geometry>)"), HasSubstr("geometry@x: is missing"));
}

TEST(OpenDriveBadInput, LengthsAndCurvatures) {
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
    RoadText text;
    text.plan = geometry(0, 0, 0, 0, 50.0) + geometry(50.0, 50.0, 0, 0, 0.0) + geometry(50.0, 50.0, 0, 0, 50.0);
    const TemporaryFile written(file(road(text)));
    const RoadNetwork network = read_opendrive(written.path());
    EXPECT_EQ(network.roads[0].plan.size(), 2U);
    EXPECT_THAT(network.warnings, testing::ElementsAre(HasSubstr("has no length and is left out")));
}

TEST(OpenDriveBadInput, Lanes) {
    EXPECT_THAT(lane_refusal(section(0.0, "", lane(-1, "1e9"))), HasSubstr("expected at most 1000 m from the reference line"));
    EXPECT_THAT(lane_refusal(section(0.0, "", R"(<lane id="-1"><width sOffset="0" a="3" b="0" c="0" d="1"/></lane>)")),
                HasSubstr("at most 1000 m"));
    EXPECT_THAT(lane_refusal(section(0.0, "", lane(-1) + lane(-1))), HasSubstr("found lane -1 twice"));
    EXPECT_THAT(lane_refusal(section(0.0, lane(-1), "")), HasSubstr("found lane -1 in 'left', expected an id above 0"));
    EXPECT_THAT(lane_refusal(section(0.0, "", R"(<lane id="x"/>)")), HasSubstr("lane@id: found 'x'"));
    EXPECT_THAT(lane_refusal(section(0.0, "", R"(<lane id="-1.5"/>)")), HasSubstr("expected a whole number"));
    EXPECT_THAT(lane_refusal(section(50.0, "", lane(-1)) + section(0.0, "", lane(-1))),
                HasSubstr("expected lane sections in ascending order"));
}

TEST(OpenDriveBadInput, RoadsUpsideDown) {
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
        RoadText text;
        text.id = std::to_string(i);
        text.link = R"(<successor elementType="road" elementId="none" contactPoint="start"/>)";
        roads += road(text);
    }
    const TemporaryFile written(file(roads)); // 1500 dead ends, and one remark that 1500 roads claim the same end
    const RoadNetwork network = read_opendrive(written.path());
    ASSERT_EQ(network.warnings.size(), 1001U);
    EXPECT_THAT(network.warnings.back(), HasSubstr("501 further warnings are left out"));
}

} // namespace
} // namespace fernlicht
