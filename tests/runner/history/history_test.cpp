// The file of nights: what goes in comes back, from every version, from two writers, and where the disk or the file is odd.
#include "runner/history/database.h"
#include "runner/history/history.h"
#include "tests/runner/program.h"
#include "tests/trial.h"

#include <algorithm>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <linux/magic.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fernlicht {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using tests::new_folder;
using tests::refusal_of;

NightReadings odd_readings() {
    return {{"a", Value(0.1 + 0.2)},
            {"b", Value(4.9e-324)},
            {"c", Value(-1.7976931348623157e308)},
            {"d", Value::at_least(200.0)},
            {"e", Value::at_most(1.0 / 3.0)},
            {"f", Value::not_measured("beyond the 'grid'")},
            {"g", Value(3.0)}};
}

Night night_of(int day, const std::string& study = "standard", double light = 1.0) {
    Night night;
    night.study = study;
    night.played_utc = fmt::format("2026-01-{:02}T02:00:00Z", day);
    night.folder = fmt::format("/nights/{}/{}", study, day);
    night.machine = {{InputKind::device, "driver", "Mesa 22.3.6"}};
    night.decide = {"reach*", "glare*"};
    for (const char* name : {"straight_xenon", "straight_halogen"}) {
        NightCell cell;
        cell.name = name;
        cell.drive = "straight";
        cell.lamp = std::string(name).substr(9);
        cell.technique = "photometric";
        cell.condition = "night, aim -1 %";
        cell.inputs = std::make_shared<CellInputs>(
            CellInputs{{InputKind::lamp, cell.lamp + ".ies", "0123"}, {InputKind::program, "renderer", "4567"}});
        NightReadings readings = odd_readings();
        readings["g"] = Value(3.0 * light);
        cell.readings = std::make_shared<NightReadings>(readings);
        cell.frame_s = cell.lamp == "xenon" ? std::optional(0.0123) : std::nullopt;
        night.cells.push_back(cell);
    }
    night.cells[1].failed = "the lamp's fault";
    return night;
}

void expect_same(const Night& a, const Night& b) {
    EXPECT_EQ(std::tie(a.study, a.played_utc, a.folder, a.machine, a.decide, a.note, a.accepted),
              std::tie(b.study, b.played_utc, b.folder, b.machine, b.decide, b.note, b.accepted));
    ASSERT_EQ(a.cells.size(), b.cells.size());
    for (std::size_t i = 0; i < a.cells.size(); ++i) {
        const NightCell &one = a.cells[i], &other = b.cells[i];
        EXPECT_EQ(std::tie(one.name, one.drive, one.lamp, one.technique, one.condition, one.failed, one.frame_s),
                  std::tie(other.name, other.drive, other.lamp, other.technique, other.condition, other.failed, other.frame_s));
        EXPECT_EQ(*one.inputs, *other.inputs);
        EXPECT_EQ(*one.readings, *other.readings);
    }
}

TEST(HistoryFile, WhatGoesInComesBackToTheLastBit) {
    const std::filesystem::path file = new_folder() / "below" / "history.db";
    {
        History history(file, History::For::collecting);
        EXPECT_EQ(history.journal(), "wal");
        Night replayed = night_of(2);
        for (NightCell& cell : replayed.cells)
            if (cell.name == "straight_xenon")
                cell.with_earlier_inputs = std::make_shared<NightReadings>(NightReadings{{"a", Value(7.0)}});
        EXPECT_EQ(history.add(replayed).number, 1);
        EXPECT_EQ(history.add(night_of(1)).number, 2);
        EXPECT_EQ(history.add(night_of(3, "other")).number, 3);
        EXPECT_FALSE(history.add(night_of(2)).is_new) << "the same night again";
        history.accept(2, "as bought");
    }
    const History history(file, History::For::reading);
    const std::vector<Night> nights = history.nights("standard");
    ASSERT_EQ(nights.size(), 2U);
    Night first = night_of(1);
    first.accepted = true;
    first.note = "as bought";
    expect_same(nights[0], night_of(2)); // as they were added
    expect_same(nights[1], first);
    EXPECT_EQ(*nights[0].cells[0].with_earlier_inputs, (NightReadings{{"a", Value(7.0)}}));
    EXPECT_EQ(nights[1].cells[0].with_earlier_inputs, nullptr);
    // Equal readings and inputs lie there once.
    EXPECT_EQ(nights[0].cells[0].readings, nights[1].cells[0].readings);
    EXPECT_EQ(nights[0].cells[0].inputs, nights[1].cells[0].inputs);
    EXPECT_EQ(history.nights().size(), 3U);
    EXPECT_THAT(refusal_of([&] { History(file, History::For::collecting).accept(9, ""); }), HasSubstr("has no night 9"));
}

