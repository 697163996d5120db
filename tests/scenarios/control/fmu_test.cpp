// FMUs as control laws: the example's law in FMI 2.0 and 3.0, and what is wrong with archives, descriptions, binaries and answers.
#include "scenarios/control/control_run.h"
#include "scenarios/control/fmu/fmi.h"
#include "scenarios/control/fmu/fmu.h"
#include "scenarios/control/fmu_law.h"
#include "tests/fmu_archive.h"
#include "tests/scenarios/drives/drive_fixture.h"
#include "tests/scenarios/drives/play/staged_drive.h"
#include "tests/shipped.h"

#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <sys/resource.h>

namespace fernlicht {
namespace {

using testing::Contains, testing::HasSubstr, testing::Not;
using tests::FmuText, tests::fmu_variable, tests::fmu_archive;

const std::vector<ControlledLamp> fmu_lamps{{"left", {3.4, 0.6, 0.65}},
                                            {"high", {3.4, 0.5, 0.65}, 0.0, {{-4.0, 0.0, -90.0, 90.0}, {0.0, 4.0, -90.0, 90.0}}}};

using Texts = std::vector<std::pair<std::string, std::string>>;

ControlRun run_fmu(const std::filesystem::path& file, const Texts& values = {}, const Texts& inputs = {}, const Texts& outputs = {}) {
    ControlParameters control{.plugins = {{file, "", {"left", "high"}}}};
    PluginParameters& plugin = control.plugins[0];
    plugin.fmu = true;
    plugin.give_up_s = plugin.budget_s = 2.0; // no note of a busy machine
    plugin.values = values;
    plugin.inputs = inputs;
    plugin.outputs = outputs;
    return run_control(control, fmu_lamps, {},
                       [](double t) {
                           ControlInputs in{.time_s = t, .speed_mps = 20.0, .yaw_rate_rad_s = 20.0 / 150.0};
                           in.surroundings.others = {{"oncoming", 103.4, 4.0, 3.14159, 20.0, 1.8, 1.5, true}};
                           return in;
                       },
                       {2.0, 0.1});
}

std::string fmu_refusal(const std::filesystem::path& file, const Texts& values = {}, const Texts& inputs = {}, const Texts& outputs = {}) {
    return tests::refusal_of([&] { run_fmu(file, values, inputs, outputs); }, "");
}
std::string fmu_refusal(const FmuText& of, const Texts& values = {}, const Texts& inputs = {}, const Texts& outputs = {}) {
    return fmu_refusal(fmu_archive(of), values, inputs, outputs);
}

std::vector<std::filesystem::path> folders_left() {
    std::vector<std::filesystem::path> left;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::temp_directory_path()))
        if (entry.path().filename().string().starts_with("fernlicht-fmu-"))
            left.push_back(entry.path());
    return left;
}

TEST(FmuLaw, BendsTheLightByNamesParametersAndUnits) {
    for (const int version : {2, 3}) {
        const ControlRun bent = run_fmu(fmu_archive({version}));
        EXPECT_NEAR(bent.swivel_rad(0, 1.9), 0.1, 1e-9);
        EXPECT_EQ(bent.swivel_rad(1, 1.9), 0.0);
        EXPECT_THAT(bent.notes, Contains("control law 'bend light': 100 calls"));
        EXPECT_NEAR(run_fmu(fmu_archive({version}), {{"preview_s", "3"}}).swivel_rad(0, 1.9), 0.2, 1e-9);
        // Degrees out, kilometres an hour in: below 2 of them the law would look straight ahead, and it is told 72.
        const std::string more = fmu_variable(version, "v", "input", "Real", 4, "unit=\"km/h\" start=\"0\"") +
                                 fmu_variable(version, "turned", "output", "Real", 64, "unit=\"deg\"") +
                                 fmu_variable(version, "spare", "output", "Real", 70);
        const ControlRun mapped =
            run_fmu(fmu_archive({version, more}), {}, {{"v", "ego.speed_mps"}},
                    {{"lamp.left.swivel_command_rad", "lamp.high.swivel_command_rad"}, {"turned", "lamp.left.pitch_command_rad"}});
        EXPECT_NEAR(mapped.swivel_rad(1, 1.9), 0.1, 1e-9);
        EXPECT_EQ(mapped.swivel_rad(0, 1.9), 0.0);
        EXPECT_THAT(mapped.notes, Contains("control law 'bend light': outputs that are no commands: spare"));
        EXPECT_THAT(mapped.notes, Contains(HasSubstr("100 commands were no numbers or out of range"))) << "72 degrees are no pitch";
        const ControlRun all = run_fmu(fmu_archive({version}), {}, {}, {{"lamp.left.swivel_command_rad", "lamp.*.swivel_command_rad"}});
        EXPECT_EQ(all.swivel_rad(0, 1.9), all.swivel_rad(1, 1.9));
        EXPECT_THAT(folders_left(), testing::IsEmpty());
    }
}

