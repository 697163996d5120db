// Masks over a bus: boxes of other road users and levels of windows, from a recording and tick by tick.
#include "scenarios/can/candump_log.h"
#include "scenarios/control/laws.h"
#include "scenarios/drives/edits/mirrored_drive.h"
#include "scenarios/drives/play/bus_drive.h"
#include "scenarios/drives/play/bus_recording.h"
#include "tests/scenarios/drives/drive_fixture.h"
#include "tests/scenarios/drives/play/staged_drive.h"
#include "tests/shipped.h"

#include <cstring>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;

/// Two others, each in one frame of doubles, and four levels in per cent.
const std::string masks_dbc = [] {
    std::string text = "VERSION \"\"\nNS_ :\nBS_:\nBU_: CAMERA LAMPS\n";
    std::string types;
    for (int other = 1; other <= 2; ++other) {
        text += fmt::format("BO_ {} Other{}: 48 CAMERA\n", 0x300 + other, other);
        int bit = 0;
        for (const auto& [name, unit] : {std::pair("Left", "rad"), std::pair("Right", "rad"), std::pair("Bottom", "rad"),
                                         std::pair("Top", "rad"), std::pair("Distance", "m"), std::pair("Valid", "")}) {
            text += fmt::format(" SG_ {} : {}|64@1- (1,0) [0|0] \"{}\" LAMPS\n", name, bit, unit);
            types += fmt::format("SIG_VALTYPE_ {} {} : 2;\n", 0x300 + other, name);
            bit += 64;
        }
    }
    text += "BO_ 784 Windows: 4 CAMERA\n";
    for (int window = 1; window <= 4; ++window)
        text += fmt::format(" SG_ W{} : {}|8@1+ (1,0) [0|100] \"%\" LAMPS\n", window, 8 * (window - 1));
    return text +
           "BA_DEF_ BO_ \"VFrameFormat\" ENUM \"StandardCAN\",\"ExtendedCAN\",\"StandardCAN_FD\";\nBA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 "
           "65535;\n"
           "BA_DEF_DEF_ \"VFrameFormat\" \"StandardCAN\";\nBA_DEF_DEF_ \"GenMsgCycleTime\" 20;\nBA_ \"VFrameFormat\" BO_ 769 2;\n"
           "BA_ \"VFrameFormat\" BO_ 770 2;\n" +
           types;
}();

class BusMasks : public DriveFixture {
  protected:
    BusMasks() { write_file(folder / "masks.dbc", masks_dbc); }

    /// A lamp of four windows on the straight, at 80 km/h.
    std::string yaml(const std::string& inputs, const std::string& more = "", const std::string& control = "") const {
        return fmt::format("fernlicht: 1\nroad: {0}/roads/straight.xodr\nroute: {{s_m: 20}}\nspeed_kmh: 80\nduration_s: 5\nrate_hz: 10\n"
                           "lamp_sets: {{one: {{source: arc, lamps: {{high-left: {{file: {0}/lamps/xenon-high.ies, position_m: [3.4, 0.5, "
                           "0.65]}}}}, control: "
                           "{{high_beam: automatic{3}, glare_free: {{windows_deg: {{high-left: [-8, -3, -1, 1, 8]}}}}}}}}}}\n{2}"
                           "can: {{databases: masks.dbc, inputs: {1}}}\n",
                           shipped_library.string(), inputs, more, control);
    }
    static std::string traffic() {
        return fmt::format("traffic: {{other: {{oncoming: {{gap_m: 200}}, speed_kmh: 80, file: {0}, source: arc}}, "
                           "before: {{ahead: {{gap_m: 60}}, speed_kmh: 80, file: {0}, source: arc}}}}\n",
                           (shipped_library / "lamps/xenon-low.ies").string());
    }
    static std::string boxes(const std::string& policy = "", const std::string& also = "") {
        std::string text;
        for (int other = 1; other <= 2; ++other)
            for (const auto& [name, signal] :
                 {std::pair("left_rad", "Left"), std::pair("right_rad", "Right"), std::pair("bottom_rad", "Bottom"),
                  std::pair("top_rad", "Top"), std::pair("distance_m", "Distance"), std::pair("valid", "Valid")})
                text += fmt::format("{}'others[{}].{}': {{signal: Other{}.{}{}}}", text.empty() ? "" : ", ", other, name, other, signal,
                                    policy);
        return "{" + text + also + "}";
    }
    static std::string windows() {
        std::string text;
        for (int window = 1; window <= 4; ++window)
            text += fmt::format("{}'lamp.high-left.segments[{}]': {{signal: Windows.W{}, stale: hold}}", text.empty() ? "" : ", ", window,
                                window);
        return "{" + text + "}";
    }
    /// What the drive's own road users and laws would have said.
    std::vector<CanFrame> recorded(const std::string& text) {
        const StagedDrive script(read(text, DriveEdits{.can_log = std::filesystem::path()}));
        script_ = script.drive.lamp_sets[0].motion->control;
        FilesRead opened;
        std::vector<std::string> notes;
        return recorded_inputs(script.drive, script.route, script.drive.lamp_sets[0], opened, notes);
    }
    Drive by(const std::vector<CanFrame>& frames, const std::string& text) {
        std::string log;
        for (const CanFrame& frame : frames)
            log += candump_line(frame) + '\n';
        write_file(folder / "bus.log", log);
        return read(text, DriveEdits{.can_log = folder / "bus.log"});
    }
    static const ControlRun& control_of(const StagedDrive& played) { return *played.drive.lamp_sets[0].motion->control; }

