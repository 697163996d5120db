// Better, worse or undecided, by hand-made changes.
#include "runner/experiments/study/study_decision.h"
#include "runner/experiments/study/study_document.h"
#include "runner/write/document.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char *reach = "reach_5lx_target_own_m", *glare = "mirror_left_at_15m_max_lx", *neutral = "foreground_own_lx";

/// A new lamp against an old one on as many drives as there are changes of each reading.
struct MadeStudy {
    StudyResult result;

    MadeStudy() {
        result.study.name = result.study.title = "by hand";
        result.study.lamps = {{.name = "old"}, {.name = "new"}};
        result.study.comparisons = {{"new", "old"}};
        result.study.decide = {reach, glare, neutral};
        result.study.conditions.times_of_day = {{}};
    }
    /// Of one drive; nudged aim moves it by `by_aim`.
    MadeStudy& on(std::size_t drive, const char* name, const Value& before, const Value& now, std::optional<double> by_aim = 0.0) {
        while (result.cells.size() < 2 * (drive + 1)) {
            CellResult cell;
            cell.cell.drive = result.cells.size() / 2;
            cell.cell.lamp = result.cells.size() % 2;
            cell.drive = "drive-" + std::to_string(cell.cell.drive);
            cell.cell.name = cell.drive + (cell.cell.lamp == 0 ? "_old" : "_new");
            result.cells.push_back(cell);
        }
        const ReadingKey key = key_of(name).value();
        for (const auto& [lamp, value] : {std::pair(0U, before), std::pair(1U, now)}) {
            CellResult& cell = result.cells[2 * drive + lamp];
            cell.readings[key] = {.key = key, .value = value, .sensitivity = {.aim_up = by_aim}};
            if (key.quantity == Quantity::reach)
                for (const char* const exact : {"reach_5lx_target_own_grid_error_m", "reach_5lx_target_own_twin_difference_m"})
                    cell.readings[key_of(exact).value()] = {key_of(exact).value(), 0.05};
        }
        return *this;
    }
    std::vector<Decision> decided() {
        compare_cells(result);
        return decide(result);
    }
};

DecisionOutcome outcome(MadeStudy study) { return study.decided().front().readings.front().outcome; }

TEST(Decision, BetterHasADirection) {
    EXPECT_EQ(outcome(MadeStudy().on(0, reach, 40.0, 50.0)), DecisionOutcome::better);
    EXPECT_EQ(outcome(MadeStudy().on(0, reach, 50.0, 40.0)), DecisionOutcome::worse);
    EXPECT_EQ(outcome(MadeStudy().on(0, glare, 1.0, 1.1)), DecisionOutcome::worse) << "more light in mirrors is no gain";
    EXPECT_EQ(outcome(MadeStudy().on(0, glare, 1.1, 1.0)), DecisionOutcome::better);
    EXPECT_EQ(outcome(MadeStudy().on(0, neutral, 1.0, 2.0)), DecisionOutcome::changed);
    EXPECT_EQ(outcome(MadeStudy().on(0, reach, 50.0, Value::at_least(200.0))), DecisionOutcome::better);
    EXPECT_EQ(outcome(MadeStudy().on(0, reach, 40.0, 40.0)), DecisionOutcome::same);
}

TEST(Decision, AimDecidesWhatIsReal) {
    EXPECT_EQ(outcome(MadeStudy().on(0, glare, 1.0, 1.1, 0.12)), DecisionOutcome::within_aim);
    EXPECT_EQ(outcome(MadeStudy().on(0, glare, 1.0, 1.1, 0.09)), DecisionOutcome::worse);
    EXPECT_EQ(outcome(MadeStudy().on(0, glare, 1.0, 1.1, std::nullopt)), DecisionOutcome::undecided) << "nothing tells what aim would do";
    EXPECT_EQ(outcome(MadeStudy().on(0, reach, Value::at_least(200.0), Value::at_least(200.0))), DecisionOutcome::undecided);
}

TEST(Decision, WhatIsMostlyNotKnownIsUndecided) {
    const Value far = Value::at_least(200.0);
    MadeStudy mostly = MadeStudy().on(0, reach, 40.0, 40.0).on(1, reach, far, far).on(2, reach, far, far);
    EXPECT_EQ(outcome(mostly), DecisionOutcome::undecided);
    MadeStudy played = mostly;
    const std::vector<Decision> decisions = played.decided();
    EXPECT_THAT(same_results(played.result, decisions), IsEmpty()) << "what is not known repeats nothing";
    EXPECT_EQ(outcome(mostly.on(3, reach, 50.0, 50.0)), DecisionOutcome::same);
    EXPECT_EQ(outcome(mostly.on(4, reach, 40.0, 50.0).on(5, reach, far, far)), DecisionOutcome::better) << "one that is real tells more";
}

