// `fernlicht history` through the program, on folders of a study that was never drawn.
#include "runner/commands/run_files.h"
#include "runner/experiments/study/study_document.h"
#include "runner/findings/report.h"
#include "tests/runner/experiments/history/planted_nights.h"
#include "tests/runner/program.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using tests::PlantedNights;
using tests::World;

/// The smallest PNG: one pixel.
const std::string png_bytes("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x08\6\0\0\0\x1f\x15\xc4\x89\0\0\0\rIDATx\x9c"
                            "c\xf8\xcf\xc0\xf0\x1f\0\5\0\1\xff\x56\xc7/\r\0\0\0\0IEND\xae"
                            "B`\x82",
                            70);

/// A night's folder: study.json, and of one cell a report with a frame.
void write_night(const std::filesystem::path& folder, const StudyResult& result) {
    const std::filesystem::path cell = folder / "cells" / "straight_xenon";
    std::filesystem::create_directories(cell / "frames");
    write_file(folder / "study.json", json_text(as_json(result, study_members)));
    write_file(cell / "frames" / "10-driver.png", png_bytes);
    Report report;
    report.context = result.context;
    PlayedCell& played = report.played.emplace_back();
    played.drive = "straight";
    played.lamp_set = "xenon";
    played.ticks_planned = played.ticks_done = 20;
    played.frames = {{10, 1.0, "driver", "frames/10-driver.png", ""}};
    write_report(report, cell);
}

class HistoryCommand : public testing::Test {
  protected:
    TemporaryFolder folder_;
    std::string file_ = folder_ / "history.db", flag_ = " --history " + file_;

    void SetUp() override {
        PlantedNights planted(3);
        World lamp;
        lamp.version["xenon"] = 1;
        lamp.lamp_light["xenon"] = 1.05;
        for (int night = 0; night < 3; ++night)
            write_night(folder_ / ("n" + std::to_string(night)), planted.play(night, night < 2 ? World{} : lamp));
    }
    std::string night(int number) const { return folder_ / ("n" + std::to_string(number)); }
};

TEST_F(HistoryCommand, FromTheFirstNightToTheCause) {
    EXPECT_THAT(printed("history add " + night(0) + " --accept --note 'as bought'" + flag_),
                HasSubstr("night 1 of planted, 2026-01-01: 6 cells, 24 readings; accepted; added to "));
    printed("history add " + night(1) + flag_);
    EXPECT_THAT(printed("history explain" + flag_),
                HasSubstr("Nothing changed since the accepted night of 2026-01-01 (\"as bought\"), in 1 night: 24 readings of 6 cells"));
    printed("history add " + night(2) + flag_);
    EXPECT_THAT(printed("history add " + night(2) + flag_), HasSubstr("was there already, as it is, in"));
    EXPECT_THAT(printed("history show" + flag_),
                AllOf(HasSubstr("yes: as bought"), HasSubstr("llvmpipe (LLVM 15.0.6, 256 bits), avx2"), HasSubstr(night(2))));
    EXPECT_THAT(printed("history show 3" + flag_),
                AllOf(HasSubstr("Mesa 22.3.6"), HasSubstr("straight_halogen"), ContainsRegex("lamp +xenon-low.ies +[0-9a-f]+ +3")));
    EXPECT_THAT(printed("history explain" + flag_),
                AllOf(HasSubstr("1 change since"), HasSubstr("2026-01-03: inputs: lamp xenon-low.ies"), HasSubstr("(+5 %)")));
    EXPECT_THAT(printed("history explain 2026-01-02" + flag_), HasSubstr("Nothing changed"));
    EXPECT_THAT(printed("history trend 'reach_5lx*' --only straight_xenon" + flag_),
                AllOf(HasSubstr("2026-01-01  2026-01-02"), HasSubstr("inputs: lamp xenon-low.ies")));
    const nlohmann::json nights = nlohmann::json::parse(printed("history show --json" + flag_)),
                         third = nlohmann::json::parse(printed("history show 3 --json" + flag_)),
                         explained = nlohmann::json::parse(printed("history explain --json" + flag_));
    EXPECT_EQ(nights.at(0).at("note"), "as bought");
    EXPECT_EQ(nights.at(2).at("readings"), 24);
    EXPECT_EQ(third.at("cells").size(), 6U);
    EXPECT_EQ(third.at("cells").at(0).at("readings").size(), 4U);
    EXPECT_THAT(explained.dump(), HasSubstr("xenon-low.ies"));
    EXPECT_EQ(run_program("history explain --fail-on-change" + flag_).exit_code, 1);
    printed("history accept last" + flag_);
    EXPECT_THAT(printed("history explain" + flag_), AllOf(HasSubstr("1 change since"), HasSubstr("This night is accepted itself")));
    EXPECT_EQ(run_program("history explain --fail-on-change" + flag_).exit_code, 0) << "who accepts a night accepts its changes";
    EXPECT_THAT(printed("history prune --keep-nights 0 --dry-run" + flag_),
                HasSubstr("would remove 1 night, kept 2 older ones that are accepted"));
    EXPECT_THAT(printed("history prune --before 2026-01-03" + flag_), HasSubstr("removed night 2 of planted, 2026-01-02"));
}

