#include "runner/files/page_link.h"

#include <cctype>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sstream>
#include <string_view>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace fernlicht {
namespace {

std::string variable(const char* name) {
    const char* const value = std::getenv(name);
    return value ? value : "";
}

std::string percent_encoded(std::string_view path) {
    std::string out;
    for (const char c : path)
        if (std::isalnum(static_cast<unsigned char>(c)) || (c != '\0' && std::strchr("/-._~", c)))
            out += c;
        else
            out += fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    return out;
}

/// Runs a shell's command line with the page's address as $1, apart from this process; true where it did not fail within a second.
bool is_taken_by(const std::string& command, const std::string& url) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_RDWR, 0);
    posix_spawnattr_t apart;
    posix_spawnattr_init(&apart);
    posix_spawnattr_setflags(&apart, POSIX_SPAWN_SETSID); // the terminal's Ctrl-C is not meant for it
    std::vector<std::string> words{"sh", "-c", command, "sh", url};
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t child = -1;
    const bool started = ::posix_spawn(&child, "/bin/sh", &files, &apart, arguments.data(), environ) == 0;
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&apart);
    for (int tenth = 0; started && tenth < 10; ++tenth) {
        int status = 0;
        if (::waitpid(child, &status, WNOHANG) == child)
            return WIFEXITED(status) && WEXITSTATUS(status) == 0;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    return started; // it runs on: a browser that stays in front
}

struct Browser {
    std::string name, command;
};

/// $BROWSER as other programs take it: several parted by colons, %s for the address or behind it.
std::vector<Browser> browsers() {
    std::vector<Browser> all;
    std::istringstream named(variable("BROWSER"));
    for (std::string one; std::getline(named, one, ':');) {
        std::string command = one;
        if (const std::size_t at = command.find("%s"); at != std::string::npos)
            command.replace(at, 2, "\"$1\"");
        else
            command += " \"$1\"";
        if (!one.empty())
            all.push_back({one, command});
    }
    if (!variable("WSL_DISTRO_NAME").empty()) {
        all.push_back({"wslview", "wslview \"$1\""});
        all.push_back({"explorer.exe", "command -v explorer.exe && { explorer.exe \"$1\"; true; }"}); // ends in 1 whatever it did
    }
    if (!variable("DISPLAY").empty() || !variable("WAYLAND_DISPLAY").empty())
        all.push_back({"xdg-open", "xdg-open \"$1\""});
    return all;
}

} // namespace

std::string file_url(const std::filesystem::path& file) {
    std::string path = std::filesystem::absolute(file).lexically_normal().string();
    const std::string distribution = variable("WSL_DISTRO_NAME");
    if (distribution.empty())
        return "file://" + percent_encoded(path);
    if (path.starts_with("/mnt/") && path.size() > 6 && path[6] == '/')
        return fmt::format("file:///{}:{}", static_cast<char>(std::toupper(static_cast<unsigned char>(path[5]))),
                           percent_encoded(std::string_view(path).substr(6)));
    return fmt::format("file://wsl.localhost/{}{}", percent_encoded(distribution), percent_encoded(path));
}

std::string page_link(const std::filesystem::path& page) {
    const std::string terminal = variable("TERM");
    const bool links = ::isatty(STDOUT_FILENO) == 1 && !terminal.empty() && terminal != "dumb" && terminal != "linux" &&
                       variable("SSH_CONNECTION").empty(); // else the file is on another machine than the browser
    return links ? fmt::format("\033]8;;{}\033\\{}\033]8;;\033\\", file_url(page), page.string()) : page.string();
}

std::string open_page(const std::filesystem::path& page) {
    const std::string url = file_url(page);
    for (const Browser& browser : browsers())
        if (is_taken_by(browser.command, url))
            return browser.name;
    return "";
}

} // namespace fernlicht
