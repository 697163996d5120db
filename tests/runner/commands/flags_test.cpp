// The command line as one: what its flags are called, what it says of those that it cannot use, what goes to which stream.
#include "runner/commands/flag_values.h"
#include "scenarios/values/errors.h"
#include "tests/runner/program.h"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

const std::string straight = library_file("drives/straight.yaml"), halogen = library_file("lamps/halogen-low.ies");

/// What a command says on one of its streams alone.
std::string on_stdout(const std::string& arguments) {
    return run_shell("{ '" FERNLICHT_BINARY "' " + arguments + " 2>/dev/null; }").output;
}
std::string on_stderr(const std::string& arguments) {
    return run_shell("{ '" FERNLICHT_BINARY "' " + arguments + " 3>&1 1>/dev/null 2>&3; }").output;
}

struct ToldFlag {
    std::string page, value, sentence;
};

/// By name, out of the man pages, which say what --help says: range and default of a value belong to its command.
std::map<std::string, std::vector<ToldFlag>> flags_of_all_commands() {
    const TemporaryFolder folder;
    printed("man --out " + folder.path().string());
    static const std::regex roff(R"(\\fB|\\fI|\\fR|\\&)"),
        own(R"( \(((-?[0-9.e+-]+ to [0-9.e+-]+)|(default: )).*\)$|; ((-?[0-9.e+-]+ to )|(default: )).*\)$)"),
        last_name(R"((.*, )?(-[A-Za-z0-9-]+)( (.*))?)");
    std::map<std::string, std::vector<ToldFlag>> flags;
    for (const auto& page : std::filesystem::directory_iterator(folder.path())) {
        std::istringstream lines(std::regex_replace(std::regex_replace(content_of(page.path()), std::regex(R"(\\-)"), "-"), roff, ""));
        for (std::string line, before; std::getline(lines, line); before = line) {
            std::smatch part;
            std::string sentence;
            if (before != ".TP" || !line.starts_with('-') || !std::regex_match(line, part, last_name) || !std::getline(lines, sentence))
                continue;
            flags[part[2]].push_back({page.path().filename().string(), part[4],
                                      std::regex_replace(std::regex_replace(sentence, own, ""), std::regex(R"(\)$)"), "")});
            line = sentence;
        }
    }
    return flags;
}

TEST(Flags, OneNameHasOneMeaningOneValueAndOneSentence) {
    const auto flags = flags_of_all_commands();
    ASSERT_GT(flags.size(), 120U);
    for (const auto& [name, all] : flags) {
        std::set<std::string> said, values;
        std::string pages;
        for (const ToldFlag& one : all) {
            said.insert(one.value + ": " + one.sentence);
            values.insert(one.value);
            pages += one.page + ": " + one.value + ": " + one.sentence + '\n';
        }
        for (const char* type : {"TEXT", "INT", "UINT", "FLOAT", "NUMBER"})
            EXPECT_FALSE(values.contains(type)) << name << '\n' << pages;
        if (!name.starts_with("--")) // letters are those of candump and cantools
            continue;
        EXPECT_EQ(said.size(), name == "--out" ? 2U : 1U) << name << '\n' << pages; // a folder, or of what prints a file
        for (const ToldFlag& one : all)
            EXPECT_TRUE(one.sentence.empty() || !one.sentence.ends_with('.')) << one.page << ": " << name;
    }
    EXPECT_TRUE(flags.contains("--lamp-set") && flags.at("--lamp-set").size() > 8);
}

TEST(Flags, WhatCannotBeParsedIsOneSentenceOfOurs) {
    for (const auto& [line, sentence] : {
             std::pair("run first-light --ouput x", "unknown flag --ouput; did you mean --out?"),
             {"film first-light --fim a.webm", "unknown flag --fim; did you mean --film?"}, // not: --film is required
             {"run first-light --zzzzzzzz", "unknown flag --zzzzzzzz; `fernlicht run --help` lists all"},
             {"lamp --convrt=x.ies", "unknown flag --convrt; did you mean --convert?"},
             {"run first-light --out", "--out: found nothing behind it, expected FOLDER"},
             {"lamp x.ies --other 60", "--other: found 1 value, expected AHEAD LEFT"},
             {"rate a b --lamps c", "found 'b' more than `fernlicht rate` takes, expected fernlicht rate [options] RATING --lamps FILE"},
             {"study standard --jobs many", "--jobs: found 'many', expected a whole number from 1 to 1024"},
             {"study standard --jobs 5000", "--jobs: found '5000', expected a whole number from 1 to 1024"},
             {"bench --rounds 1.5", "--rounds: found '1.5', expected a whole number"},
             {"model --body car --yaw left", "--yaw: found 'left', expected a number from -360 to 360"},
             {"study standard --executor pbs", "--executor: found 'pbs', expected local|slurm"},
             {"techniques --json=abc", "--json: found a value with it, expected none"},
             {"run", "found no DRIVE, expected fernlicht run [options] DRIVE..."},
             {"film first-light", "found no --film, expected fernlicht film [options] DRIVE... --film FILE"},
             {"store", "fernlicht store needs a command, expected one of ls, verify, prune"},
             {"importance first-light --row 7", "--row: found without --rating, expected both"},
             {"film first-light --film a.webm --wipe --grid", "--wipe: found beside --grid, expected one of them"},
             {"run first-light --out a --out b", "--out: given twice, expected it once"},
             {"run first-light --annotate github --log-json", ""},
             {"can decode --dbc x.dbc --known", "found '--known', expected --skip-unknown, as it is called now"},
             {"can merge a.log --channel can0", "found '--channel', expected --rename-channel, as it is called now"},
             {"history prune --keep 3", "found '--keep', expected --keep-nights, as it is called now"},
             {"lamp --model xenon-low", "found '--model', expected --lamp-model, as it is called now"},
             {"accept out/x --add --note why", "found '--add', expected --also, as it is called now"},
         }) {
        const std::string said = printed(line, 2);
        EXPECT_EQ(std::ranges::count(said, '\n'), 1) << line << '\n' << said;
        if (*sentence != '\0')
            EXPECT_EQ(said, fmt::format("fernlicht: {}\n", sentence)) << line;
        else
            EXPECT_THAT(said, HasSubstr("--annotate")) << line;
        EXPECT_THAT(on_stdout(line), IsEmpty()) << line;
    }
}

