// Lamp control in drives: what is read is written back, what is wrong is refused, and moments have what the laws did.
#include "scenarios/control/plugin.h"
#include "scenarios/values/errors.h"
#include "tests/scenarios/drives/drive_fixture.h"
#include "tests/scenarios/drives/play/staged_drive.h"
#include "tests/shipped.h"

#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <stdexcept>

namespace fernlicht {
namespace {

using testing::HasSubstr;

double swivel_deg(const Moment& moment, std::size_t lamp) { return degrees(swivel_rad(moment, lamp)); }

class ControlDrive : public DriveFixture {};

TEST_F(ControlDrive, ShippedBendLightLooksIntoTheBend) {
    const StagedDrive played(read_drive(shipped_drives / "s-bend-alc.yaml"));
    // 64.4 km/h = 17.9 m/s, 150 m, 1.5 s: 17.9 * 1.5 / 300 rad = 5.1 degrees inside, 0.6 of it outside.
    double left = 0.0, right = 0.0;
    for (double t = 0.0; t < 30.0; t += 0.5) {
        const Moment moment = played.at(t, 1);
        left = std::max(left, swivel_deg(moment, 0));
        right = std::min(right, swivel_deg(moment, 1));
        EXPECT_NEAR(swivel_deg(played.at(t, 0), 0), 0.0, 1e-9);
        EXPECT_EQ(moment.ego, played.at(t, 0).ego) << "lamps do not act on the car";
    }
    EXPECT_NEAR(left, 5.1, 0.5);
    EXPECT_NEAR(right, -5.1, 0.5) << "and a little more where the bend begins";
    const Moment bend = played.at(12.0, 1);
    const double inner = std::max(std::abs(swivel_deg(bend, 0)), std::abs(swivel_deg(bend, 1)));
    const double outer = std::min(std::abs(swivel_deg(bend, 0)), std::abs(swivel_deg(bend, 1)));
    EXPECT_NEAR(outer, 0.6 * inner, 0.02 * inner + 0.01);
}

const std::string everything = R"(    control:
      period_s: 0.01
      bend: {law: route, lamps: [left], gain: 0.9, dead_band_deg: 0.2, outer_share: 0.5, min_deg: -10, max_deg: 8, dead_time_s: 0.1}
      cornering: {left: [right], until_kmh: 41, on_deg: 3}
      levelling: {control: static, natural_frequency_hz: 2}
      load: {front_kg: 10, rear_n: 2000}
      modes: {lamps: [left], e: {level: 0.5, pitch_deg: 0.3, file: low.ies}, v_below_kmh: 51, delay_s: 1}
      high_beam: {lamps: [right], oncoming_m: 300}
      glare_free: {windows_deg: {right: [-3, 0, 2.5]}, margin_deg: 1}
      failures: [{at_s: 1, stuck_swivel: left}, {at_s: 0, until_s: 2, lost_signal: road.motorway}]
      stuck_swivel: {off_deg: 3, after_s: 0.2, pitch_rad: -0.02, level: 0.1}
      inputs: {ego.indicator: [{at_s: 0, value: 1}, {at_s: 1, value: 0}], road.motorway: 1}
)";

TEST_F(ControlDrive, ResolvedDrivesReadBackToTheSame) {
    const std::string with =
        "fernlicht: 1\nroad: road.xodr\nspeed_kmh: 72\nduration_s: 3\nlamp_sets:\n  one:\n    file: low.ies\n" + everything;
    const Drive drive = read(with);
    ASSERT_NE(drive.lamp_sets[0].control, nullptr);
    const std::string written = write_drive(drive);
    const Drive again = read(written);
    EXPECT_EQ(write_drive(again), written);
    ControlParameters a = *drive.lamp_sets[0].control, b = *again.lamp_sets[0].control;
    EXPECT_NE(a.modes->settings[2].file, nullptr);
    a.modes->settings[2].file = b.modes->settings[2].file = nullptr; // read once by each
    a.bend->actuator.control_period_s = b.bend->actuator.control_period_s;
    EXPECT_TRUE(a == b);
    EXPECT_EQ(a.glare_free->lamps[0].windows_deg.size(), 2U);
}

TEST_F(ControlDrive, WhatIsWrongIsRefusedWithTheNearest) {
    const auto with = [&](const std::string& control) { return refusal(minimal + "control: " + control + "\n"); };
    EXPECT_EQ(with("none"), "not refused");
    EXPECT_EQ(with("{}"), "not refused");
    EXPECT_THAT(with("{bend: yaw}"), HasSubstr("one of steering, yaw-rate, route"));
    EXPECT_THAT(with("{bend: {lamps: [lift]}}"),
                HasSubstr("no lamp 'lift' in lamp set 'one', expected one of left, right (nearest: 'left')"));
    EXPECT_THAT(with("{bends: route}"), HasSubstr("'bend', the nearest known key"));
    EXPECT_THAT(with("{inputs: {ego.sped_mps: 3}}"), HasSubstr("no signal 'ego.sped_mps', expected 'ego.speed_mps', the nearest signal"));
    EXPECT_THAT(with("{inputs: {control.mode: 1}}"), HasSubstr("which the laws write"));
    EXPECT_THAT(with("{inputs: {ego.indicator: 2}}"), HasSubstr("a number from -1 to 1"));
    EXPECT_THAT(with("{failures: [{at_s: 1}]}"), HasSubstr("stuck_swivel, stuck_levelling (a lamp) or lost_signal (a signal)"));
    EXPECT_THAT(with("{high_beam: automatic}"), HasSubstr("no lamp of lamp set 'one' has a name with 'high'"));
    EXPECT_THAT(with("{glare_free: {windows_deg: {left: [0, 1]}}}"), HasSubstr("high_beam beside it"));
    EXPECT_THAT(with("{high_beam: {lamps: [left]}, glare_free: {windows_deg: {left: [2, 1]}}}"), HasSubstr("edges that do not ascend"));
    EXPECT_THAT(with("{plugins: [{library: law.so}]}"), HasSubstr("there is no file"));
    EXPECT_EQ(with("{stuck_swivel: none}"), "not refused");
    EXPECT_THAT(with("{stuck_swivel: {off_deg: 0}}"), HasSubstr("off_deg above 0"));
    EXPECT_THAT(with("{failures: [{at_s: 1, stuck_swivel: left}]}"), HasSubstr("stuck_swivel of 'left', which nothing turns"));
    EXPECT_THAT(with("{cornering: {left: [left], again_below_kmh: 50}}"), HasSubstr("a hysteresis upside down"));
    EXPECT_THAT(with("{levelling: {control_period_s: 1}}"), HasSubstr("control.period_s"));
    EXPECT_THAT(refusal(minimal + "vehicle: single-track\nactuators: {swivel: true}\ncontrol: {bend: route}\n"), HasSubstr("one of them"));
}

Drive straight(const std::string& lamp_sets, const std::string& more = "") {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "control-drive.yaml";
    std::ofstream(file) << "fernlicht: 1\nroad: " << (shipped_library / "roads/straight.xodr").string()
                        << "\nroute: {s_m: 20}\nspeed_kmh: 80\nduration_s: 6\nrate_hz: 10\n"
                        << more << "lamp_sets:\n"
                        << lamp_sets;
    return read_drive(file);
}
const std::string xenon_high = "file: " + (shipped_library / "lamps/xenon-high.ies").string();

/// 200 kg on the rear axle: springs of 43 kN/m go down by 45.6 mm, tyres of 400 kN/m by 4.9 mm; over 2.7 m the springs' part is 0.968
/// degrees.
TEST(ControlLoad, LevellingTakesOutTheSpringsPartOfALoad) {
    const StagedDrive played(straight("  loaded: {source: arc, " + xenon_high +
                                      ", control: {load: {rear_kg: 200}}}\n  levelled: {source: arc, " + xenon_high +
                                      ", control: {load: {rear_kg: 200}, levelling: static}}\n"));
    const auto pitch_deg = [](const Pose& pose) { return degrees(std::asin(pose.forward().z)); };
    EXPECT_NEAR(pitch_deg(played.at(3.0).ego), 1.072, 0.001);
    EXPECT_NEAR(pitch_deg(played.at(3.0).lamps[0].pose), 1.072, 0.001);
    EXPECT_NEAR(pitch_deg(played.at(3.0).wheels), 0.0, 1e-9) << "a luxmeter stands on the road, not on the body";
    EXPECT_NEAR(pitch_deg(played.at(3.0, 1).lamps[0].pose), 1.072 - 0.968, 0.001);
}

/// Both at 80 km/h = 22.2 m/s: 500 m apart they come within 400 m after 2.3 s.
TEST(ControlTraffic, OncomingCarsDipTheBeamOrDarkenItsWindows) {
    const std::string lamps = "source: arc, lamps: {left: LOW, high-left: {file: HIGH, position_m: [3.4, 0.5, 0.65]}}";
    const auto with_files = [](std::string text) {
        for (const auto& [word, file] : {std::pair("LOW", "xenon-low.ies"), std::pair("HIGH", "xenon-high.ies")})
            for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word))
                text.replace(at, std::string(word).size(), (shipped_library / "lamps" / file).string());
        return text;
    };
    Drive drive =
        straight(with_files("  dips: {" + lamps + ", control: {high_beam: automatic}}\n  masks: {" + lamps +
                            ", control: {high_beam: automatic, glare_free: {windows_deg: {high-left: [-8, -3, -1, 0, 1, 8]}}}}\n"),
                 with_files("traffic: {other: {oncoming: {gap_m: 500}, speed_kmh: 80, file: LOW, source: arc}}\n"));
    const StagedDrive played(std::move(drive));
    const auto high = [&](double t, std::size_t lamp_set) { return played.at(t, lamp_set).lamps[1]; };
    EXPECT_EQ(high(0.5, 0).intensity_factor, 1.0);
    EXPECT_EQ(high(4.0, 0).intensity_factor, 0.0) << "dipped";
    EXPECT_EQ(high(4.0, 1).intensity_factor, 1.0) << "masked instead";
    EXPECT_EQ(high(0.5, 1).file, played.drive.lamp_sets[1].lamps[1].file) << "nobody there: the file itself";
    const CandelaTable& dark = high(4.0, 1).file->table;
    const CandelaTable& whole = high(0.5, 1).file->table;
    int dark_windows = 0;
    for (const double h : {-5.0, -2.0, -0.5, 0.5, 4.0})
        dark_windows += intensity_cd(dark, h, 0.0) == 0.0 && intensity_cd(whole, h, 0.0) > 0.0 ? 1 : 0;
    EXPECT_GE(dark_windows, 1);
    EXPECT_LE(dark_windows, 3);
    EXPECT_EQ(intensity_cd(dark, 4.0, 0.0), intensity_cd(whole, 4.0, 0.0)) << "it comes on the left";
}

