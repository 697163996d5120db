// report.json against runner/report/report.schema.json.
#include "runner/report/report_writers.h"
#include "scenarios/values/files.h"
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

tests::Schema report_schema() {
    FilesRead opened;
    return tests::Schema(json::parse(read_file(FERNLICHT_SOURCE_DIR "/runner/report/report.schema.json", opened)));
}

TEST(ReportSchema, DescribesReports) {
    Report report = tests::sample_report(3);
    EXPECT_THAT(report_schema().check(json::parse(report_json(report))), IsEmpty());
    report.played[0].extents[1] = {};
    report.played[1].extents.clear();
    report.complete = false;
    report.interrupted = "a reason";
    report.played[0].passes[0].seconds.clear();
    EXPECT_THAT(report_schema().check(json::parse(report_json(report))), IsEmpty());
    EXPECT_THAT(report_schema().check(json::parse(report_json({}))), IsEmpty());
}

TEST(ReportSchema, RefusesWhatIsNoReport) {
    const json good = json::parse(report_json(tests::sample_report(1)));
    const auto complaint = [&](const char* pointer, const json& value) {
        json bad = good;
        bad[json::json_pointer(pointer)] = value;
        const std::vector<std::string> complaints = report_schema().check(bad);
        return complaints.empty() ? std::string("none") : complaints.front();
    };
    EXPECT_THAT(complaint("/schema_version", 2), HasSubstr("/schema_version: is not 1"));
    EXPECT_THAT(complaint("/rows/0/value", "61.2"), HasSubstr("/rows/0/value: is no"));
    EXPECT_THAT(complaint("/verdict", "maybe"), HasSubstr("/verdict: is none of"));
    EXPECT_THAT(complaint("/drives/0/extents/twin/0/widths/0/left_m/0", true), HasSubstr("is no"));
    EXPECT_THAT(complaint("/surprise", 1), HasSubstr("unknown member 'surprise'"));
}

} // namespace
} // namespace fernlicht