/// What goes in at a reference comes out 60 further on.
TEST(FmuLaw, TypesArraysAndListsOfOthersGoThrough) {
    const std::string integer =
        fmu_variable(2, "near", "input", "Integer", 4, "start=\"0\"") + fmu_variable(2, "lamps", "input", "Boolean", 5) +
        fmu_variable(2, "lamp.left.level", "output", "Boolean", 65) + fmu_variable(2, "lamp.high.level", "output", "Integer", 64);
    const ControlRun whole = run_fmu(fmu_archive({2, integer}), {}, {{"near", "others[2].speed_mps"}, {"lamps", "others[1].lamps_on"}});
    EXPECT_EQ(whole.level(0, 1.9), 1.0);
    EXPECT_EQ(whole.level(1, 1.9), 0.0) << "there is no second";
    const auto dimension = [](int size) { return fmt::format("<Dimension start=\"{}\"/>", size); };
    const std::string arrays = fmu_variable(3, "others.lamps_on", "input", "Float32", 5, "", dimension(2)) +
                               fmu_variable(3, "windows", "structuralParameter", "UInt16", 30, "start=\"2\"") +
                               fmu_variable(3, "lamp.high.segments", "output", "Int8", 65, "", "<Dimension valueReference=\"30\"/>") +
                               fmu_variable(3, "far", "input", "UInt16", 10) + fmu_variable(3, "lamp.left.level", "output", "Boolean", 70) +
                               fmu_variable(3, "table", "parameter", "Float64", 20, "start=\"1 2\"", "<Dimension valueReference=\"3\"/>");
    const ControlRun masked = run_fmu(fmu_archive({3, arrays}), {}, {{"far", "others[2].x_m"}});
    ASSERT_FALSE(masked.runs[1].segments.empty());
    EXPECT_THAT(masked.runs[1].segments.back().second, testing::ElementsAre(1.0, 0.0));
    EXPECT_EQ(masked.level(0, 1.9), 1.0) << "infinity, cut to 65535, is true";
    for (const int version : {2, 3}) {
        const std::string text = fmu_variable(version, "word", "parameter", "String", 0);
        EXPECT_NEAR(run_fmu(fmu_archive({version, text}), {{"word", "said"}, {"fault", "21"}}).swivel_rad(0, 1.9), 0.25, 1e-6);
    }
}

