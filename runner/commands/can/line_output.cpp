#include "runner/commands/can/line_output.h"

#include "scenarios/values/errors.h"

#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace fernlicht {

LineOutput::LineOutput(const std::filesystem::path& file, bool force) : path_(file), file_(STDOUT_FILENO) {
    if (!file.empty() && file != "-")
        open(force);
}

void LineOutput::fail(int error) const {
    throw DeviceError((path_.empty() ? "standard output" : printable(path_.string(), 400)) +
                      ": cannot be written: " + std::generic_category().message(error));
}

void LineOutput::refuse(int error) const {
    if (error == ENOSPC || error == EIO || error == EMFILE || error == ENFILE)
        fail(error);
    throw InputError({{}, 0, 0, "--out"}, printable(path_.string(), 400) + " cannot be written: " + std::generic_category().message(error),
                     "a new file in a folder that can be written to");
}

void LineOutput::open(bool force) {
    struct stat status {};
    const bool is_there = ::stat(path_.c_str(), &status) == 0;
    if (is_there && (S_ISCHR(status.st_mode) || S_ISFIFO(status.st_mode))) { // nothing there to lose
        file_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    } else if (is_there && S_ISREG(status.st_mode) && force) {
        if (::access(path_.c_str(), W_OK) != 0)
            refuse(errno);
        std::error_code error;
        target_ = std::filesystem::canonical(path_, error); // behind links: those stay
        if (error)
            fail(error.value());
        part_ = target_.string() + fmt::format(".part-{}", ::getpid());
        file_ = ::open(part_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
        if (file_ >= 0)
            ::fchmod(file_, status.st_mode & 07777);
    } else {
        file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (force ? 0 : O_EXCL), 0666);
        is_new_ = !is_there;
    }
    if (file_ < 0 && errno == EEXIST)
        throw InputError({{}, 0, 0, "--out"}, printable(path_.string(), 400) + " is there already", "a new file, or --force");
    if (file_ < 0)
        refuse(errno);
}

LineOutput::~LineOutput() {
    if (!finished_ && part_.empty()) {
        try {
            flush();
        } catch (const DeviceError&) { // what went wrong first is told
        }
    }
    if (file_ == STDOUT_FILENO)
        return;
    if (file_ >= 0)
        ::close(file_);
    if (!finished_ && (!part_.empty() || (is_new_ && !has_bytes_)))
        ::unlink(part_.empty() ? path_.c_str() : part_.c_str());
}

void LineOutput::finish() {
    flush();
    if (file_ != STDOUT_FILENO) {
        const int file = std::exchange(file_, -1);
        if (::close(file) != 0)
            fail(errno);
        if (!part_.empty() && ::rename(part_.c_str(), target_.c_str()) != 0)
            fail(errno);
    }
    finished_ = true;
}

bool LineOutput::flush() {
    std::string_view left = text_;
    while (!left.empty()) {
        const ::ssize_t put = ::write(file_, left.data(), left.size());
        if (put < 0 && errno == EINTR)
            continue;
        if (put < 0 && errno == EPIPE)
            return false;
        if (put < 0)
            fail(errno);
        has_bytes_ = true;
        left.remove_prefix(static_cast<std::size_t>(put));
    }
    text_.clear();
    return true;
}

} // namespace fernlicht