/// Pixels 1 degree wide and 0.5 high: those that the other car covers go dark, all others stay lit, and the light above and below it stays.
TEST(ControlTraffic, PixelsGoDarkWhereOthersAreAndNowhereElse) {
    const std::filesystem::path file = tests::written(
        "pixels.yaml",
        "fernlicht_pixel_lamp: 1\nraster: {pixels: [24, 12], h_deg: [-12, 12], v_deg: [-2, 4], spread_deg: [0.05, 0.05], cd: 20000}\n");
    const std::string lamps = "lamps: {high-left: {source: arc, file: " + file.string() + ", position_m: [3.4, 0.5, 0.65]}}";
    const StagedDrive played(
        straight("  masks: {" + lamps + ", control: {high_beam: automatic, glare_free: {windows_deg: {high-left: pixels}}}}\n",
                 "traffic: {other: {oncoming: {gap_m: 300}, speed_kmh: 80, file: " + (shipped_library / "lamps/xenon-low.ies").string() +
                     ", source: arc}}\n"));
    const Moment moment = played.at(5.5); // about 55 m apart
    const CandelaTable& table = moment.lamps[0].file->table;
    const glm::dvec3 eye_m = moment.bodies.at(0).pose.position_m + glm::dvec3(0.0, 0.0, 1.1);
    const glm::dvec3 seen = to_local(moment.lamps[0].pose, eye_m);
    const double h_deg = degrees(-std::atan2(seen.y, seen.x)), v_deg = degrees(std::atan2(seen.z, seen.x));
    EXPECT_LT(intensity_cd(table, h_deg, v_deg), 1.0) << h_deg << ' ' << v_deg;
    EXPECT_GT(intensity_cd(table, h_deg, 3.2), 19900.0) << "above it";
    EXPECT_GT(intensity_cd(table, h_deg + 6.0, v_deg), 19900.0) << "beside it";
}