TEST(FmuLaw, BadAnswersAreLeftOutOrEndTheRunWithASentence) {
    for (const int version : {2, 3}) {
        const std::filesystem::path law = fmu_archive({version});
        const ControlRun odd = run_fmu(law, {{"fault", "1"}});
        EXPECT_EQ(odd.swivel_rad(0, 1.9), 0.0);
        EXPECT_THAT(odd.notes, Contains("control law 'bend light': 100 commands were no numbers or out of range, and left out; the first: "
                                        "lamp.left.swivel_command_rad nan at 0 s, which goes from -1.6 to 1.6"));
        ASSERT_TRUE(odd.unusable);
        EXPECT_THAT(odd.unusable->what(), HasSubstr("law.fmu: control law 'bend light', none of whose 100 commands could be used; "));
        EXPECT_FALSE(run_fmu(law).unusable);
        for (const auto& [fault, word] : {std::pair("12", "discard"), std::pair("13", "error"), std::pair("14", "fatal")})
            EXPECT_THAT(fmu_refusal(law, {{"fault", fault}}),
                        HasSubstr(fmt::format("law.fmu: 'bend light' at 0.02 s: fmi{}DoStep() returned {}: no step of 20 ms, expected ok",
                                              version, word)));
        EXPECT_EQ(run_fmu(law, {{"fault", "11"}}).notes.size(), run_fmu(law).notes.size()) << "a warning";
        EXPECT_THAT(fmu_refusal(law, {{"fault", "20"}}), HasSubstr("a segmentation fault in a step of 'bend light' at 0.02 s"));
        EXPECT_THAT(fmu_refusal({.version = version, .token = "other"}),
                    HasSubstr(fmt::format("no instance for {} 'other': not ", version == 2 ? "guid" : "instantiationToken")));
    }
    EXPECT_THAT(folders_left(), testing::IsEmpty());
}

FmuVariable fmu_variable_of(Fmu& fmu, const std::string& name) {
    return *std::ranges::find(fmu.description().variables, name, &FmuVariable::name);
}

/// Past its initialization, with this fault.
void start_with_fault(Fmu& fmu, double fault) {
    const FmuVariable variable = fmu_variable_of(fmu, "fault");
    fmu.will_set(variable);
    ASSERT_EQ(fmu.instantiate(), "");
    ASSERT_EQ(fmu.set(variable, std::span(&fault, 1)), "");
    ASSERT_EQ(fmu.initialize(), "");
    ASSERT_EQ(fmu.begin(), "");
}

TEST(Fmu, OnlyWhatACallLoggedIsItsReason) {
    Fmu fmu(fmu_archive({2}));
    start_with_fault(fmu, 11.0);
    EXPECT_EQ(fmu.step(0.0, 0.02), "") << "a warning, and its text";
    EXPECT_EQ(fmu.step(-1.0, 0.02), "fmi2DoStep() returned error") << "it says nothing";
    fmu.close();
}

/// After "fatal" the library stays, and may log by what it was handed, which lay in the object that is gone.
TEST(Fmu, WhatAFatalFmuWasHandedOutlivesIt) {
    alignas(Fmu) std::array<std::byte, sizeof(Fmu)> place{};
    Fmu* const fmu = new (place.data())
        Fmu(fmu_archive({3, fmu_variable(3, "environment", "output", "Real", 128) + fmu_variable(3, "log", "output", "Real", 129)}));
    start_with_fault(*fmu, 14.0);
    EXPECT_THAT(fmu->step(0.0, 0.02), HasSubstr("fatal"));
    const auto handed = [&](const std::string& name, auto& pointer) {
        double bits = 0.0;
        fmu->will_get(fmu_variable_of(*fmu, name));
        fmu->get(fmu_variable_of(*fmu, name), std::span(&bits, 1));
        std::memcpy(&pointer, &bits, sizeof pointer);
    };
    fmi::Environment environment = nullptr;
    fmi::v3::Log* log = nullptr;
    handed("environment", environment);
    handed("log", log);
    fmu->~Fmu();
    place.fill(std::byte{0xaa});
    log(environment, fmi::warning, "all", "still here");
}

TEST(FmuLaw, UnitsAreDefinedOrOurs) {
    const auto refused = [](const std::string& unit, const std::string& command, const std::string& root_more = "") {
        const std::string turned = fmu_variable(2, "turned", "output", "Real", 64, "unit=\"" + unit + "\"");
        return fmu_refusal({.variables = turned, .root_more = root_more}, {}, {}, {{"turned", "lamp.left." + command}});
    };
    EXPECT_THAT(refused("deg", "pitch_command_rad"),
                HasSubstr("outputs: 'turned' in 'deg', a unit that the FMU does not define, expected its BaseUnit, because "
                          "'lamp.left.pitch_command_rad' is in rad"));
    EXPECT_EQ(refused("rad", "pitch_command_rad"), "");
    EXPECT_THAT(refused("deg", "level", FmuText{}.root_more), HasSubstr("a unit of what 'lamp.left.level' has in 1"));
}

