// Preloaded before a program (LD_PRELOAD): a disk and a clock with faults. By variables, of files below FAULT_BELOW alone:
//   FAULT_FROM=N FAULT_ERRNO=E   the N-th change of the disk of each process, and all after it, fail with this error
//   FAULT_LOG=FILE               a line for each change that worked: "write PATH", "sync PATH", "rename FROM TO"
//   FAULT_CLOCK_S=S              the time of day is so many seconds later (or earlier) than it is
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <dlfcn.h>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

namespace {

const char* variable(const char* name) {
    const char* const value = std::getenv(name);
    return value ? value : "";
}

template <class Function> Function real(const char* name) { return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name)); }

std::string path_of(int file) {
    char path[PATH_MAX];
    const ssize_t length = ::readlink(("/proc/self/fd/" + std::to_string(file)).c_str(), path, sizeof path);
    return length > 0 ? std::string(path, static_cast<std::size_t>(length)) : std::string();
}

bool is_below(const std::string& path) {
    static const std::string below = variable("FAULT_BELOW");
    return !below.empty() && path.rfind(below, 0) == 0;
}

/// Sets errno and says true where this change is to fail.
bool fails(const std::string& path) {
    static std::atomic<long> changes{0};
    static const long from = std::atol(variable("FAULT_FROM"));
    static const int with = std::atoi(variable("FAULT_ERRNO"));
    if (from == 0 || !is_below(path) || ++changes < from)
        return false;
    errno = with;
    return true;
}

void log(const std::string& line, const std::string& path) {
    static const std::string to = variable("FAULT_LOG");
    if (to.empty() || !is_below(path))
        return;
    static const auto open_really = real<int (*)(const char*, int, ...)>("open");
    static const auto write_really = real<ssize_t (*)(int, const void*, std::size_t)>("write");
    const int error = errno, file = open_really(to.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    const std::string text = line + "\n";
    [[maybe_unused]] const ssize_t written = write_really(file, text.data(), text.size());
    ::close(file);
    errno = error;
}

std::time_t shift_s() {
    static const long shift = std::atol(variable("FAULT_CLOCK_S"));
    return shift;
}

} // namespace

extern "C" {

ssize_t write(int file, const void* bytes, std::size_t count) {
    static const auto really = real<ssize_t (*)(int, const void*, std::size_t)>("write");
    const std::string path = path_of(file);
    if (fails(path))
        return -1;
    log("write " + path, path);
    return really(file, bytes, count);
}

ssize_t writev(int file, const iovec* parts, int count) {
    static const auto really = real<ssize_t (*)(int, const iovec*, int)>("writev");
    const std::string path = path_of(file);
    if (fails(path))
        return -1;
    log("write " + path, path);
    return really(file, parts, count);
}

std::size_t fwrite(const void* bytes, std::size_t size, std::size_t count, std::FILE* file) {
    static const auto really = real<std::size_t (*)(const void*, std::size_t, std::size_t, std::FILE*)>("fwrite");
    const std::string path = path_of(::fileno(file));
    if (fails(path))
        return 0;
    log("write " + path, path);
    return really(bytes, size, count, file);
}

int fsync(int file) {
    static const auto really = real<int (*)(int)>("fsync");
    const std::string path = path_of(file);
    if (fails(path))
        return -1;
    const int result = really(file);
    log("sync " + path, path);
    return result;
}

int rename(const char* from, const char* to) {
    static const auto really = real<int (*)(const char*, const char*)>("rename");
    if (fails(to))
        return -1;
    const int result = really(from, to);
    if (result == 0)
        log(std::string("rename ") + from + " " + to, to);
    return result;
}

int mkdir(const char* path, mode_t mode) {
    static const auto really = real<int (*)(const char*, mode_t)>("mkdir");
    return fails(path) ? -1 : really(path, mode);
}

int open(const char* path, int flags, ...) {
    static const auto really = real<int (*)(const char*, int, ...)>("open");
    std::va_list more;
    va_start(more, flags);
    const unsigned mode = flags & O_CREAT ? va_arg(more, unsigned) : 0U;
    va_end(more);
    return flags & O_CREAT && fails(path) ? -1 : really(path, flags, mode);
}

std::FILE* fopen(const char* path, const char* how) {
    static const auto really = real<std::FILE* (*)(const char*, const char*)>("fopen");
    return std::strchr(how, 'w') && fails(path) ? nullptr : really(path, how);
}

int clock_gettime(clockid_t clock, timespec* time) {
    static const auto really = real<int (*)(clockid_t, timespec*)>("clock_gettime");
    const int result = really(clock, time);
    if (result == 0 && clock == CLOCK_REALTIME)
        time->tv_sec += shift_s();
    return result;
}
}