/// Another name for a lamp makes all its cells new: they were compared with nothing, and nobody may take that for a night without changes.
TEST_F(HistoryCommand, WhatWasNotComparedIsCountedAndFailsTheJob) {
    PlantedNights planted(3);
    const auto explained_after = [&](int number, const std::set<std::string>& renamed) {
        StudyResult result = planted.play(number, {});
        for (StudyLamp& lamp : result.study.lamps)
            lamp.name += renamed.contains(lamp.name) ? "-new" : "";
        for (CellResult& cell : result.cells)
            cell.cell.name += renamed.contains(cell.cell.name.substr(cell.cell.name.find('_') + 1)) ? "-new" : "";
        const std::string folder = folder_ / ("renamed" + std::to_string(number));
        write_night(folder, result);
        printed("history add " + folder + flag_);
        EXPECT_EQ(run_program("history explain --fail-on-change" + flag_).exit_code, 1);
        return printed("history explain" + flag_);
    };
    printed("history add " + night(0) + " --accept" + flag_);
    EXPECT_THAT(
        explained_after(1, {"xenon"}),
        AllOf(HasSubstr("Nothing changed since the accepted night of 2026-01-01, in 1 night: 12 readings of 3 cells are the same to "
                        "the last bit. 6 cells cannot be compared"),
              HasSubstr("straight_xenon was not played tonight")));
    EXPECT_THAT(explained_after(2, {"xenon", "halogen"}),
                AllOf(HasSubstr("Nothing can be compared with the accepted night of 2026-01-01"), Not(HasSubstr("same to the last bit"))));
}

/// Where everything failed in the first night, later ones are compared with the first that read anything.
TEST_F(HistoryCommand, ANightWithoutReadingsIsComparedWithNothing) {
    StudyResult failed = PlantedNights(3).play(0, {});
    for (CellResult& cell : failed.cells) {
        cell.failed = "the disk was full";
        cell.readings.clear();
    }
    write_night(folder_ / "failed", failed);
    printed("history add " + (folder_ / "failed") + flag_);
    EXPECT_THAT(printed("history accept last" + flag_, 2), HasSubstr("in which no cell was played, expected one with readings"));
    EXPECT_THAT(printed("history add " + (folder_ / "failed") + " --accept" + flag_, 2), HasSubstr("in which no cell was played"));
    printed("history add " + night(1) + flag_);
    EXPECT_THAT(printed("history explain --fail-on-change" + flag_), AllOf(HasSubstr("The first night"), Not(HasSubstr("compared"))));
    printed("history add " + night(2) + flag_);
    EXPECT_THAT(printed("history explain" + flag_),
                AllOf(HasSubstr("1 change since the first night, 2026-01-02 "), Not(HasSubstr("cannot be compared"))));
}

/// The accepted night was played with a clock a day ahead: the next ones are compared with it all the same, and told so.
TEST_F(HistoryCommand, NightsFollowEachOtherAsTheyWereAddedWhateverTheirClocksSay) {
    const auto add_dated = [&](int number, const std::string& utc) {
        StudyResult result = from_json<StudyResult>(CheckedJson::read(night(number) + "/study.json"), study_members);
        result.context.started_utc = utc;
        const std::string folder = folder_ / utc;
        write_night(folder, result);
        printed("history add " + folder + (number == 0 ? " --accept" : "") + flag_);
    };
    add_dated(0, "2026-02-02T02:00:00Z");
    add_dated(1, "2026-02-01T12:00:00Z");
    EXPECT_THAT(printed("history explain" + flag_),
                AllOf(HasSubstr("Nothing changed since the accepted night of 2026-02-02"), Not(HasSubstr("first night")),
                      HasSubstr("The night of 2026-02-02 is dated after this one of 2026-02-01, though it was added before")));
    EXPECT_EQ(run_program("history explain --fail-on-change" + flag_).exit_code, 0);
    add_dated(2, "2026-02-01T18:00:00Z");
    const Outcome changed = run_program("history explain --fail-on-change" + flag_);
    EXPECT_EQ(changed.exit_code, 1);
    EXPECT_THAT(changed.output, HasSubstr("(+5 %)")) << "from before to after";
    EXPECT_THAT(printed("history trend 'reach_5lx*' --only straight_xenon" + flag_), HasSubstr("2026-02-02        2026-02-01 12:00"));
}

TEST_F(HistoryCommand, AnAcceptanceIsTakenBack) {
    for (const int number : {0, 1})
        printed("history add " + night(number) + (number == 1 ? " --accept" : "") + flag_);
    EXPECT_THAT(printed("history accept 1" + flag_),
                HasSubstr("night 2 is accepted, too, and nights after that one are compared with that"));
    EXPECT_THAT(printed("history accept 2 --withdraw" + flag_), HasSubstr("night 2 of planted, 2026-01-02, is not accepted any more"));
    EXPECT_THAT(printed("history explain" + flag_), HasSubstr("since the accepted night of 2026-01-01"));
    EXPECT_EQ(run_program("history explain --fail-on-change" + flag_).exit_code, 0);
    EXPECT_THAT(printed("history accept 2 --withdraw" + flag_, 2), HasSubstr("which is not accepted"));
}

