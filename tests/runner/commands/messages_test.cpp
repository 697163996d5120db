// Messages, annotations, traces and exit codes of the program itself.
#include "tests/runner/program.h"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <map>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::vector<json> objects_of(const std::string& lines) {
    std::vector<json> objects;
    std::istringstream in(lines);
    for (std::string line; std::getline(in, line);)
        objects.push_back(json::parse(line, nullptr, false));
    return objects;
}

/// A straight drive in small pictures, with more keys.
std::string straight_drive(const TemporaryFolder& folder, const std::string& more = "") {
    std::string text = content_of(library_file("drives/straight.yaml"));
    for (const char* below : {"../roads/", "../lamps/"})
        for (std::size_t at = text.find(below); at != std::string::npos; at = text.find(below, at + 1))
            text.replace(at, 3, library_file(""));
    std::ofstream(folder / "d.yaml") << text << more;
    return folder / "d.yaml";
}

constexpr const char* three_moments = " --frames 0:2 --resolution 96x72 --no-accuracy --backend software ";

TEST(Messages, AsJsonWhateverEndsTheProgram) {
    for (const auto& [line, code, message] : {std::tuple("run nothing.yaml --log-json", 2, "nothing.yaml"),
                                              {"run --log-json --fraems 3", 2, "--fraems"},
                                              {"rnu --log-json", 2, "rnu"},
                                              {"bench --backend egl-device=99 --log-json", 3, "egl-device=99"},
                                              {"can cut nothing.log --log-json", 2, "nothing.log"}}) {
        const std::vector<json> said = objects_of(printed(line, code));
        ASSERT_FALSE(said.empty()) << line;
        EXPECT_EQ(said.front().at("level"), "error") << line;
        EXPECT_EQ(said.front().at("exit_code"), code) << line;
        EXPECT_THAT(said.front().at("message").get<std::string>(), HasSubstr(message));
    }
    EXPECT_THAT(printed("run nothing.yaml --frames 0:1 --frames 0:2", 2), HasSubstr("--frames: given twice, expected it once"));
    EXPECT_THAT(printed("techniques --log-level loud", 2), HasSubstr("error, warning, info or debug"));
    EXPECT_THAT(printed("techniques --annotate gitlab", 2), HasSubstr("expected github"));
}

TEST(Messages, OfARunAndItsTrace) {
    const TemporaryFolder folder;
    const std::string drive = straight_drive(folder), trace_file = folder / "out/trace.json";
    const std::string said = printed("run " + drive + three_moments + "--light-pass shader --log-json --log-level debug --trace " +
                                     trace_file + " --out " + (folder / "out"));
    std::vector<json> progress;
    bool renders = false, compiles = false;
    for (const json& object : objects_of(said))
        if (object.is_object()) {
            renders = renders || object.contains("backend");
            compiles = compiles || object.contains("compiled");
            if (object.contains("progress"))
                progress.push_back(object);
        }
    EXPECT_TRUE(renders && compiles) << said;
    ASSERT_FALSE(progress.empty()) << said;
    EXPECT_EQ(progress.back().at("done"), 3);
    EXPECT_EQ(progress.back().at("total"), 3);

    const json events = json::parse(content_of(trace_file)).at("traceEvents");
    std::map<std::string, int> count;
    std::map<int, std::string> threads;
    for (const json& event : events)
        if (event.at("ph") == "X")
            ++count[event.at("name")];
        else if (event.at("name") == "thread_name")
            threads[event.at("tid")] = event.at("args").at("name");
    const int lamp_sets = count["lamp set"];
    EXPECT_EQ(lamp_sets, 2);
    EXPECT_EQ(count["moment"], 3 * lamp_sets);
    EXPECT_EQ(count["extent"], 3 * lamp_sets);
    for (const char* name : {"read road, make scene", "open device", "drive", "prepare", "compile", "submit", "scene", "read back",
                             "extent of the twin", "seeing", "sensitivity", "write PNG", "wait for extents", "write report"})
        EXPECT_GT(count[name], 0) << name;
    // What a thread does lies within what it does around it: no two spans of one overlap in part.
    std::map<int, std::vector<std::pair<double, double>>> spans;
    for (const json& event : events)
        if (event.at("ph") == "X") {
            const double begin = event.at("ts"), dur = event.at("dur");
            EXPECT_TRUE(threads.contains(event.at("tid")));
            spans[event.at("tid")].emplace_back(begin, begin + dur);
        }
    for (auto& [thread, all] : spans) {
        std::ranges::sort(all,
                          [](const auto& a, const auto& b) { return a.first < b.first || (a.first == b.first && a.second > b.second); });
        std::vector<double> open;
        for (const auto& [begin, end] : all) {
            while (!open.empty() && open.back() <= begin + 1e-3)
                open.pop_back();
            if (!open.empty()) {
                EXPECT_LE(end, open.back() + 2e-3) << threads[thread];
            }
            open.push_back(end);
        }
    }
    EXPECT_THAT(printed("run " + drive + three_moments + "--trace " + trace_file + " --out " + (folder / "again"), 2),
                HasSubstr("--trace"));
    EXPECT_FALSE(std::filesystem::exists(folder / "again"));
}