    std::optional<ControlRun> script_;
};

TEST_F(BusMasks, ABoxIsWhereTheOtherIs) {
    const OtherUser other{"car", 61.9, 3.0, 3.1, 20.0, 1.8, 1.5, true, -0.4};
    const OtherUser again = user_in_box(*box_from_camera(other));
    EXPECT_NEAR(again.ahead_m, other.ahead_m, 1e-9);
    EXPECT_NEAR(again.left_m, other.left_m, 1e-9);
    EXPECT_NEAR(again.width_m, other.width_m, 1e-9);
    EXPECT_NEAR(again.up_m, other.up_m, 1e-9);
    EXPECT_NEAR(again.height_m, other.height_m, 1e-9);
    EXPECT_EQ(box_from_camera({"beside", 1.0, 3.0}), std::nullopt);
}

TEST_F(BusMasks, BoxesOfTheDrivesOwnTrafficMakeItsMasks) {
    const std::vector<CanFrame> frames = recorded(yaml(boxes(), traffic()));
    ASSERT_GT(script_->runs[0].segments.size(), 3U);
    const StagedDrive played(by(frames, yaml(boxes())));
    EXPECT_EQ(control_of(played).runs[0].segments, script_->runs[0].segments) << "with nobody on its own road";
}

TEST_F(BusMasks, ABoxThatIsLostDarkensAllAndOneWithoutDistanceIsFar) {
    const std::vector<CanFrame> frames = recorded(yaml(boxes(), traffic()));
    std::vector<CanFrame> gap = frames;
    std::erase_if(gap, [](const CanFrame& frame) { return frame.time_ns > 1'000'000'000 && frame.time_ns < 1'500'000'000; });
    const StagedDrive played(by(gap, yaml(boxes())));
    const auto& segments = control_of(played).runs[0].segments;
    const auto dark = std::ranges::find(segments, std::vector<double>(4, 0.0), &std::pair<double, std::vector<double>>::second);
    ASSERT_NE(dark, segments.end());
    EXPECT_NEAR(dark->first, 1.16, 1e-9) << "three cycles and the delay of 0.1 s after the last frame";
    // A box 2 to 3 degrees to the left and no distance: infinitely far the lamp sees it there, too; margins of 0.5 degrees.
    for (const auto& [input, expected] :
         {std::pair("'others[1].left_rad': Other1.Left, 'others[1].right_rad': Other1.Right", std::vector<double>{0, 0, 1, 1}),
          std::pair("'others[1].left_rad': Other1.Left", std::vector<double>{0, 0, 0, 0}),
          std::pair("'others[1].left_rad': Other1.Right, 'others[1].right_rad': Other1.Left", std::vector<double>{0, 0, 0, 0}),
          std::pair("'others[1].bottom_rad': Other1.Left, 'others[1].top_rad': Other1.Right", std::vector<double>{0, 0, 0, 0})}) {
        CanFrame frame{.time_ns = 0, .channel = "can0", .id = 769, .fd = true};
        frame.length = 48;
        for (const auto& [at, value] : {std::pair(0, radians(3.0)), std::pair(8, radians(2.0))})
            std::memcpy(frame.data.data() + at, &value, sizeof value);
        std::vector<CanFrame> one;
        for (int i = 0; i < 100; ++i, frame.time_ns += 20'000'000)
            one.push_back(frame);
        const StagedDrive far(by(one, yaml(fmt::format("{{{}}}", input))));
        EXPECT_EQ(control_of(far).runs[0].segments.front().second, expected) << input;
        const bool wrong_way =
            std::string(input).find(".Right, ") != std::string::npos || std::string(input).find("bottom") != std::string::npos;
        const auto told = testing::Contains(testing::ContainsRegex("others.1. had its left edge to the right of its right one, or its top "
                                                                   "below its bottom, at 10[0-9] ticks: it counts as lost there"));
        if (wrong_way)
            EXPECT_THAT(control_of(far).notes, told) << input;
        else
            EXPECT_THAT(control_of(far).notes, testing::Not(told)) << input;
    }
}