/// A file as each version of the tables left it, with one night in it. A new version adds its own; what stands here is never changed.
const std::vector<const char*> files_by_version{
    "PRAGMA user_version=0",
    R"(
CREATE TABLE nights (number INTEGER PRIMARY KEY, study TEXT NOT NULL, played_utc TEXT NOT NULL, folder TEXT NOT NULL, accepted INTEGER NOT NULL DEFAULT 0,
    note TEXT NOT NULL DEFAULT '', machine INTEGER NOT NULL REFERENCES input_sets, decide TEXT NOT NULL, UNIQUE (study, played_utc, folder));
CREATE TABLE input_sets (number INTEGER PRIMARY KEY, hash TEXT NOT NULL UNIQUE);
CREATE TABLE inputs (input_set INTEGER NOT NULL REFERENCES input_sets, place INTEGER NOT NULL, kind TEXT NOT NULL, name TEXT NOT NULL, hash TEXT NOT NULL,
    PRIMARY KEY (input_set, place)) WITHOUT ROWID;
CREATE TABLE results (number INTEGER PRIMARY KEY, hash TEXT NOT NULL UNIQUE);
CREATE TABLE readings (result INTEGER NOT NULL REFERENCES results, name TEXT NOT NULL, bound TEXT NOT NULL, figure REAL, why_not TEXT NOT NULL,
    PRIMARY KEY (result, name)) WITHOUT ROWID;
CREATE TABLE cells (night INTEGER NOT NULL REFERENCES nights, place INTEGER NOT NULL, name TEXT NOT NULL, drive TEXT NOT NULL, lamp TEXT NOT NULL,
    technique TEXT NOT NULL, condition TEXT NOT NULL, failed TEXT NOT NULL, input_set INTEGER NOT NULL REFERENCES input_sets,
    result INTEGER NOT NULL REFERENCES results, result_with_earlier_inputs INTEGER REFERENCES results, frame_s REAL,
    PRIMARY KEY (night, place)) WITHOUT ROWID;
CREATE INDEX cells_by_result ON cells (result);
CREATE VIEW every_reading AS
    SELECT n.study, n.number AS night, n.played_utc, n.accepted, c.name AS cell, c.drive, c.lamp, c.technique, c.condition,
           r.name AS reading, r.bound, r.figure, r.why_not
    FROM nights n JOIN cells c ON c.night = n.number JOIN readings r ON r.result = c.result;
INSERT INTO input_sets VALUES (1, 'x'), (2, 'y');
INSERT INTO inputs VALUES (1, 0, 'device', 'driver', 'Mesa 22.3.6'), (2, 0, 'lamp', 'xenon.ies', '0123');
INSERT INTO results VALUES (1, 'z');
INSERT INTO readings VALUES (1, 'a', 'number', 0.30000000000000004, ''), (1, 'd', 'at_least', 200.0, ''), (1, 'f', 'not_measured', NULL, 'beyond');
INSERT INTO nights VALUES (1, 'standard', '2025-12-31T02:00:00Z', '/nights/0', 1, 'old', 1, 'reach*' || char(10));
INSERT INTO cells VALUES (1, 0, 'straight_xenon', 'straight', 'xenon', 'photometric', 'night', '', 2, 1, NULL, 0.01);
PRAGMA application_id=1717924462; PRAGMA user_version=1)",
};

