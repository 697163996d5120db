#include "runner/experiments/check/check_files.h"

#include "runner/experiments/check/file_kinds.h"
#include "scenarios/values/files.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <set>
#include <sys/stat.h>
#include <system_error>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

/// Throws InputError for what is no file, cannot be read or is empty. Nothing but a regular file is opened: a pipe would be waited for.
FileHead head_of(const fs::path& path) {
    struct stat status {};
    FileHead head{path, {}};
    if (::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode))
        if (std::FILE* const file = std::fopen(path.c_str(), "rbe")) {
            const std::unique_ptr<std::FILE, int (*)(std::FILE*)> closes(file, std::fclose);
            head.bytes.resize(FileHead::most_bytes);
            head.bytes.resize(std::fread(head.bytes.data(), 1, head.bytes.size(), file));
        }
    if (FilesRead ignored; head.bytes.empty())
        read_file(path, ignored); // says why
    return head;
}

void add(FileProblem problem, FileChecks& checks) {
    if (std::ranges::find(checks.problems, problem) == checks.problems.end())
        checks.problems.push_back(std::move(problem));
}

std::string kinds_told() {
    std::string told;
    std::set<std::string_view> seen;
    for (const FileKind& kind : file_kinds())
        if (seen.insert(kind.name).second)
            told += fmt::format("{}{}", told.empty() ? "" : ", ", kind.name);
    return told;
}

void check_file_of(const FileKind& kind, const fs::path& path, FileChecks& checks) {
    FileLook look{std::string(kind.name), {}};
    kind.check(path, look);
    checks.files.push_back({path, look.kind});
    std::ranges::stable_sort(look.problems, [](const FileProblem& a, const FileProblem& b) {
        return std::tie(a.where.file, a.where.line, a.where.column) < std::tie(b.where.file, b.where.line, b.where.column);
    });
    for (FileProblem& problem : look.problems)
        add(std::move(problem), checks);
}

const FileKind* kind_of(const FileHead& head, bool in_folder) {
    const auto kinds = file_kinds();
    const auto found = std::ranges::find_if(kinds, [&](const FileKind& kind) { return (kind.in_folders || !in_folder) && kind.is(head); });
    return found == kinds.end() ? nullptr : &*found;
}

void check_one(const fs::path& path, FileChecks& checks) {
    try {
        const FileHead head = head_of(path);
        const FileKind* const kind = kind_of(head, false);
        if (!kind)
            throw InputError({path, 0, 0, {}}, "is of no kind that fernlicht reads", fmt::format("one of {}", kinds_told()));
        check_file_of(*kind, path, checks);
    } catch (const InputError& error) {
        checks.files.push_back({path, ""});
        add(problem_of(error), checks);
    }
}

/// A file that nobody can read is told where its name says that somebody would want it.
bool is_wanted(const fs::path& path) {
    return FileHead{path, {}}.ends_in({".yaml", ".yml", ".ies", ".ldt", ".xodr", ".xosc", ".dbc", ".gltf", ".glb", ".fmu"});
}

void check_folder(const fs::path& folder, FileChecks& checks) {
    std::error_code failed;
    std::vector<fs::directory_entry> entries;
    for (fs::directory_iterator it(folder, failed), end; !failed && it != end; it.increment(failed))
        entries.push_back(*it);
    if (failed)
        add({{folder, 0, 0, {}}, true, "cannot be read: " + failed.message()}, checks);
    std::ranges::sort(entries);
    for (const fs::directory_entry& entry : entries) {
        std::error_code ignored;
        if (entry.path().filename().string().starts_with('.'))
            continue;
        if (entry.is_directory(ignored)) {
            if (!entry.is_symlink(ignored))
                check_folder(entry.path(), checks);
            continue;
        }
        try {
            const FileHead head = head_of(entry.path());
            if (const FileKind* const kind = kind_of(head, true))
                check_file_of(*kind, entry.path(), checks);
            else
                ++checks.left_out;
        } catch (const InputError& error) {
            if (is_wanted(entry.path())) {
                checks.files.push_back({entry.path(), ""});
                add(problem_of(error), checks);
            } else
                ++checks.left_out;
        }
    }
}

} // namespace

std::size_t FileChecks::errors() const { return static_cast<std::size_t>(std::ranges::count(problems, true, &FileProblem::is_error)); }

void check_path(const fs::path& path, FileChecks& checks) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored))
        check_folder(path, checks);
    else
        check_one(path, checks);
}

std::string problem_line(const FileProblem& problem) {
    std::string line = printable(problem.where.file.string(), 4000);
    if (problem.where.line > 0)
        line += fmt::format(":{}", problem.where.line);
    if (problem.where.line > 0 && problem.where.column > 0)
        line += fmt::format(":{}", problem.where.column);
    return fmt::format("{}{}{}: {}", line, line.empty() ? "" : ": ", problem.is_error ? "error" : "warning", problem.text);
}

} // namespace fernlicht