TEST(Flags, HelpHasOneGrammar) {
    const std::string help = printed("film --help");
    EXPECT_THAT(help, HasSubstr("Usage: fernlicht film [options] DRIVE... --film FILE\n"));
    EXPECT_THAT(help, testing::ContainsRegex("  --rate FPS +frames per second \\(default: 25\\)\n"));
    EXPECT_THAT(
        printed("study --help"),
        testing::ContainsRegex("  --jobs N +cells to play at a time \\(1 to 1024; default: one per core; with a\n? *GPU at most 4\\)"));
    for (const char* command : {"", "run ", "lamp ", "history trend ", "can convert "}) {
        std::istringstream lines(printed(std::string(command) + "--help"));
        for (std::string line; std::getline(lines, line);)
            EXPECT_TRUE(line.size() <= 112 || !line.starts_with("  ")) << line;
    }
}

TEST(Flags, FramesAreARangeOrOne) {
    EXPECT_EQ(std::pair(tick_range("20").first, tick_range("20").last), std::pair(20, 20));
    EXPECT_EQ(std::pair(tick_range(":5").first, tick_range("3:5").last), std::pair(0, 5));
    EXPECT_THROW(tick_range("two"), InputError);
}

TEST(Streams, ResultsGoOutAndAllElseGoesToStandardError) {
    const TemporaryFolder folder;
    const std::string run = "run " + straight + " --frames 0:1 --resolution 64x48 --no-accuracy --backend software --out " + (folder / "a");
    EXPECT_THAT(on_stderr(run), AllOf(HasSubstr("fernlicht: straight-1: 2 of 100 moments, as --frames asks"), Not(HasSubstr("0/2"))));
    const std::string results = on_stdout(std::string(run).replace(run.size() - 1, 1, "b"));
    EXPECT_THAT(results, AllOf(Not(HasSubstr("as --frames asks")), testing::EndsWith("/b/report.html\n")));
    EXPECT_THAT(on_stdout("run nothing.yaml --annotate github"), IsEmpty());
    EXPECT_THAT(on_stderr("run nothing.yaml --annotate github"), HasSubstr("::error file=nothing.yaml,title=fernlicht::"));
    EXPECT_NO_THROW(json::parse(on_stdout("lamp " + halogen + " --regulation r112-b --mirror --json --annotate github")));
}

/// A bar for eyes alone: on a terminal that may be written anew.
/// As a CI server ends a job: its log says so although there is nothing to report yet.
TEST(Streams, WhatSigtermEndsSaysSo) {
    const std::string program = "'" FERNLICHT_BINARY "' ", ended = "sleep 3 | timeout --preserve-status --signal=TERM 0.7 " + program;
    Outcome killed = run_shell("( " + ended + "lamp - )");
    EXPECT_EQ(killed.exit_code, 143);
    EXPECT_EQ(killed.output, "fernlicht: ended by SIGTERM\n");
    killed = run_shell("( " + ended + "lamp - --log-json )");
    EXPECT_EQ(nlohmann::json::parse(killed.output).at("message"), "ended by SIGTERM");
}

