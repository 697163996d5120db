// The folder that a run writes to: never another run's, never somebody's files.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace fernlicht {

/// "out/<drive>-20241121T193000Z" below the working folder; characters of `drive` that are not plain become "-". When that exists, "-2",
/// "-3" ... is added.
std::filesystem::path default_output_folder(const std::string& drive, const std::string& started_utc);

/// A run's folder while it is written. The file INCOMPLETE in it says so until finish(); after a crash, a full disk or Ctrl-C it stays and
/// tells readers that not all is there.
class OutputFolder {
  public:
    /// Creates `folder` (and those above it) or takes an empty one, and marks it as in progress.
    /// Throws InputError naming it when it holds anything (another run, other files), is no folder or cannot be created or written to
    /// (read-only, no right), DeviceError where the disk refuses (full).
    explicit OutputFolder(std::filesystem::path folder);

    /// A folder whose run did not end, to be gone on with. Throws InputError for any other.
    static OutputFolder left_incomplete(const std::filesystem::path& folder);

    const std::filesystem::path& path() const { return folder_; }

    /// Removes the mark: everything is there. Throws DeviceError.
    void finish();

  private:
    OutputFolder() = default;
    std::filesystem::path folder_;
};

/// So that nothing is made or lost for a file that cannot be written in the end: throws InputError naming the flag unless `file` is new, in
/// a folder that can be written to, or in `folder`, which the run will make ("": it makes none). With `replaces` it may be a file that is
/// there.
void refuse_unwritable(const char* flag, const std::filesystem::path& file, const std::filesystem::path& folder, bool replaces = false);

/// True for a folder whose run did not end.
bool is_marked_incomplete(const std::filesystem::path& folder);

/// A file or folder name made of letters, digits, '-', '_' and '.', from any text.
std::string file_name_of(const std::string& text);

/// Names of the files of one folder: file_name_of(), with "-2", "-3" ... where that leaves of several texts the same.
class FileNames {
  public:
    std::string of(const std::string& text);

  private:
    std::set<std::string> given_;
};

} // namespace fernlicht