TEST(Decision, PlacesMayDisagree) {
    EXPECT_EQ(outcome(MadeStudy().on(0, reach, 40.0, 50.0).on(1, reach, 50.0, 30.0)), DecisionOutcome::mixed);
    EXPECT_EQ(outcome(MadeStudy().on(0, reach, 40.0, 50.0).on(1, reach, 50.0, 52.0, 4.0)), DecisionOutcome::better);
    EXPECT_EQ(outcome(MadeStudy().on(0, reach, 40.0, 40.0).on(1, reach, 50.0, 52.0, 4.0)), DecisionOutcome::within_aim);
}

TEST(Decision, TheMedianChangeIsToldAndOfTwoTheSmaller) {
    const auto told = [](MadeStudy study) {
        const std::size_t change = study.decided().front().readings.front().told;
        return study.result.changes[change].change().figure().value();
    };
    MadeStudy two = MadeStudy().on(0, reach, 40.0, 50.0).on(1, reach, 30.0, 34.0), three = two;
    EXPECT_DOUBLE_EQ(told(two), 4.0);
    EXPECT_DOUBLE_EQ(told(three.on(2, reach, 20.0, 40.0)), 10.0);
}

TEST(Decision, OneResultInTwoPlacesIsNamed) {
    MadeStudy study;
    study.on(0, reach, 40.0, 50.0).on(1, reach, 40.02, 50.01).on(2, reach, 60.0, 62.0, 3.0);
    const std::vector<Decision> decisions = study.decided();
    EXPECT_THAT(same_results(study.result, decisions), ElementsAre("1 result of drive-1 repeats what drive-0 has: no further evidence"));
    EXPECT_THAT(decision_sentence(study.result, decisions.front()), HasSubstr("in 2 of 3 results, at most +10.00 m (+25 %) on drive-0"));
    MadeStudy apart = MadeStudy().on(0, reach, 40.0, 50.0).on(1, reach, 41.0, 51.0);
    const std::vector<Decision> no_repeats = apart.decided();
    EXPECT_THAT(same_results(apart.result, no_repeats), IsEmpty());
    study.result.cells[2].cell.point = study.result.cells[3].cell.point = 1; // another point of the axes is no repeat
    EXPECT_THAT(same_results(study.result, decisions), IsEmpty());
}

TEST(Decision, TheSentenceNamesThePointOfTheAxes) {
    MadeStudy study;
    study.on(0, reach, 40.0, 42.0).on(1, reach, 50.0, 60.0);
    for (std::size_t i = 2; i < 4; ++i)
        study.result.cells[i].cell.axes = {{"pitch_deg", "0.3"}, {"weather.wetness", ""}, {"rate_hz", "1"}};
    for (std::size_t i = 0; i < 2; ++i)
        study.result.cells[i].cell.axes = {{"pitch_deg", "0"}, {"weather.wetness", "1"}, {"rate_hz", "1"}};
    EXPECT_THAT(decision_sentence(study.result, study.decided().front()),
                HasSubstr(" +2.00 m (+5.0 %), at most +10.00 m (+20 %) on drive-1, pitch_deg 0.3."));
}

TEST(Decision, TheSentenceNamesWhereMostChangedAndWhatIsWithinAim) {
    MadeStudy study;
    study.on(0, reach, 40.0, 42.0).on(1, reach, 50.0, 60.0).on(2, reach, 60.0, 64.0);
    study.on(0, glare, 1.0, 1.1, 0.12).on(0, neutral, 2.0, 2.1, 0.2);
    const std::string sentence = decision_sentence(study.result, study.decided().front());
    EXPECT_THAT(sentence, HasSubstr("own lane +4.00 m (+6.7 %), at most +10.00 m (+20 %) on drive-1."));
    EXPECT_THAT(sentence, HasSubstr("Within 0.1° of aim: largest illuminance on the mirror left of a car "
                                    "15 m ahead; foreground: mean light on the road from 5 to 15 m, own lane."));
}

