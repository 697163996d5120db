// What counts as a change, by hand-made cells.
#include "runner/experiments/study/study_document.h"
#include "runner/write/document.h"
#include "runner/write/report_texts.h"
#include "scenarios/values/errors.h"
#include "tests/runner/schema_check.h"

#include <cmath>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A reading that aim does not move unless said otherwise.
void put(CellResult& cell, const std::string& name, std::optional<double> value, const std::string& why = "",
         const Sensitivity& sensitivity = {.aim_up = 0.0, .aim_down = 0.0}) {
    const ReadingKey key = key_of(name).value();
    cell.readings[key] = {key, Value::of(value, why)};
    cell.readings[key].sensitivity = sensitivity;
}

/// Two lamps on one drive. Of reach each side leaves 0.3 + 0.1 m open, so 0.57 m together; 0.1 degrees move it by 4 m.
StudyResult two_cells(double old_reach_m, double new_reach_m) {
    StudyResult result;
    result.study.name = result.study.title = "by hand";
    result.study.lamps.resize(2);
    result.study.lamps[0].name = "old";
    result.study.lamps[1].name = "new";
    result.study.drives = {"one.yaml"};
    result.study.conditions.times_of_day = {{}};
    result.study.comparisons = {{"new", "old"}};
    result.study.decide = {"reach_5lx_target_own_m"};
    for (std::size_t lamp = 0; lamp < 2; ++lamp) {
        CellResult cell;
        cell.cell.lamp = lamp;
        cell.cell.name = lamp == 0 ? "one_old" : "one_new";
        cell.drive = "one-1";
        put(cell, "reach_5lx_target_own_m", lamp == 0 ? old_reach_m : new_reach_m, "",
            {.aim_up = lamp == 0 ? 1.0 : 3.0, .aim_down = lamp == 0 ? -4.0 : -3.0, .brighter = 2.0, .dimmer = -1.0});
        put(cell, "reach_5lx_target_own_grid_error_m", 0.3);
        put(cell, "reach_5lx_target_own_twin_difference_m", 0.1);
        result.cells.push_back(cell);
    }
    return result;
}

std::string study_json_of(const StudyResult& result) { return json_text(as_json(result, study_members)); }

std::string study_csv_of(const StudyResult& result) {
    std::string csv;
    study_csv(result, [&](std::string_view piece) { csv += piece; });
    return csv;
}

const Change& change_in(const StudyResult& result, const std::string& name) {
    for (const Change& change : result.changes)
        if (name_of(change.reading) == name)
            return change;
    throw std::runtime_error("no change of " + name);
}

/// Sliders over two pictures, and sentences that refuse one.
std::pair<int, int> laid_over_and_refused(const StudyResult& result) {
    std::pair<int, int> counts;
    for (const Section& section : document(result).sections)
        for (const DocumentPart& block : section.blocks) {
            const auto* const text = std::get_if<std::string>(&block);
            counts.first += std::holds_alternative<PictureOverlay>(block) ? 1 : 0;
            counts.second += text && text->find("no common exposure, white and tone: `b` and `a`") != std::string::npos ? 1 : 0;
        }
    return counts;
}

TEST(StudyPictures, AreLaidOverEachOtherOnlyWhereTheyAreShownAlike) {
    StudyResult result = two_cells(40.0, 50.0);
    for (CellResult& cell : result.cells)
        cell.frames = {{.view = "driver", .png = cell.cell.name + ".png", .exr = "", .shown_by = "a"}};
    EXPECT_EQ(laid_over_and_refused(result), std::pair(1, 0));
    result.cells[1].frames[0].shown_by = "b";
    EXPECT_EQ(laid_over_and_refused(result), std::pair(0, 1));
}

ChangeKind kind_for(double old_m, double new_m) {
    StudyResult result = two_cells(old_m, new_m);
    compare_cells(result);
    EXPECT_EQ(result.changes.size(), 1U) << "rows on trust are no readings";
    EXPECT_NEAR(result.changes.front().uncertainty.value_or(0.0), 0.4 * std::sqrt(2.0), 1e-12);
    return result.changes.front().kind;
}