TEST(HistoryFile, EveryEarlierVersionIsBroughtUpToDate) {
    ASSERT_EQ(files_by_version.size(), history_steps().size() + 1) << "each version of the tables has its file here";
    for (std::size_t version = 0; version < files_by_version.size(); ++version)
        for (const bool reads_first : {false, true}) {
            const std::filesystem::path file = new_folder() / "history.db";
            Database(file, Database::For::writing).run(files_by_version[version]);
            if (reads_first && version > 0) {
                EXPECT_EQ(History(file, History::For::reading).nights().size(), 1U) << version;
            }
            History history(file, History::For::collecting);
            EXPECT_TRUE(history.add(night_of(1)).is_new) << version;
            const std::vector<Night> nights = history.nights();
            ASSERT_EQ(nights.size(), version == 0 ? 1U : 2U);
            expect_same(nights.back(), night_of(1));
            if (version == 0)
                continue;
            EXPECT_TRUE(nights[0].accepted);
            EXPECT_EQ(nights[0].decide, (std::vector<std::string>{"reach*"}));
            EXPECT_EQ(nights[0].machine, (CellInputs{{InputKind::device, "driver", "Mesa 22.3.6"}}));
            EXPECT_EQ(*nights[0].cells[0].readings,
                      (NightReadings{{"a", Value(0.1 + 0.2)}, {"d", Value::at_least(200.0)}, {"f", Value::not_measured("beyond")}}));
            EXPECT_EQ(nights[0].cells[0].frame_s, 0.01);
        }
}

TEST(HistoryFile, AMigrationIsAllOrNothing) {
    const std::filesystem::path file = new_folder() / "m.db";
    Database database(file, Database::For::writing);
    const std::vector<const char*> one{"CREATE TABLE a (x); INSERT INTO a VALUES (1)"},
        broken{one[0], "ALTER TABLE a ADD COLUMN y DEFAULT 5", "INSERT INTO nowhere VALUES (1)"},
        three{one[0], "ALTER TABLE a ADD COLUMN y DEFAULT 5", "UPDATE a SET y = x + y"};
    migrate(database, 77, one);
    EXPECT_THAT(refusal_of<std::exception>([&] { migrate(database, 77, broken); }), HasSubstr("nowhere"));
    EXPECT_EQ(database.whole_of("PRAGMA user_version"), 1);
    EXPECT_EQ(database.whole_of("SELECT count(*) FROM pragma_table_info('a')"), 1);
    migrate(database, 77, three);
    migrate(database, 77, three);
    EXPECT_EQ(database.whole_of("PRAGMA user_version"), 3);
    EXPECT_EQ(database.whole_of("SELECT y FROM a"), 6);
    EXPECT_THAT(refusal_of([&] { migrate(database, 77, one); }),
                AllOf(HasSubstr("is a history of version 3"), HasSubstr("a newer fernlicht wrote it")));
    EXPECT_THAT(refusal_of([&] { migrate(database, 78, three); }), HasSubstr("is a database of another program"));
}

