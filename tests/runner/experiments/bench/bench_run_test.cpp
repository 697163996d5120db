// Whole benches through the program: a real drive in, files out. No test asserts a time.
#include "runner/experiments/bench/bench_run.h"
#include "scenarios/values/errors.h"
#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;

std::string small_bench_of(int rounds) {
    return fmt::format("bench --quiet {} --count 2 --rounds {} --resolution 64x48 ", library_file("drives/first-light.yaml"), rounds);
}
const std::string small_bench = small_bench_of(6);

TEST(BenchRun, TicksAreTheMiddlesOfEqualParts) {
    EXPECT_EQ(ticks_over(360, 8), (std::vector<int>{22, 67, 112, 157, 202, 247, 292, 337})); // 22.5 + 45 k
    EXPECT_EQ(ticks_over(5, 5), (std::vector<int>{0, 1, 2, 3, 4}));
    EXPECT_EQ(ticks_over(1, 1), std::vector<int>{0});
    EXPECT_THROW(ticks_over(5, 6), InputError);
    EXPECT_THROW(ticks_over(5, 0), InputError);
    EXPECT_THROW(ticks_over(5, -1), InputError);
}

TEST(BenchRun, ChoosesInTheTablesOrderAndTheReferenceInAnyCase) {
    EXPECT_EQ(chosen_techniques({}).size(), techniques().size());
    const std::vector<Technique> chosen = chosen_techniques({"photometric-naive", "photometric"});
    std::vector<std::string_view> names;
    for (const Technique& row : chosen)
        names.push_back(row.name);
    std::vector<std::string_view> expected;
    for (const Technique& row : techniques())
        if (row.name == "photometric-naive" || row.name == "photometric" || row.name == reference_technique)
            expected.push_back(row.name);
    EXPECT_EQ(names, expected);
    EXPECT_GE(names.size(), 2U);
    EXPECT_THROW(chosen_techniques({"photometric", "photometric"}), InputError);
}

TEST(BenchRun, LeavesRawSamplesOfEveryRound) {
    const TemporaryFolder folder;
    EXPECT_THAT(printed(small_bench + "--techniques photometric,photometric-naive --seed 3 --lamp-set xenon --light-pass shader --out " +
                        (folder / "out")),
                testing::AllOf(HasSubstr("first-light-1, xenon: 2 moments x 6 rounds, 64 x 48 pixels, orders from seed 3"),
                               HasSubstr("\nphotometric ")));
    const json bench = json::parse(content_of(folder / "out/bench.json"));
    EXPECT_THAT(tests::complaints(bench, "bench/bench"), IsEmpty());
    EXPECT_EQ(bench.at("settings").at("moments"), json::parse(R"([{"frame":90,"time_s":3.0},{"frame":270,"time_s":9.0}])"));
    ASSERT_GE(bench.at("techniques").size(), 2U);
    for (const json& technique : bench.at("techniques")) {
        const json& samples = technique.at("samples");
        EXPECT_EQ(samples.at("frame_s").size(), 6U);
        EXPECT_EQ(samples.at("cpu_s").size(), 6U);
        EXPECT_EQ(samples.at("latency_s").size(), 12U);
        for (const json& seconds : samples.at("frame_s"))
            EXPECT_GT(seconds.get<double>(), 0.0);
        EXPECT_GT(technique.at("work").at("triangles"), 0);
        EXPECT_GT(technique.at("work").at("fragments"), 0);
    }
    for (const char* name : {"bench.csv", "bench.svg", "bench.png"})
        EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / name)) << name;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out/INCOMPLETE"));

    EXPECT_EQ(bench.at("settings").at("lit_by"), "the fragment shader");

    printed(small_bench + "--techniques photometric,photometric-naive --seed 3 --light-pass cpu --out " + (folder / "again"));
    const json again = json::parse(content_of(folder / "again/bench.json"));
    EXPECT_EQ(again.at("orders"), bench.at("orders"));
    EXPECT_EQ(again.at("settings").at("lit_by"), "the CPU, each visible pixel once");
    for (const json* const by : {&bench, &again}) {
        EXPECT_EQ(by->at("roofline").at("pixels"), bench.at("roofline").at("pixels"));
        EXPECT_GT(by->at("roofline").at("floor_cpu_s"), 0.0);
    }
    EXPECT_EQ(run_program(small_bench + "--out " + (folder / "again")).exit_code, 2) << "not over another's files";
}

TEST(BenchRun, RefusesWhatItCannotUseAndLeavesNoFolder) {
    const TemporaryFolder folder;
    for (const auto& [flags, complaint] :
         {std::pair("--techniques photometrik", "'photometric'"), std::pair("--lamp-set neon", "one of halogen, xenon"),
          std::pair("--rounds 0", "1 to 100000"), std::pair("--resolution 64", "WIDTHxHEIGHT"), std::pair("--count 361", "1 to 360")}) {
        const Outcome run = run_program("bench --quiet " + library_file("drives/first-light.yaml") + " --out " + (folder / "out ") + flags);
        EXPECT_EQ(run.exit_code, 2) << flags;
        EXPECT_THAT(run.output, HasSubstr(complaint));
        EXPECT_FALSE(std::filesystem::exists(folder.path() / "out")) << flags;
    }
}

/// Without --count, a drive of fewer than eight moments is drawn at all that it has.
TEST(BenchRun, TakesAllMomentsOfAShortDrive) {
    const TemporaryFolder folder;
    std::ofstream(folder / "short.yaml") << "fernlicht: 1\nroad: \"" << library_file("roads/straight.xodr")
                                         << "\"\nspeed_kmh: 72\nrate_hz: 10\nduration_s: 0.3\nlamp_sets:\n  one: {file: \""
                                         << library_file("lamps/halogen-low.ies") << "\"}\n";
    const std::string bench_short = "bench --quiet --rounds 1 --resolution 64x48 --techniques photometric " + (folder / "short.yaml");
    printed(bench_short + " --out " + (folder / "out"));
    EXPECT_EQ(json::parse(content_of(folder / "out/bench.json")).at("settings").at("moments").size(), 3U);
    EXPECT_THAT(run_program(bench_short + " --count 8 --out " + (folder / "again")).output,
                HasSubstr("--count: found 8, expected 1 to 3, the drive's moments"));
}

TEST(BenchRun, EndsAfterARoundWhenInterrupted) {
    const TemporaryFolder folder;
    const Outcome run =
        run_program(small_bench_of(100000) + "--techniques photometric --out " + (folder / "out"), "timeout --signal=INT 5");
    ASSERT_EQ(run.exit_code, 124) << run.output; // timeout's own: the program ended in time after its signal
    const json bench = json::parse(content_of(folder / "out/bench.json"));
    EXPECT_EQ(bench.at("interrupted"), "interrupted by the user");
    EXPECT_LT(bench.at("settings").at("rounds_done"), 100000);
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "out/INCOMPLETE"));
}

} // namespace
} // namespace fernlicht