TEST(StudyCompare, AChangeIsRealBeyondCalculationAndAim) {
    EXPECT_EQ(kind_for(40.0, 40.0), ChangeKind::none);
    EXPECT_EQ(kind_for(40.0, 40.56), ChangeKind::none);
    EXPECT_EQ(kind_for(40.0, 40.58), ChangeKind::within_aim);
    EXPECT_EQ(kind_for(40.0, 36.0), ChangeKind::within_aim);
    EXPECT_EQ(kind_for(40.0, 44.5), ChangeKind::within_aim); // 4.5 < 4 + 0.57
    EXPECT_EQ(kind_for(40.0, 44.6), ChangeKind::real);
    EXPECT_EQ(kind_for(40.0, 35.4), ChangeKind::real);
}

/// Glare of 0.0312 and 0.0298 lx is two values, also where reach has two decimals; what is uncertain has no more.
TEST(StudyCompare, DigitsTellOldAndNewApart) {
    StudyResult result = two_cells(40.0, 40.00002);
    result.study.decide = {"reach_5lx_target_own_m", "glare_opposite_facing_max_lx"};
    for (CellResult& cell : result.cells)
        put(cell, "glare_opposite_facing_max_lx", cell.cell.lamp == 0 ? 0.0312 : 0.0298);
    compare_cells(result);
    const std::string paper = document_markdown(study_paper(result));
    EXPECT_THAT(paper, HasSubstr(" 0.0312 | 0.0298 | -0.0014 |"));
    EXPECT_THAT(paper, HasSubstr(" 40.00 | 40.00 | +0.00 |"));
    EXPECT_THAT(document_html(document(result), result), AllOf(HasSubstr(">0.0312<"), HasSubstr(">0.0298<"), HasSubstr(">−0.0014<")));
}

TEST(StudyCompare, AnUncertaintyTooSmallToTellIsAtMostSoMuch) {
    StudyResult result = two_cells(40.0, 50.0);
    for (CellResult& cell : result.cells)
        for (const char* error : {"reach_5lx_target_own_grid_error_m", "reach_5lx_target_own_twin_difference_m"})
            put(cell, error, 1e-6);
    compare_cells(result);
    EXPECT_THAT(document_text(study_summary(result)), HasSubstr("+10.00 m (+25.0 %) ±0.01 at most; new against old"));
    EXPECT_THAT(document_html(document(result), result), AllOf(HasSubstr("; ±0.01 m numerical at most, ±"), Not(HasSubstr("±&lt;"))));
}

TEST(StudyCompare, WhatWasLeftOutStandsBesideTheVerdict) {
    StudyResult result = two_cells(40.0, 41.0);
    result.cells.pop_back();
    result.study.techniques = {"photometric"};
    result.only = "*old";
    compare_cells(result);
    const std::string said = "Only 1 of 2 cells was asked for (--only *old)";
    for (const std::string& text : {document_text(study_summary(result)), document_html(document(result), result), study_json_of(result),
                                    report_junit(suites_of(result))})
        EXPECT_THAT(text, HasSubstr(said));
}

TEST(StudyCompare, RanksByShareEachReadingOnce) {
    StudyResult result = two_cells(40.0, 50.0); // 20 % of the larger
    result.study.decide = {"reach_5lx_target_own_m", "reach_1lx_road_own_m", "width_1lx_road_all_at_20m_m"};
    for (CellResult& cell : result.cells) {
        put(cell, "reach_1lx_road_own_m", cell.cell.lamp == 0 ? 20.0 : 10.0); // 50 %
        put(cell, "reach_1lx_road_own_grid_error_m", 0.1);
        put(cell, "reach_1lx_road_own_twin_difference_m", 0.0);
        put(cell, "width_1lx_road_all_at_20m_m", cell.cell.lamp == 0 ? 5.0 : 5.3); // 0.3 < 0.35: a column of the grid at each edge
        put(cell, "area_1lx_road_all_m2", cell.cell.lamp == 0 ? 10.0 : 90.0);      // decides nothing
        put(cell, "area_1lx_road_all_grid_error_m2", 1.0);
    }
    compare_cells(result);
    ASSERT_EQ(result.largest.size(), 2U);
    EXPECT_EQ(name_of(result.changes[result.largest[0]].reading), "reach_1lx_road_own_m");
    EXPECT_EQ(name_of(result.changes[result.largest[1]].reading), "reach_5lx_target_own_m");
    EXPECT_EQ(change_in(result, "width_1lx_road_all_at_20m_m").kind, ChangeKind::none);
    EXPECT_EQ(change_in(result, "area_1lx_road_all_m2").kind, ChangeKind::real);
    EXPECT_DOUBLE_EQ(change_in(result, "reach_1lx_road_own_m").size(), 0.5);
}

