// Runs the real program, as a user would.
#pragma once

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace fernlicht {

struct Outcome {
    int exit_code = -1; ///< 128 + signal when killed
    std::string output; ///< stdout and stderr together
};

/// A shell's command line.
inline Outcome run_shell(const std::string& command) {
    const std::string line = command + " 2>&1";
    std::FILE* pipe = ::popen(line.c_str(), "r");
    Outcome outcome;
    std::array<char, 4096> buffer{};
    while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe))
        outcome.output.append(buffer.data(), got);
    const int status = ::pclose(pipe);
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return outcome;
}

/// `before` is put before the program: variables, timeout.
inline Outcome run_program(const std::string& arguments, const std::string& before = {}) {
    return run_shell(before + " '" FERNLICHT_BINARY "' " + arguments);
}

/// What it prints; it must end with this code.
inline std::string printed(const std::string& arguments, int exit_code = 0) {
    const Outcome run = run_program(arguments);
    EXPECT_EQ(run.exit_code, exit_code) << arguments << '\n' << run.output;
    return run.output;
}

/// The program, interrupted as by Ctrl-C when it first writes `sign`, which tells how far it is; `signals` of them at once.
inline Outcome run_interrupted(const std::string& arguments, const std::string& sign, int signals = 1) {
    const std::string line = "echo $$; exec '" FERNLICHT_BINARY "' " + arguments + " 2>&1";
    std::FILE* pipe = ::popen(line.c_str(), "r");
    Outcome outcome;
    std::array<char, 4096> text{};
    const ::pid_t program = std::fgets(text.data(), text.size(), pipe) ? std::atoi(text.data()) : 0; // the shell's own, by exec
    bool asked = false;
    while (std::fgets(text.data(), text.size(), pipe)) {
        outcome.output += text.data();
        if (!asked && program > 0 && outcome.output.find(sign) != std::string::npos)
            for (int i = 0; i < signals; ++i)
                asked = ::kill(program, SIGINT) == 0;
    }
    const int status = ::pclose(pipe);
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return outcome;
}

inline std::string library_file(const std::string& below) { return std::string(FERNLICHT_SOURCE_DIR "/scenarios/library/") + below; }

inline std::string content_of(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// The fields of each line, split at commas.
inline std::vector<std::vector<std::string>> csv_rows(const std::string& text) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream in(line);
        rows.emplace_back();
        for (std::string field; std::getline(in, field, ',');)
            rows.back().push_back(field);
    }
    return rows;
}

/// A fresh folder, removed at the end.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "fernlicht-test-XXXXXX").string();
        path_ = ::mkdtemp(name.data());
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }
    std::string operator/(const std::string& name) const { return (path_ / name).string(); }

  private:
    std::filesystem::path path_;
};

} // namespace fernlicht
