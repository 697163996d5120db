// Storyboards as drives: one that is shipped, one alone, and lamps that look along the road which a storyboard drives.
#include "runner/experiments/compare/runs/run_folder.h"
#include "runner/play/stage.h"
#include "scenarios/drives/play/motion.h"
#include "scenarios/drives/play/storyboard_timeline.h"
#include "tests/runner/program.h"
#include "tests/scenarios/openscenario/story_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

namespace fernlicht::osc {
namespace {

using testing::HasSubstr;

/// Angle of a lamp to the left of the car.
double to_the_left_deg(const Moment& moment, std::size_t lamp) {
    const glm::dvec3 in_car = moment.lamps.at(lamp).pose.forward() * moment.ego.axes;
    return degrees(std::atan2(in_car.y, in_car.x));
}

bool shines(const Moment& moment, const std::string& lamp) {
    return std::ranges::any_of(moment.other_lamps, [&](const LitLamp& lit) { return lit.name == lamp; });
}

TEST(ShippedStory, GoesFromDuskToNightWithItsCars) {
    const Stage stage(read_drive(library_file("drives/s-bend-story.yaml")));
    ASSERT_EQ(stage.drive.views.size(), 7U) << "six, and the map";
    const double rate_hz = 1.0 / stage.drive.step_s;
    const auto at = [&](double time_s, std::size_t lamp_set = 0) {
        return moments_at({static_cast<int>(std::lround(time_s * rate_hz))}, stage, stage.drive.lamp_sets[lamp_set]).front();
    };
    EXPECT_GT(stage.drive.duration_s, 60.0);
    const Moment dusk = at(0.0), night = at(stage.drive.duration_s - 1.0);
    EXPECT_GT(dusk.daylight.horizontal_illuminance_lx, 3.4) << "civil twilight";
    EXPECT_LT(night.daylight.horizontal_illuminance_lx, 0.05);
    EXPECT_EQ(dusk.daylight.direct(), nullptr);
    EXPECT_EQ(night.daylight.direct(), nullptr) << "a moon would cost a shadow map";
    // At 19:19, 20 minutes after the beginning, 30 s at a rate of 40.
    EXPECT_FALSE(shines(at(29.0), "Unlit left"));
    EXPECT_FALSE(shines(at(29.0), "Unlit tail-left")) << "with the low beam";
    EXPECT_TRUE(shines(at(31.0), "Unlit left"));
    EXPECT_TRUE(shines(at(31.0), "Unlit tail-left"));
    EXPECT_TRUE(shines(at(28.0), "Preceding brake-left"));
    EXPECT_FALSE(shines(at(20.0), "Preceding brake-left"));
    // 17.9 m/s, 150 m, 1.5 s: 5.1 degrees inside, 0.6 of it outside, as along the lane of a drive without a storyboard.
    double left = 0.0, right = 0.0, ahead_m = 1e9;
    for (double t = 8.0; t < 30.0; t += 1.0) {
        const Moment moment = at(t, 1);
        left = std::max(left, to_the_left_deg(moment, 0));
        right = std::min(right, to_the_left_deg(moment, 1));
        EXPECT_NEAR(to_the_left_deg(at(t), 0), 0.0, 1e-9) << "halogen lamps are held still";
        for (const Body& body : moment.bodies)
            if (body.name == "Preceding")
                ahead_m = std::min(ahead_m, glm::distance(body.pose.position_m, moment.ego.position_m));
    }
    EXPECT_NEAR(left, 5.1, 0.5);
    EXPECT_NEAR(right, -5.1, 0.5);
    EXPECT_GT(ahead_m, 15.0) << "nobody runs into the car ahead";
    EXPECT_LT(ahead_m, 50.0);
}

TEST(ShippedStory, PlaysAndPlaysAgain) {
    const TemporaryFolder folder;
    const std::string small = " --quiet --no-accuracy --resolution 64x48 --frames 60:61 --capture all --out ";
    const Outcome first = run_program("run " + library_file("drives/s-bend-story.yaml") + small + (folder / "a"));
    ASSERT_EQ(first.exit_code, 0) << first.output;
    const Outcome resolved = run_program("run " + (folder / "a/s-bend-story-1.yaml") + " --replay " +
                                         (folder / "a/drive-log-s-bend-story-1.csv") + small + (folder / "b"));
    ASSERT_EQ(resolved.exit_code, 0) << resolved.output;
    int views = 0;
    for (const auto& frame : std::filesystem::directory_iterator(folder / "a/frames/s-bend-story-1-xenon")) {
        ++views;
        EXPECT_TRUE(content_of(frame.path()) == content_of(folder / ("b/frames/s-bend-story-1-xenon/" + frame.path().filename().string())))
            << frame.path().filename();
    }
    EXPECT_GE(views, 12) << "six views of two moments";
}

std::string on_s_bend(const std::string& text) {
    std::string out = text;
    out.replace(out.find(straight_road), straight_road.size(), library_file("roads/s-bend.xodr"));
    return out;
}

std::string drive_with(const std::string& name, const std::string& way, const std::string& control) {
    return fmt::format(
        "fernlicht: 1\nname: {}\n{}rate_hz: 10\nduration_s: 14\nlamp_sets:\n  one: {{source: arc, file: \"{}\", control: {}}}\n", name, way,
        library_file("lamps/xenon-low.ies"), control);
}

/// A law that looks at the road ahead, 30 m away.
std::string road_law(const TemporaryFolder& folder) {
    std::ofstream(folder / "look.c") << R"(#include "scenarios/control/fernlicht_control.h"
#include <math.h>
static int state;
static void* create(const char* parameters) { return &state; }
static int step(void* s, const fernlicht_control_input* in, fernlicht_control_output* out) {
    double angle = -0.1;
    for (size_t i = 0; i < in->road_count; ++i)
        if (in->road[i].along_m == 30.0)
            angle = atan2(in->road[i].y_m, in->road[i].x_m);
    for (size_t i = 0; i < out->lamp_count; ++i)
        out->lamps[i].swivel_rad = angle;
    return 0;
}
static void destroy(void* s) {}
const fernlicht_control_plugin_info* fernlicht_control_plugin(void) {
    static const fernlicht_control_plugin_info info = {FERNLICHT_CONTROL_VERSION, sizeof(fernlicht_control_plugin_info), "look", create, step, destroy};
    return &info;
})";
    const Outcome built = run_shell(
        fmt::format("cc -O1 -w -shared -fPIC -I'{}' -o '{}' '{}' -lm", FERNLICHT_SOURCE_DIR, folder / "look.so", folder / "look.c"));
    EXPECT_EQ(built.exit_code, 0) << built.output;
    return "{plugins: [{library: look.so, lamps: [left, right], give_up_s: 10}]}";
}

TEST(StoryControl, LampsSeeTheRoadAheadAsInADriveWithoutStoryboard) {
    const TemporaryFolder folder;
    std::ofstream(folder / "told.xosc") << on_s_bend(scenario_text(of("Ego", teleport(on_lane(-1, 120.0)) + speed("18")), stop_at(14.0)));
    const std::string own_way = fmt::format("road: \"{}\"\nroute: {{s_m: 120}}\nspeed_mps: 18\n", library_file("roads/s-bend.xodr"));
    for (const std::string& control : {std::string("{bend: {law: route, preview_s: 1.5}}"), road_law(folder)}) {
        std::ofstream(folder / "told.yaml") << drive_with("told", "storyboard: told.xosc\n", control);
        std::ofstream(folder / "own.yaml") << drive_with("own", own_way, control);
        const Stage told(read_drive(folder / "told.yaml")), own(read_drive(folder / "own.yaml"));
        double most = 0.0;
        for (int tick = 0; tick < 135; ++tick) {
            const Moment a = moments_at({tick}, told, told.drive.lamp_sets[0]).front();
            const Moment b = moments_at({tick}, own, own.drive.lamp_sets[0]).front();
            EXPECT_NEAR(to_the_left_deg(a, 0), to_the_left_deg(b, 0), 0.1) << control << ", tick " << tick;
            most = std::max(most, to_the_left_deg(a, 0));
            EXPECT_NEAR(a.distance_m, b.distance_m, 0.15) << "the storyboard drives by the reference line's s";
        }
        EXPECT_GT(most, 4.0);
    }
}

/// Changing to the oncoming lane, the lane ahead is that one's; the distance is still the route's.
TEST(StoryControl, TheLaneAheadIsTheOneThatTheCarIsOn) {
    const TemporaryFolder folder;
    const std::string change =
        R"(<PrivateAction><LateralAction><LaneChangeAction><LaneChangeActionDynamics dynamicsShape="sinusoidal" dynamicsDimension="time" value="3"/><LaneChangeTarget><AbsoluteTargetLane value="1"/></LaneChangeTarget></LaneChangeAction></LateralAction></PrivateAction>)";
    std::ofstream(folder / "told.xosc") << scenario_text(of("Ego", teleport(on_lane(-1, 50.0)) + speed("20")),
                                                         story(event("over", change, at_time(1.0))) + stop_at(10.0));
    std::ofstream(folder / "told.yaml") << drive_with("told", "storyboard: told.xosc\n", "{bend: {law: route, preview_s: 1.5}}");
    const Stage stage(read_drive(folder / "told.yaml"));
    const auto at = [&](double t) {
        return moments_at({static_cast<int>(std::lround(10.0 * t))}, stage, stage.drive.lamp_sets[0]).front();
    };
    for (const double t : {0.5, 6.0, 9.5}) {
        EXPECT_NEAR(to_the_left_deg(at(t), 0), 0.0, 0.01) << "straight along its lane at " << t << " s";
        const auto place = track_place(stage.drive, t);
        ASSERT_TRUE(place);
        EXPECT_NEAR(place->offset_left_m, t < 1.0 ? 0.0 : 3.5, 0.01);
        EXPECT_NEAR(place->lane_left_m, t < 1.0 ? 0.0 : 3.5, 0.01);
    }
    const Moment last = at(9.5);
    const Pose foot = stage.route.pose(last.distance_m);
    EXPECT_NEAR(glm::dot(last.ego.position_m - foot.position_m, foot.forward()), 0.0, 1e-3);
    EXPECT_LT(last.distance_m, 190.0) << "what goes sideways does not go ahead";
}

TEST(StoryAlone, IsPlayedWithDefaults) {
    const TemporaryFolder folder;
    std::string text = scenario_text(
        of("Ego", teleport(on_lane(-1, 50.0)) + speed("20")) + of("Other", teleport(on_lane(1, 200.0)) + speed("15")), stop_at(10.0));
    std::ofstream(folder / "alone.xosc") << text;
    const std::string small = " --quiet --no-accuracy --resolution 96x72 --frames 0:9 ";
    const Outcome first = run_program("run " + (folder / "alone.xosc") + small + "--out " + (folder / "a"));
    ASSERT_EQ(first.exit_code, 0) << first.output;
    const std::string drive = content_of(folder / "a/alone.yaml"), readings = content_of(folder / "a/readings.csv");
    EXPECT_THAT(drive, HasSubstr("halogen-low.ies"));
    EXPECT_THAT(readings, HasSubstr("reach_1lx_road_own_m"));
    EXPECT_THAT(content_of(folder / "a/drive-log-alone.csv"), HasSubstr(",Other left\n")) << "other cars are lit";
    // Twenty metres a second at thirty moments a second: what comparisons take for the step.
    const RunFolder run = read_run_folder(folder / "a");
    ASSERT_EQ(run.drives.size(), 1U);
    EXPECT_NEAR(run.drives[0].step_m, 20.0 / 30.0, 1e-9);
    EXPECT_NEAR(run.drives[0].step_s, 1.0 / 30.0, 1e-12);

    const Outcome other = run_program("run " + (folder / "alone.xosc") + small + "--ego Other --out " + (folder / "b"));
    ASSERT_EQ(other.exit_code, 0) << other.output;
    EXPECT_THAT(content_of(folder / "b/drive-log-alone.csv"), HasSubstr(",Ego left\n"));
    const Outcome nobody = run_program("run " + (folder / "alone.xosc") + small + "--ego Nobody --out " + (folder / "c"));
    EXPECT_EQ(nobody.exit_code, 2);
    EXPECT_THAT(nobody.output, HasSubstr("one of Ego, Other"));

    // Its road in a folder of its own; the own car by another usual name.
    std::filesystem::create_directories(folder / "roads");
    std::filesystem::copy_file(straight_road, folder / "roads/here.xodr");
    text.replace(text.find(straight_road), straight_road.size(), "/nowhere/roads/here.xodr");
    for (std::size_t at = text.find("\"Ego\""); at != std::string::npos; at = text.find("\"Ego\""))
        text.replace(at, 5, "\"hero\"");
    std::ofstream(folder / "alone.xosc") << text;
    EXPECT_EQ(run_program("run " + (folder / "alone.xosc") + small + "--out " + (folder / "d")).exit_code, 2);
    const Outcome found =
        run_program("run " + (folder / "alone.xosc") + small + "--road-folder " + (folder / "roads") + " --out " + (folder / "e"));
    ASSERT_EQ(found.exit_code, 0) << found.output;
    EXPECT_THAT(content_of(folder / "e/alone.yaml"), HasSubstr("ego: \"hero\""));
    // Another road in place of one that is not there.
    const std::string replaced = " --road " + (folder / "roads/here.xodr");
    const Outcome elsewhere = run_program("run " + (folder / "alone.xosc") + small + replaced + " --out " + (folder / "f"));
    ASSERT_EQ(elsewhere.exit_code, 0) << elsewhere.output;
    EXPECT_THAT(printed("storyboard " + (folder / "alone.xosc") + replaced), HasSubstr("alone.xosc: "));
    EXPECT_THAT(printed("storyboard " + (folder / "alone.xosc"), 2), HasSubstr("or another by --road"));
}

/// A car that turns where its lane does not lead: real files of others.
TEST(StoryAlone, PlaysOnWhereItsLaneDoesNotLead) {
    const std::filesystem::path shared = FERNLICHT_SHARED_DATA;
    const std::filesystem::path story = shared / "scenarios/esmini__esmini/EnvironmentSimulator/Unittest/xosc/route_lane_change.xosc";
    if (!std::filesystem::exists(story))
        GTEST_SKIP() << "no " << story;
    DriveEdits edits;
    edits.road_folders = {shared / "roads"};
    edits.lenient = true;
    const Stage stage(read_drive(story, edits));
    EXPECT_THAT(stage.drive.notes, testing::Contains(HasSubstr("does not lead to the road that it takes after '1'")));
    EXPECT_EQ(stage.network.roads[stage.route.legs().back().road].id, "1");
    const Moment first = moments_at({0}, stage, stage.drive.lamp_sets[0]).front();
    const Moment later = moments_at({30}, stage, stage.drive.lamp_sets[0]).front();
    EXPECT_GT(later.distance_m, first.distance_m);
}

} // namespace
} // namespace fernlicht::osc