TEST(StudyCompare, WhatNobodyVouchesForIsNotKnown) {
    StudyResult result = two_cells(40.0, 50.0);
    put(result.cells[0], "control_others_max_lx", 0.2);
    put(result.cells[1], "control_others_max_lx", 0.4);
    put(result.cells[0], "control_high_beam_share", 3.0);
    put(result.cells[1], "control_high_beam_share", 3.0);
    put(result.cells[0], "control_left_bends_inside_at_50m_lx", 0.2);
    put(result.cells[1], "control_left_bends_inside_at_50m_lx", 0.4);
    put(result.cells[0], "control_left_bends_inside_at_50m_standard_error_lx", 0.03);
    put(result.cells[1], "control_left_bends_inside_at_50m_standard_error_lx", 0.04);
    for (CellResult& cell : result.cells) { // calculated from the tables in double precision; lengths hang on the moments
        put(cell, "glare_a_facing_max_lx", cell.cell.lamp == 0 ? 0.2 : 0.2001);
        put(cell, "glare_a_length_above_1lx_m", cell.cell.lamp == 0 ? 20.0 : 30.0);
    }
    put(result.cells[0], "reach_10lx_road_own_m", 3.0);
    put(result.cells[1], "reach_10lx_road_own_m", std::nullopt, "never lit");
    compare_cells(result);
    EXPECT_EQ(change_in(result, "control_others_max_lx").kind, ChangeKind::unknown);
    EXPECT_THAT(change_in(result, "control_others_max_lx").reason_unknown, HasSubstr("nothing tells"));
    EXPECT_EQ(change_in(result, "control_high_beam_share").kind, ChangeKind::none) << "however exact, there is nothing to explain";
    EXPECT_EQ(change_in(result, "control_left_bends_inside_at_50m_lx").kind, ChangeKind::real);
    EXPECT_DOUBLE_EQ(*change_in(result, "control_left_bends_inside_at_50m_lx").uncertainty, 0.05);
    EXPECT_EQ(change_in(result, "glare_a_facing_max_lx").kind, ChangeKind::real);
    EXPECT_EQ(change_in(result, "glare_a_length_above_1lx_m").kind, ChangeKind::unknown);
    EXPECT_EQ(change_in(result, "reach_10lx_road_own_m").reason_unknown, "never lit");
}