TEST(FmuLaw, NumbersAreThoseOfTheirType) {
    const FmuText whole{3, fmu_variable(3, "n", "parameter", "UInt16", 30)};
    for (const char* const number : {"70000", "-1", "1.5"})
        EXPECT_THAT(fmu_refusal(whole, {{"n", number}}), HasSubstr(fmt::format("'{}' for 'n', expected a value of type UInt16", number)));
    EXPECT_EQ(fmu_refusal(whole, {{"n", "65535"}}), "");
    EXPECT_EQ(fmu_refusal({2, fmu_variable(2, "ambient", "input", "Real", 4, "start=\"-INF\"") +
                                  fmu_variable(2, "inner", "local", "Integer", 5, "start=\"one\"")},
                          {{"ambient", "3.5"}}),
              "");
}

TEST(FmuLaw, CommandsAreOfLampsThatItMayMove) {
    ControlParameters control{.plugins = {{fmu_archive({}), "", {"high"}}}};
    control.plugins[0].fmu = true;
    EXPECT_THAT(tests::refusal_of([&] {
                    run_control(control, fmu_lamps, {}, [](double t) { return ControlInputs{.time_s = t}; }, {1, 1});
                }),
                HasSubstr("no output that is a command"));
}

TEST(FmuLaw, WhatDoesNotFitIsOneSentence) {
    EXPECT_THAT(fmu_refusal({2, fmu_variable(2, "ego.sped_mps", "input", "Real", 4)}),
                HasSubstr("law.fmu: inputs: no signal 'ego.sped_mps' for input 'ego.sped_mps', expected 'ego.speed_mps', the nearest "
                          "signal, or a place in inputs or parameters"));
    EXPECT_EQ(fmu_refusal({2, fmu_variable(2, "ambient", "input", "Real", 4)}, {{"ambient", "3.5"}}), "") << "a start value is enough";
    EXPECT_THAT(fmu_refusal({2, fmu_variable(2, "ego.wipers", "input", "String", 4)}),
                HasSubstr("variable 'ego.wipers' of type String, expected a number"));
    EXPECT_THAT(fmu_refusal({.swivel_type = "String"}),
                HasSubstr("variable 'lamp.left.swivel_command_rad' of type String, expected a number"));
    EXPECT_THAT(fmu_refusal({.swivel = "angle"}), HasSubstr("outputs: no output that is a command, expected lamp.left.swivel_command_rad"));
    EXPECT_THAT(fmu_refusal({.swivel = "angle"}, {}, {}, {{"angle", "lamp.lift.level"}}),
                HasSubstr("'lamp.lift.level' for 'angle', no command of these lamps"));
    EXPECT_THAT(fmu_refusal(FmuText{}, {}, {{"yaw", "ego.speed_mps"}}), HasSubstr("inputs: no input 'yaw'"));
    EXPECT_THAT(fmu_refusal({2, fmu_variable(2, "v", "input", "Real", 4)}, {{"v", "1"}}, {{"v", "ego.speed_mps"}}),
                HasSubstr("inputs: 'v', which parameters give a value, expected one of them"));
    EXPECT_THAT(fmu_refusal({.swivel = "lamp.high.segments"}), HasSubstr("no output that is a command")) << "without a number";
    EXPECT_THAT(fmu_refusal(FmuText{}, {{"preview", "1"}}), HasSubstr("no parameter 'preview', expected 'preview_s', the nearest"));
    EXPECT_THAT(fmu_refusal(FmuText{}, {{"fault", "1.5"}}), HasSubstr("'1.5' for 'fault', expected a value of type Integer"));
    EXPECT_THAT(fmu_refusal({2, fmu_variable(2, "ego.wipers", "input", "Real", 4, "unit=\"km/h\"")}),
                HasSubstr("'ego.wipers' in 'km/h', expected a unit of what 'ego.wipers' has in 1"));
    EXPECT_THAT(fmu_refusal({3, fmu_variable(3, "lamp.high.segments", "output", "Int8", 65, "", "<Dimension start=\"3\"/>")}),
                HasSubstr("'lamp.high.segments' of 3 values for 2"));
    EXPECT_THAT(fmu_refusal({3, fmu_variable(3, "others.x_m", "input", "Float64", 4, "", "<Dimension valueReference=\"99\"/>")}),
                HasSubstr("a dimension that no variable gives"));
    EXPECT_THAT(
        fmu_refusal({2, fmu_variable(2, "ego.wipers", "input", "Integer", 4, "start=\"one\"")}),
        HasSubstr("law.fmu/modelDescription.xml:9: Integer@start: found 'one' of variable 'ego.wipers', expected a value of type Integer"));
    EXPECT_THAT(fmu_refusal({.version = 4}), HasSubstr("fmiModelDescription@fmiVersion: found '4.0', expected 2.0 or 3.0"));
    EXPECT_THAT(fmu_refusal({.co_simulation = "<ModelExchange modelIdentifier=\"bend\"/>"}),
                HasSubstr("an FMU for model exchange alone, expected co-simulation"));
    EXPECT_THAT(fmu_refusal({.co_simulation = "<CoSimulation modelIdentifier=\"../bend\"/>"}),
                HasSubstr("modelIdentifier: found '../bend'"));
    EXPECT_THAT(fmu_refusal({.co_simulation = "<CoSimulation modelIdentifier=\"bend\" needsExecutionTool=\"true\"/>"}),
                HasSubstr("an FMU that runs without the tool that made it"));
}