TEST(Messages, ARunSaysWhatItFoundAndWhatALampKeeps) {
    const TemporaryFolder folder;
    const std::string drive = straight_drive(folder);
    const auto said = [&](const std::string& flags, const char* out) {
        return printed("run " + drive + three_moments + flags + " --out " + (folder / out));
    };
    const std::string two = said("", "two");
    EXPECT_THAT(two,
                testing::ContainsRegex("straight-1: Reach at [^:]*: xenon is better than halogen: [0-9.]+ m against [0-9.]+ m \\(\\+"));
    EXPECT_THAT(two, Not(HasSubstr("--lamp replaces")));
    const std::string one = said("--lamp " + library_file("lamps/led-low.ies"), "one");
    EXPECT_THAT(one, HasSubstr("straight-1: --lamp replaces the file alone: the lamp stays a filament at 13.2 V"));
    EXPECT_THAT(printed("run " + library_file("studies/standard.yaml"), 2), HasSubstr("is a study, expected a drive; `fernlicht study`"));
}

TEST(Messages, ATraceOutlivesCtrlC) {
    const TemporaryFolder folder;
    const Outcome run =
        run_interrupted("run " + straight_drive(folder) + " --resolution 96x72 --no-accuracy --backend software --log-json --trace " +
                            (folder / "t.json") + " --out " + (folder / "out"),
                        "10/100 moments");
    EXPECT_EQ(run.exit_code, 1) << run.output;
    const json events = json::parse(content_of(folder / "t.json")).at("traceEvents");
    const auto count = [&](const char* name) {
        return std::ranges::count_if(events, [&](const json& event) { return event.at("name") == name; });
    };
    EXPECT_GE(count("moment"), 10);
    EXPECT_LT(count("moment"), 100);
    EXPECT_EQ(count("write report"), 1);
}

TEST(Messages, QuietAndWarningLeaveTheWarningsOfARunThatIsWell) {
    const TemporaryFolder folder;
    const std::string drive = straight_drive(folder);
    const auto said = [&](const std::string& flag, const std::string& out) { // on standard error alone
        return run_shell("{ '" FERNLICHT_BINARY "' run " + drive + three_moments + flag + " --out " + (folder / out) +
                         " 3>&1 1>/dev/null 2>&3; }")
            .output;
    };
    const std::string warning = "fernlicht: straight-1: 3 of 100 moments, as --frames asks; readings are of these alone\n";
    EXPECT_EQ(said("--quiet", "quiet"), warning);
    EXPECT_EQ(said("--log-level warning", "warning"), warning);
    EXPECT_EQ(said("--log-level error", "silent"), "");
    EXPECT_THAT(printed("run " + drive + " --frames 1:1 --resolution 96x72 --no-accuracy --quiet --out " + (folder / "none")),
                HasSubstr("of these alone, and none is stored (--capture all stores every one)"));
}

TEST(Messages, AnnotationsNameFileAndLineOfALimit) {
    const TemporaryFolder folder;
    const std::string drive = straight_drive(folder, "\nlimits:\n  - {reading: reach_1lx_road_own_m, at_least: 900}\n");
    const std::string text = content_of(drive);
    const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find("  - {reading:")), '\n') + 1;
    const std::string said = run_shell("cd " + folder.path().string() + " && '" FERNLICHT_BINARY "' run d.yaml" + three_moments +
                                       "--quiet --annotate github --out out")
                                 .output;
    const auto at_limit = HasSubstr(fmt::format("::error file=d.yaml,line={},title=FAIL ", line));
    EXPECT_THAT(said, AllOf(at_limit, HasSubstr("limit at least 900 m%0Arepeat with: ")));
    std::ofstream(folder / "s.yaml") << "fernlicht_study: 1\nlamps: {a: {low: " << library_file("lamps/halogen-low.ies")
                                     << "}}\ndrives: [d.yaml]\nresolution_px: [96, 72]\n";
    EXPECT_THAT(run_shell("cd " + folder.path().string() +
                          " && '" FERNLICHT_BINARY
                          "' study s.yaml --frames 0:2 --no-accuracy --quiet --annotate github --store store --out study")
                    .output,
                at_limit);
    std::ofstream(drive, std::ios::app) << "nonsense: 1\n";
    EXPECT_THAT(run_program("run " + drive + " --annotate github").output, HasSubstr("::error file="));
}

/// The one page that documents them.
TEST(ExitCodes, AreThoseOfTheReference) {
    const std::string page = content_of(FERNLICHT_SOURCE_DIR "/docs/reference/exit-codes.md");
    const TemporaryFolder folder;
    std::map<int, std::string> lines{{0, "techniques"},
                                     {1, "lamp " + library_file("lamps/halogen-low.ies") + " --regulation r112-b --mirror"},
                                     {2, "run nothing.yaml"},
                                     {3, "bench --backend egl-device=99"}};
    for (const auto& [code, line] : lines) {
        EXPECT_THAT(page, HasSubstr(fmt::format("\n- **{}**: ", code)));
        printed(line, code);
    }
    for (const int code : {4, 130})
        EXPECT_THAT(page, HasSubstr(fmt::format("\n- **{}**: ", code)));
}

} // namespace
} // namespace fernlicht
