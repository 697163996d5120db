#include "runner/experiments/run/report_writers.h"
#include "runner/files/clean_text.h"
#include "runner/write/report_texts.h"
#include "scenarios/values/errors.h"
#include "tests/runner/sample_report.h"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

const char* const hostile = "=<script>alert(\"x\")</script>'&\n\x01\xff{{title}}";

Report hostile_report() {
    Report report = tests::sample_report(2);
    report.context.command = report.context.gl_renderer = hostile;
    report.context.inputs[0].path = hostile;
    PlayedVariant& played = report.played[0];
    played.drive = played.variant = hostile;
    played.lamps[0] = {hostile, hostile};
    played.readings[0].where = hostile;
    played.readings[2].value = Value::not_measured(hostile);
    played.verdicts[1].name = played.verdicts[1].text = played.verdicts[1].rerun = hostile;
    played.left_out = played.notes = {hostile};
    played.frames[0].view = hostile;
    played.frames[0].png = std::string("frames/") + hostile;
    for (ExtentRow& row : played.extents)
        row.rendered[0].lane = hostile;
    return report;
}

TEST(Overall, WorstVerdictCounts) {
    Report report;
    EXPECT_EQ(overall(report), VerdictKind::pass);
    report.played.emplace_back();
    report.played[0].verdicts = {{VerdictKind::pass, "a", "", ""}, {VerdictKind::not_measured, "b", "", ""}};
    EXPECT_EQ(overall(report), VerdictKind::not_measured);
    report.played.emplace_back();
    report.played[1].verdicts = {{VerdictKind::fail, "c", "", ""}};
    EXPECT_EQ(overall(report), VerdictKind::fail);
    report.played.clear();
    report.complete = false;
    EXPECT_EQ(overall(report), VerdictKind::not_measured) << "a run that did not end has not measured all that was asked for";
}

TEST(ReportJson, HoldsWhatWasMeasured) {
    const Report report = tests::sample_report(3);
    const json whole = json::parse(report_json(report));
    EXPECT_EQ(whole["schema_version"], 1);
    EXPECT_EQ(whole["verdict"], "fail");
    EXPECT_EQ(whole["complete"], true);
    EXPECT_EQ(whole["context"]["inputs"][1]["xxh128"], "fedcba9876543210fedcba9876543210");
    const json& drive = whole["drives"][0];
    EXPECT_EQ(drive["extents"]["time_s"].size(), 3U);
    for (const json& series : drive["extents"]["rendered"])
        for (const char* const column : {"reach_centre_m", "area_m2", "reach_is_cut_off"})
            EXPECT_EQ(series[column].size(), 3U) << series["lane"] << column;
    EXPECT_NEAR(drive["extents"]["rendered"][0]["reach_centre_m"][0], report.played[0].extents[0].rendered[0].reach_centre_m, 5.1e-5);
    EXPECT_EQ(whole["timing"][0]["samples_s"].size(), 3U);
    EXPECT_EQ(whole["timing"][0]["pass"], "frame");
}

TEST(ReportJson, NotMeasuredIsNullWithItsReason) {
    const json whole = json::parse(report_json(tests::sample_report(1)));
    const json& row = whole["rows"][2];
    EXPECT_EQ(row["name"], "glare_own_time_above_1lx_s");
    EXPECT_TRUE(row["value"].is_null());
    EXPECT_EQ(row["not_measured"], "nobody came towards the car");
    EXPECT_TRUE(row["frame"].is_null());
    EXPECT_FALSE(whole["rows"][1].contains("not_measured"));
    EXPECT_EQ(whole["rows"][1]["frame"], 0);
}

TEST(ReportJson, ValuesRoundTripExactly) {
    Report report = tests::sample_report(1);
    report.played[0].readings[1].value = 0.1 + 0.2;
    EXPECT_EQ(json::parse(report_json(report))["rows"][1]["value"].get<double>(), 0.1 + 0.2);
}

TEST(ReportJson, RefusesNumbersThatAreNone) {
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        Report report = tests::sample_report(1);
        EXPECT_THROW(Value{bad}, std::invalid_argument);
        report.played[1].extents[0].rendered[0].area_m2 = bad;
        EXPECT_THROW(report_json(report), std::logic_error);
        report = tests::sample_report(1);
        report.played[1].passes[0].seconds[0] = bad;
        EXPECT_THROW(report_json(report), std::logic_error);
    }
}

TEST(ReportJson, OnlyContextAndTimingVary) {
    Report one = tests::sample_report(2), two = one;
    two.context.started_utc = "2031-01-01T00:00:00Z";
    two.context.cpu = "another";
    for (PassTime& pass : two.played[0].passes)
        for (double& seconds : pass.seconds)
            seconds *= 1.7;
    json a = json::parse(report_json(one)), b = json::parse(report_json(two));
    EXPECT_NE(a, b);
    for (json* const whole : {&a, &b}) {
        whole->erase("context");
        whole->erase("timing");
        whole->erase("throughput");
        whole->erase("accuracy_times");
        whole->erase("savings");
    }
    EXPECT_EQ(a, b);
    EXPECT_EQ(report_junit(one), report_junit(two));
    EXPECT_EQ(report_csv(one), report_csv(two));
}

