#include "runner/files/file_watch.h"

#include "tests/runner/program.h"

#include <functional>
#include <gmock/gmock.h>
#include <thread>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

std::vector<fs::path> after(const std::vector<std::string>& files, const std::function<void()>& does) {
    FilesRead read;
    for (const std::string& file : files)
        read.push_back({file, 0, ""});
    FileWatch watch(read);
    std::jthread changes([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        does();
    });
    return watch.wait();
}

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

TEST(FileWatch, TellsWhatHoldsSomethingElse) {
    const TemporaryFolder folder;
    const std::string a = folder / "a", b = folder / "b", gone = folder / "deep/down/c", link = folder / "link";
    write(a, "1");
    write(b, "1");
    fs::create_directory(folder / "far");
    write(folder / "far/target", "1");
    fs::create_symlink("far/target", link);
    EXPECT_THAT(after({a, b}, [&] { write(a, "2"); }), ElementsAre(a));
    EXPECT_THAT(after({a, b},
                      [&] { // as editors do
                          write(folder / "b.part", "2");
                          fs::rename(folder / "b.part", b);
                      }),
                ElementsAre(b));
    EXPECT_THAT(after({a, b}, [&] { fs::remove(b); }), ElementsAre(b));
    EXPECT_THAT(after({a, gone},
                      [&] {
                          fs::create_directories(folder / "deep/down");
                          write(gone, "1");
                      }),
                ElementsAre(gone));
    EXPECT_THAT(after({link}, [&] { write(folder / "far/target", "2"); }), ElementsAre(link)) << "what a link leads to";
    EXPECT_THAT(after({a, link},
                      [&] {
                          write(a, "2");                     // the same again
                          write(folder / "other", "1");      // nobody reads it
                          fs::remove(folder / "far/target"); // and is there again at once
                          write(folder / "far/target", "3");
                      }),
                ElementsAre(link));
}

TEST(FileWatch, HearsOfWhatChangedBeforeItBegan) {
    const TemporaryFolder folder;
    write(folder / "a", "as it was read");
    FilesRead read;
    read_file(folder / "a", read);
    write(folder / "a", "as it is");
    EXPECT_THAT(FileWatch(read).wait(), ElementsAre(fs::path(folder / "a")));
}

} // namespace
} // namespace fernlicht
