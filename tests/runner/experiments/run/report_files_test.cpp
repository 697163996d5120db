#include "runner/commands/run_files.h"
#include "runner/experiments/run/run_report.h"
#include "runner/files/clean_text.h"
#include "runner/findings/moment_columns.h"
#include "runner/write/report_texts.h"
#include "scenarios/values/errors.h"
#include "tests/runner/program.h"
#include "tests/runner/run_readings.h"
#include "tests/runner/sample_report.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <tuple>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

const char* const hostile = "=<script>alert(\"x\")</script>'&\n\x01\xff{{title}}";

Report hostile_report() {
    Report report = tests::sample_report(2);
    report.context.command = report.context.gl_renderer = hostile;
    report.context.inputs[0].path = hostile;
    PlayedCell& played = report.played[0];
    played.drive = played.lamp_set = hostile;
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
    EXPECT_EQ(whole["schema_version"], 2);
    EXPECT_EQ(whole["verdict"], "fail");
    EXPECT_EQ(whole["complete"], true);
    EXPECT_EQ(whole["context"]["inputs"][1]["xxh128"], "fedcba9876543210fedcba9876543210");
    EXPECT_EQ(whole["times"][0]["passes"][0]["samples_s"].size(), 3U);
    EXPECT_EQ(whole["times"][0]["passes"][0]["pass"], "frame");
}