TEST(HistoryFile, WhatIsNoHistoryIsRefusedInOneSentence) {
    const std::filesystem::path folder = new_folder();
    EXPECT_THAT(refusal_of([&] { History(folder / "none.db", History::For::reading); }),
                HasSubstr("none.db: is no file, expected a history"));
    for (const auto what : {History::For::reading, History::For::collecting}) {
        const std::filesystem::path text = tests::written("text.db", std::string(5000, 'x'), folder);
        EXPECT_THAT(refusal_of([&] { History(text, what); }), HasSubstr("text.db: is damaged or no database"));
        const std::filesystem::path foreign = folder / "foreign.db";
        Database(foreign, Database::For::writing).run("CREATE TABLE IF NOT EXISTS songs (title)");
        EXPECT_THAT(refusal_of([&] { History(foreign, what); }), HasSubstr("is a database of another program"));
        const std::filesystem::path newer = new_folder() / "newer.db";
        const History made(newer, History::For::collecting);
        Database(newer, Database::For::writing).run("PRAGMA user_version=99");
        EXPECT_THAT(refusal_of([&] { History(newer, what); }), HasSubstr("is a history of version 99"));
        Database(newer, Database::For::writing).run("PRAGMA user_version=-7");
        EXPECT_THAT(refusal_of([&] { History(newer, what); }), HasSubstr("is a history of version -7"));
    }
    // The head is whole, what it leads to is not.
    const std::filesystem::path damaged = folder / "damaged.db";
    {
        History history(damaged, History::For::collecting);
        for (int day = 1; day < 20; ++day)
            history.add(night_of(day, "standard", day));
    }
    std::fstream bytes(damaged, std::ios::in | std::ios::out | std::ios::binary);
    for (std::streamoff at = 4096; at < static_cast<std::streamoff>(std::filesystem::file_size(damaged)) - 16; at += 64)
        bytes.seekp(at).write("damaged damaged damaged damaged damaged damaged damaged damaged", 60);
    bytes.close();
    EXPECT_THAT(refusal_of([&] { History(damaged, History::For::reading).nights(); }), HasSubstr("damaged.db: is damaged"));
}

/// Adds nights from a process of its own; its exit code tells whether that went well.
::pid_t add_in_a_process(const std::filesystem::path& file, int first_day, const std::string& study) {
    const ::pid_t child = ::fork();
    if (child != 0)
        return child;
    try {
        for (int day = first_day; day < first_day + 10; ++day)
            History(file, History::For::collecting).add(night_of(day, study, day));
        std::_Exit(0);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        std::_Exit(1);
    }
}

void expect_both_land(const std::filesystem::path& file, const std::string& journal) {
    const ::pid_t writers[] = {add_in_a_process(file, 1, "standard"), add_in_a_process(file, 11, "standard"),
                               add_in_a_process(file, 1, "other")};
    for (const ::pid_t writer : writers) {
        int status = 0;
        ASSERT_EQ(::waitpid(writer, &status, 0), writer);
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    }
    const std::vector<Night> nights = History(file, History::For::reading).nights();
    EXPECT_EQ(nights.size(), 30U);
    for (const Night& night : nights)
        expect_same(night, night_of(std::stoi(night.played_utc.substr(8, 2)), night.study, std::stoi(night.played_utc.substr(8, 2))));
    EXPECT_EQ(History(file, History::For::collecting).journal(), journal);
    EXPECT_EQ(Database(file, Database::For::reading).text_of("PRAGMA integrity_check"), "ok");
}

TEST(HistoryFile, NightsThatWriteAtOnceAllLand) { expect_both_land(new_folder() / "history.db", "wal"); }

/// A folder where the index of the write-ahead log should lie: SQLite switches, and its first transaction fails, as on a network disk.
TEST(HistoryFile, WhereWriteAheadLoggingDoesNotWorkARollbackJournalDoes) {
    const std::filesystem::path folder = new_folder();
    std::filesystem::create_directory(folder / "new.db-shm");
    expect_both_land(folder / "new.db", "delete");
    // The second process leaves the journal alone where the first one found out, and may be writing.
    std::filesystem::create_directory(folder / "begun.db-shm");
    const Database first(folder / "begun.db", Database::For::writing);
    const std::string begun = content_of(folder / "begun.db");
    const Database second(folder / "begun.db", Database::For::writing);
    EXPECT_TRUE(content_of(folder / "begun.db") == begun);
    // A file that was made elsewhere and moved here.
    History(folder / "moved.db", History::For::collecting).add(night_of(1));
    std::filesystem::create_directory(folder / "moved.db-shm");
    EXPECT_EQ(History(folder / "moved.db", History::For::reading).nights().size(), 1U);
    History moved(folder / "moved.db", History::For::collecting);
    EXPECT_EQ(moved.journal(), "delete");
    EXPECT_TRUE(moved.add(night_of(2)).is_new);
    EXPECT_EQ(moved.nights().size(), 2U);
}