TEST(FmuLaw, UnusableArchivesAreOneSentence) {
    const std::string xml = tests::fmu_description({}), inside = "binaries/linux64/bend.so";
    EXPECT_THAT(fmu_refusal(tests::zipped("a.fmu", {{inside, "x"}})), HasSubstr("a.fmu: no modelDescription.xml, expected an FMU"));
    EXPECT_THAT(fmu_refusal(tests::zipped("a.fmu", {{"modelDescription.xml", "<a"}})),
                HasSubstr("a.fmu/modelDescription.xml:1: is not well-formed XML"));
    EXPECT_THAT(fmu_refusal(tests::zipped("a.fmu", {{"modelDescription.xml", xml}})), HasSubstr("no binaries, expected " + inside));
    EXPECT_THAT(fmu_refusal(tests::zipped("a.fmu", {{"modelDescription.xml", xml}, {"binaries/win64/bend.dll", "MZ"}})),
                HasSubstr("no " + inside + "; binaries for win64, expected " + inside));
    EXPECT_THAT(fmu_refusal(tests::zipped("a.fmu", {{"modelDescription.xml", xml}, {inside, "no library"}})),
                testing::AllOf(HasSubstr("cannot be loaded: " + inside + ": "), Not(HasSubstr("fernlicht-fmu-"))));
    std::ifstream plugin(std::filesystem::path(FERNLICHT_BINARY).parent_path() / "example_bend_light.so", std::ios::binary);
    EXPECT_THAT(
        fmu_refusal(tests::zipped("a.fmu", {{"modelDescription.xml", xml}, {inside, {std::istreambuf_iterator<char>(plugin), {}}}})),
        HasSubstr("no function fmi2EnterInitializationMode() in bend.so, expected a binary of FMI 2.0"));
    std::ifstream good(fmu_archive({}), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(good), {}};
    EXPECT_THAT(fmu_refusal(tests::written("short.fmu", bytes.substr(0, bytes.size() / 2))),
                HasSubstr("expected a zip archive, as FMUs are"));
    std::string damaged = bytes;
    damaged[bytes.size() / 2] ^= 0x10;
    EXPECT_THAT(fmu_refusal(tests::written("damaged.fmu", damaged)), HasSubstr("expected a zip archive, as FMUs are"));
    std::ifstream long_name(tests::zipped("a.fmu", {{"modelDescription.xml", xml}, {"resources/aa", "x"}, {"xx/yy/evil", "x"}}),
                            std::ios::binary);
    std::string climbing{std::istreambuf_iterator<char>(long_name), {}};
    for (std::size_t at = 0; (at = climbing.find("xx/yy/evil")) != std::string::npos;)
        climbing.replace(at, 10, "xx/../evil");
    EXPECT_THAT(fmu_refusal(tests::written("climbs.fmu", climbing)), HasSubstr("an entry 'xx/../evil', which climbs out of the archive"));
    // An entry that says it has 2 GiB: its size in the directory, little-endian, 24 bytes behind the entry's signature.
    std::string huge = bytes;
    huge.replace(huge.rfind("PK\x01\x02") + 24, 4, std::string("\0\0\0\x7f", 4));
    EXPECT_THAT(fmu_refusal(tests::written("huge.fmu", huge)), HasSubstr("more than 1024 MiB when unpacked"));
    huge.replace(huge.rfind("PK\x01\x02") + 24, 4, std::string("\0\0\x10\1", 4));
    EXPECT_THAT(fmu_refusal(tests::written("huge.fmu", huge)), HasSubstr("a modelDescription.xml of more than 16 MiB"));
    EXPECT_THAT(folders_left(), testing::IsEmpty());
}