TEST(ReportJson, SaysWhyItIsIncomplete) {
    Report report = tests::sample_report(1);
    report.complete = false;
    report.interrupted = "interrupted by the user";
    const json whole = json::parse(report_json(report));
    EXPECT_EQ(whole["complete"], false);
    EXPECT_EQ(whole["interrupted"], "interrupted by the user");
    EXPECT_THAT(report_junit(report), HasSubstr("<error message=\"interrupted: interrupted by the user\""));
}

TEST(ReportJson, LanesThatEndLeaveNulls) {
    Report report = tests::sample_report(3);
    report.played[0].extents[1].rendered.clear();
    const json series = json::parse(report_json(report))["drives"][0]["extents"]["rendered"][0];
    EXPECT_TRUE(series["reach_centre_m"][1].is_null());
    EXPECT_TRUE(series["widths"][0]["width_m"][1].is_null());
    EXPECT_EQ(series["widths"][0]["width_m"].size(), 3U);
    EXPECT_FALSE(series["reach_centre_m"][2].is_null());
}

TEST(ReportJson, HostileNamesStayText) {
    const json whole = json::parse(report_json(hostile_report()));
    EXPECT_EQ(whole["rows"][0]["where"], "=<script>alert(\"x\")</script>'&\n\x01\ufffd{{title}}");
}

TEST(ReportCsv, MatchesByHand) {
    Report report;
    report.played.emplace_back();
    report.played[0].drive = "S bend, 150 m";
    report.played[0].variant = "xenon";
    report.played[0].technique = "photometric";
    report.played[0].readings = {{key_of("reach_5lx_road_left_1_p05_m").value(), 61.25, "own lane, \"centre\"", 7},
                                 {key_of("probe_-wall_lx").value(), -0.5, "=1+1"},
                                 {key_of("glare_mirrors_at_15m_time_below_5_de_boer_s").value(), Value::not_measured("no clock")},
                                 {key_of("area_1lx_target_all_grid_error_m2").value(), Value::at_least(200.0)}};
    EXPECT_EQ(report_csv(report),
              "drive,lamp_set,technique,frame,quantity,aspect,threshold,threshold_unit,surface,lane,place,distance_m,statistic,subject,"
              "bound,value,"
              "unit,reason,where,name\r\n"
              "\"S bend, 150 m\",xenon,photometric,7,reach,value,5,lx,road,left 1,,,p05,,,61.25,m,,\"own lane, \"\"centre\"\"\","
              "reach_5lx_road_left_1_p05_m\r\n"
              "\"S bend, 150 m\",xenon,photometric,,probe_illuminance,value,,,,,,,median,'-wall,,-0.5,lx,,'=1+1,probe_-wall_lx\r\n"
              "\"S bend, 150 m\",xenon,photometric,,glare_time,value,5,de_boer,,,mirrors,15,,,,,s,no clock,,"
              "glare_mirrors_at_15m_time_below_5_de_boer_s\r\n"
              "\"S bend, 150 m\",xenon,photometric,,area,grid_error,1,lx,target,all,,,median,,at_least,200,m2,,,"
              "area_1lx_target_all_grid_error_m2\r\n");
}

TEST(ReportJunit, CountsAndEscapes) {
    const std::string xml = report_junit(hostile_report());
    EXPECT_THAT(xml, HasSubstr("<testsuites name=\"fernlicht\" tests=\"4\" failures=\"1\" errors=\"0\">"));
    EXPECT_THAT(xml, HasSubstr("&lt;script&gt;"));
    EXPECT_THAT(xml, Not(HasSubstr("<script")));
    for (const char c : xml)
        EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 || c == '\n') << "a control character that XML forbids";
}

TEST(ReportHtml, HostileNamesStayText) {
    const std::string html = report_html(hostile_report(), "no such folder");
    EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert"));
    EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
    EXPECT_THAT(html, HasSubstr("{{title}}")) << "a text that looks like a tag of the template must not be taken for one";
    EXPECT_THAT(html, Not(HasSubstr("\xff")));
}

TEST(ReportHtml, NeedsNothingFromOutside) {
    const std::string html = report_html(tests::sample_report(3), "no such folder");
    EXPECT_THAT(html, HasSubstr("default-src 'none'"));
    for (const char* const outside : {"src=\"http", "href=\"http", "url(http", "@import", "<link", "src=\"//", "<iframe"})
        EXPECT_THAT(html, Not(HasSubstr(outside)));
}

TEST(ReportHtml, VerdictComesFirst) {
    const std::string html = report_html(tests::sample_report(3), "no such folder");
    const std::size_t verdict = html.find("Limits exceeded"), reach = html.find("Reach and width");
    ASSERT_NE(verdict, std::string::npos);
    ASSERT_NE(reach, std::string::npos);
    EXPECT_LT(verdict, reach);
    EXPECT_LT(html.find("13.5 m, limit at least 15 m"), reach) << "with the figures of what failed";
}

TEST(WriteReport, WritesAllFourOrSaysWhyNot) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "fernlicht-write-report";
    std::filesystem::remove_all(folder);
    EXPECT_THROW(write_report(tests::sample_report(1), folder), DeviceError);
    std::filesystem::create_directories(folder);
    write_report(tests::sample_report(1), folder, TableFormat::tex);
    for (const char* const name : {"report.json", "junit.xml", "readings.csv", "report.html", "tables/country_road-readings.tex"})
        EXPECT_TRUE(std::filesystem::is_regular_file(folder / name)) << name;
    std::filesystem::remove_all(folder);
}

} // namespace
} // namespace fernlicht