TEST(ReportJson, RefusesNumbersThatAreNone) {
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        Report report = tests::sample_report(1);
        EXPECT_THROW(Value{bad}, std::invalid_argument);
        report.played[1].extents[0].rendered[0].area_m2 = bad;
        EXPECT_THROW(moments_csv(report.played[1]), std::logic_error);
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
        whole->erase("times");
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

/// As accepting, comparing and resuming read a run.
TEST(ReportJson, ComesBackAsItWasWritten) {
    const TemporaryFolder folder;
    Report report = tests::sample_report(3);
    PlayedCell& played = report.played[0];
    played.technique = "photometric";
    played.input_hashes = {{"drive", "one hash"}, {"road", "another"}};
    played.readings[0].value = Value::at_least(0.1 + 0.2);
    played.readings[1].where = "=1+1, \"quoted\"";
    played.repeats = {3, {"readings"}, {{played.readings[1].key, 0, 3, 33.0, 4.0}}};
    played.seeing = {tests::sample_seeing()};
    played.throughput = {3, 0.5, 0.01, {}, 200.0};
    played.savings.not_measured = "too few moments were played";
    played.error.ticks = {0, 2};
    played.error.rays = 7;
    played.error.road_p95 = {0.2, 0.3};
    PixelErrors& road = played.error.road.emplace();
    road.pixels = 4;
    road.error = {0.1, 0.2, 0.3};
    road.worst.picture = 1;
    played.error.no_target = "no target";
    report.warnings = {"a warning"};
    write_report(report, folder.path());
    const Report read = read_report(folder.path());
    EXPECT_EQ(report_csv(read), report_csv(report));
    for (PlayedCell& one : report.played)
        one.extent_summaries.clear(); // moments are not read back, so that they add up to nothing
    EXPECT_EQ(json::parse(report_json(read)), json::parse(report_json(report)));
}

TEST(ReportJson, RefusesFilesThatLostTheirEndAndFramesThatAreNone) {
    const TemporaryFolder folder;
    Report report = tests::sample_report(3);
    report.played[0].technique = "photometric";
    write_report(report, folder.path());
    const auto refused = [&](const std::string& file, const auto& change, const char* sentence) {
        const std::string good = content_of(folder / file);
        std::string bad = good;
        change(bad);
        std::ofstream(folder / file, std::ios::binary) << bad;
        EXPECT_THAT([&] { read_moments(folder.path(), read_report(folder.path()), 1); },
                    testing::ThrowsMessage<InputError>(testing::AllOf(HasSubstr(file), HasSubstr(sentence))));
        std::ofstream(folder / file, std::ios::binary) << good;
    };
    const auto lose_a_line = [](std::string& text) { text.erase(text.rfind("\r\n", text.size() - 3) + 2); };
    refused("moments-country_road-xenon.csv", lose_a_line, "found 2 moments, expected 3, as report.json says");
    const std::size_t readings = report.played[1].readings.size();
    refused("readings.csv", lose_a_line,
            fmt::format("found {} readings of country road with xenon, expected {}, as report.json says", readings - 1, readings).c_str());
    for (const std::string frame : {"1.5", "-1", "1e3", "2147483648", "nan"})
        refused(
            "readings.csv", [&](std::string& text) { text.insert(text.find(",photometric,") + 13, frame); },
            "expected a whole number of at least 0");
    EXPECT_EQ(read_moments(folder.path(), read_report(folder.path()), 1).rows.size(), 3U);
}

TEST(MomentsCsv, EachCellHasAFileOfItsOwn) {
    std::vector<PlayedCell> played(6);
    const std::string wide(90, 'x');
    const std::pair<std::string, std::string> cells[] = {{"a-b", "c"},   {"a", "b-c"}, {"a", "b c"},
                                                         {"a", "b-c-2"}, {wide, "c"},  {wide, "d"}};
    for (std::size_t i = 0; i < played.size(); ++i)
        std::tie(played[i].drive, played[i].lamp_set) = cells[i];
    const std::string cut = "moments-" + wide.substr(0, 80);
    EXPECT_THAT(moments_files(played), ElementsAre("moments-a-b-c.csv", "moments-a-b-c-2.csv", "moments-a-b_c.csv", "moments-a-b-c-2-2.csv",
                                                   cut + ".csv", cut + "-2.csv"));
}

TEST(MomentsCsv, HasAColumnForEachFigure) {
    Report report = tests::sample_report(3);
    PlayedCell& played = report.played[0];
    played.extents[1].rendered.clear(); // the lane ends
    played.extents[2].grid_errors[0].reach = Value();
    played.car = {{0.0, -1.5, 30.25, 1.125, {}}, {0.1, -1.25, 31.0, 1.25, {}}, {0.2, -1.0, 31.5, 1.5, {}}};
    played.seeing = {tests::sample_seeing()};
    const TemporaryFolder folder;
    std::ofstream(folder / "moments.csv") << moments_csv(played);
    const auto cells = [&](const char* column) { return tests::moments_of(folder / "moments.csv", column); };
    EXPECT_THAT(cells("frame"), ElementsAre("0", "1", "2"));
    EXPECT_EQ(cells("reach_1lx_road_own_m")[1], "");
    EXPECT_NEAR(std::stod(cells("reach_1lx_road_own_m")[2]), played.extents[2].rendered[0].reach_centre_m, 5.1e-5);
    EXPECT_THAT(cells("reach_1lx_road_own_m.cut_off"), ElementsAre("0", "", "0"));
    EXPECT_NE(cells("reach_1lx_road_own_m.twin")[1], "") << "goes on";
    EXPECT_NE(cells("width_5lx_target_own_at_20m_m.left")[0], "");
    EXPECT_THAT(cells("reach_1lx_road_own_grid_error_m"), ElementsAre("0.25", "0.25", ""));
    EXPECT_THAT(cells("car.pitch_deg"), ElementsAre("-1.5", "-1.25", "-1"));
    EXPECT_THAT(cells("car.levelling_deg"), ElementsAre("1.125", "1.25", "1.5"));
    EXPECT_THAT(moments_csv(played), Not(HasSubstr("swivel")));
    EXPECT_THAT(cells("glare_eye.at_m"), ElementsAre("30", "20", ""));
    EXPECT_THAT(cells("glare_eye.de_boer"), ElementsAre("no light", "> 4", ""));
}

TEST(ReportCsv, HostileNamesStayText) { EXPECT_THAT(report_csv(hostile_report()), HasSubstr("\"'=<script>alert(\"\"x\"\")</script>'&")); }

TEST(ReportCsv, MatchesByHand) {
    Report report;
    report.played.emplace_back();
    report.played[0].drive = "S bend, 150 m";
    report.played[0].lamp_set = "xenon";
    report.played[0].technique = "photometric";
    report.played[0].readings = {
        {key_of("reach_5lx_road_left_1_p05_m").value(), 61.25, "own lane, \"centre\"", 7, {.aim_up = 4.5, .loaded = -2.0}, 0.5},
        {key_of("probe_-wall_lx").value(), -0.5, "=1+1"},
        {key_of("glare_mirrors_at_15m_time_below_5_de_boer_s").value(), Value::not_measured("no clock")},
        {key_of("area_1lx_target_all_grid_error_m2").value(), Value::at_least(200.0)}};
    EXPECT_EQ(
        report_csv(report),
        "drive,lamp_set,technique,frame,quantity,aspect,threshold,threshold_unit,surface,lane,place,distance_m,to_m,statistic,subject,"
        "bound,value,"
        "unit,reason,where,name,aim_up,aim_down,brighter,dimmer,higher,lower,loaded,between_moments\r\n"
        "\"S bend, 150 m\",xenon,photometric,7,reach,value,5,lx,road,left 1,,,,p05,,,61.25,m,,\"own lane, \"\"centre\"\"\","
        "reach_5lx_road_left_1_p05_m,4.5,,,,,,-2,0.5\r\n"
        "\"S bend, 150 m\",xenon,photometric,,probe_illuminance,value,,,,,,,,median,'-wall,,-0.5,lx,,'=1+1,probe_-wall_lx,,,,,,,,\r\n"
        "\"S bend, 150 m\",xenon,photometric,,glare_time,value,5,de_boer,,,mirrors,15,,,,,,s,no clock,,"
        "glare_mirrors_at_15m_time_below_5_de_boer_s,,,,,,,,\r\n"
        "\"S bend, 150 m\",xenon,photometric,,area,grid_error,1,lx,target,all,,,,median,,at_least,200,m2,,,"
        "area_1lx_target_all_grid_error_m2,,,,,,,,\r\n");
}

TEST(ReportJunit, CountsAndEscapes) {
    const std::string xml = report_junit(hostile_report());
    EXPECT_THAT(xml, HasSubstr("<testsuites name=\"fernlicht\" tests=\"4\" failures=\"1\" errors=\"0\">"));
    EXPECT_THAT(xml, HasSubstr("&lt;script&gt;"));
    EXPECT_THAT(xml, Not(HasSubstr("<script")));
    for (const char c : xml)
        EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 || c == '\n') << "a control character that XML forbids";
}