std::string fmu_bytes(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Its size stands 24 bytes behind the directory's record of an entry, the name 46.
TEST(FmuLaw, ASizeThatAnArchiveClaimsTakesNoMemory) {
    std::string claims = fmu_bytes(fmu_archive({}));
    claims.replace(claims.rfind("binaries/linux64/bend.so") - 46 + 24, 4, std::string("\0\0\0\x3f", 4));
    const std::filesystem::path file = tests::written("claims.fmu", claims);
    rusage before{}, after{};
    ::getrusage(RUSAGE_SELF, &before);
    EXPECT_THAT(fmu_refusal(file), HasSubstr("expected a zip archive, as FMUs are"));
    ::getrusage(RUSAGE_SELF, &after);
    EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 300L << 10) << "KiB, of 1008 MiB";
}

TEST(FmuLaw, EntriesThatCannotLieBesideEachOtherAreTheArchivesFault) {
    for (const std::string second : {"resources/bb", "resources/bb/c"}) {
        std::string twice =
            fmu_bytes(tests::zipped("a.fmu", {{"modelDescription.xml", tests::fmu_description({})}, {"resources/aa", "x"}, {second, "y"}}));
        for (std::size_t at = 0; (at = twice.find("resources/bb")) != std::string::npos;)
            twice.replace(at, 12, "resources/aa");
        EXPECT_THAT(fmu_refusal(tests::written("twice.fmu", twice)), HasSubstr("' that cannot lie beside the others"));
    }
    std::string twice = fmu_bytes(tests::zipped("a.fmu", {{"modelDescription.xml", "<a/>"}, {"modelDescription.xmm", "<a/>"}}));
    for (std::size_t at = 0; (at = twice.find("modelDescription.xmm")) != std::string::npos;)
        twice.replace(at, 20, "modelDescription.xml");
    EXPECT_THAT(fmu_refusal(tests::written("twice.fmu", twice)), HasSubstr("'modelDescription.xml' that cannot lie beside the others"));
}

class FmuDrive : public DriveFixture {};

