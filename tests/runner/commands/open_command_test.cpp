// `fernlicht open`, and links to pages on terminals.
#include "tests/runner/program.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* no_desktop = "env -u BROWSER -u DISPLAY -u WAYLAND_DISPLAY -u WSL_DISTRO_NAME ";

TEST(Open, HandsThePageToABrowser) {
    const TemporaryFolder folder;
    const std::string run = folder / "a night, 100%", url = "file://" + (folder / "a%20night%2C%20100%25/report.html");
    std::filesystem::create_directory(run);
    std::ofstream(run + "/report.html") << "<html></html>";
    std::ofstream(folder / "browser") << "#!/bin/sh\nprintf %s \"$1\" >'" << folder / "asked"
                                      << "'\n";
    std::filesystem::permissions(folder / "browser", std::filesystem::perms::owner_all);

    const Outcome none = run_program("open '" + run + "'", no_desktop);
    EXPECT_EQ(none.exit_code, 0) << none.output;
    EXPECT_THAT(none.output, HasSubstr(url));
    EXPECT_THAT(none.output, HasSubstr("no browser"));
    const std::string before = std::string(no_desktop) + "BROWSER=/nowhere/at-all:" + (folder / "browser");
    EXPECT_THAT(run_program("open '" + run + "'", before).output, Not(HasSubstr("no browser")));
    EXPECT_EQ(content_of(folder / "asked"), url);
    const std::string as_wsl = std::string(no_desktop) + "WSL_DISTRO_NAME='My Debian' PATH=/nowhere";
    EXPECT_THAT(run_program("open '" + run + "'", as_wsl).output, HasSubstr("file://wsl.localhost/My%20Debian" + url.substr(7)));

    for (const auto& [given, said] :
         {std::pair(folder / "none", "is not there"), {folder / "", "holds no report"}, {folder / "browser", "is no page"}})
        EXPECT_THAT(printed("open '" + given + "'", 2), HasSubstr(said));
    const Outcome nothing = run_shell("cd " + folder.path().string() + " && '" FERNLICHT_BINARY "' open");
    EXPECT_THAT(nothing.output, HasSubstr("no result in out/"));
}

TEST(Open, PathsOfPagesAreLinksOnTerminalsAlone) {
    if (run_shell("command -v script").exit_code != 0)
        GTEST_SKIP() << "needs script of util-linux";
    const TemporaryFolder folder;
    const std::string ies = "'" + library_file("lamps/led-low.ies") + "'";
    const auto compare = [&](const std::string& out) {
        return "'" FERNLICHT_BINARY "' compare --as-lamps " + ies + " " + ies + " --out " + (folder / out);
    };
    const std::string link = "\033]8;;file://" + (folder / "a/report.html") + "\033\\" + (folder / "a/report.html") + "\033]8;;\033\\";
    const auto on_terminal = [&](const std::string& out, const std::string& variables) {
        return run_shell("env -u SSH_CONNECTION -u WSL_DISTRO_NAME " + variables + " script -qec \"" + compare(out) +
                         "\" /dev/null </dev/null")
            .output;
    };
    EXPECT_THAT(on_terminal("a", "TERM=xterm"), HasSubstr(link));
    EXPECT_THAT(on_terminal("b", "TERM=dumb"), Not(HasSubstr("\033]8")));
    EXPECT_THAT(on_terminal("c", "TERM=xterm SSH_CONNECTION=x"), Not(HasSubstr("\033]8")));
    EXPECT_THAT(run_shell("TERM=xterm " + compare("d")).output, Not(HasSubstr("\033")));
}

} // namespace
} // namespace fernlicht