// Control laws in shared libraries: the two examples as they are built, and small ones built here that misbehave.

const std::filesystem::path build = std::filesystem::path(FERNLICHT_BINARY).parent_path();
const std::vector<ControlledLamp> pair{{"left", {3.4, 0.6, 0.65}, 0.0},
                                       {"high", {3.4, 0.5, 0.65}, 0.0, {{-4.0, 0.0, -90.0, 90.0}, {0.0, 4.0, -90.0, 90.0}}}};

ControlParameters with(const std::filesystem::path& compiled_plugin, const std::string& parameters = "") {
    ControlParameters control{.plugins = {{compiled_plugin, parameters, {"left", "high"}}}};
    control.plugins[0].give_up_s = 0.4;
    return control;
}

ControlRun run(
    const ControlParameters& control, const std::function<void(ControlInputs&)>& change = [](ControlInputs&) {}) {
    return run_control(control, pair, {},
                       [&](double t) {
                           ControlInputs in{.time_s = t, .speed_mps = 20.0, .yaw_rate_rad_s = 20.0 / 150.0};
                           change(in);
                           return in;
                       },
                       {2.0, 0.1});
}

/// Builds a library whose step() has the body; "" for one without the interface's function.
std::filesystem::path compiled_plugin(const std::string& name, const std::string& step,
                                      const std::string& version = "FERNLICHT_CONTROL_VERSION") {
    const std::filesystem::path folder = testing::TempDir();
    const std::filesystem::path source = folder / (name + ".c");
    std::filesystem::path out = folder / (name + ".so");
    std::ofstream(source) << fmt::format(
        "#include \"scenarios/control/fernlicht_control.h\"\n#include <math.h>\n#include <stdlib.h>\n"
        "static int step(void* state, const fernlicht_control_input* in, fernlicht_control_output* out) "
        "{{ (void)state; (void)in; (void)out; {} return 0; }}\n"
        "const fernlicht_control_plugin_info* {}(void) {{ static const fernlicht_control_plugin_info info = "
        "{{{}, sizeof(fernlicht_control_plugin_info), \"{}\", 0, step, 0}}; return &info; }}\n",
        step, step.empty() ? "something_else" : "fernlicht_control_plugin", version, name);
    const std::string command =
        fmt::format("cc -O0 -w -shared -fPIC -I'{}' -o '{}' '{}' -lm", FERNLICHT_SOURCE_DIR, out.string(), source.string());
    if (std::system(command.c_str()) != 0)
        throw std::runtime_error("no C compiler here");
    return out;
}