TEST_F(BusMasks, LevelsOfWindowsAreTheLawsOwnOrWhatTheBusSays) {
    const std::vector<CanFrame> frames = recorded(yaml(windows(), traffic()));
    const StagedDrive played(by(frames, yaml(windows())));
    EXPECT_EQ(control_of(played).runs[0].segments, script_->runs[0].segments);
    std::vector<CanFrame> half(frames.begin(), frames.begin() + 100);
    for (CanFrame& frame : half)
        frame.data[1] = 50;
    const StagedDrive dimmed(by(half, yaml(windows())));
    EXPECT_EQ(control_of(dimmed).runs[0].segments.back().second[1], 0.5) << "held to the end";
    const auto& table = dimmed.at_tick(20, 0).lamps[0].file->table;
    EXPECT_NEAR(intensity_cd(table, -2.0, 0.0), 0.5 * intensity_cd(dimmed.drive.lamp_sets[0].lamps[0].file->table, -2.0, 0.0), 1e-6);
}

TEST_F(BusMasks, TickByTickIsTheSameAsBeforehand) {
    std::vector<CanFrame> frames = recorded(yaml(boxes("", ", 'lamp.high-left.segments[4]': Windows.W4"), traffic()));
    std::erase_if(frames, [](const CanFrame& frame) { return frame.time_ns > 2'000'000'000 && frame.time_ns < 2'300'000'000; });
    const std::string text = yaml(boxes(", stale: lost", ", 'lamp.high-left.segments[4]': Windows.W4"));
    const StagedDrive before(by(frames, text));
    Drive live_drive = by(frames, text);
    live_drive.live = true;
    StagedDrive live(std::move(live_drive));
    BusDrive drive(live.drive, live.route);
    for (std::size_t next = 0; !drive.done(); drive.step())
        for (; next < frames.size() && frames[next].time_ns <= drive.next_tick_ns(); ++next)
            drive.take(frames[next]);
    drive.finish();
    const ControlRun &a = control_of(before), &b = control_of(live);
    EXPECT_EQ(a.signals.back(), "lamp.high-left.segments[4]");
    EXPECT_EQ(a.runs[0].segments, b.runs[0].segments);
    ASSERT_EQ(a.rows.size(), b.rows.size());
    for (std::size_t row = 0; row < a.rows.size(); ++row)
        EXPECT_EQ(std::memcmp(a.rows[row].data(), b.rows[row].data(), a.rows[row].size() * sizeof(double)), 0) << "row " << row;
    for (int tick = 0; tick < tick_count(before.drive); ++tick)
        EXPECT_EQ(before.at_tick(tick, 0).lamps[0].file->table.cd, drive.moment(tick).lamps[0].file->table.cd) << tick;
}

TEST_F(BusMasks, WhatIsNotThereIsRefused) {
    const auto refused = [&](const std::string& inputs) { return refusal(yaml(inputs)); };
    EXPECT_THAT(refused("{'lamp.high-left.segments[5]': Windows.W1}"),
                HasSubstr("window 5 of 'high-left', which has 4, expected one of its pixels"));
    EXPECT_THAT(refused("{'lamp.*.segments[1]': Windows.W1}"),
                HasSubstr("a window of all lamps, expected the name of a lamp in place of the star"));
    EXPECT_THAT(refused("{'others[0].left_rad': Other1.Left}"),
                HasSubstr("no signal 'others[0].left_rad', expected 'others[#].left_rad', the nearest"));
    EXPECT_THAT(refused("{'lamp.lift.segments[1]': Windows.W1}"), HasSubstr("no signal 'lamp.lift.segments[1]'"));
    Drive drive = read(yaml("{'others[1].left_rad': Other1.Left, 'others[1].top_rad': Other1.Top}"));
    mirror_traffic(drive, true);
    EXPECT_EQ(drive.can->inputs[0].name, "others[1].right_rad");
    EXPECT_TRUE(drive.can->inputs[0].opposite);
    EXPECT_FALSE(drive.can->inputs[1].opposite);
    Drive levels = read(yaml(windows()));
    EXPECT_THAT(tests::refusal_of([&] { mirror_traffic(levels, true); }), HasSubstr("segments[1] in a drive that is mirrored"));
}

} // namespace
} // namespace fernlicht