TEST_F(HistoryCommand, ThePageHasLinesAndFramesSideBySide) {
    for (int number = 0; number < 3; ++number)
        printed("history add " + night(number) + (number == 0 ? " --accept" : "") + flag_);
    printed("history explain --tables csv --out " + (folder_ / "page") + flag_);
    const std::string page = content_of(folder_ / "page/report.html");
    EXPECT_THAT(page, AllOf(HasSubstr("What changed since 2026-01-01"), HasSubstr("Before and after"),
                            HasSubstr("xenon on straight, night, aim -1 %, 13.2 V, driver, after 1.0 s"), HasSubstr("<svg"),
                            HasSubstr("as accepted")));
    EXPECT_EQ(std::filesystem::exists(folder_ / "page/history-reach_5lx_target_own_m.png"), true);
    EXPECT_THAT(content_of(folder_ / "page/tables/moved.csv"), HasSubstr("2026-01-03,inputs,xenon,\"straight, night"));
    const std::string anew = " --history " + (folder_ / "anew.db");
    printed("history add " + night(0) + " --accept" + anew);
    std::filesystem::copy(night(2), night(0), std::filesystem::copy_options::recursive | std::filesystem::copy_options::overwrite_existing);
    printed("history add " + night(0) + anew);
    EXPECT_THAT(printed("history explain" + anew), HasSubstr("The folder of the night of 2026-01-01 was written anew"));
    std::filesystem::remove_all(night(0));
    EXPECT_THAT(printed("history explain" + flag_), HasSubstr("The folder of the night of 2026-01-01 is gone"));
    EXPECT_THAT(printed("history show" + flag_), HasSubstr("gone: " + night(0)));
}

TEST_F(HistoryCommand, TidyCsvHasEveryReading) {
    for (int number = 0; number < 3; ++number)
        printed("history add " + night(number) + flag_);
    const std::vector<std::vector<std::string>> rows = csv_rows(printed("history export" + flag_));
    ASSERT_EQ(rows.size(), 1U + 3U * (24U + 4U)); // and four timed cells
    EXPECT_THAT(rows[0], testing::Contains("reading"));
    printed("history export --out " + (folder_ / "all.csv") + flag_);
    EXPECT_THAT(printed("history export --out " + (folder_ / "all.csv") + flag_, 2), HasSubstr("is there already"));
}

TEST_F(HistoryCommand, WhatCannotBeUsedGivesOneSentence) {
    EXPECT_THAT(printed("history explain" + flag_, 2),
                HasSubstr("history.db: is no file, expected a history; `fernlicht history add FOLDER` begins one"));
    EXPECT_THAT(printed("history add " + (folder_ / "none") + flag_, 2), HasSubstr("is no folder of a study"));
    EXPECT_FALSE(std::filesystem::exists(file_));
    printed("history add " + night(0) + flag_);
    EXPECT_THAT(printed("history explain 2027-01-01" + flag_, 2), HasSubstr("found '2027-01-01', expected last, a number or a date"));
    EXPECT_THAT(printed("history explain --study standard" + flag_, 2), HasSubstr("expected one of planted"));
    for (const char* action : {"show", "export"})
        EXPECT_THAT(printed(std::string("history ") + action + " --study standard" + flag_, 2), HasSubstr("expected one of planted"));
    EXPECT_THAT(printed("history prune" + flag_, 2), HasSubstr("found neither --keep-nights nor --before"));
    EXPECT_THAT(printed("history trend reach_5lx_target_own" + flag_, 2), HasSubstr("such as reach_5lx_target_own_m"));
    EXPECT_THAT(printed("history trend 'reach*' --only strait_xenon" + flag_, 2), HasSubstr("such as straight_xenon"));
    write_file(folder_ / "n1/INCOMPLETE", "");
    EXPECT_THAT(printed("history add " + night(1) + flag_, 2), HasSubstr("holds a study that did not end"));
    EXPECT_THAT(printed("history", 2), Not(HasSubstr("bug")));
    EXPECT_THAT(printed("history forget last", 2), HasSubstr("'forget' is no command of history, expected one of add, accept, show"));
    EXPECT_THAT(printed("history prune --keep-nights -1" + flag_, 2), HasSubstr("expected a whole number from 0 to 1000000"));
}

TEST_F(HistoryCommand, TheDefaultFileFollowsXdg) {
    const std::string home = "HOME=" + (folder_ / "home"), data = "XDG_DATA_HOME=" + (folder_ / "data");
    EXPECT_EQ(run_program("history add " + night(0), "env -u XDG_DATA_HOME " + home).exit_code, 0);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "home/.local/share/fernlicht/history.db"));
    EXPECT_EQ(run_program("history add " + night(0), "env " + home + " " + data).exit_code, 0);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "data/fernlicht/history.db"));
}

} // namespace
} // namespace fernlicht
