// What a file is, by its content.
#pragma once

#include "runner/experiments/check/check_files.h"

#include <functional>
#include <initializer_list>
#include <span>

namespace fernlicht {

/// The first bytes of a file.
struct FileHead {
    static constexpr std::size_t most_bytes = std::size_t{1} << 16;
    std::filesystem::path path;
    std::string bytes;

    bool begins_with(std::string_view text) const;
    bool has(std::string_view text) const;
    /// A YAML map's own key, as far as the beginning of lines tells.
    bool has_key(std::string_view key) const;
    bool ends_in(std::initializer_list<std::string_view> extensions) const; ///< in small letters
};

/// An error with its text as it stands behind the place.
FileProblem problem_of(const InputError& error);

/// What a look at a file takes and leaves.
struct FileLook {
    std::string kind; ///< may become more exact
    std::vector<FileProblem> problems;

    /// All that `reads` refuses; whether that was nothing.
    bool tries(const std::function<void()>& reads);
    void warn(const InputError::Where& where, const std::string& text);
};

struct FileKind {
    std::string_view name;
    bool (*is)(const FileHead&);
    void (*check)(const std::filesystem::path&, FileLook&);
    bool in_folders = true; ///< false: looked at only where it is named itself
};

/// In the order in which a file's beginning is held against them.
std::span<const FileKind> file_kinds();

} // namespace fernlicht
