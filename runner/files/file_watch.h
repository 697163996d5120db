// Waits until the content of files changes.
#pragma once

#include "scenarios/values/files.h"

#include <filesystem>
#include <string>
#include <vector>

namespace fernlicht {

/// Files by what they held, also those that editors replace by another of the same name, and those that are not there. Told by the
/// system where it can (inotify), and by a look each second where it cannot: drives of networks and of Windows.
class FileWatch {
  public:
    /// Each with the hash that it was read with; files without one are as they are now.
    explicit FileWatch(const FilesRead& files);
    ~FileWatch();
    FileWatch(const FileWatch&) = delete;
    FileWatch& operator=(const FileWatch&) = delete;

    /// Waits, and then until nobody has written for a moment. Those that changed, those that are gone among them.
    std::vector<std::filesystem::path> wait();

  private:
    struct Watched {
        std::filesystem::path path;
        std::string hash;  ///< of its content; "" where it cannot be read
        std::string stamp; ///< what the system says of it, as of the last look
        bool changed = false;
    };
    bool look();
    void listen(const std::filesystem::path& file);
    bool is_told(int longest_ms) const;

    std::vector<Watched> files_;
    int inotify_ = -1;
};

/// Its content's hash; "" where it cannot be read.
std::string hash_of_file(const std::filesystem::path& path);

} // namespace fernlicht