/// Each kind of reading by what its calculation leaves open, both sides together: a row on trust, the distance of moments or of places, or
/// the width of a double.
TEST(StudyCompare, EachKindOfReadingHasItsOwnUncertainty) {
    StudyResult result = two_cells(40.0, 40.0);
    for (CellResult& cell : result.cells) {
        const double more = cell.cell.lamp == 1 ? 1.0 : 0.0;
        cell.step_s = 0.1;
        cell.step_m = 2.0;
        cell.look_step_m = 1.0;
        put(cell, "reach_1lx_road_left_1_m", 20.0 + more);
        put(cell, "reach_1lx_road_left_1_grid_error_m", 0.2);
        put(cell, "reach_1lx_road_left_1_twin_difference_m", 0.1);
        put(cell, "reach_1lx_road_left_1_left_edge_m", 20.0 + more);
        put(cell, "reach_1lx_road_left_1_edge_grid_error_m", 0.9);
        put(cell, "unlit_before_reach_1lx_road_left_1_m", 5.0 + more);
        put(cell, "unlit_before_reach_1lx_road_left_1_grid_error_m", 0.4);
        put(cell, "area_1lx_road_right_12_min_m2", 9.0 + more);
        put(cell, "area_1lx_road_right_12_grid_error_m2", 0.3);
        put(cell, "glare_a_length_above_1lx_m", 20.0 + more);
        put(cell, "glare_a_time_above_1lx_s", 2.0 + more);
        put(cell, "sensor_a_reach_5lx_m", 20.0 + more);
        put(cell, "detection_card_own_m", 30.0 + more);
        put(cell, "patch_dark_own_m", 3.0 + more);
        put(cell, "board_left_at_50m_cdm2", 3.0 + more);
        put(cell, "foreground_ratio_own", 3.0 + more);
    }
    compare_cells(result);
    const double both = std::sqrt(2.0);
    for (const auto& [name, open] :
         {std::pair("reach_1lx_road_left_1_m", 0.3), std::pair("reach_1lx_road_left_1_left_edge_m", 1.0),
          std::pair("unlit_before_reach_1lx_road_left_1_m", 0.5), std::pair("area_1lx_road_right_12_min_m2", 0.3),
          std::pair("glare_a_length_above_1lx_m", 2.0), std::pair("glare_a_time_above_1lx_s", 0.1), std::pair("sensor_a_reach_5lx_m", 2.0),
          std::pair("detection_card_own_m", 1.0), std::pair("patch_dark_own_m", 1.0)}) {
        EXPECT_NEAR(change_in(result, name).uncertainty.value(), both * open, 1e-12) << name;
        EXPECT_EQ(change_in(result, name).kind, 1.0 > both * open ? ChangeKind::real : ChangeKind::none) << name;
    }
    for (const char* name : {"board_left_at_50m_cdm2", "foreground_ratio_own"})
        EXPECT_NEAR(change_in(result, name).uncertainty.value(), 5e-6, 1e-12) << name; // a millionth of 3 and of 4
}

/// Noise of 1 % in the difference of two intensities, three deviations of it: 3 % more or less light.
TEST(StudyCompare, WhatNoiseOfTheTablesWouldDoIsNoDifference) {
    StudyResult result = two_cells(40.0, 40.0);
    result.lamps.resize(1);
    result.lamps[0].tested = "new";
    result.lamps[0].against = "old";
    result.lamps[0].difference.noise_relative = 0.01;
    for (CellResult& cell : result.cells) {
        const bool tested = cell.cell.lamp == 1;
        const Sensitivity by_light{.aim_up = 0.0, .brighter = 3.0, .dimmer = -4.0}; // 40 for 100 %: 1.2
        put(cell, "area_1lx_road_all_m2", 100.0 + (tested ? 1.1 : 0.0), "", by_light);
        put(cell, "area_1lx_road_all_grid_error_m2", 0.0);
        put(cell, "area_3lx_road_all_m2", 60.0 + (tested ? 1.6 : 0.0), "", by_light);
        put(cell, "area_3lx_road_all_grid_error_m2", 0.0);
        put(cell, "area_10lx_road_all_m2", 20.0 + (tested ? 1.6 : 0.0));
        put(cell, "area_10lx_road_all_grid_error_m2", 0.0);
        put(cell, "glare_a_facing_max_lx", tested ? 2.05 : 2.0);
        put(cell, "glare_a_time_above_1lx_s", 1.0);
        put(cell, "glare_a_time_above_3lx_s", 0.5, "", {.aim_up = 0.0, .brighter = 0.1});
        put(cell, "glare_a_time_above_5percent_s", 9.0); // another ladder
        put(cell, "glare_a_time_below_4_de_boer_s", 0.0);
        put(cell, "glare_a_de_boer_min", tested ? 5.03 : 5.0); // 3 % move W by 2 lg 1.03 = 0.0257, with 1.03 - 1 for ln: 0.0261
        put(cell, "control_swivel_max_standard_error_deg", 0.0);
        put(cell, "control_swivel_max_deg", tested ? 2.0 : 1.0);
    }
    compare_cells(result);
    EXPECT_NEAR(change_in(result, "reach_5lx_target_own_m").noise_effect.value(), 0.6, 1e-12);
    EXPECT_NEAR(change_in(result, "area_1lx_road_all_m2").noise_effect.value(), 1.2, 1e-12);
    EXPECT_EQ(change_in(result, "area_1lx_road_all_m2").kind, ChangeKind::none); // 1.1 < 1.2
    EXPECT_EQ(change_in(result, "area_3lx_road_all_m2").kind, ChangeKind::real); // 1.6 > 1.2
    EXPECT_EQ(change_in(result, "area_10lx_road_all_m2").kind, ChangeKind::unknown);
    EXPECT_NEAR(change_in(result, "glare_a_time_above_3lx_s").noise_effect.value(), 0.03, 1e-12);
    EXPECT_EQ(change_in(result, "glare_a_facing_max_lx").kind, ChangeKind::none); // 0.05 < 3 % of 2.05
    EXPECT_NEAR(change_in(result, "glare_a_de_boer_min").noise_effect.value(), 0.02606, 1e-5);
    EXPECT_EQ(change_in(result, "glare_a_de_boer_min").kind, ChangeKind::real);
    EXPECT_EQ(change_in(result, "control_swivel_max_deg").kind, ChangeKind::unknown);
    EXPECT_THAT(change_in(result, "control_swivel_max_deg").reason_unknown, HasSubstr("noise of the lamp tables"));
}