TEST(ReportJunit, ClassNamesHaveNoDot) {
    Report report = tests::sample_report(1);
    report.played[0].lamp_set = "13.2 V";
    const std::string xml = report_junit(report);
    EXPECT_THAT(xml, HasSubstr("13_2 V,"));
    EXPECT_THAT(xml, Not(testing::ContainsRegex("classname=\"[^\"]*[.]")));
}

TEST(ReportHtml, HostileNamesStayText) {
    const std::string html = report_html(hostile_report(), "no such folder");
    EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert"));
    EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
    EXPECT_THAT(html, HasSubstr("{{title}}")) << "a text that looks like a tag of the template must not be taken for one";
    EXPECT_THAT(html, Not(HasSubstr("\xff")));
}

TEST(ReportHtml, AReadingOfTwoLampsIsOneRowWhereverEachFoundIt) {
    Report report = tests::sample_report(2);
    report.played[0].readings[0].where = "adapted to 0.4 cd/m2";
    report.played[1].readings[0].where = "adapted to 0.7 cd/m2";
    const std::string page = report_html(report, "no such folder");
    EXPECT_THAT(page, HasSubstr("halogen: adapted to 0.4 cd/m2; xenon: adapted to 0.7 cd/m2"));
    EXPECT_THAT(page, Not(HasSubstr("not asked for")));
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
    write_report(tests::sample_report(1), folder, &output_formats().front());
    for (const char* const name : {"report.json", "junit.xml", "readings.csv", "report.html", "tables/country_road-readings.csv"})
        EXPECT_TRUE(std::filesystem::is_regular_file(folder / name)) << name;
    std::filesystem::remove_all(folder);
}

} // namespace
} // namespace fernlicht