TEST(HistoryFile, OfAFileSystemThatSeveralMachinesMayMountNoneIsLocal) {
    for (const std::int64_t local :
         std::vector<std::int64_t>{EXT4_SUPER_MAGIC, XFS_SUPER_MAGIC, BTRFS_SUPER_MAGIC, TMPFS_MAGIC, OVERLAYFS_SUPER_MAGIC})
        EXPECT_TRUE(is_local_file_system(local)) << local;
    for (const std::int64_t shared :
         std::vector<std::int64_t>{NFS_SUPER_MAGIC, SMB_SUPER_MAGIC, AFS_SUPER_MAGIC, FUSE_SUPER_MAGIC, V9FS_MAGIC, CEPH_SUPER_MAGIC})
        EXPECT_FALSE(is_local_file_system(shared)) << shared;
    constexpr std::int64_t lustre = 0x0bd00bd0;
    EXPECT_FALSE(is_local_file_system(lustre));
}

/// A study whose cells failed stands there with them; gone on with, it stands there as it is then, and once.
TEST(HistoryFile, ANightThatWasGoneOnWithIsWrittenAnew) {
    History history(new_folder() / "history.db", History::For::collecting);
    Night red = night_of(1);
    red.cells.front().failed = "was killed by SIGSEGV";
    EXPECT_EQ(history.add(red).number, 1);
    EXPECT_EQ(history.nights().front().cells.front().failed, "was killed by SIGSEGV");
    const History::Added whole = history.add(night_of(1));
    EXPECT_TRUE(whole.is_new);
    EXPECT_EQ(whole.number, 1);
    ASSERT_EQ(history.nights().size(), 1U);
    expect_same(history.nights().front(), night_of(1));
    EXPECT_FALSE(history.add(night_of(1)).is_new);
}

TEST(HistoryFile, AReaderSeesWholeNightsWhileOneIsAdded) {
    const std::filesystem::path file = new_folder() / "history.db";
    History writer(file, History::For::collecting);
    writer.add(night_of(1));
    const History reader(file, History::For::reading);
    Database other(file, Database::For::writing);
    {
        Transaction half(other);
        other.run("DELETE FROM cells");
        EXPECT_EQ(reader.nights().front().cells.size(), 2U);
    } // undone
    EXPECT_EQ(writer.nights().front().cells.size(), 2U);
}

TEST(HistoryFile, PruningKeepsAcceptedNightsAndWhatTheyNeed) {
    const std::filesystem::path file = new_folder() / "history.db";
    History history(file, History::For::collecting);
    for (int day = 1; day <= 10; ++day)
        history.add(night_of(day, "standard", day));
    history.add(night_of(1, "other"));
    history.accept(2, "");
    EXPECT_EQ(history.prune(4, "", true).nights.size(), 5U);
    EXPECT_EQ(history.nights().size(), 11U);
    const History::Pruned pruned = history.prune(4, "", false);
    EXPECT_EQ(pruned.nights.size(), 5U);
    EXPECT_EQ(pruned.kept_accepted, 1U);
    EXPECT_EQ(pruned.nights.front().played_utc, "2026-01-01T02:00:00Z");
    const std::vector<Night> left = history.nights("standard");
    ASSERT_EQ(left.size(), 5U);
    Night accepted = night_of(2, "standard", 2);
    accepted.accepted = true;
    expect_same(left.front(), accepted);
    Database database(file, Database::For::reading);
    EXPECT_EQ(database.whole_of("SELECT count(*) FROM results"), 6); // of five nights and the other study's
    EXPECT_EQ(database.whole_of("SELECT count(DISTINCT result) FROM readings"), 6);
    EXPECT_EQ(history.prune(std::nullopt, "2026-01-09", false).nights.size(), 3U) << "two of January 7 and 8, and the other study's";
    EXPECT_EQ(history.nights().size(), 3U);
}

} // namespace
} // namespace fernlicht
