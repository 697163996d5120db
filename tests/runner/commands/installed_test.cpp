// The program away from its source: where it finds its data and its parts, and what it says where they are missing.
#include "tests/runner/program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

/// A file of the library that no reader takes: the refusal says which file was opened.
void write_rating(const fs::path& library, const std::string& name) {
    fs::create_directories(library / "ratings");
    std::ofstream(library / "ratings" / (name + ".yaml")) << "nonsense: 1\n";
}

/// A prefix with the program and its part that draws plots, away from the source; gone with the test.
class Installed : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = "/tmp/fernlicht-prefix-XXXXXX";
        prefix_ = ::mkdtemp(name.data());
        for (const char* folder : {"bin", "lib/fernlicht/modules", "share/fernlicht"})
            fs::create_directories(prefix_ / folder);
        fs::copy_file(FERNLICHT_BINARY, prefix_ / "bin/fernlicht");
    }
    void TearDown() override { fs::remove_all(prefix_); }

    /// From the root folder, with these variables alone.
    Outcome run(const std::string& arguments, const std::string& variables = {}, const std::string& program = "bin/fernlicht") const {
        return run_shell(fmt::format("cd / && env -i HOME={0}/home XDG_DATA_DIRS={0}/one:{0}/two {1} {0}/{2} {3}", prefix_.string(),
                                     variables, program, arguments));
    }
    /// Which file of the library is opened for this rating.
    std::string opened(const std::string& rating, const std::string& variables = {}) const {
        const std::string said = run("rate " + rating + " --lamps nowhere.yaml", variables).output;
        return said.substr(0, said.find(".yaml"));
    }
    std::string at(const std::string& below) const { return (prefix_ / below).string(); }

    fs::path prefix_;
};

TEST_F(Installed, DataIsFoundByVariableThenBesideTheProgramThenInXdgFolders) {
    for (const char* library :
         {"own", "share/fernlicht", "home/.local/share/fernlicht", "data/fernlicht", "one/fernlicht", "two/fernlicht"})
        write_rating(prefix_ / library, "iihs");
    EXPECT_THAT(opened("iihs", "FERNLICHT_DATA=" + at("own")), HasSubstr(at("own/ratings/iihs")));
    EXPECT_THAT(opened("iihs"), HasSubstr(at("share/fernlicht/ratings/iihs")));
    fs::remove_all(prefix_ / "share/fernlicht");
    EXPECT_THAT(opened("iihs", "XDG_DATA_HOME=" + at("data")), HasSubstr(at("data/fernlicht/ratings/iihs")));
    EXPECT_THAT(opened("iihs", "XDG_DATA_HOME=data"), HasSubstr(at("one/fernlicht/ratings/iihs"))) << "relative ones do not count";
    EXPECT_THAT(opened("iihs"), HasSubstr(at("home/.local/share/fernlicht/ratings/iihs")));
    fs::remove_all(prefix_ / "home");
    EXPECT_THAT(opened("iihs"), HasSubstr(at("one/fernlicht/ratings/iihs")));
    fs::remove_all(prefix_ / "one");
    EXPECT_THAT(opened("iihs"), HasSubstr(at("two/fernlicht/ratings/iihs")));
}

TEST_F(Installed, FoldersAddToOneAnother) {
    write_rating(prefix_ / "share/fernlicht", "iihs");
    write_rating(prefix_ / "home/.local/share/fernlicht", "mine");
    EXPECT_THAT(opened("mine"), HasSubstr(at("home/.local/share/fernlicht/ratings/mine")));
    EXPECT_THAT(run("rate yours --lamps nowhere.yaml").output, HasSubstr("expected a rating file, or one of iihs, mine"));
}

TEST_F(Installed, WithoutDataSaysWhereItLooked) {
    for (const std::string arguments : {"rate iihs --lamps nowhere.yaml", "run first-light", "bench", "shadows"}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_THAT(
            outcome.output,
            AllOf(HasSubstr(fmt::format("{0}/share/fernlicht, {0}/home/.local/share/fernlicht, {0}/one/fernlicht, {0}/two/fernlicht, "
                                        "nor scenarios/library above the program or here",
                                        prefix_.string())),
                  HasSubstr("FERNLICHT_DATA"), Not(HasSubstr("one of "))))
            << arguments;
    }
    const Outcome wrong = run("techniques", "FERNLICHT_DATA=/nowhere");
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_THAT(wrong.output, HasSubstr("FERNLICHT_DATA: found '/nowhere', which is no folder"));
}

TEST_F(Installed, PartsLieInLibOfItsPrefixAlsoWhenCalledByALink) {
    const std::string plot = "lamp --lamp-model halogen-low --force --picture " + at("beam.png");
    const Outcome missing = run(plot);
    EXPECT_EQ(missing.exit_code, 3);
    EXPECT_THAT(missing.output, HasSubstr(at("lib/fernlicht/modules/fernlicht-svg.so") + " is not installed"));
    fs::copy_file(fs::path(FERNLICHT_BINARY).parent_path() / "fernlicht-svg.so", prefix_ / "lib/fernlicht/modules/fernlicht-svg.so");
    EXPECT_EQ(run(plot).exit_code, 0);
    EXPECT_GT(fs::file_size(prefix_ / "beam.png"), 1000U);
    fs::create_symlink(prefix_ / "bin/fernlicht", prefix_ / "linked");
    EXPECT_EQ(run(plot, "", "linked").exit_code, 0);
}

TEST(NamedDrives, AreOursWhereThereIsNoSuchFile) {
    const TemporaryFolder folder;
    const std::string here = "cd '" + folder.path().string() + "' &&";
    fs::create_directory(folder.path() / "s-bend-can"); // a folder is no drive
    const Outcome record = run_program("can record s-bend-can", here);
    EXPECT_EQ(record.exit_code, 0) << record.output;
    EXPECT_EQ(record.output, printed("can record " + library_file("drives/s-bend-can.yaml")));
    EXPECT_THAT(run_program("study standard --list", here).output, HasSubstr("straight"));
    EXPECT_THAT(run_program("run countri", here).output, HasSubstr("(nearest: 'country')"));
    std::ofstream(folder / "straight") << "nonsense: 1\n";
    EXPECT_THAT(run_program("run straight", here).output, HasSubstr("straight:1:1: nonsense"));
}

TEST(WindowsPaths, AreRefusedWithTheirNameUnderWsl) {
    const TemporaryFolder folder;
    const std::string here = "cd '" + folder.path().string() + "' &&";
    EXPECT_THAT(
        run_program(R"(lamp 'C:\My lamps\low.ies')", here).output,
        HasSubstr("found 'C:\\My lamps\\low.ies', a path of Windows, expected one of Linux; WSL2 has this as /mnt/c/My lamps/low.ies"));
    EXPECT_THAT(run_program("lamp d:/low.ies", here).output, HasSubstr("WSL2 has this as /mnt/d/low.ies"));
    std::ofstream(folder / "drive.yaml") << "fernlicht: 1\nroad: 'C:\\roads\\bend.xodr'\n";
    EXPECT_THAT(run_program("run drive.yaml", here).output,
                AllOf(HasSubstr("drive.yaml:2:7: road: found"), HasSubstr("WSL2 has this as /mnt/c/roads/bend.xodr")));
    EXPECT_THAT(run_program(R"(run straight --out 'C:\out')", here).output, HasSubstr("--out: found 'C:\\out', a path of Windows"));
    EXPECT_THAT(run_program("lamp low:/ies", here).output, Not(HasSubstr("Windows")));
}

} // namespace
} // namespace fernlicht