TEST_F(FmuDrive, KeysAreReadBackAndTheFileIsAnInput) {
    std::filesystem::copy_file(fmu_archive({}), folder / "law.fmu");
    const std::string with = minimal +
                             "control: {plugins: [{fmu: law.fmu, parameters: {preview_s: 2, \"a[1].b\": true}, inputs: {v: ego.speed_mps}, "
                             "outputs: {lamp.left.swivel_command_rad: \"lamp.*.swivel_command_rad\"}}]}\n";
    const Drive drive = read(with);
    const std::string written = write_drive(drive);
    const Drive again = read(written);
    EXPECT_EQ(write_drive(again), written);
    EXPECT_TRUE(*drive.lamp_sets[0].control == *again.lamp_sets[0].control);
    EXPECT_EQ(again.lamp_sets[0].control->plugins[0].values[1].second, "true");
    EXPECT_THAT(drive.opened, Contains(testing::Field(&FileRead::path, folder / "law.fmu")));
    const auto refused = [&](const std::string& plugin) { return refusal(minimal + "control: {plugins: [" + plugin + "]}\n"); };
    EXPECT_THAT(refused("{parameters: a}"), HasSubstr("a shared library, or fmu"));
    EXPECT_THAT(refused("{fmu: low.ies, library: low.ies}"), HasSubstr("fmu"));
    EXPECT_THAT(refused("{fmu: law.fmu, parameters: text}"), HasSubstr("expected a map of the FMU's parameters"));
    EXPECT_THAT(refused("{library: low.ies, parameters: {a: 1}}"), HasSubstr("expected the library's own text"));
    EXPECT_THAT(refused("{library: low.ies, inputs: {a: b}}"), HasSubstr("fmu in its place"));
    EXPECT_THAT(refused("{fmu: nowhere.fmu}"), HasSubstr("there is no file"));
}

/// What is wrong with a mapping, or with all of a law's commands, is told at its place in the drive.
TEST_F(FmuDrive, WhatDoesNotFitIsToldInTheDrive) {
    std::filesystem::copy_file(fmu_archive({}), folder / "law.fmu");
    const auto refused = [&](const std::string& more) {
        const std::string road = (shipped_library / "roads/straight.xodr").string();
        const std::string yaml = "fernlicht: 1\nroad: " + road + "\nspeed_kmh: 72\nduration_s: 1\nlamp_sets:\n  one:\n    file: low.ies\n" +
                                 "    control:\n      plugins:\n        - fmu: law.fmu\n" + more;
        return tests::refusal_of([&] { StagedDrive(read(yaml)); }, "");
    };
    EXPECT_EQ(refused("          give_up_s: 20\n"), "");
    EXPECT_THAT(
        refused("          inputs: {yaw: ego.speed_mps}\n"),
        testing::ContainsRegex("/drive.yaml:11:[0-9]+: .*control.plugins.*.inputs: law.fmu: no input 'yaw', expected an input of the FMU"));
    EXPECT_THAT(refused("          outputs: {lamp.left.swivel_command_rad: lamp.lift.level}\n"),
                testing::ContainsRegex("/drive.yaml:11:[0-9]+: .*outputs: law.fmu: 'lamp.lift.level' for"));
    EXPECT_THAT(
        refused("          parameters: {fault: 1}\n"),
        testing::ContainsRegex("/drive.yaml:10:[0-9]+: .*plugins.*: control law 'bend light', none of whose 50 commands could be used"));
}

TEST_F(FmuDrive, ItsVariablesAreListedWithWhatTheyAreTiedTo) {
    const std::string more = fmu_variable(2, "v", "input", "Real", 4, "unit=\"km/h\" start=\"0\"") +
                             fmu_variable(2, "ambient", "input", "Real", 5) + fmu_variable(2, "spare", "output", "Real", 70) +
                             fmu_variable(2, "inner", "local", "Real", 71);
    PluginParameters plugin;
    plugin.library = fmu_archive({2, more});
    plugin.values = {{"preview_s", "2"}};
    plugin.inputs = {{"v", "others[1].speed_mps"}};
    plugin.outputs = {{"lamp.left.swivel_command_rad", "lamp.*.swivel_command_rad"}};
    std::vector<std::string> ties;
    for (const FmuTie& tie : fmu_ties(plugin))
        ties.push_back(tie.variable.name + " " + tie.tie);
    EXPECT_THAT(ties, testing::ElementsAre("ego.yaw_rate_rad_s reads ego.yaw_rate_rad_s", "ego.speed_mps reads ego.speed_mps",
                                           "lamp.left.swivel_command_rad commands lamp.*.swivel_command_rad", "fault its own start value",
                                           "preview_s is 2", "v reads others[1].speed_mps",
                                           "ambient nothing: it needs a signal (inputs) or a value (parameters)", "spare nothing"));
}

} // namespace
} // namespace fernlicht
