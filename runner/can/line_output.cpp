#include "runner/can/line_output.h"

#include "scenarios/values/errors.h"

#include <cerrno>
#include <fcntl.h>
#include <string_view>
#include <system_error>
#include <unistd.h>

namespace fernlicht {

LineOutput::LineOutput(const std::filesystem::path& file, bool force) : path_(file), file_(STDOUT_FILENO) {
    if (file.empty() || file == "-")
        return;
    file_ = ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (force ? O_TRUNC : O_EXCL), 0666);
    if (file_ < 0 && errno == EEXIST)
        throw InputError({{}, 0, 0, "--out"}, printable(file.string(), 400) + " is there already", "a new file, or --force");
    if (file_ < 0)
        throw DeviceError(printable(file.string(), 400) + ": cannot be written: " + std::generic_category().message(errno));
}

LineOutput::~LineOutput() {
    if (file_ != STDOUT_FILENO)
        ::close(file_);
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
            throw DeviceError((path_.empty() ? "standard output" : printable(path_.string(), 400)) +
                              ": cannot be written: " + std::generic_category().message(errno));
        left.remove_prefix(static_cast<std::size_t>(put));
    }
    text_.clear();
    return true;
}

} // namespace fernlicht
