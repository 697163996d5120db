// All that is wrong with files, found before anything is played: what their readers refuse, what the first frame would lack, and what the
// intake check says of lamps. It runs no plug-in and no FMU.
#pragma once

#include "scenarios/values/errors.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

struct FileProblem {
    InputError::Where where;
    bool is_error = true; ///< else a warning: the file can be played
    std::string text;     ///< "aim: found 'up', expected as-is or auto"

    bool operator==(const FileProblem& other) const {
        return where.file == other.where.file && where.line == other.where.line && where.column == other.where.column &&
               is_error == other.is_error && text == other.text;
    }
};

struct FileSeen {
    std::filesystem::path file; ///< as it was given
    std::string kind;           ///< "drive", "lamp", "road" ...; "" where nobody can tell
};

struct FileChecks {
    std::vector<FileSeen> files;
    std::vector<FileProblem> problems; ///< each once, whoever names the file that it stands in
    std::size_t left_out = 0;          ///< files in folders that are of no kind that fernlicht reads

    std::size_t errors() const;
    std::size_t warnings() const { return problems.size() - errors(); }
};

/// Of a file; of a folder all that fernlicht reads, and of the folders below it. Links to folders are not followed.
void check_path(const std::filesystem::path& path, FileChecks& checks);

/// How a problem stands in front of an editor: "drive.yaml:4:7: error: ..."; what is not known is left out.
std::string problem_line(const FileProblem& problem);

} // namespace fernlicht
