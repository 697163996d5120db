// The page as a browser sees it. Needs Chromium; skips without.
#include "runner/commands/run_files.h"
#include "runner/findings/report.h"
#include "scenarios/values/files.h"
#include "tests/runner/sample_report.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

std::string output_of(const std::string& command) {
    std::string out;
    FILE* const pipe = ::popen(command.c_str(), "r");
    if (!pipe)
        return out;
    std::array<char, 65536> buffer;
    for (std::size_t got; (got = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
        out.append(buffer.data(), got);
    ::pclose(pipe);
    return out;
}

struct ReportPage : testing::Test {
    fs::path folder = fs::path(testing::TempDir()) / ("fernlicht-page-" + std::to_string(::getpid()));
    std::string browser;

    void SetUp() override {
        browser = output_of("command -v chromium || command -v chromium-browser || command -v google-chrome");
        if (browser.empty())
            GTEST_SKIP() << "no Chromium on this machine: the page is not opened";
        browser.pop_back();
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }

    /// Title of the page after `script` has run in it. The browser's complaints (refused sources, errors of scripts) go to `console`.
    std::string title_after(const Report& report, const std::string& script, std::string& console) {
        tests::write_sample_frames(report, folder);
        write_report(report, folder);
        FilesRead opened;
        std::string page = read_file(folder / "report.html", opened);
        page.insert(page.rfind("</body>"), "<script>" + script + "</script>");
        write_file(folder / "opened.html", page);
        const std::string dom = output_of(fmt::format(
            "timeout 120 {} --headless --no-sandbox --disable-gpu --window-size=500,800 --enable-logging=stderr --user-data-dir={}/browser "
            "--dump-dom file://{}/opened.html 2>{}/console.txt",
            browser, folder.string(), folder.string(), folder.string()));
        console = read_file(folder / "console.txt", opened, std::size_t{256} << 20, true);
        const std::size_t from = dom.find("<title>"), to = dom.find("</title>");
        return from == std::string::npos || to == std::string::npos ? "the browser showed nothing" : dom.substr(from + 7, to - from - 7);
    }
};

constexpr const char* shown_moment =
    "document.title = Array.from(document.querySelectorAll('.moment')).findIndex((m) => !m.hidden) + ' of ' + "
    "document.querySelectorAll('.moment:not([hidden])').length + ', pictures ' + "
    "Array.from(document.images).filter((i) => i.complete && i.naturalWidth === 320).length;";

TEST_F(ReportPage, ShowsOneMomentWithItsPictures) {
    std::string console;
    EXPECT_EQ(title_after(tests::sample_report(12), shown_moment, console), "0 of 1, pictures 12") << "3 moments, 2 lamps, 2 views";
    EXPECT_THAT(console, Not(HasSubstr("CONSOLE"))) << "the browser complained";
}

TEST_F(ReportPage, KeysAndButtonsChooseTheMoment) {
    std::string console;
    const std::string press =
        "const key = (key) => document.querySelector('.moment').dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}));"
        "key('ArrowRight'); key('ArrowRight'); key('ArrowRight'); key('ArrowLeft');";
    EXPECT_EQ(title_after(tests::sample_report(12), press + shown_moment, console), "1 of 1, pictures 12") << "stops at the last";
    const std::string click = "document.querySelector('.chooser [data-step=\"1\"]').click();";
    EXPECT_EQ(title_after(tests::sample_report(12), click + shown_moment, console), "1 of 1, pictures 12");
}

TEST_F(ReportPage, HostileNamesRunNothing) {
    Report report = tests::sample_report(2);
    const std::string hostile = "\"'><script>document.title='owned'</script><img src=x onerror=\"document.title='owned'\">\n\xff";
    for (PlayedCell& played : report.played) {
        played.drive = hostile;
        played.lamp_set += hostile;
        played.lamps[0] = {hostile, hostile};
        played.left_out = played.notes = {hostile};
        for (StoredFrame& frame : played.frames)
            frame.view = hostile;
        for (LuxMap& map : played.maps)
            map.edges[0].kind = hostile;
        for (Verdict& verdict : played.verdicts)
            verdict.text = verdict.rerun = hostile;
    }
    report.context.command = report.context.inputs[0].xxh128 = report.interrupted = hostile;
    report.context.inputs[0].path = hostile + std::string(4000, 'x');
    std::string console;
    const std::string title = title_after(report, "", console);
    EXPECT_THAT(title, HasSubstr("&lt;script&gt;"));
    EXPECT_THAT(title, Not(testing::StrEq("owned")));
    EXPECT_THAT(console, Not(HasSubstr("CONSOLE"))) << "the browser complained: something was tried to be loaded or run";
}

TEST_F(ReportPage, MayLoadNothing) {
    std::string console;
    const std::string load = "const i = new Image(); i.src = 'http://127.0.0.1:9/x.png'; document.body.append(i);";
    title_after(tests::sample_report(2), load, console);
    EXPECT_THAT(console, HasSubstr("CONSOLE"));
    EXPECT_THAT(console, HasSubstr("Content Security Policy"));
}

TEST_F(ReportPage, FitsANarrowScreen) {
    Report report = tests::sample_report(2);
    report.context.inputs[0].path = std::string(300, 'x');
    report.context.command = "fernlicht run " + std::string(300, 'y');
    std::string console;
    // The page itself must not scroll sideways; wide tables do so in their own box.
    EXPECT_EQ(
        title_after(report, "document.title = document.documentElement.scrollWidth <= window.innerWidth ? 'fits' : 'too wide';", console),
        "fits");
}

} // namespace
} // namespace fernlicht
