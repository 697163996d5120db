#include "runner/can/text_lines.h"

#include "runner/interruption.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cerrno>
#include <poll.h>
#include <system_error>
#include <unistd.h>

namespace fernlicht {

bool TextLines::fill() {
    buffer_.erase(0, begin_);
    begin_ = 0;
    if (buffer_.size() > longest_line)
        throw InputError({"standard input", number_ + 1, 0, {}}, "found a line of more than 16 MiB", "shorter ones");
    constexpr std::size_t piece = std::size_t{1} << 18;
    for (;;) {
        // A handler of signals may restart read(), so the wait is here, and not for long at once.
        ::pollfd one{STDIN_FILENO, POLLIN, 0};
        if (Interruption::asked())
            break;
        if (::poll(&one, 1, 200) <= 0)
            continue;
        const std::size_t before = buffer_.size();
        buffer_.resize(before + piece);
        const ::ssize_t got = ::read(STDIN_FILENO, buffer_.data() + before, piece);
        const int error = errno;
        buffer_.resize(before + static_cast<std::size_t>(std::max<::ssize_t>(got, 0)));
        if (got > 0)
            return true;
        if (got == 0)
            break;
        if (error != EINTR)
            throw InputError({"standard input", 0, 0, {}}, "cannot be read: " + std::generic_category().message(error));
    }
    at_end_ = true;
    return false;
}

bool TextLines::next() {
    std::size_t searched = begin_;
    for (;;) {
        if (const std::size_t end = buffer_.find('\n', searched); end != std::string::npos) {
            text_ = std::string_view(buffer_).substr(begin_, end - begin_);
            begin_ = end + 1;
            ++number_;
            return true;
        }
        const std::size_t left = buffer_.size() - begin_;
        if (at_end_ || !fill())
            break;
        searched = left;
    }
    if (begin_ == buffer_.size() || Interruption::asked()) // half a line before Ctrl-C is none
        return false;
    text_ = std::string_view(buffer_).substr(begin_);
    begin_ = buffer_.size();
    ++number_;
    return true;
}

} // namespace fernlicht
