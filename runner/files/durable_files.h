// Files that outlive a power cut: on the disk before anything refers to them.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace fernlicht {

/// Writes beside the file, waits until it is on the disk, then names it, and waits for that: after a power cut there is the file from
/// before or the new one, whole. Any number of processes, on any machines, may do so at once. Throws DeviceError with the path and the
/// reason.
void write_durably(const std::filesystem::path& path, const std::string& content);

/// Renames within one file system, over a file that may be there, and waits until the folder is on the disk. Throws DeviceError.
void rename_durably(const std::filesystem::path& from, const std::filesystem::path& to);

/// Waits until the folder's list of names is on the disk. Throws DeviceError.
void sync_folder(const std::filesystem::path& folder);

/// Creates the folder and those above it. Throws DeviceError.
void make_folder(const std::filesystem::path& folder);

/// Held while it lives; a second process waits. On a folder: of processes of this machine; on a file: of all machines that see it. Throws
/// DeviceError.
class FolderLock {
  public:
    enum class For {
        change, ///< nobody else holds it
        reading ///< many may read, nobody changes. Where it cannot be opened, or its file system has no locks, nothing is held
    };
    explicit FolderLock(const std::filesystem::path& path, For what = For::change);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

    /// The same for a change, without waiting; nullptr where somebody else holds it.
    static std::unique_ptr<FolderLock> at_once(const std::filesystem::path& path);

  private:
    explicit FolderLock(int file) : file_(file) {}
    int file_;
};

} // namespace fernlicht
