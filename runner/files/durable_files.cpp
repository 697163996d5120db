#include "runner/files/durable_files.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <system_error>
#include <unistd.h>

namespace fernlicht {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what, int error) {
    throw DeviceError(path.string() + ": " + what + ": " + std::generic_category().message(error));
}

void sync(const std::filesystem::path& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0)
        fail(path, "cannot be opened", errno);
    const int error = ::fsync(file) == 0 ? 0 : errno;
    ::close(file);
    // Some network file systems cannot sync a folder and say EINVAL; they have no later moment at which they could.
    if (error != 0 && error != EINVAL)
        fail(path, "cannot be written to the disk", error);
}

int open_to_lock(const std::filesystem::path& path) {
    std::error_code ignored;
    return std::filesystem::is_directory(path, ignored) ? ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)
                                                        : ::open(path.c_str(), O_RDWR | O_CLOEXEC);
}

} // namespace

void write_durably(const std::filesystem::path& path, const std::string& content) {
    static std::atomic<unsigned> written{0};
    std::array<char, 64> host{};
    ::gethostname(host.data(), host.size() - 1);
    const std::filesystem::path part = path.string() + fmt::format(".part-{}-{}-{}", host.data(), ::getpid(), ++written);
    try {
        write_file(part, content);
        sync(part);
        rename_durably(part, path);
    } catch (const DeviceError& error) {
        ::unlink(part.c_str());
        std::string text = error.what(); // nobody knows the file by that name
        if (text.starts_with(part.native()))
            text.replace(0, part.native().size(), path.native());
        throw DeviceError(text);
    }
}

void rename_durably(const std::filesystem::path& from, const std::filesystem::path& to) {
    std::error_code error;
    std::filesystem::rename(from, to, error);
    if (error)
        fail(to, "cannot be written", error.value());
    sync_folder(to.parent_path());
}

void sync_folder(const std::filesystem::path& folder) { sync(folder.empty() ? "." : folder); }

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        fail(folder, "cannot be created", error.value());
}

FolderLock::FolderLock(const std::filesystem::path& path, For what) : file_(open_to_lock(path)) {
    const bool reading = what == For::reading;
    if (file_ < 0 && !reading)
        fail(path, "cannot be opened", errno);
    while (file_ >= 0 && ::flock(file_, reading ? LOCK_SH : LOCK_EX) != 0)
        if (errno != EINTR) {
            const int error = errno;
            if (reading)
                return;
            ::close(file_);
            fail(path, "cannot be locked", error);
        }
}

std::unique_ptr<FolderLock> FolderLock::at_once(const std::filesystem::path& path) {
    const int file = open_to_lock(path);
    if (file < 0)
        fail(path, "cannot be opened", errno);
    while (::flock(file, LOCK_EX | LOCK_NB) != 0)
        if (errno != EINTR) {
            const int error = errno;
            ::close(file);
            if (error == EWOULDBLOCK)
                return nullptr;
            fail(path, "cannot be locked", error);
        }
    return std::unique_ptr<FolderLock>(new FolderLock(file));
}

FolderLock::~FolderLock() {
    if (file_ >= 0)
        ::close(file_);
}

} // namespace fernlicht