TEST(StudyCompare, LimitsHoldForValuesAndForChanges) {
    StudyResult result = two_cells(40.0, 50.0);
    result.study.limits.resize(3);
    result.study.limits[0].reading = result.study.limits[1].reading = "reach_5lx_target_own_m";
    result.study.limits[0].lamp = "new";
    result.study.limits[0].at_least = 45.0;
    result.study.limits[1].change_at_most = 9.0;
    result.study.limits[2].reading = "nothing_m";
    result.study.limits[2].change_at_least = 0.0;
    result.study.limits[2].line = 12;
    compare_cells(result);
    EXPECT_EQ(result.verdicts.back().line, 12U);
    ASSERT_EQ(result.verdicts.size(), 3U);
    EXPECT_EQ(result.verdicts[0].kind, VerdictKind::pass);
    EXPECT_EQ(result.verdicts[1].kind, VerdictKind::fail);
    EXPECT_EQ(result.verdicts[2].kind, VerdictKind::not_measured);
    EXPECT_EQ(overall(result), VerdictKind::fail);
    EXPECT_THAT(report_junit(suites_of(result)), HasSubstr("<failure"));
    EXPECT_THAT(document_text(study_summary(result)), HasSubstr("FAIL one_new: change of reach_5lx_target_own_m: 10 m, limit at most 9 m"));
}

TEST(StudyCompare, OfCellsAskedForOneByOneNoChangeIsMissed) {
    const auto verdicts = [](const char* only, const char* reading) {
        StudyResult result = two_cells(40.0, 50.0);
        result.only = only;
        result.cells.pop_back();
        result.study.limits.resize(1);
        result.study.limits[0].reading = reading;
        result.study.limits[0].change_at_least = 0.0;
        compare_cells(result);
        return result.verdicts;
    };
    EXPECT_THAT(verdicts("one_old", "reach_5lx_target_own_m"), testing::IsEmpty());
    EXPECT_EQ(verdicts("one_old", "reach_5lx_tarket_own_m").size(), 1U) << "misspelt";
    EXPECT_EQ(verdicts("", "reach_5lx_target_own_m").size(), 1U) << "all cells were asked for";
}

TEST(StudyCompare, AnAxisThatMovesNothingIsNamed) {
    StudyResult result = two_cells(40.0, 50.0);
    result.study.axes = {{"weather.wetness", {}, {}, {}}, {"eyes_m", {}, {}, {}}};
    const CellResult one = result.cells.front();
    result.cells.clear();
    for (const char* const wetness : {"0", "1"})
        for (const char* const eyes : {"1.1", "1.2"}) {
            result.cells.push_back(one);
            result.cells.back().cell.axes = {{"weather.wetness", wetness}, {"eyes_m", eyes}};
            put(result.cells.back(), "reach_5lx_target_own_m", *wetness == '0' ? 40.0 : 50.0);
        }
    add_axis_warnings(result);
    EXPECT_THAT(result.warnings, testing::ElementsAre(HasSubstr("axis eyes_m: 1.1 and 1.2 read the same in every cell")));
}

