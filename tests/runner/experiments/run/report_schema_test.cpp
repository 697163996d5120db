// report.json against runner/experiments/run/report.schema.json.
#include "runner/commands/run_files.h"
#include "runner/findings/extent_keys.h"
#include "tests/runner/sample_report.h"
#include "tests/runner/schema_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> complaints_of(const json& report) { return tests::complaints(report, "run/report"); }

TEST(ReportSchema, DescribesReports) {
    Report report = tests::sample_report(3);
    const json written = json::parse(report_json(report));
    EXPECT_THAT(complaints_of(written), IsEmpty());
    for (const json& extent : written["drives"][0]["summary"])
        EXPECT_EQ(extent["same_direction"], extent["lane"] != "left 1");
    report.played[0].extents[1] = {};
    report.played[1].extents.clear();
    report.complete = false;
    report.interrupted = "a reason";
    report.played[0].passes[0].seconds.clear();
    EXPECT_THAT(complaints_of(json::parse(report_json(report))), IsEmpty());
    EXPECT_THAT(complaints_of(json::parse(report_json({}))), IsEmpty());
}

TEST(ReportSchema, EveryNullOfASummaryHasItsReason) {
    Report report = tests::sample_report(1);
    ExtentSummary summary;
    summary.key = {Surface::target, "own", 1.0};
    const auto reach = [&](Aspect aspect) -> CensoredSamples& {
        return summary.moments[extent_reading(summary.key, Quantity::reach, ReadingPlace::none, aspect)];
    };
    reach(Aspect::value).add(150.0);
    reach(Aspect::value).add(Value::at_least(200.0));
    reach(Aspect::twin_difference).add(Value::not_measured("both beyond 200 m"));
    reach(Aspect::grid_error).add(0.02);
    report.played[0].extent_summaries = {summary};
    const json written = json::parse(report_json(report));
    EXPECT_THAT(complaints_of(written), IsEmpty());
    const json& entry = written["drives"][0]["summary"][0];
    EXPECT_EQ(entry["reach_m"]["median"], json({{"at_least", 175.0}}));
    EXPECT_EQ(entry["reach_m"]["not_measured"],
              json({{"mean", "1 of 2 moments give a bound only"}, {"standard_deviation", "1 of 2 moments give a bound only"}}));
    EXPECT_EQ(entry["not_measured"]["largest_twin_difference_m"], "both beyond 200 m in every moment");
    EXPECT_EQ(entry["not_measured"]["by_tenth_degree_m"], "no reach on both sides of the change");
    EXPECT_FALSE(entry["not_measured"].contains("grid_error_m"));
}

TEST(ReportSchema, ThePagePlotsTheCarBesideTheSpeed) {
    Report report = tests::sample_report(2);
    const auto page = [&] { return report_html(report, {}); };
    EXPECT_THAT(page(), testing::Not(HasSubstr("Pitch of the body")));
    report.played[0].car = {{0.0, -1.5, 30.25, std::nullopt, std::nullopt}, {0.1, -1.25, 31.0, std::nullopt, std::nullopt}};
    report.played[1].car = {{0.0, -1.5, 30.25, 1.125, std::nullopt}, {0.1, -1.25, 31.0, 1.25, std::nullopt}};
    const std::string shown = page();
    EXPECT_THAT(shown, testing::AllOf(HasSubstr("Pitch of the body against the road"), HasSubstr("Lift of the body over the rear axle"),
                                      HasSubstr("Levelling"), testing::Not(HasSubstr("Swivel"))));
}

TEST(ReportSchema, DescribesSeeingWhereADriveAsks) {
    Report report = tests::sample_report(2);
    EXPECT_FALSE(json::parse(report_json(report))["drives"][0].contains("seeing"));
    EXPECT_THAT(report_html(report, {}), testing::Not(HasSubstr("Seeing and glare")));
    report.played[0].seeing = {tests::sample_seeing()};
    const json written = json::parse(report_json(report));
    EXPECT_THAT(complaints_of(written), IsEmpty());
    const json& seen = written["drives"][0]["seeing"][0];
    EXPECT_EQ(seen["subject"], "glare_eye");
    EXPECT_EQ(seen["columns"][1], json::parse(R"({"name": "de_boer", "what": "de Boer's rating", "unit": ""})"));
    const std::string page = report_html(report, {});
    EXPECT_THAT(page, testing::AllOf(HasSubstr("Seeing and glare"), HasSubstr("Oncoming driver: facing illuminance"), HasSubstr("de Boer"),
                                     testing::Not(HasSubstr("angle of left"))));
}

TEST(ReportSchema, RefusesWhatIsNoReport) {
    const json good = json::parse(report_json(tests::sample_report(1)));
    const auto complaint = [&](const char* pointer, const json& value) {
        json bad = good;
        bad[json::json_pointer(pointer)] = value;
        const std::vector<std::string> complaints = complaints_of(bad);
        return complaints.empty() ? std::string("none") : complaints.front();
    };
    EXPECT_THAT(complaint("/schema_version", 1), HasSubstr("/schema_version: is not 2"));
    EXPECT_THAT(complaint("/drives/0/ticks_done", "61.2"), HasSubstr("/drives/0/ticks_done: is no"));
    EXPECT_THAT(complaint("/verdict", "maybe"), HasSubstr("/verdict: is none of"));
    EXPECT_THAT(complaint("/drives/0/summary/0/widths_m/0/at_m", true), HasSubstr("is no"));
    EXPECT_THAT(complaint("/surprise", 1), HasSubstr("unknown member 'surprise'"));
}

} // namespace
} // namespace fernlicht
