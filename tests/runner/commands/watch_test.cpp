// --watch: plays again when a file changes, tells what a broken one lacks, and leaves ordinary pages as they are.
#include "tests/runner/program.h"

#include <chrono>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <thread>

namespace fernlicht {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The program beside the test, with all that it says in a file.
class Watching {
  public:
    Watching(const std::string& arguments, std::string log) : log_(std::move(log)) {
        const std::string line =
            fmt::format("echo $$; exec env --default-signal=INT '{}' {} >'{}' 2>&1", FERNLICHT_BINARY, arguments, log_);
        pipe_ = ::popen(line.c_str(), "r");
        std::array<char, 64> text{};
        program_ = std::fgets(text.data(), text.size(), pipe_) ? std::atoi(text.data()) : 0;
    }
    ~Watching() {
        if (pipe_)
            end();
    }
    /// Waits for the words, behind those that were waited for before.
    void until(const std::string& words) {
        for (int tenth = 0; tenth < 1200; ++tenth) {
            said_ = content_of(log_);
            if (const std::size_t at = said_.find(words, from_); at != std::string::npos) {
                from_ = at + words.size();
                return;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
        FAIL() << "never said '" << words << "':\n" << said_.substr(from_);
    }
    int end() {
        ::kill(program_, SIGINT);
        const int status = ::pclose(std::exchange(pipe_, nullptr));
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    const std::string& said() const { return said_; }

  private:
    std::string log_, said_;
    std::size_t from_ = 0;
    std::FILE* pipe_ = nullptr;
    ::pid_t program_ = 0;
};

std::string small_drive(const TemporaryFolder& folder) {
    std::ofstream(folder / "d.yaml") << "fernlicht: 1\nroad: fernlicht:roads/straight.xodr\nspeed_kmh: 50\nrate_hz: 10\nduration_s: 1\n"
                                        "lamp_sets: {a: {file: lamp.ies}}\nmeasure: {extent: {thresholds_lx: [5]}}\n"
                                        "limits: [{reading: reach_5lx_target_own_m, at_least: 1}]\n";
    std::filesystem::copy_file(library_file("lamps/halogen-low.ies"), folder / "lamp.ies");
    return folder / "d.yaml";
}

constexpr const char* quickly = " --frames 0:1 --resolution 64x48 --no-accuracy --backend software --quiet";

TEST(Watch, PlaysARunAgainWhenItsLampChanges) {
    const TemporaryFolder folder;
    const std::string drive = small_drive(folder), out = folder / "out", lamp = folder / "lamp.ies";
    Watching run("run " + drive + quickly + " --watch --out " + out, folder / "log");
    run.until("1 passed");
    run.until("watching");
    const std::string first = content_of(folder / "out/readings.csv");
    EXPECT_THAT(content_of(folder / "out/report.html"), HasSubstr("fernlicht_turn"));
    EXPECT_EQ(content_of(folder / "out/watch.js"), "fernlicht_turn(1, \"\");\n");
    std::ofstream(folder / "out/notes.txt") << "mine";

    printed("lamp '" + lamp + "' --scale 0.5 --convert " + (folder / "new.ies"));
    std::filesystem::rename(folder / "new.ies", lamp);
    run.until("changed: ");
    run.until("reach_5lx_target_own_m: ");
    run.until(" -> ");
    run.until("watching");
    EXPECT_NE(content_of(folder / "out/readings.csv"), first);
    EXPECT_EQ(content_of(folder / "out/notes.txt"), "mine") << "what somebody put there stays";
    EXPECT_EQ(content_of(folder / "out/watch.js"), "fernlicht_turn(2, \"\");\n");

    std::ofstream(lamp) << "IESNA:LM-63-2002\nbroken";
    run.until("lamp.ies");
    run.until("watching");
    EXPECT_THAT(content_of(folder / "out/watch.js"), HasSubstr("fernlicht_turn(2, \"")) << "the page is still that of the second turn";
    EXPECT_THAT(content_of(folder / "out/watch.js"), HasSubstr("lamp.ies")) << "and says what is wrong";
    std::filesystem::copy_file(library_file("lamps/halogen-low.ies"), lamp, std::filesystem::copy_options::overwrite_existing);
    run.until(" -> ");
    run.until("watching");
    EXPECT_EQ(run.end(), 130);
    EXPECT_EQ(content_of(folder / "out/readings.csv"), first) << "the same lamp, the same bytes";
    EXPECT_FALSE(std::filesystem::exists(folder / "out/INCOMPLETE"));
    for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        EXPECT_THAT(entry.path().string(), Not(HasSubstr(".next")));

    printed("run " + drive + quickly + " --out " + (folder / "plain"));
    EXPECT_THAT(content_of(folder / "plain/report.html"), Not(HasSubstr("fernlicht_turn")));
    EXPECT_THAT(content_of(folder / "plain/report.html"), Not(HasSubstr("file:;")));
    EXPECT_FALSE(std::filesystem::exists(folder / "plain/watch.js"));
}

TEST(Watch, LooksAtALampAgain) {
    const TemporaryFolder folder;
    const std::string lamp = folder / "lamp.csv";
    const auto write = [&](int cd) { std::ofstream(lamp) << "# unit: cd\nV\\H,-10,0,10\n-5,10,20,10\n0,30," << cd << ",30\n5,1,2,1\n"; };
    write(4321);
    Watching look("lamp " + lamp + " --picture " + (folder / "p.svg") + " --watch", folder / "log");
    look.until("4321");
    look.until("watching 1 file");
    write(8765);
    look.until("8765");
    look.until("watching");
    EXPECT_EQ(look.end(), 130);
    EXPECT_TRUE(std::filesystem::exists(folder / "p.svg"));
}

TEST(Watch, PlaysOnlyCellsOfAStudyThatChanged) {
    const TemporaryFolder folder;
    small_drive(folder);
    std::filesystem::copy_file(folder / "lamp.ies", folder / "other.ies");
    std::ofstream(folder / "s.yaml") << "fernlicht_study: 1\nlamps: {a: {low: lamp.ies}, b: {low: other.ies}}\ndrives: [d.yaml]\n"
                                        "resolution_px: [64, 48]\n";
    Watching study("study " + (folder / "s.yaml") + " --frames 0:1 --no-accuracy --backend software --quiet --watch --store " +
                       (folder / "store") + " --out " + (folder / "out"),
                   folder / "log");
    study.until("0 of 2 cells came from the store");
    study.until("watching");
    printed("lamp '" + (folder / "other.ies") + "' --scale 0.5 --force --convert " + (folder / "o.ies"));
    std::filesystem::rename(folder / "o.ies", folder / "other.ies");
    study.until("1 of 2 cells came from the store");
    study.until("watching");
    EXPECT_EQ(study.end(), 130);
    EXPECT_THAT(content_of(folder / "out/report.html"), HasSubstr("fernlicht_turn"));
}

TEST(Watch, EndsWhereNoFileCanMendIt) {
    const TemporaryFolder folder;
    const std::string drive = small_drive(folder);
    for (const auto& [arguments, said] : {std::pair("run " + (folder / "none.yaml"), std::string("none.yaml")),
                                          {"run " + drive + " --frames 99:", "--frames"},
                                          {"run " + drive + " --trace " + (folder / "t.json"), "--trace"},
                                          {"run " + drive + " --out " + folder.path().string(), "--out"},
                                          {"study standard --list", "--list"},
                                          {"lamp --model none", "--model"}})
        EXPECT_THAT(printed(arguments + " --watch", 2), HasSubstr(said)) << arguments;
}

} // namespace
} // namespace fernlicht