TEST(StudyCompare, ADecidingReadingThatNothingHasIsNotMeasured) {
    StudyResult result = two_cells(40.0, 50.0);
    result.study.decide = {"reach_5lx_tarket_own_m", "reach_5lx_target_own_grid_error_m"};
    result.study.limits.resize(2);
    result.study.limits[0].reading = result.study.limits[1].reading = "reach_5lx_tarket_own_m";
    result.study.limits[0].lamp = "new";
    result.study.limits[0].at_least = result.study.limits[1].change_at_least = 0.0;
    compare_cells(result);
    EXPECT_EQ(overall(result), VerdictKind::not_measured);
    const std::string text = document_text(study_summary(result)),
                      nearest = "there is no reading of this name; the nearest name is reach_5lx_target_own_m";
    EXPECT_THAT(text, HasSubstr("NOT MEASURED deciding reading reach_5lx_tarket_own_m: " + nearest));
    EXPECT_THAT(text, HasSubstr("NOT MEASURED deciding reading reach_5lx_target_own_grid_error_m: no two cells were compared by it"));
    EXPECT_THAT(text, HasSubstr("NOT MEASURED one_new: reach_5lx_tarket_own_m: " + nearest));
    EXPECT_THAT(text, HasSubstr("NOT MEASURED change of reach_5lx_tarket_own_m: " + nearest));
    EXPECT_THAT(text, HasSubstr("Nothing could be compared: no deciding reading is in two cells that are compared."));
    EXPECT_THAT(text, Not(HasSubstr("no deciding reading changed")));
}

TEST(StudyCompare, ADecidingReadingThatNoCellMeasuredIsRedAndSaysWhy) {
    const auto verdicts = [](const char* decide, bool measured_in_one) {
        StudyResult result = two_cells(40.0, 50.0);
        const ReadingKey mirror = key_of("mirror_left_at_15m_lx").value();
        for (CellResult& cell : result.cells)
            cell.readings[mirror] = {.key = mirror, .value = Value::not_measured("no mirror was met")};
        if (measured_in_one)
            result.cells[0].readings[mirror].value = 1.0;
        result.study.decide = {"reach_5lx_target_own_m", decide};
        compare_cells(result);
        return std::pair(overall(result), document_text(study_summary(result)));
    };
    const auto [kind, text] = verdicts("mirror_*", false);
    EXPECT_EQ(kind, VerdictKind::not_measured) << "exit code 1";
    EXPECT_THAT(text, HasSubstr("NOT MEASURED deciding reading mirror_*: no cell measured it: no mirror was met"));
    EXPECT_EQ(verdicts("mirror_*", true).first, VerdictKind::pass);
    const auto [no_glare, why] = verdicts("detection_*", false);
    EXPECT_EQ(no_glare, VerdictKind::not_measured);
    EXPECT_THAT(why, HasSubstr("deciding reading detection_*: no reading's name fits, as no drive measures visibility: ask for "
                               "`visibility` in `measure:`"));
    EXPECT_THAT(verdicts("reach_7lx_*", false).second, HasSubstr("deciding reading reach_7lx_*: no reading's name fits\n"));
}

TEST(StudyCompare, WhereNothingWasPlayedNothingIsSaidToBeUnchanged) {
    StudyResult result = two_cells(40.0, 40.0);
    for (CellResult& cell : result.cells) {
        cell.failed = "not reached";
        cell.readings.clear();
    }
    compare_cells(result);
    for (const std::string& text : {document_text(study_summary(result)), study_json_of(result), document_html(document(result), result)}) {
        EXPECT_THAT(text, HasSubstr("Nothing could be compared: cells played: 0 of 2."));
        EXPECT_THAT(text, Not(HasSubstr("deciding reading changed")));
    }
    StudyResult same = two_cells(40.0, 40.0);
    compare_cells(same);
    EXPECT_THAT(document_text(study_summary(same)), HasSubstr("new against old: 1 reading without a difference."));
    EXPECT_THAT(document_html(document(same), same), HasSubstr("No deciding reading changed"));
}