TEST(Decision, OfManyReadingsTheSmallestChangeIsLeftOut) {
    MadeStudy study;
    study.result.study.decide = {"mirror_left_*"};
    for (const auto& [at_m, now] : {std::pair(10, 1.5), std::pair(15, 1.1), std::pair(20, 1.4), std::pair(25, 1.3), std::pair(30, 2.0)})
        study.on(0, fmt::format("mirror_left_at_{}m_max_lx", at_m).c_str(), 1.0, now);
    const std::string sentence = decision_sentence(study.result, study.decided().front());
    EXPECT_THAT(sentence, AllOf(HasSubstr("(+100 %)"), Not(HasSubstr("(+10 %)")), HasSubstr("; and 1 more")));
}

TEST(Decision, WarningsOfTheAimStandOnTheFirstScreen) {
    MadeStudy study;
    study.result.study.decide = {reach};
    study.on(0, reach, 40.0, 50.0).decided();
    study.result.warnings = {"new, left and right: the cut-off lies at -0.30 %"};
    EXPECT_THAT(document_text(study_summary(study.result)), testing::StartsWith("by hand\nnew against old: better"));
    const std::string page = document_html(document(study.result), study.result);
    EXPECT_LT(page.find("the cut-off lies at -0.30 %"), page.find("The largest changes"));
}

TEST(Decision, PlacesThatDrawOneFlatLineHaveItOnce) {
    MadeStudy study;
    study.on(0, reach, 40.0, 50.0).on(1, reach, 40.0, 50.0).on(2, reach, 40.0, 50.0);
    for (std::size_t i = 0; i < study.result.cells.size(); ++i) {
        const double reach_m = i % 2 == 0 ? 40.0 : 50.0, bend_m = i / 2 == 2 ? 5.0 : 0.0; // the third drive has a bend
        study.result.cells[i].reaches = {{key_of(reach).value(), {0.0, 10.0, 20.0}, {reach_m, reach_m - bend_m, reach_m}}};
    }
    const std::vector<StudyFigure> figures = study_figures(study.result, {});
    ASSERT_EQ(figures.size(), 2U);
    EXPECT_THAT(figures[0].title, testing::EndsWith("; the same on drive-1"));
    EXPECT_THAT(figures[0].cells, ElementsAre(0U, 1U, 2U, 3U));
    EXPECT_THAT(figures[0].plot.places, ElementsAre("drive-0", "drive-1"));
    EXPECT_THAT(figures[1].cells, ElementsAre(4U, 5U));
}

TEST(Decision, TheFirstWordsOfAllAreTheSentence) {
    MadeStudy study;
    study.on(0, reach, 40.0, 50.0).on(0, glare, 1.0, 1.1, 0.05).on(0, neutral, 2.0, 3.0, std::nullopt);
    const std::vector<Decision> decisions = study.decided();
    EXPECT_EQ(decision_heading(study.result, decisions), "new against old: better in 1, worse in 1 of 3 deciding readings");
    const std::string sentence = decision_sentence(study.result, decisions.front());
    EXPECT_EQ(sentence,
              "new against old: better by reach at 5 lx on a target, own lane +10.00 m (+25 %). Worse by largest illuminance on "
              "the mirror left of a car 15 m ahead +0.10 lx (+10 %). Undecided: foreground: mean light on the road from 5 to 15 m, "
              "own lane because nothing tells what 0.1 degrees of aim would do to this reading.");
    EXPECT_THAT(document_text(study_summary(study.result)),
                testing::StartsWith("by hand\nnew against old: better in 1, worse in 1 of 3 deciding readings\n" + sentence));
    const std::string page = document_html(document(study.result), study.result);
    EXPECT_LT(page.find("better in 1, worse in 1"), page.find("The largest changes"));
    EXPECT_THAT(sentence, Not(HasSubstr(" 1 ")));
}