std::string plugin_refusal(const std::filesystem::path& file) {
    return tests::refusal_of([&] { run(with(file)); }, "");
}

TEST(Plugin, ExampleInCBendsTheLight) {
    const ControlRun bent = run(with(build / "example_bend_light.so", "1.5"));
    EXPECT_NEAR(bent.swivel_rad(0, 1.9), 0.1, 1e-9);
    EXPECT_THAT(bent.notes, testing::Contains("control law 'bend light by yaw rate (example)': 100 calls"));
    EXPECT_NEAR(run(with(build / "example_bend_light.so", "3")).swivel_rad(0, 1.9), 0.2, 1e-9) << "parameters reach it";
}

TEST(Plugin, ExampleInCppDarkensTheWindowThatMeetsAnother) {
    // 100 m ahead, 3.5 m to the left: 1.7 to 2.6 degrees to the left of the lamp.
    const ControlRun masked = run(with(build / "example_glare_free.so"), [](ControlInputs& in) {
        if (in.time_s > 0.5)
            in.surroundings.others = {{"oncoming", 103.4, 4.0, 3.14159, 20.0, 1.8, 1.5, true}};
    });
    ASSERT_FALSE(masked.runs[1].segments.empty());
    EXPECT_THAT(masked.runs[1].segments.back().second, testing::ElementsAre(0.0, 1.0));
    EXPECT_GT(masked.runs[1].segments.front().first, 0.5);
    EXPECT_TRUE(masked.runs[0].segments.empty());
}