TEST(StudyCompare, ADrivePlayedInPartIsNamedAndNoLimitsAreNoPass) {
    StudyResult result = two_cells(40.0, 50.0);
    compare_cells(result);
    EXPECT_THAT(
        document_text(study_summary(result)),
        testing::StartsWith("by hand\nnew against old: better in 1 of 1 deciding reading\nnew against old: better by reach at 5 lx"));
    EXPECT_THAT(document_html(document(result), result),
                AllOf(HasSubstr("<p>No limits were set.</p>"), Not(HasSubstr("<h2>No limits")), Not(HasSubstr("Within limits"))));
    EXPECT_THAT(report_junit(suites_of(result)), HasSubstr("all moments"));
    EXPECT_THAT(document_markdown(study_paper(result)), Not(HasSubstr("--frames")));
    for (CellResult& cell : result.cells) {
        cell.moments = 9;
        cell.moments_of_drive = 660;
    }
    result.frames = "0:8";
    result.study.limits.resize(1);
    result.study.limits[0].reading = "reach_5lx_target_own_m";
    result.study.limits[0].at_least = 1.0;
    compare_cells(result);
    const std::string part = "Only moments 0:8 of each drive were played: 9 of 660";
    for (const std::string& text : {document_text(study_summary(result)), study_json_of(result), document_markdown(study_paper(result)),
                                    document_latex(study_paper(result)), document_html(document(result), result)})
        EXPECT_THAT(text, HasSubstr(part));
    EXPECT_THAT(report_junit(suites_of(result)), AllOf(HasSubstr("9 of 660 moments (--frames 0:8)"), Not(HasSubstr("all moments"))));
    EXPECT_THAT(document_html(document(result), result), HasSubstr("Within limits"));
    result.cells[1].moments_of_drive = 900;
    compare_cells(result);
    EXPECT_THAT(document_text(study_summary(result)), HasSubstr("each drive were played: 9 of 660 to 900"));
}

/// Whoever sees it on a CI server's page wants the verdict, then what to repeat, then the decision; the table after all that.
TEST(StudyCompare, ThePaperLeadsWithTheVerdictWhatIsRedAndTheDecision) {
    StudyResult result = two_cells(40.0, 50.0);
    compare_cells(result);
    EXPECT_THAT(document_markdown(study_paper(result)),
                testing::StartsWith("# by hand\n\n## No limits were set\n\nnew against old: better by reach at 5 lx"));
    result.call = {"fernlicht", "study", "s.yaml"};
    result.study.limits.resize(2);
    for (StudyLimit& limit : result.study.limits)
        limit.reading = "reach_5lx_target_own_m";
    result.study.limits[0].at_least = 45.0;
    result.study.limits[1].at_most = 60.0;
    result.study.techniques = {"photometric"};
    compare_cells(result);
    EXPECT_THAT(
        document_markdown(study_paper(result)),
        testing::StartsWith("# by hand\n\n## Limits exceeded\n\nFAIL by hand: one_old: reach_5lx_target_own_m: 40 m, limit at least 45 m. "
                            "Repeat with `fernlicht study s.yaml --only one_old`; `--known` calls it `by hand///one_old: "
                            "reach_5lx_target_own_m`\n\nnew against old: better by reach"));
    result.interrupted = "interrupted by the user";
    result.cells[1].failed = "not reached";
    EXPECT_THAT(document_markdown(study_paper(result)), AllOf(HasSubstr("\n\nThe study did not end: interrupted by the user.\n"),
                                                              HasSubstr("NOT MEASURED one_new: played: not reached")));
    EXPECT_THAT(document_latex(study_paper(result)), HasSubstr("\n% FAIL by hand: one_old")) << "a comment in a paper";
    for (int i = 0; i < 200; ++i)
        result.verdicts.push_back({VerdictKind::fail, "more", "x", ""});
    EXPECT_THAT(document_markdown(study_paper(result)), HasSubstr("\nAnd 102 more, all in report.html.\n"));
}

TEST(StudyCompare, ACellThatFailedTakesTheVerdictWithIt) {
    StudyResult result = two_cells(40.0, 40.0);
    compare_cells(result);
    EXPECT_EQ(overall(result), VerdictKind::pass);
    result.cells[1].failed = "the disk is full";
    EXPECT_EQ(overall(result), VerdictKind::not_measured);
    EXPECT_THAT(document_text(study_summary(result)), testing::StartsWith("by hand: not measured\n"));
    EXPECT_THAT(report_junit(suites_of(result)), HasSubstr("the disk is full"));
}

