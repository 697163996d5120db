#include "runner/commands/commands.h"

#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/check/check_files.h"
#include "runner/files/json_text.h"
#include "runner/files/log.h"
#include "runner/findings/figures.h"
#include "scenarios/values/files.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <fmt/format.h>
#include <memory>
#include <system_error>
#include <unistd.h>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

struct CheckFlags {
    std::vector<fs::path> files;
    bool strict = false, json = false;
};

constexpr const char* from_input = "-";

/// Standard input as a file here, so that paths in it are found as they would be; gone with this.
class InputFile {
  public:
    InputFile() {
        const std::string content = all_of_it();
        for (const fs::path& folder : {fs::path("."), fs::temp_directory_path()}) {
            std::string name = (folder / ".fernlicht-input-XXXXXX").string();
            if (const int file = ::mkstemp(name.data()); file >= 0) {
                ::close(file);
                path_ = name;
                write_file(path_, content);
                return;
            }
        }
        throw DeviceError("standard input: neither this folder nor that of temporary files can be written to");
    }
    ~InputFile() {
        std::error_code ignored;
        fs::remove(path_, ignored);
    }
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;
    const fs::path& path() const { return path_; }

  private:
    static std::string all_of_it() {
        constexpr std::size_t most_bytes = std::size_t{256} << 20;
        std::string content, piece(std::size_t{1} << 16, '\0');
        for (;;) {
            const ssize_t got = ::read(STDIN_FILENO, piece.data(), piece.size());
            if (got == 0)
                return content;
            if (got < 0 && errno == EINTR)
                continue;
            if (got < 0)
                throw InputError({from_input, 0, 0, {}}, "cannot be read: " + std::generic_category().message(errno), "a file");
            content.append(piece, 0, static_cast<std::size_t>(got));
            if (content.size() > most_bytes)
                throw InputError({from_input, 0, 0, {}}, fmt::format("has more than {} bytes", most_bytes), "a smaller file");
        }
    }
    fs::path path_;
};

void check_input(FileChecks& checks) {
    const InputFile input;
    FileChecks of_input;
    check_path(input.path(), of_input);
    const fs::path here = fs::absolute(input.path()).lexically_normal();
    for (FileSeen& seen : of_input.files)
        seen.file = from_input;
    for (FileProblem& problem : of_input.problems)
        if (fs::absolute(problem.where.file).lexically_normal() == here)
            problem.where.file = from_input;
    std::ranges::move(of_input.files, std::back_inserter(checks.files));
    std::ranges::move(of_input.problems, std::back_inserter(checks.problems));
}

std::string as_json(const FileChecks& checks) {
    nlohmann::ordered_json json{{"files", nlohmann::ordered_json::array()}, {"problems", nlohmann::ordered_json::array()}};
    for (const FileSeen& seen : checks.files)
        json["files"].push_back({{"file", seen.file.string()}, {"kind", seen.kind}});
    const auto place = [](std::size_t number) { return number > 0 ? nlohmann::ordered_json(number) : nlohmann::ordered_json(nullptr); };
    for (const FileProblem& problem : checks.problems)
        json["problems"].push_back({{"file", problem.where.file.string()},
                                    {"line", place(problem.where.line)},
                                    {"column", place(problem.where.column)},
                                    {"severity", problem.is_error ? "error" : "warning"},
                                    {"key", problem.where.key},
                                    {"text", problem.text}});
    json["errors"] = checks.errors();
    json["warnings"] = checks.warnings();
    json["left_out"] = checks.left_out;
    return json_text(json);
}

int check(const CheckFlags& flags) {
    FileChecks checks;
    for (const fs::path& file : flags.files) {
        if (file == from_input)
            check_input(checks);
        else
            check_path(file, checks);
    }
    if (flags.json)
        fmt::print("{}", as_json(checks));
    else {
        for (const FileProblem& problem : checks.problems)
            fmt::print("{}\n", problem_line(problem));
        fmt::print("{}, {}, {}{}\n", counted(checks.files.size(), "file"), counted(checks.errors(), "error"),
                   counted(checks.warnings(), "warning"),
                   checks.left_out > 0 ? fmt::format("; {} of other kinds left out", counted(checks.left_out, "file")) : "");
    }
    for (const FileProblem& problem : checks.problems)
        if (problem.is_error)
            annotate(problem.where, "fernlicht check", problem.text);
    return checks.errors() > 0 ? 2 : flags.strict && checks.warnings() > 0 ? 1 : 0;
}

} // namespace

void add_check_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    const auto flags = std::make_shared<CheckFlags>();
    CLI::App* sub = app.add_subcommand("check", "report everything that is wrong with files, without playing them");
    take_shipped_lamps(
        sub->add_option("FILE", flags->files,
                        "files of any kind that fernlicht reads, told by their content; folders with all such files in them; "
                        "shipped lamps by name; -: standard input"))
        ->required();
    sub->add_flag("--fail-on-warning", flags->strict, "exit with 1 if there are warnings");
    add_shared(*sub, "--json", flags->json);
    sub->footer("A line for each problem: FILE:LINE:COLUMN: error: TEXT. Exit code 2 where there is an error.");
    sub->callback([flags, &chosen] { chosen = [flags] { return check(*flags); }; });
}

} // namespace fernlicht
