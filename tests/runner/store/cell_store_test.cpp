#include "runner/store/cell_store.h"

#include "runner/files/object_store.h"
#include "runner/store/store_upkeep.h"
#include "tests/runner/program.h"
#include "tests/trial.h"

#include <chrono>
#include <ctime>
#include <gmock/gmock.h>
#include <iomanip>
#include <sstream>

namespace fernlicht {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

namespace fs = std::filesystem;

constexpr double noon_s = 1'800'014'400.0; // 2027-01-15T12:00:00Z

struct CellStoreTest : testing::Test {
    TemporaryFolder folder;
    CellStore store{folder / "store"};
    const PackedFiles files{{"report.json", "{}"}, {"frames/a.png", std::string("\0\n\xff", 3)}, {"empty", ""}};

    static std::string key_of_cell(int number) { return std::string(31, 'a') + static_cast<char>('0' + number); }
    StoredCell keep(int number, const std::string& played = "2027-01-15T10:00:00Z", const std::string& study = "s") {
        const std::string key = key_of_cell(number);
        PackedFiles own = files;
        own["number"] = std::string(1000, static_cast<char>('0' + number));
        const fs::path lamp = folder / (study + "/lamp.ies");
        fs::create_directories(lamp.parent_path());
        if (!fs::exists(lamp))
            write_file(lamp, "lamp of " + study);
        FilesRead opened;
        read_file(lamp, opened);
        store.keep({key, study, "cell " + key.substr(31), played, {{InputKind::lamp, "lamp.ies", opened.front().xxh128}}, {}, 0, {}}, own,
                   opened);
        set_used(key, played);
        return *store.find(key);
    }
    void set_used(const std::string& key, const std::string& utc) const {
        std::tm time{};
        std::istringstream(utc) >> std::get_time(&time, "%Y-%m-%dT%H:%M:%SZ");
        fs::last_write_time(store.folder() / "cells/aa" / (key.substr(2) + ".json"),
                            fs::file_time_type::clock::from_sys(std::chrono::system_clock::from_time_t(::timegm(&time))));
    }
    static void flip_bit(const fs::path& file) {
        std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
        stream.seekg(3);
        const char byte = static_cast<char>(stream.get() ^ 4);
        stream.seekp(3);
        stream.put(byte);
    }
};

TEST_F(CellStoreTest, GivesBackWhatItKeeps) {
    EXPECT_FALSE(store.find(key_of_cell(1)));
    const StoredCell kept = keep(1);
    EXPECT_EQ(kept.cell, "cell 1");
    PackedFiles expected = files;
    expected["number"] = std::string(1000, '1');
    EXPECT_EQ(store.load(kept), expected);
    ASSERT_THAT(kept.files, SizeIs(1));
    EXPECT_EQ(get_object(store.folder(), kept.files[0].second, "lamp"), "lamp of s");
    EXPECT_THAT(store.list(), SizeIs(1));
    write_files(store.load(kept), folder / "out");
    EXPECT_EQ(files_below(folder / "out"), expected);
}

TEST_F(CellStoreTest, WhatIsDamagedIsFoundAndTakenOut) {
    const StoredCell flipped = keep(1), gone = keep(2), halved = keep(3), whole = keep(4);
    flip_bit(object_path(store.folder(), flipped.object));
    fs::remove(object_path(store.folder(), gone.object));
    const fs::path entry = store.folder() / "cells/aa" / (halved.key.substr(2) + ".json");
    fs::resize_file(entry, fs::file_size(entry) / 2);
    EXPECT_THAT(tests::refusal_of([&] { store.load(flipped); }), HasSubstr("is not the cell that was kept: its hash is "));
    EXPECT_FALSE(store.find(gone.key));
    EXPECT_FALSE(store.find(halved.key));
    EXPECT_EQ(store.damage(flipped.key), "its results are missing or damaged");
    EXPECT_EQ(store.damage(gone.key), "its results are missing or damaged");
    EXPECT_EQ(store.damage(halved.key), "its entry is damaged");
    EXPECT_EQ(store.damage(whole.key), "");
    EXPECT_THAT(verify_store(store), SizeIs(4)) << "object and cell of the first, the second's cell, the third's entry";
    EXPECT_FALSE(store.find(flipped.key));
    EXPECT_TRUE(store.find(whole.key));
    EXPECT_THAT(verify_store(store), IsEmpty());
    EXPECT_EQ(keep(1).object, flipped.object) << "computed anew";
}

TEST_F(CellStoreTest, NoBitOfAnEntryIsReadFlipped) {
    const StoredCell kept = keep(1);
    const fs::path entry = store.folder() / "cells/aa" / (kept.key.substr(2) + ".json");
    const std::string text = content_of(entry);
    for (std::size_t at = 0; at < text.size(); ++at) {
        std::string flipped = text;
        flipped[at] = static_cast<char>(flipped[at] ^ 1);
        write_file(entry, flipped);
        EXPECT_FALSE(store.find(kept.key)) << at;
    }
    write_file(entry, text);
    EXPECT_EQ(store.find(kept.key)->inputs, kept.inputs);
}

/// The history plays lamps of earlier nights out of the store.
TEST_F(CellStoreTest, ACellWhoseInputIsGoneIsPlayedAgain) {
    const StoredCell kept = keep(1);
    flip_bit(object_path(store.folder(), kept.files[0].second));
    std::vector<std::string> told;
    for (const StoreDamage& one : verify_store(store))
        told.push_back(one.what + ": " + one.why);
    EXPECT_THAT(told,
                ElementsAre("object " + kept.files[0].second + ": its bytes are not those that were kept",
                            "cell cell 1 of s: the input file lamp.ies that is kept with it is missing or damaged; it is played again "
                            "when it is asked for"));
    EXPECT_FALSE(store.find(kept.key));
    EXPECT_EQ(get_object(store.folder(), keep(1).files[0].second, "lamp"), "lamp of s");
    const std::string object = put_object(store.folder(), "of a cell that was played again since");
    flip_bit(object_path(store.folder(), object));
    EXPECT_THAT(verify_store(store), testing::IsEmpty());
    EXPECT_FALSE(fs::exists(object_path(store.folder(), object)));
}

TEST_F(CellStoreTest, IsBuiltAmongNobodysFiles) {
    fs::create_directory(folder / "theirs");
    write_file(folder / "theirs/thesis.txt", "text");
    EXPECT_THAT(tests::refusal_of([&] { CellStore(folder / "theirs").new_workplace("a"); }),
                HasSubstr("is a folder with other files in it"));
    EXPECT_EQ(files_below(folder / "theirs").size(), 1U);
    fs::create_directories(folder / "volume/lost+found");
    CellStore(folder / "volume").new_workplace("a");
}

TEST_F(CellStoreTest, PrunesByAgeSizeAndStudy) {
    keep(1, "2027-01-01T12:00:00Z", "old");
    keep(2, "2027-01-10T12:00:00Z");
    keep(3, "2027-01-14T12:00:00Z");
    keep(4, "2099-01-01T00:00:00Z"); // by a clock that was wrong: it has no age
    const auto left = [&] {
        std::vector<std::string> cells;
        for (const StoredCell& cell : store.list())
            cells.push_back(cell.cell);
        return cells;
    };
    const Pruned dry = prune_store(store, {.older_than_s = 86400.0 * 3, .dry = true}, noon_s);
    EXPECT_EQ(dry.cells, 2U);
    EXPECT_THAT(left(), SizeIs(4));
    EXPECT_EQ(prune_store(store, {.study = "o*"}, noon_s).files, 2U) << "its results, and the lamp that no other had";
    EXPECT_THAT(left(), ElementsAre("cell 2", "cell 3", "cell 4"));
    const Pruned old = prune_store(store, {.older_than_s = 86400.0 * 3}, noon_s);
    EXPECT_EQ(old.cells, 1U);
    EXPECT_EQ(old.files, 1U) << "others have its lamp, too";
    const std::uint64_t one = store.list().front().bytes;
    EXPECT_EQ(prune_store(store, {.at_most_bytes = one + 10}, noon_s).cells, 1U);
    EXPECT_THAT(left(), ElementsAre("cell 4"));
    EXPECT_THAT(verify_store(store), IsEmpty());
}

/// What a night takes from the store each time stays, however long ago it was played.
TEST_F(CellStoreTest, PrunesByUse) {
    const StoredCell used = keep(1, "2026-01-01T12:00:00Z"), other = keep(2, "2026-01-10T12:00:00Z");
    EXPECT_EQ(store.list().front().key, used.key);
    store.load(used);
    EXPECT_EQ(store.list().front().key, other.key);
    const double now_s = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
    EXPECT_NEAR(store.find(used.key)->used_s, now_s, 60.0);
    EXPECT_EQ(prune_store(store, {.older_than_s = 3600.0}, now_s).cells, 1U);
    EXPECT_TRUE(store.find(used.key));
}

/// Of 1000 cells with a lamp each the lamps are a part of what a disk holds.
TEST_F(CellStoreTest, CountsInputFilesOnce) {
    const std::uint64_t cell = keep(1, "2027-01-01T12:00:00Z", "a").bytes, lamp = std::string_view("lamp of a").size();
    keep(2, "2027-01-02T12:00:00Z", "b");
    keep(3, "2027-01-03T12:00:00Z", "b");
    EXPECT_EQ(prune_store(store, {.at_most_bytes = 3 * cell + 2 * lamp}, noon_s).cells, 0U);
    const Pruned pruned = prune_store(store, {.at_most_bytes = 3 * cell + 2 * lamp - 1}, noon_s);
    EXPECT_EQ(pruned.cells, 1U);
    EXPECT_EQ(pruned.bytes_left, 2 * cell + lamp);
}

/// A cell that writes nothing for hours is still being played; one whose process was killed is not.
TEST_F(CellStoreTest, WhatIsBeingPlayedStaysAndWhatWasLeftGoes) {
    const auto old = fs::file_time_type::clock::now() - std::chrono::hours(3);
    const auto leave = [&](const fs::path& place) {
        write_file(place / "frame.png", "a frame");
        for (const fs::path& path : {place / "frame.png", place})
            fs::last_write_time(path, old);
    };
    const Workplace first = store.new_workplace(key_of_cell(1)), second = store.new_workplace(key_of_cell(1));
    EXPECT_NE(first.folder(), second.folder()) << "of one key, also where every process has the number 1";
    leave(first.folder());
    const fs::path left = store.folder() / "playing/left-by-one-that-was-killed";
    fs::create_directories(left);
    leave(left);
    EXPECT_EQ(prune_store(store, {}, noon_s).files, 1U);
    EXPECT_FALSE(fs::exists(left));
    EXPECT_TRUE(fs::exists(first.folder() / "frame.png"));
    store.note_failure(key_of_cell(9), "found no lamp");
    fs::last_write_time(store.folder() / "failed" / key_of_cell(9), old);
    prune_store(store, {}, noon_s);
    EXPECT_EQ(store.failure(key_of_cell(9)), "found no lamp") << "for whoever collects in the morning";
}

/// Whatever else lies there is somebody's.
TEST_F(CellStoreTest, TakesOutNothingThatNoStoreWrote) {
    keep(1, "2027-01-01T12:00:00Z");
    const std::vector<fs::path> others{"cells/straight/report.json", "cells/foo/p.json", "objects/ab/thesis.txt", "cells/ab/thesis.json",
                                       "note"};
    for (const fs::path& other : others) {
        fs::create_directories((store.folder() / other).parent_path());
        write_file(store.folder() / other, "of somebody");
        fs::last_write_time(store.folder() / other, fs::file_time_type::clock::now() - std::chrono::hours(1000));
    }
    EXPECT_THAT(verify_store(store), IsEmpty());
    EXPECT_EQ(prune_store(store, {.older_than_s = 0.0}, noon_s).files, 2U) << "the cell's results and its lamp";
    for (const fs::path& other : others)
        EXPECT_TRUE(fs::exists(store.folder() / other)) << other;
}

TEST_F(CellStoreTest, ManyWritersAtOnceLeaveWholeCells) {
    std::vector<::pid_t> writers;
    for (int w = 0; w < 6; ++w)
        if (const ::pid_t pid = ::fork(); pid == 0) {
            try {
                for (int round = 0; round < 20; ++round)
                    for (int cell = 0; cell < 5; ++cell)
                        keep(cell);
            } catch (const std::exception& error) {
                std::fprintf(stderr, "%s\n", error.what());
                ::_exit(1);
            }
            ::_exit(0);
        } else
            writers.push_back(pid);
    std::size_t read = 0;
    for (int round = 0; round < 50; ++round) {
        for (int cell = 0; cell < 5; ++cell)
            if (const auto found = store.find(key_of_cell(cell))) {
                EXPECT_EQ(store.load(*found).at("number"), std::string(1000, static_cast<char>('0' + cell)));
                ++read;
            }
        if (round % 10 == 0)
            prune_store(store, {.study = "other"}, noon_s);
    }
    for (const ::pid_t pid : writers) {
        int status = 0;
        ::waitpid(pid, &status, 0);
        EXPECT_EQ(status, 0);
    }
    EXPECT_THAT(store.list(), SizeIs(5));
    EXPECT_THAT(verify_store(store), IsEmpty());
}

TEST_F(CellStoreTest, AFailureIsKeptUntilTheCellIs) {
    fs::create_directories(store.folder());
    store.note_failure(key_of_cell(1), "no road");
    EXPECT_EQ(store.failure(key_of_cell(1)), "no road");
    keep(1);
    EXPECT_EQ(store.failure(key_of_cell(1)), "");
}

TEST_F(CellStoreTest, SaysThatItCannotBeWritten) {
    EXPECT_EQ(store.refuses_writing(), "");
    const CellStore none(tests::written("a file", "") / "store");
    EXPECT_THAT(none.refuses_writing(), HasSubstr("cannot be created"));
}

TEST(PackedFolder, RefusesWhatItDidNotMake) {
    const std::string text = packed({{"a", "one"}, {"b/c", "two"}});
    EXPECT_EQ(unpacked(text, "x").at("b/c"), "two");
    for (std::size_t length = 0; length < text.size(); ++length)
        EXPECT_THROW(unpacked(text.substr(0, length), "x"), InputError) << length;
    EXPECT_THAT(tests::refusal_of([&] { unpacked(text + "!", "x"); }), HasSubstr("found 1 bytes behind the last file"));
    std::string outside = text;
    outside.replace(outside.find("b/c"), 3, "../");
    EXPECT_THAT(tests::refusal_of([&] { unpacked(outside, "x"); }), HasSubstr("a name below the folder"));
}

} // namespace
} // namespace fernlicht