TEST(Plugin, OwnPeriodAndOthersLampsAreKept) {
    ControlParameters control = with(build / "example_bend_light.so", "1.5");
    control.plugins[0].period_s = 0.1;
    control.plugins[0].lamps = {"left"};
    const ControlRun bent = run(control);
    EXPECT_THAT(bent.notes, testing::Contains(HasSubstr(": 20 calls")));
    EXPECT_NEAR(bent.swivel_rad(0, 1.9), 0.1, 1e-9);
    EXPECT_EQ(bent.swivel_rad(1, 1.9), 0.0);
}

TEST(Plugin, UnusableLibrariesAreRefused) {
    EXPECT_THAT(plugin_refusal("/nowhere/law.so"), HasSubstr("cannot be loaded"));
    EXPECT_THAT(plugin_refusal(compiled_plugin("no-entry", "")), HasSubstr("no function fernlicht_control_plugin()"));
    EXPECT_THAT(plugin_refusal(compiled_plugin("version", "in = in;", "7")), HasSubstr("version 7 of the interface, expected version 1"));
    EXPECT_THAT(plugin_refusal(compiled_plugin("answers", "return 3;")), HasSubstr("step() of 'answers' failed with 3 at 0 s"));
}

TEST(Plugin, CrashesExitsAndExceptionsAreErrors) {
    EXPECT_THAT(plugin_refusal(compiled_plugin("segv", "*(volatile int*)0 = 1;")),
                HasSubstr("a segmentation fault in step() of 'segv' at 0 s"));
    EXPECT_THAT(plugin_refusal(compiled_plugin("aborts", "if (in->time_s > 0.5) abort();")),
                HasSubstr("abort() in step() of 'aborts' at 0.52 s"));
    EXPECT_THAT(plugin_refusal(compiled_plugin("loops", "for (volatile int i = 0; ; ) i = i;")), HasSubstr("no return within 0.4 s"));
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(guarded_call([] { std::exit(0); }, 10.0), testing::ExitedWithCode(2), "called exit");
    EXPECT_EQ(guarded_call([] { throw std::runtime_error("no"); }, 1.0).failed, "an exception: no");
    EXPECT_EQ(guarded_call([] {}, 1.0).failed, "");
}

TEST(Plugin, CommandsThatAreNoneAreLeftOut) {
    const ControlRun odd =
        run(with(compiled_plugin("odd", "out->lamps[0].swivel_rad = in->time_s < 1 ? 0.05 : NAN; out->lamps[0].level = 7;")));
    EXPECT_NEAR(odd.swivel_rad(0, 1.95), 0.05, 1e-9) << "the last good command holds";
    EXPECT_EQ(odd.level(0, 1.95), 1.0);
    EXPECT_THAT(odd.notes,
                testing::Contains(HasSubstr("control law 'odd': 150 commands were no numbers or out of range, and left out; the first: ")));
    EXPECT_FALSE(odd.unusable);
    EXPECT_FALSE(run(with(compiled_plugin("once", "if (in->time_s == 0) out->lamps[0].swivel_rad = NAN;"))).unusable)
        << "it asked for nothing else";
    const ControlRun never = run(with(compiled_plugin("never", "out->lamps[0].level = 7;")));
    ASSERT_TRUE(never.unusable);
    EXPECT_THAT(never.unusable->what(),
                HasSubstr("none of whose 100 commands could be used; the first: lamp.left.level 7 at 0 s, which goes from 0 to 1"));
}

} // namespace
} // namespace fernlicht