TEST(StudyJson, ComesBack) {
    StudyResult result = two_cells(40.0, 50.0);
    put(result.cells[0], "reach_10lx_road_own_m", 3.0);
    put(result.cells[1], "reach_10lx_road_own_m", std::nullopt, "never lit");
    const ReadingKey bound = key_of("reach_1lx_road_own_m").value();
    result.cells[1].readings[bound] = {bound, Value::at_least(200.0)};
    result.study.techniques = {"photometric", "full"};
    result.study.conditions.mirror = {false, true};
    for (CellResult& cell : result.cells)
        cell.cell.technique = cell.cell.mirror = 1;
    result.cells[1].moments_of_drive = 660;
    result.cells[1].frame_s = 0.01;
    result.cells[1].error_share = 0.02;
    result.cells[1].reused = true;
    result.cells[1].inputs = {{InputKind::lamp, "new.ies", "1f0c"}, {InputKind::device, "driver", "Mesa 22.3.6"}};
    result.cells[1].key = "91bc";
    result.cells[1].verdicts = {{VerdictKind::fail, "reach", "50 m", "fernlicht run", Expectation::known, "known since May"}};
    result.lamps = {{"new", "old", "left", "new.ies", "old.ies", {.level = {{0.03, 0.01}}, .undecided = "not known which"}},
                    {"new", "old", "right", "new-right.ies", "old-right.ies", {}}};
    result.figures = {{{.name = "figures/lux_one.new"}, "Lux", {1}}};
    result.interrupted = result.cells[0].failed = "interrupted by the user";
    result.context.versions = {{"fernlicht", "0.1"}};
    compare_cells(result);
    ASSERT_EQ(result.changes.size(), 2U);
    ASSERT_EQ(result.largest.size(), 1U);
    std::string text = study_json_of(result);
    tests::checked(text, study_members);
    EXPECT_EQ(study_json_of(from_json<StudyResult>(CheckedJson::parse(text, {}), study_members)), text);
    text.replace(text.find("[\"one_new\"]"), 11, "[\"one_odd\"]");
    EXPECT_THAT([&] { from_json<StudyResult>(CheckedJson::parse(text, {}), study_members); },
                testing::ThrowsMessage<InputError>(HasSubstr("figures[0].cells[0]")));
}

TEST(StudyText, TablesEscapeWhatTheirFormatsMean) {
    StudyResult result = two_cells(40.0, 50.0);
    result.study.lamps[1].name = result.study.comparisons[0].tested = "a_b|c%";
    compare_cells(result);
    EXPECT_THAT(document_latex(study_paper(result)), HasSubstr("a\\_b\\textbar{}c\\% / old"));
    EXPECT_THAT(document_latex(study_paper(result)), HasSubstr("$40.00$ & $50.00$ & $+10.00$ & $0.57$"));
    EXPECT_THAT(document_markdown(study_paper(result)), HasSubstr("a_b\\|c% / old"));
    EXPECT_THAT(study_csv_of(result), HasSubstr("c0,a_b|c%,old,one-1"));
    for (CellResult& cell : result.cells)
        put(cell, "area_1lx_road_all_m2", cell.cell.lamp == 0 ? 10.0 : 90.0);
    result.study.decide = {"area_1lx_road_all_m2"};
    result.changes.clear();
    compare_cells(result);
    EXPECT_THAT(document_latex(study_paper(result)),
                AllOf(HasSubstr("& m$^2$ &"), HasSubstr("\\resizebox{\\linewidth}"), Not(HasSubstr("²"))));
    EXPECT_THAT(document_markdown(study_paper(result)), HasSubstr("| m² |"));
    EXPECT_THAT(study_csv_of(result), HasSubstr(",m2,"));
}

TEST(StudyCompare, AnEyeThatLooksIntoTheLampsIsNamedOnce) {
    StudyResult result;
    result.cells.resize(2);
    result.cells[0].gazes = {{{"bend-1", "Oncoming driver opposite"}, 0.9}};
    result.cells[1].gazes = {{{"bend-1", "Oncoming driver opposite"}, 0.4}};
    add_gaze_warnings(result);
    EXPECT_THAT(result.warnings,
                testing::ElementsAre(testing::HasSubstr("bend-1: Oncoming driver opposite: the line of sight passes the lamps at 0.40°")));
}

} // namespace
} // namespace fernlicht
