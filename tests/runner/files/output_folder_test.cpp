#include "runner/commands/run_files.h"
#include "runner/files/output_folder.h"
#include "runner/findings/report.h"
#include "scenarios/values/errors.h"
#include "tests/runner/sample_report.h"

#include <csignal>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct OutputFolderTest : testing::Test {
    fs::path root = fs::path(testing::TempDir()) / ("fernlicht-output-" + std::to_string(::getpid()));
    OutputFolderTest() { fs::create_directories(root); }
    ~OutputFolderTest() override {
        std::error_code ignored;
        fs::permissions(root, fs::perms::owner_all, ignored);
        fs::remove_all(root, ignored);
    }
    static std::string refusal(const fs::path& folder) {
        try {
            OutputFolder taken(folder);
        } catch (const InputError& error) {
            return std::string("input: ") + error.what();
        } catch (const DeviceError& error) {
            return std::string("device: ") + error.what();
        }
        return "taken";
    }
    static void put(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }
};

TEST_F(OutputFolderTest, MarksUntilFinished) {
    OutputFolder folder(root / "a" / "b");
    EXPECT_TRUE(is_marked_incomplete(folder.path()));
    folder.finish();
    EXPECT_TRUE(fs::is_directory(root / "a" / "b"));
    EXPECT_FALSE(is_marked_incomplete(folder.path()));
}

TEST_F(OutputFolderTest, TakesAnEmptyFolder) {
    fs::create_directories(root / "empty");
    EXPECT_EQ(refusal(root / "empty"), "taken");
}

TEST_F(OutputFolderTest, RefusesWhatItDidNotMake) {
    fs::create_directories(root / "photos");
    put(root / "photos" / "cat.jpg", "meow");
    EXPECT_THAT(refusal(root / "photos"), HasSubstr("input: " + (root / "photos").string() + ": --out: is not empty (it holds 'cat.jpg')"));
    EXPECT_EQ(std::distance(fs::directory_iterator(root / "photos"), {}), 1) << "nothing may be added";
}

TEST_F(OutputFolderTest, RefusesAnotherRun) {
    fs::create_directories(root / "run");
    put(root / "run" / "report.json", "{}");
    EXPECT_THAT(refusal(root / "run"), HasSubstr("holds another run"));
    EXPECT_EQ(fs::file_size(root / "run" / "report.json"), 2U);
    OutputFolder interrupted(root / "interrupted");
    EXPECT_THAT(refusal(root / "interrupted"), HasSubstr("holds a run that did not end"));
}

TEST_F(OutputFolderTest, GoesOnOnlyWithARunThatDidNotEnd) {
    const auto why = [&](const char* name) {
        try {
            OutputFolder::left_incomplete(root / name);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("taken");
    };
    EXPECT_THAT(why("nowhere"), HasSubstr("--out: there is no such folder"));
    fs::create_directories(root / "empty");
    EXPECT_THAT(why("empty"), HasSubstr("holds nothing that was interrupted"));
    OutputFolder interrupted(root / "interrupted");
    EXPECT_EQ(why("interrupted"), "taken");
}

TEST_F(OutputFolderTest, RefusesAFile) {
    put(root / "file", "text");
    EXPECT_THAT(refusal(root / "file"), HasSubstr("is not a folder"));
    EXPECT_THAT(refusal(root / "file" / "below"), HasSubstr("input: "));
}

TEST_F(OutputFolderTest, RefusesAReadOnlyPlace) {
    // /proc refuses new folders even to root, for whom permissions do not count.
    EXPECT_THAT(refusal("/proc/fernlicht"), HasSubstr("input: /proc/fernlicht: --out: cannot be made"));
    if (::geteuid() == 0)
        return;
    fs::permissions(root, fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_THAT(refusal(root / "new"), HasSubstr("input: "));
}

TEST_F(OutputFolderTest, DefaultNameIsPlainAndNew) {
    const fs::path cwd = fs::current_path();
    fs::current_path(root);
    const fs::path first = default_output_folder("../Country road: <S>", "2024-11-21T19:30:00Z");
    EXPECT_EQ(first, "out/Country-road-S-20241121T193000Z");
    fs::create_directories(first);
    EXPECT_EQ(default_output_folder("../Country road: <S>", "2024-11-21T19:30:00Z"), "out/Country-road-S-20241121T193000Z-2");
    EXPECT_EQ(default_output_folder("", "2024-11-21T19:30:00Z"), "out/drive-20241121T193000Z");
    EXPECT_LT(default_output_folder(std::string(5000, 'x'), "2024-11-21T19:30:00Z").string().size(), 200U);
    fs::current_path(cwd);
}

/// In a process of its own, as the limit cannot be lifted again and the signal would end the tests.
TEST_F(OutputFolderTest, FullDiskKeepsWhatWasDone) {
    const fs::path folder = root / "full";
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        std::signal(SIGXFSZ, SIG_IGN); // then write() fails with EFBIG, as with ENOSPC on a full disk
        const rlimit limit{4096, 4096};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        try {
            OutputFolder output(folder);
            write_report(tests::sample_report(10), output.path());
            output.finish();
        } catch (const DeviceError& error) {
            const std::string text = error.what();
            const bool one_sentence =
                text.find('\n') == std::string::npos && text.find("report.json: cannot be written: ") != std::string::npos;
            ::_exit(one_sentence ? 3 : 4);
        } catch (...) {
            ::_exit(5);
        }
        ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 3);
    EXPECT_TRUE(is_marked_incomplete(folder));
    EXPECT_TRUE(fs::exists(folder / "readings.csv")) << "the small files were done and stay";
    EXPECT_TRUE(fs::exists(folder / "junit.xml"));
    EXPECT_FALSE(fs::exists(folder / "report.json")) << "half a file must not pass for one";
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        EXPECT_EQ(entry.path().string().find(".part-"), std::string::npos) << entry.path();
}

TEST(FileNames, AreNoneTwice) {
    FileNames names;
    EXPECT_EQ(names.of("a/b"), "a_b");
    EXPECT_EQ(names.of("a_b-2"), "a_b-2");
    EXPECT_EQ(names.of("a b"), "a_b-3") << "a_b-2 is given";
    EXPECT_EQ(names.of(std::string(90, 'x')), std::string(80, 'x'));
    EXPECT_EQ(names.of(std::string(91, 'x')), std::string(80, 'x') + "-2");
}

} // namespace
} // namespace fernlicht
