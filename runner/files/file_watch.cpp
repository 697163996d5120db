#include "runner/files/file_watch.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <limits>
#include <poll.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

constexpr int look_each_ms = 1000;
constexpr int quiet_ms = 150; // editors write, rename and set times within less
constexpr int gone_ms = 1000; // some remove a file before they write it again

std::string stamp_of(const fs::path& path) {
    struct stat now {};
    if (::stat(path.c_str(), &now) != 0)
        return "gone";
    return fmt::format("{} {} {} {}.{} {}.{}", now.st_dev, now.st_ino, now.st_size, now.st_mtim.tv_sec, now.st_mtim.tv_nsec,
                       now.st_ctim.tv_sec, now.st_ctim.tv_nsec);
}

} // namespace

std::string hash_of_file(const fs::path& path) {
    try {
        FilesRead read;
        read_file(path, read, std::numeric_limits<std::size_t>::max(), true);
        return read.front().xxh128;
    } catch (const InputError&) {
        return "";
    }
}

FileWatch::FileWatch(const FilesRead& files) : inotify_(::inotify_init1(IN_CLOEXEC | IN_NONBLOCK)) {
    for (const FileRead& file : files) {
        const fs::path path = fs::absolute(file.path).lexically_normal();
        if (std::ranges::find(files_, path, &Watched::path) != files_.end())
            continue;
        listen(path); // before it is looked at: what comes between is told
        files_.push_back({path, file.xxh128.empty() ? hash_of_file(path) : file.xxh128, ""});
    }
}

FileWatch::~FileWatch() {
    if (inotify_ >= 0)
        ::close(inotify_);
}

/// The folders of its name and of what that leads to, or the nearest ones above that are there: a file's own watch would go with the file.
void FileWatch::listen(const fs::path& file) {
    std::error_code ignored;
    for (fs::path folder : {file.parent_path(), fs::weakly_canonical(file, ignored).parent_path()}) {
        while (!fs::is_directory(folder, ignored) && folder.has_relative_path())
            folder = folder.parent_path();
        if (inotify_ >= 0)
            ::inotify_add_watch(inotify_, folder.c_str(),
                                IN_CLOSE_WRITE | IN_CREATE | IN_DELETE | IN_MOVED_FROM | IN_MOVED_TO | IN_ATTRIB | IN_DELETE_SELF |
                                    IN_MOVE_SELF | IN_ONLYDIR);
    }
}

/// Whether any file has another content; only those are read of which the system says something new.
bool FileWatch::look() {
    bool any = false;
    for (Watched& file : files_) {
        if (std::string stamp = stamp_of(file.path); stamp != file.stamp) {
            file.stamp = std::move(stamp);
            file.changed = hash_of_file(file.path) != file.hash;
        }
        any = any || file.changed;
    }
    return any;
}

/// Waits for news at most so long, and takes it.
bool FileWatch::is_told(int longest_ms) const {
    pollfd asked{inotify_, POLLIN, 0};
    const bool told = ::poll(&asked, inotify_ >= 0 ? 1 : 0, longest_ms) > 0;
    std::array<char, 4096> news{};
    while (told && ::read(inotify_, news.data(), news.size()) > 0)
        ;
    return told;
}

std::vector<fs::path> FileWatch::wait() {
    while (!look())
        is_told(look_each_ms);
    const auto is_gone = [](const Watched& file) { return file.changed && file.stamp == "gone"; };
    for (bool quiet = false; !quiet;) {
        const auto before = std::ranges::count_if(files_, is_gone);
        quiet = !is_told(before > 0 ? gone_ms : quiet_ms);
        const std::vector<Watched> then = files_;
        look();
        quiet = quiet && std::ranges::equal(then, files_, {}, &Watched::stamp, &Watched::stamp);
    }
    std::vector<fs::path> changed;
    for (const Watched& file : files_)
        if (file.changed)
            changed.push_back(file.path);
    return changed.empty() ? wait() : changed; // all as it was again
}

} // namespace fernlicht