TEST(Decision, ALampThatIsOnlyAimedOtherwiseIsCalledSo) {
    MadeStudy study;
    study.on(0, reach, 40.0, 50.0);
    study.result.lamps = {{.tested = "new", .against = "old", .side = "left and right"}};
    study.result.lamps.front().difference.aim_up_deg.emplace();
    study.result.lamps.front().difference.aim_right_deg.emplace();
    EXPECT_THAT(decision_sentence(study.result, study.decided().front()), HasSubstr("it is the aim, not the lamp"));
    study.result.lamps.front().is_turned_later = true;
    EXPECT_THAT(decision_sentence(study.result, decide(study.result).front()), Not(HasSubstr("it is the aim"))) << "aim: auto took it away";
    const auto mount = [&](double new_percent) { // one file, or two of one beam: where they are put decides
        for (CellResult& cell : study.result.cells)
            cell.aims = {{.lamp = "left", .percent = cell.cell.lamp == 1 ? new_percent : -1.0}};
        return decision_sentence(study.result, decide(study.result).front());
    };
    EXPECT_THAT(mount(-0.6), HasSubstr("it is the aim, not the lamp"));
    EXPECT_THAT(mount(-1.0), Not(HasSubstr("it is the aim")));
    study.result.lamps.front().difference.level.emplace();
    EXPECT_THAT(mount(-0.6), HasSubstr("As mounted its cut-off lies 0.23° higher: some or all of this is aim"));
    EXPECT_THAT(mount(-1.05), Not(HasSubstr("of this is aim")));
    EXPECT_THAT(decision_sentence(study.result, decide(study.result).front()), Not(HasSubstr("it is the aim")));
}

/// The first section of the page: its heading, the sentence below it, the matrix.
struct FirstScreen {
    Section section;
    explicit FirstScreen(MadeStudy& study) : section(answer_section(study.result, study.decided())) {}
    const std::string& where() const { return std::get<std::string>(section.blocks.at(0)); }
    const MatrixEntry& entry(std::size_t row, std::size_t lamp) const {
        return std::get<PlaceMatrix>(section.blocks.at(2)).rows.at(row).second.at(lamp);
    }
};

TEST(Answer, TellsOneSizeOnceAndHowFarApartTheCutOffsLie) {
    MadeStudy study;
    study.on(0, reach, 40.0, 50.0, 2.0).on(1, reach, 40.0, 50.0, 2.0);
    for (CellResult& cell : study.result.cells)
        cell.aims = {{.lamp = "left", .percent = cell.cell.lamp == 1 ? -0.6 : -1.0}};
    const FirstScreen screen(study);
    EXPECT_EQ(screen.where(),
              "Median over 2 routes by change in per cent, the smaller of the middle two: better on 2 of 2 routes, +10.0 m on each.");
    EXPECT_THAT(screen.section.title, testing::EndsWith("(+10.0 m, +25 %); the cut-off of new lies 0.23° higher"));
}

TEST(Answer, NamesBestAndWorstByHowMuchAndWhere) {
    MadeStudy study;
    study.on(0, reach, 40.0, 50.0, 2.0).on(1, reach, 60.0, 63.0, 4.0).on(0, glare, 1.0, 1.2, 0.05);
    const FirstScreen screen(study);
    EXPECT_EQ(screen.section.title, "Reach at 5 lx on a target, own lane: new is better than old: 56.5 m against 50.0 m (+6.50 m, +13 %)");
    EXPECT_EQ(screen.where(), "Median over 2 routes: better on 1 of 2 routes, on 1 within what calculation, "
                              "noise and 0.1° of aim leave open, most on drive-0 (+10.0 m).");
    EXPECT_EQ(screen.entry(0, 0).standing, "") << "the old lamp is compared with nothing";
    EXPECT_EQ(screen.entry(0, 1).standing, "better");
    EXPECT_EQ(screen.entry(0, 1).change, "+10.00");
    EXPECT_EQ(screen.entry(0, 1).share, "+25");
    EXPECT_EQ(screen.entry(0, 1).open, "2.00");
    EXPECT_DOUBLE_EQ(screen.entry(0, 1).shade, 0.25 / 0.4);
    EXPECT_EQ(screen.entry(1, 1).standing, "within aim");
    EXPECT_EQ(screen.entry(1, 1).shade, 0.0) << "what aim would do as well is not marked";
    EXPECT_THAT(std::get<std::string>(screen.section.blocks.at(1)),
                testing::AllOf(HasSubstr("new against old: better in 1, worse in 1 of 2 deciding readings."),
                               HasSubstr("Worse by largest illuminance"), HasSubstr(" Not measured, though it would decide: foreground.")));
    const std::string page = document_html(document(study.result), study.result);
    EXPECT_LT(page.find(screen.section.title), page.find("class=\"wide matrix"));
    EXPECT_THAT(page, HasSubstr("<td class=\"gain\" style=\"--shade:0.62\""));
    EXPECT_THAT(page, HasSubstr("▲ </span>+10.00 (+25 %) better<small> aim ±2.00</small>"));
}

