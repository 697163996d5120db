#include "runner/experiments/bench/bench_result.h"
#include "runner/write/document.h"
#include "runner/write/plots/png.h"
#include "runner/write/plots/svg.h"
#include "scenarios/values/files.h"
#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"

#include <algorithm>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// As it might have been, with figures that are easy to work out. Two moments, seven rounds. texturing-only takes 10 ms but 20 in round 3;
/// full twice that; clamped, which is full up to 1 % of noise; light-map a tenth of it.
BenchResult sample_bench() {
    BenchResult result;
    result.context.command = "fernlicht bench";
    result.context.started_utc = "2026-01-31T22:15:00Z";
    result.context.seed = 5;
    result.context.backend = "egl";
    result.context.gl_renderer = "llvmpipe <&>";
    result.context.cpu = "a CPU (avx2)";
    result.context.versions = {{"fernlicht", "0.1.0"}};
    result.context.inputs = {{"a.yaml", 12, "00112233445566778899aabbccddeeff"}};
    result.cores = 2;
    result.load_before = {0.25, 0.5, 1.0};
    result.load_after = {1.5, 0.75, 1.0};
    result.others.cores = 0.1;
    result.drive = "night";
    result.lamp_set = "xenon";
    result.width_px = 640;
    result.height_px = 480;
    result.moments = {{0, 0.0}, {30, 1.0}};
    result.rounds_planned = 7;
    result.warm_up_plays = 2;
    result.gpu_not_measured = "the driver renders on the CPU";
    const auto add = [&](const char* name, int thesis_row, const char* thesis_fps, double factor, double noise) {
        BenchedTechnique benched;
        benched.row.name = name;
        benched.row.thesis_row = thesis_row;
        benched.row.thesis_fps = thesis_fps;
        for (int round = 0; round < 7; ++round) {
            const double frame_s = (round == 3 ? 0.020 : 0.010) * factor * (round % 2 == 0 ? 1.0 + noise : 1.0 - noise);
            benched.samples.frame_s.push_back(frame_s);
            benched.samples.cpu_s.push_back(2.0 * frame_s);
            benched.samples.latency_s.insert(benched.samples.latency_s.end(), {1.5 * frame_s, 2.5 * frame_s});
        }
        benched.work = {{1, 20, 3, 5, 2, 4, 7, 4000, 300000, 3 << 20}, {1, 30, 3, 5, 2, 4, 7, 5000, 310000, 3 << 20}};
        result.techniques.push_back(std::move(benched));
    };
    add("texturing-only", 3, ">= 60", 1.0, 0.0);
    add("full", 4, "~22", 2.0, 0.0);
    add("clamped", 8, "~30", 2.0, 0.01);
    add("light-map", 0, "", 0.1, 0.0);
    result.orders.assign(7, {2, 0, 3, 1});
    result.roofline = {
        {.pixels = 500'000, .bytes = 10'000'000, .operations = 200'000'000, .divisions = 5'000'000, .look_ups = 3'000'000, .cpu_s = 0.006},
        {packs::Level::avx2, 2, 1e10, 2e9, 1e11, 5e9}}; // 1, 1.5, 2 and 1 ms
    return result;
}

TEST(BenchRows, AreWhatTheSamplesSay) {
    const BenchResult result = sample_bench();
    const std::vector<BenchRow> rows = summarise(result);
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_DOUBLE_EQ(rows[0].frame.median, 0.010);
    EXPECT_DOUBLE_EQ(rows[0].frames_per_s(), 100.0);
    EXPECT_DOUBLE_EQ(rows[0].frame.p95, 0.017); // seven samples, the last 20 ms: at place 5.7
    EXPECT_EQ(rows[0].frame_deviation_s, 0.0);
    EXPECT_DOUBLE_EQ(rows[1].ratio->median, 2.0); // the slow round was slow for both
    EXPECT_NEAR(rows[1].ratio->p95, 2.0, 1e-14);
    EXPECT_EQ(rows[1].ratio->difference, Difference::slower);
    EXPECT_EQ(rows[3].ratio->difference, Difference::faster);
    EXPECT_DOUBLE_EQ(rows[1].cpu.median, 0.040);
    EXPECT_DOUBLE_EQ(rows[1].latency.median, 0.050); // six of 30, six of 50, then 60 and 100 ms
    EXPECT_EQ(rows[1].latency.count, 14U);
    EXPECT_FALSE(rows[1].gpu);
    EXPECT_EQ(rows[1].work->triangles, 4000U);
    EXPECT_EQ(rows[1].work->draws, 20);
}

TEST(BenchRows, VerdictsSayRatioAndSpread) {
    EXPECT_EQ(verdict_text({7, 1.02, 0.97, 1.06, Difference::not_distinguishable}), "not distinguishable (ratio 1.02, spread 0.97..1.06)");
    EXPECT_EQ(verdict_text({7, 2.312, 2.251, 2.399, Difference::slower}), "slower (ratio 2.31, spread 2.25..2.40)");
}

TEST(BenchRows, WarnOfWhatMakesTimesDoubtful) {
    BenchResult result = sample_bench();
    EXPECT_THAT(bench_warnings(result), IsEmpty());
    result.others = {1.25, "cc1plus", 0.9};
    EXPECT_THAT(bench_warnings(result),
                ElementsAre(HasSubstr("others used 1.25 of the machine's 2 cores meanwhile (busiest seen: 'cc1plus' with 0.90)")));
    result.others.cores.reset();
    result.orders.resize(3);
    result.interrupted = "interrupted by the user";
    result.techniques.erase(result.techniques.begin());
    EXPECT_THAT(bench_warnings(result), ElementsAre(HasSubstr("/proc/stat does not tell"), HasSubstr("3 rounds are too few"),
                                                    HasSubstr("3 of 7 rounds were done: interrupted by the user"),
                                                    HasSubstr("no ratios: texturing-only did not take part")));
    EXPECT_FALSE(summarise(result)[0].ratio);
}

TEST(BenchText, AlignsColumns) { EXPECT_EQ(aligned_table("<>", {{"a", "long"}, {"word", "1"}, {"x", ""}}), "a     long\nword     1\nx\n"); }

TEST(BenchText, TablesStandBesideTheThesis) {
    const std::string text = document_text(document(sample_bench()));
    EXPECT_THAT(text, HasSubstr("#  technique       thesis, frames/s  here, frames/s  ratio      spread  verdict\n"
                                "3  texturing-only             >= 60           100.0   1.00           -  the reference\n"
                                "4  full                         ~22            50.0   2.00  2.00..2.00  slower\n"
                                "8  clamped                      ~30            49.5   2.02  1.98..2.02  slower\n"));
    EXPECT_THAT(text, HasSubstr("technique  frames/s  ratio      spread  verdict\n"
                                "light-map    1000.0   0.10  0.10..0.10  faster\n"));
    EXPECT_THAT(text,
                HasSubstr("full             20.00  34.00    50.00  74.00  40.00    -       1     20       4000     300000       3.0\n"));
    EXPECT_THAT(text, HasSubstr("load average 0.25 before, 1.50 after"));
}

TEST(BenchText, LightStandsBesideItsFloor) {
    BenchResult result = sample_bench();
    EXPECT_THAT(
        document_text(document(result)),
        testing::AllOf(HasSubstr("takes 6.00 ms of CPU time, 3.0 times its floor of 2.00 ms: the operations that its 500000 pixels"),
                       HasSubstr("(2 threads, packs of 8)"), Not(HasSubstr("are GL's"))));
    EXPECT_THAT(document_text(document(result)), HasSubstr("look-ups                 6.0     3.00            2.00          1.50\n"));
    result.techniques[1].row.name = "photometric";
    result.lit_by = lit_by_cpu;
    EXPECT_THAT(document_text(document(result)), HasSubstr("The other 34.00 ms of photometric, in its quickest round, are GL's"));
    result.roofline.reset();
    result.roofline_not_measured = "a GPU renders";
    EXPECT_THAT(document_text(document(result)), HasSubstr("light is not measured: a GPU renders."));
}

TEST(BenchJson, FitsItsSchema) {
    FilesRead opened;
    tests::Schema schema(json::parse(read_file(FERNLICHT_SOURCE_DIR "/runner/experiments/bench/bench.schema.json", opened)));
    BenchResult result = sample_bench();
    const json whole = json::parse(bench_json(result));
    EXPECT_THAT(schema.check(whole), IsEmpty());
    result.techniques[1].samples.gpu_s.assign(7, 0.001);
    result.techniques[2].work.clear();
    result.techniques.erase(result.techniques.begin()); // no reference
    result.orders.assign(7, {0, 1, 2});
    result.others = {};
    result.load_before.reset();
    result.roofline.reset();
    EXPECT_THAT(schema.check(json::parse(bench_json(result))), IsEmpty());
    EXPECT_THAT(schema.check(json::parse(bench_json({}))), IsEmpty());
    json bad = whole;
    bad["techniques"][0]["frame_s"] = 3;
    EXPECT_THAT(schema.check(bad), Not(IsEmpty()));
}

TEST(BenchJson, KeepsRawSamplesAndComparesEveryTwo) {
    const BenchResult result = sample_bench();
    const json whole = json::parse(bench_json(result));
    EXPECT_EQ(whole.at("techniques").at(1).at("samples").at("frame_s").get<std::vector<double>>(), result.techniques[1].samples.frame_s);
    EXPECT_EQ(whole.at("context").at("inputs").at(0).at("xxh128"), "00112233445566778899aabbccddeeff");
    EXPECT_EQ(whole.at("orders").at(6), json({"clamped", "texturing-only", "light-map", "full"}));
    EXPECT_EQ(whole.at("techniques").at(0).at("gpu_not_measured"), "the driver renders on the CPU");
    ASSERT_EQ(whole.at("comparisons").size(), 6U);
    const json& clamped_full = whole.at("comparisons").at(2);
    EXPECT_EQ(clamped_full.at("technique"), "clamped");
    EXPECT_EQ(clamped_full.at("against"), "full");
    EXPECT_EQ(clamped_full.at("verdict"), "not distinguishable");
    EXPECT_EQ(clamped_full.at("text"), "not distinguishable (ratio 1.01, spread 0.99..1.01)");
}

TEST(BenchJson, HasTheRoofline) {
    const json roofline = json::parse(bench_json(sample_bench())).at("roofline");
    EXPECT_EQ(roofline.at("bound"), "operations");
    EXPECT_DOUBLE_EQ(roofline.at("floor_cpu_s").get<double>(), 0.002);
    EXPECT_DOUBLE_EQ(roofline.at("ratio").get<double>(), 3.0);
    EXPECT_DOUBLE_EQ(roofline.at("ceilings").at(3).at("floor_cpu_s").get<double>(), 0.001);
}

TEST(BenchCsv, HasALinePerTechniqueAndRound) {
    const std::string text = bench_csv(sample_bench());
    EXPECT_THAT(text, HasSubstr("technique,round,place,frame_s,cpu_s,gpu_s,latency_median_s\r\ntexturing-only,0,1,0.01,0.02,,0.02\r\n"));
    EXPECT_THAT(text, HasSubstr("\r\nlight-map,3,2,0.002,0.004,,0.004\r\n"));
    EXPECT_EQ(std::ranges::count(text, '\n'), 1 + 4 * 7);
}

TEST(BenchPlot, ShowsEachWithItsTimeAndRatio) {
    const std::string svg = plots::svg_of(bench_plot(sample_bench()));
    for (const char* text : {">4. full<", ">20.00 ms, x 2.00<", ">light-map<", ">1.00 ms, x 0.10<", "[ms]", "llvmpipe &lt;&amp;&gt;"})
        EXPECT_THAT(svg, HasSubstr(text));
    EXPECT_LT(svg.find(">4. full<"), svg.find(">light-map<"));
    EXPECT_EQ(plots::png_of_svg(svg).substr(1, 3), "PNG");
    EXPECT_EQ(svg, plots::svg_of(bench_plot(sample_bench())));
    EXPECT_THAT(plots::svg_of(bench_plot({})), HasSubstr("</svg>"));
}

} // namespace
} // namespace fernlicht
