// What leaving out saves: when it is measured, and how reports say it.
#include "runner/experiments/run/savings.h"

#include "runner/commands/run_files.h"
#include "runner/write/report_texts.h"
#include "tests/runner/program.h"
#include "tests/runner/sample_report.h"
#include "tests/runner/schema_check.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(PruningSavings, AreMeasuredOnAsManyMomentsAsTwoSecondsAllow) {
    // A moment takes 9 frames of each, 2.3 times the pruned one's time together: 20.7 of those.
    EXPECT_EQ(affordable_moments(0.016, 60.0), 4); // 6.04, at most 4
    EXPECT_EQ(affordable_moments(0.0324, 60.0), 2);
    EXPECT_EQ(affordable_moments(0.0322, 60.0), 3); // 3 * 20.7 * 0.0322 = 1.9996 s
    EXPECT_EQ(affordable_moments(0.096, 60.0), 1);
    EXPECT_EQ(affordable_moments(0.097, 60.0), 0);
    EXPECT_EQ(affordable_moments(0.01, 3.2), 3); // a fifth: 0.64 s, of which a moment takes 0.207
    EXPECT_EQ(affordable_moments(0.01, 1.0), 0);
}

TEST(PruningSavings, SayWhyTheyAreNotMeasured) {
    Drive drive;
    drive.views.emplace_back();
    PlayedCell played;
    EXPECT_EQ(no_savings(drive, played), "too few moments were played");
    played.throughput.view_s = 0.3;
    EXPECT_EQ(no_savings(drive, played), "a frame takes 300 ms, and seven rounds more than two seconds");
    played.throughput.view_s = 0.01;
    EXPECT_EQ(no_savings(drive, played), "too few moments were played: it would take more than a fifth of their time");
    played.throughput.wall_s = 2.0;
    EXPECT_EQ(no_savings(drive, played), "");
    drive.views.front().projection = Projection::map;
    EXPECT_EQ(no_savings(drive, played), "the drive has only maps");
    drive.technique = "full";
    EXPECT_EQ(no_savings(drive, played), "it is measured for the technique photometric only, this is full");
}

TEST(PruningSavings, WhatCannotBeContestedIsLeftOutAndTheRunStays) {
    const TemporaryFolder folder;
    std::string lamps;
    for (int i = 0; i < 10; ++i)
        lamps += "      l" + std::to_string(i) + ": {file: " + library_file("lamps/halogen-low.ies") + ", position_m: [0, " +
                 std::to_string(i) + ", 0.65], level: " + (i == 0 ? "1" : "0") + "}\n";
    std::ofstream(folder / "ten.yaml") << "fernlicht: 1\nname: ten\nroad: " << library_file("roads/straight.xodr")
                                       << "\nroute: {s_m: 20}\nspeed_kmh: 36\nrate_hz: 10\nduration_s: 10\nlamp_sets:\n  ten:\n"
                                          "    source: filament\n    lamps:\n"
                                       << lamps << "views: {driver: {resolution_px: [64, 48]}}\n";
    const Outcome run = run_program("run " + (folder / "ten.yaml") + " --quiet --out " + (folder / "out"));
    ASSERT_EQ(run.exit_code, 0) << run.output;
    EXPECT_THAT(json::parse(content_of(folder / "out/report.json")).at("times").at(0).at("savings").at("not_measured").get<std::string>(),
                HasSubstr("10 lamps are mounted, and an unpruned technique renders those that are off, too, expected at most 8"));
}

/// Seven rounds that take `factor` of the time of the unpruned ones, up to the given share of it more or less.
PruningSavings savings_of(double factor, double noise) {
    PruningSavings savings;
    savings.ticks = {5, 15};
    for (int round = 0; round < 7; ++round) {
        savings.unpruned_s.push_back(0.020);
        savings.pruned_s.push_back(0.020 * factor * (1.0 + noise * (round - 3) / 3.0));
    }
    savings.pruned.passes = 1;
    savings.unpruned.passes = 5;
    return savings;
}

