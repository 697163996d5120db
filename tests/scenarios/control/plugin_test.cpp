// Control laws in shared libraries: the two examples as they are built, and small ones built here that misbehave.
#include "scenarios/control/control_run.h"
#include "scenarios/control/plugin.h"
#include "scenarios/values/errors.h"

#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <stdexcept>

namespace fernlicht {
namespace {

using testing::HasSubstr;

const std::filesystem::path build = std::filesystem::path(FERNLICHT_BINARY).parent_path();
const std::vector<ControlledLamp> lamps{{"left", {3.4, 0.6, 0.65}, 0.0}, {"high", {3.4, 0.5, 0.65}, 0.0, {{-4.0, 0.0}, {0.0, 4.0}}}};

ControlParameters with(const std::filesystem::path& compiled_plugin, const std::string& parameters = "") {
    ControlParameters control;
    control.plugins = {{compiled_plugin, parameters, {"left", "high"}}};
    control.plugins[0].give_up_s = 0.4;
    return control;
}

ControlRun run(
    const ControlParameters& control, const std::function<void(ControlInputs&)>& change = [](ControlInputs&) {}) {
    return run_control(control, lamps, {},
                       [&](double t) {
                           ControlInputs in;
                           in.time_s = t;
                           in.speed_mps = 20.0;
                           in.yaw_rate_rad_s = 20.0 / 150.0;
                           change(in);
                           return in;
                       },
                       {2.0, 0.1});
}

/// Builds a library whose step() has the body; "" for one without the interface's function.
std::filesystem::path compiled_plugin(const std::string& name, const std::string& step,
                                      const std::string& version = "FERNLICHT_CONTROL_VERSION") {
    const std::filesystem::path folder = testing::TempDir();
    const std::filesystem::path source = folder / (name + ".c"), out = folder / (name + ".so");
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

std::string refusal(const std::filesystem::path& file) {
    try {
        run(with(file));
        return {};
    } catch (const InputError& error) {
        return error.what();
    }
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
    EXPECT_THAT(refusal("/nowhere/law.so"), HasSubstr("cannot be loaded"));
    EXPECT_THAT(refusal(compiled_plugin("no-entry", "")), HasSubstr("no function fernlicht_control_plugin()"));
    EXPECT_THAT(refusal(compiled_plugin("version", "in = in;", "7")), HasSubstr("version 7 of the interface, expected version 1"));
    EXPECT_THAT(refusal(compiled_plugin("answers", "return 3;")), HasSubstr("step() of 'answers' failed with 3 at 0 s"));
}

TEST(Plugin, CrashesAreErrors) {
    EXPECT_THAT(refusal(compiled_plugin("segv", "*(volatile int*)0 = 1;")), HasSubstr("a segmentation fault in step() of 'segv' at 0 s"));
    EXPECT_THAT(refusal(compiled_plugin("aborts", "if (in->time_s > 0.5) abort();")), HasSubstr("abort() in step() of 'aborts' at 0.52 s"));
    EXPECT_THAT(refusal(compiled_plugin("loops", "for (volatile int i = 0; ; ) i = i;")), HasSubstr("no return within 0.4 s"));
}

TEST(Plugin, CommandsThatAreNoneAreLeftOut) {
    const ControlRun odd =
        run(with(compiled_plugin("odd", "out->lamps[0].swivel_rad = in->time_s < 1 ? 0.05 : NAN; out->lamps[0].level = 7;")));
    EXPECT_NEAR(odd.swivel_rad(0, 1.95), 0.05, 1e-9) << "the last good command holds";
    EXPECT_EQ(odd.level(0, 1.95), 1.0);
    EXPECT_THAT(odd.notes, testing::Contains("control law 'odd': 150 commands were no numbers or out of range, and left out"));
}

TEST(Plugin, ExitIsNoFinishedRun) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(guarded_call([] { std::exit(0); }, 10.0), testing::ExitedWithCode(2), "called exit");
}

TEST(Plugin, ExceptionsAreErrors) {
    EXPECT_EQ(guarded_call([] { throw std::runtime_error("no"); }, 1.0).failed, "an exception: no");
    EXPECT_EQ(guarded_call([] {}, 1.0).failed, "");
}

} // namespace
} // namespace fernlicht