TEST(Streams, ProgressIsForTerminals) {
    if (run_shell("command -v script").exit_code != 0)
        GTEST_SKIP() << "script of bsdutils is not installed";
    const TemporaryFolder folder;
    const auto on_terminal = [&](const std::string& variables, const std::string& out) {
        return run_shell(variables + " script -qec \"'" FERNLICHT_BINARY "' run " + straight +
                         " --frames 0:1 --resolution 64x48 --no-accuracy --backend software --out " + (folder / out) +
                         "\" /dev/null </dev/null")
            .output;
    };
    EXPECT_THAT(on_terminal("TERM=xterm", "bar"), HasSubstr("[########################] 2/2"));
    EXPECT_THAT(on_terminal("TERM=dumb", "dumb"), Not(HasSubstr("[###")));
    EXPECT_THAT(run_shell("TERM=xterm script -qec \"'" FERNLICHT_BINARY "' lamp --lamp-model xenon-low --convert " + (folder / "x.exr") +
                          " && cat " + (folder / "x.exr") + " | '" FERNLICHT_BINARY "' model --body car --write -\" /dev/null </dev/null")
                    .output,
                HasSubstr("-: found a terminal, and what is written is no text"));
}

TEST(StandardInput, IsALampADriveOrAModel) {
    EXPECT_EQ(printed("lamp - --json <" + halogen),
              std::regex_replace(printed("lamp " + halogen + " --json"), std::regex("halogen-low\\.ies"), "-"));
    EXPECT_THAT(printed("lamp - </dev/null", 2), HasSubstr("standard input: is empty"));
    EXPECT_THAT(run_shell("printf 'fernlicht: 1\\nnonsense: 1\\n' | '" FERNLICHT_BINARY "' installation -").output,
                StartsWith("fernlicht: standard input:2:1: nonsense"));
    // Relative paths are those of the working folder.
    const std::string drive = std::regex_replace(content_of(straight), std::regex("[.][.]/"), "scenarios/library/");
    const TemporaryFolder folder;
    std::ofstream(folder / "d.yaml") << drive;
    const Outcome here = run_shell("cd '" FERNLICHT_SOURCE_DIR "' && '" FERNLICHT_BINARY "' installation - --json <" + (folder / "d.yaml"));
    EXPECT_LE(here.exit_code, 1) << here.output;
    EXPECT_FALSE(json::parse(here.output).at("lamps").empty());
    printed("model --body van --write " + (folder / "van.glb"));
    EXPECT_EQ(run_shell("'" FERNLICHT_BINARY "' model --body van --write - | cmp - " + (folder / "van.glb")).exit_code, 0);
    EXPECT_EQ(json::parse(printed("model - --json <" + (folder / "van.glb"))).at("triangles"),
              json::parse(printed("model " + (folder / "van.glb") + " --json")).at("triangles"));
    EXPECT_THAT(printed("study - </dev/null", 2), HasSubstr("STUDY: found '-', expected a file"));
}

TEST(StandardOutput, TakesWhatWouldBeAFile) {
    const TemporaryFolder folder;
    printed("lamp " + halogen + " --convert " + (folder / "x.ies"));
    EXPECT_EQ(printed("lamp " + halogen + " --convert -"), content_of(folder / "x.ies"));
    EXPECT_THAT(printed("lamp " + halogen + " --picture -"), StartsWith("<svg"));
    EXPECT_THAT(printed("lamp " + halogen + " --picture - --json", 2), HasSubstr("one thing to print"));
    for (const char* line : {"lamp --lamp-model xenon-low --convert /nowhere/x.ies", "lamp --lamp-model xenon-low --picture /nowhere/x.svg",
                             "model --body car --write /nowhere/x.glb", "can cut - -o /nowhere/x.log </dev/null",
                             "stability --only table/poles --out /proc/x", "run first-light --out /proc/x/y --backend software"})
        EXPECT_EQ(run_program(line).exit_code, 2) << line << '\n' << run_program(line).output;
}

TEST(Json, OfReadingsDoctorAndStore) {
    const json readings = json::parse(printed("readings --json"));
    EXPECT_TRUE(std::ranges::any_of(readings, [](const json& one) {
        return one.at("unit") == "m" && one.at("better") == "higher" && one.at("names").at(0).get<std::string>().starts_with("reach_");
    }));
    const json doctor = json::parse(printed("doctor --json"));
    EXPECT_EQ(doctor.at("works"), true);
    EXPECT_FALSE(doctor.at("backends").empty());
    EXPECT_LT(doctor.at("sanity").at("worst_error").get<double>(), doctor.at("sanity").at("bound").get<double>());
    EXPECT_TRUE(doctor.at("versions").contains("GLM"));
    const TemporaryFolder folder;
    std::ofstream(folder / "fernlicht-store") << "";
    EXPECT_EQ(json::parse(printed("store ls --json --store " + folder.path().string())), json::array());
    EXPECT_EQ(json::parse(printed("store verify --json --store " + folder.path().string())).at("removed"), json::array());
    EXPECT_EQ(json::parse(printed("store prune --json --dry-run --older-than 1d --store " + folder.path().string())).at("dry_run"), true);
}

TEST(Signals, OfADriveWithoutAnFmuAreNoError) {
    EXPECT_EQ(printed("signals " + straight), straight + " has no FMU: its lamps move by built-in laws, or not at all\n");
    EXPECT_EQ(json::parse(printed("signals --json " + straight)), json::array());
}

} // namespace
} // namespace fernlicht