TEST(PruningSavings, StandInAllFilesOfTheReport) {
    Report report = tests::sample_report(4);
    report.played[0].savings = savings_of(0.8, 0.01);
    report.played[1].savings = savings_of(1.0, 0.05);
    const json whole = json::parse(report_json(report));
    EXPECT_THAT(tests::complaints(whole, "run/report"), IsEmpty());
    const json& entry = whole.at("times").at(0).at("savings");
    EXPECT_EQ(entry.at("frames"), json::parse("[5, 15]"));
    EXPECT_NEAR(entry.at("ratio").at("median").get<double>(), 0.8, 1e-12);
    EXPECT_EQ(entry.at("ratio").at("verdict"), "faster");
    EXPECT_EQ(entry.at("unpruned").at("samples_s").size(), 7U);
    EXPECT_EQ(entry.at("unpruned").at("work").at("passes"), 5);
    EXPECT_EQ(entry.at("pruned").at("work").at("passes"), 1);
    EXPECT_EQ(whole.at("times").at(1).at("savings").at("ratio").at("verdict"), "not distinguishable");
    EXPECT_THAT(times_csv(report), HasSubstr("\"frame back to back with nothing left out, median\",20,ms"));

    const std::string page = report_html(report, "/nonexistent");
    EXPECT_THAT(page, HasSubstr("halogen: 16.00 ms instead of 20.00 ms a frame (ratio 0.80, 0.79 … 0.81 over 7 rounds)"));
    EXPECT_THAT(page, HasSubstr("xenon: nothing that can be told from chance: 20.00 ms a frame against 20.00 ms (ratio 1.00, "));
    EXPECT_THAT(page, HasSubstr("<td class=\"words\">unpruned</td><td class=\"n\">20.00</td><td class=\"n\">5</td>"));
}

TEST(PruningSavings, SayTheReasonInTheirPlace) {
    Report report = tests::sample_report(4);
    for (PlayedCell& played : report.played)
        played.savings.not_measured = "too few moments were played";
    const json whole = json::parse(report_json(report));
    EXPECT_EQ(whole.at("times").at(0).at("savings").at("not_measured"), "too few moments were played");
    EXPECT_TRUE(whole.at("times").at(0).at("savings").at("pruned").is_null());
    const std::string page = report_html(report, "/nonexistent");
    EXPECT_THAT(page, HasSubstr("halogen: not measured: too few moments were played"));
    EXPECT_THAT(page, Not(HasSubstr("\">unpruned</td>")));
    EXPECT_THAT(times_csv(report), Not(HasSubstr("nothing left out")));
}

TEST(PruningSavings, OfARunAreMeasuredOnTheSameMoments) {
    const TemporaryFolder folder;
    const Outcome run =
        run_program("run " + library_file("drives/straight.yaml") + " --quiet --frames 10:60 --resolution 64x48 --out " + (folder / "out"));
    ASSERT_LE(run.exit_code, 1) << run.output;
    const json report = json::parse(content_of(folder / "out/report.json"));
    ASSERT_FALSE(report.at("times").empty());
    for (const json& times : report.at("times")) {
        const json& entry = times.at("savings");
        if (entry.at("pruned").is_null()) { // a machine so busy that frames of 64 x 48 take a tenth of a second
            EXPECT_THAT(entry.at("not_measured").get<std::string>(), HasSubstr("more than "));
            continue;
        }
        for (const json& tick : entry.at("frames")) {
            EXPECT_GE(tick, 10);
            EXPECT_LE(tick, 60);
        }
        EXPECT_EQ(entry.at("pruned").at("samples_s").size(), 7U);
        const json &pruned = entry.at("pruned").at("work"), &unpruned = entry.at("unpruned").at("work");
        EXPECT_GT(pruned.at("draws"), 0);
        EXPECT_GE(unpruned.at("draws"), pruned.at("draws"));
        EXPECT_GT(unpruned.at("features"), pruned.at("features"));
        EXPECT_GE(unpruned.at("triangles"), pruned.at("triangles"));
    }
}

TEST(PruningSavings, AreNotMeasuredWherePassesAreTimed) {
    const TemporaryFolder folder;
    const Outcome run = run_program("run " + library_file("drives/straight.yaml") +
                                    " --quiet --profile --frames 0:5 --resolution 64x48 --out " + (folder / "out"));
    ASSERT_LE(run.exit_code, 1) << run.output;
    EXPECT_EQ(json::parse(content_of(folder / "out/report.json")).at("times").at(0).at("savings").at("not_measured"),
              "the run timed each pass");
}

} // namespace
} // namespace fernlicht