TEST(Answer, LessGlareIsBetterAndWithinAimNobodyWins) {
    MadeStudy dim;
    dim.result.study.decide = {glare};
    dim.on(0, glare, 1.2, 1.0).on(1, glare, 1.0, 1.1);
    const FirstScreen mixed(dim);
    EXPECT_EQ(mixed.section.title, "Largest illuminance on the mirror left of a car 15 m ahead: new is better than old on 1 of 2 routes, "
                                   "worse on 1: 1.05 lx against 1.10 lx (−0.0500 lx, −5 %)");
    EXPECT_THAT(mixed.where(), HasSubstr("better on 1 of 2 routes, worse on 1, most on drive-0 (−0.200 lx)"));
    EXPECT_GT(mixed.entry(0, 1).shade, 0.0);
    EXPECT_LT(mixed.entry(1, 1).shade, 0.0);
    MadeStudy alike;
    alike.on(0, reach, 40.0, 41.0, 3.0);
    EXPECT_EQ(
        FirstScreen(alike).section.title,
        "Reach at 5 lx on a target, own lane: new and old do not differ by more than aim and noise: 41.0 m against 40.0 m (+1.00 m, +2 %)");
}

TEST(Answer, HeadlineSaysNoMoreThanTheRoutes) {
    MadeStudy worse; // the median gains by what aim would do as well
    worse.on(0, reach, 40.0, 55.0, 20.0).on(1, reach, 60.0, 58.0, 0.5);
    EXPECT_EQ(FirstScreen(worse).section.title, "Reach at 5 lx on a target, own lane: new is worse than old on 1 of 2 routes, better on "
                                                "none: 56.5 m against 50.0 m (+6.50 m, +13 %)");
    MadeStudy mixed;
    mixed.on(0, reach, 40.0, 80.0)
        .on(1, reach, 41.0, 60.0, 30.0)
        .on(2, reach, 50.0, 48.0)
        .on(3, reach, 56.0, 54.0)
        .on(4, reach, 57.0, 55.0);
    EXPECT_EQ(
        FirstScreen(mixed).section.title,
        "Reach at 5 lx on a target, own lane: new is better than old on 1 of 5 routes, worse on 3: 55.0 m against 50.0 m (+5.00 m, +10 %)");
}

TEST(Answer, OfTheLampComparedAgainstSignsAreItsOwn) {
    MadeStudy study;
    study.on(0, reach, 52.0, 40.0).on(1, reach, 60.0, 52.0).on(2, reach, Value::at_least(200.0), 50.0);
    const FirstScreen screen(study);
    EXPECT_EQ(screen.section.title, "Reach at 5 lx on a target, own lane: old is better than new: 52.0 m against 40.0 m (+12.0 m, +30 %)");
    EXPECT_THAT(
        screen.where(),
        HasSubstr(
            "Median over 3 routes by change in per cent: better on 3 of 3 routes, most on drive-2 (> +150 m), least on drive-1 (+8.00 m)"));
}

TEST(Answer, MedianCountsTheRoutesThatItIsOver) {
    MadeStudy study;
    study.on(0, reach, 40.0, 50.0).on(1, reach, 42.0, Value::not_measured("off the road"));
    EXPECT_THAT(FirstScreen(study).where(), testing::StartsWith("Median over 1 of 2 routes"));
}

TEST(Answer, RanksWhatDecidesWithIntervals) {
    MadeStudy study;
    study.on(0, glare, 1.0, 1.2, 0.05).on(0, reach, 40.0, 50.0, 2.0);
    const FirstScreen screen(study);
    const auto& drawing = std::get<plots::Drawing>(std::get<Plot>(screen.section.blocks.at(3)).figure);
    std::vector<std::string> names;
    for (const plots::Drawing::Mark& mark : drawing.marks)
        if (const auto* text = std::get_if<plots::Drawing::Text>(&mark);
            text && text->lettering.anchor == "end" && text->text.find("worse") == std::string::npos)
            names.push_back(text->text);
    EXPECT_THAT(names, ElementsAre("reach at 5 lx on a target, own lane", "largest illuminance on the mirror left of a car", "15 m ahead"));
}

TEST(FullDisk, IsTheMachinesFault) {
    StudyResult study;
    study.cells.resize(2);
    study.cells[1].failed = "it took longer than 5 minutes";
    EXPECT_FALSE(met_full_disk(study));
    study.cells[0].failed = "store/playing/a.exr: cannot be written: No space left on device";
    EXPECT_TRUE(met_full_disk(study));
}

} // namespace
} // namespace fernlicht
