#include "scenarios/can/candump_stream.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fcntl.h>
#include <limits>
#include <poll.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace fernlicht {
namespace {

constexpr std::size_t stream_buffer_bytes = std::size_t{1} << 18;

bool is_candump_comment(std::string_view text) {
    return text.empty() || text.front() == '#' || text.front() == ';' || text.find_first_not_of(" \t\r") == std::string_view::npos;
}

bool take_text(std::string_view& rest, std::string_view text) {
    if (!rest.starts_with(text))
        return false;
    rest.remove_prefix(text.size());
    return true;
}

bool take_count(std::string_view& rest, std::uint64_t& count) {
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), count);
    if (error != std::errc{})
        return false;
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    return true;
}

/// "DROPCOUNT: dropped 2 CAN frames on 'can0' socket (total drops 7)"
bool is_drop_count(std::string_view rest, CandumpStream::Lost& lost) {
    if (!take_text(rest, "DROPCOUNT: dropped ") || !take_count(rest, lost.frames) || !take_text(rest, " CAN frame"))
        return false;
    take_text(rest, "s");
    if (!take_text(rest, " on '"))
        return false;
    const std::size_t quote = rest.find('\'');
    if (quote > 15) // npos, too
        return false;
    lost.channel.assign(rest, 0, quote);
    rest.remove_prefix(quote);
    if (!take_text(rest, "' socket (total drops ") || !take_count(rest, lost.total) || !take_text(rest, ")"))
        return false;
    return rest.empty() || rest == "\r";
}

std::string system_reason(int error) { return std::generic_category().message(error); }

} // namespace

CandumpStream::CandumpStream(const std::filesystem::path& path, const CandumpReading& reading)
    : where_{path, 0, 0, {}}, reading_(reading), buffer_(stream_buffer_bytes) {
    if (path == "-") {
        where_.file = "standard input";
        file_ = STDIN_FILENO;
        from_pipe_ = true;
        return;
    }
    file_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file_ < 0)
        throw InputError({path, 0, 0, {}}, "cannot be read: " + system_reason(errno), "a log of candump, or - for standard input");
    struct stat status {};
    if (::fstat(file_, &status) == 0 && S_ISDIR(status.st_mode)) {
        ::close(file_);
        throw InputError({path, 0, 0, {}}, "is a folder", "a log of candump, or - for standard input");
    }
    from_pipe_ = !S_ISREG(status.st_mode);
}

CandumpStream::CandumpStream(const std::filesystem::path& path, std::string_view text, const CandumpReading& reading)
    : where_{path, 0, 0, {}}, reading_(reading), at_end_(true), rest_(text), whole_(text) {}

CandumpStream::~CandumpStream() {
    if (file_ > STDIN_FILENO)
        ::close(file_);
}

bool CandumpStream::may_wait() const { return !at_end_ && rest_.find('\n') == std::string_view::npos; }

/// Waits until read() would not. False: asked to stop. A handler of signals may restart read(), so the wait is here, and not for long at
/// once: a signal between question and wait would be slept through.
bool CandumpStream::has_more_to_read() const {
    for (;;) {
        if (reading_.stopped())
            return false;
        ::pollfd one{file_, POLLIN, 0};
        if (::poll(&one, 1, 200) > 0)
            return true;
    }
}

/// More of the file behind what is left; false at its end.
bool CandumpStream::fill() {
    if (rest_.size() > longest_line)
        return false;
    if (!rest_.empty())
        std::memmove(buffer_.data(), rest_.data(), rest_.size());
    for (;;) {
        if (from_pipe_ && reading_.stopped && !has_more_to_read()) {
            at_end_ = true;
            rest_ = {buffer_.data(), rest_.size()};
            return false;
        }
        const ::ssize_t got = ::read(file_, buffer_.data() + rest_.size(), buffer_.size() - rest_.size());
        if (got > 0) {
            rest_ = {buffer_.data(), rest_.size() + static_cast<std::size_t>(got)};
            return true;
        }
        if (got < 0 && errno == EINTR)
            continue;
        const int error = got < 0 ? errno : 0;
        rest_ = {buffer_.data(), rest_.size()};
        at_end_ = true;
        if (error != 0)
            throw InputError({where_.file, 0, 0, {}}, "cannot be read: " + system_reason(error));
        return false;
    }
}

/// Past the end of the line that is in the buffer in part.
void CandumpStream::skip_line() {
    std::size_t end = 0;
    while ((end = rest_.find('\n')) == std::string_view::npos) {
        rest_ = {};
        if (at_end_ || !fill())
            return;
    }
    rest_.remove_prefix(end + 1);
}

bool CandumpStream::fetch_line() {
    if (std::exchange(skip_line_, false))
        skip_line();
    std::size_t searched = 0;
    for (;;) {
        const std::size_t end = rest_.find('\n', searched);
        if (end <= longest_line) { // not npos
            text_ = rest_.substr(0, end);
            rest_.remove_prefix(end + 1);
            ended_ = true;
            ++where_.line;
            return true;
        }
        if (end != std::string_view::npos || rest_.size() > longest_line) {
            skip_line_ = true; // whoever asks again gets the line behind it
            ++where_.line;
            throw InputError({where_.file, where_.line, 0, {}}, "found a line of more than 16384 bytes", "a log of candump");
        }
        searched = rest_.size();
        if (!at_end_ && fill())
            continue;
        if (rest_.empty())
            return false;
        text_ = rest_;
        rest_ = {};
        ended_ = false;
        ++where_.line;
        return true;
    }
}

CandumpStream::What CandumpStream::next() {
    if (!fetch_line())
        return What::end;
    if (where_.line == 1 && text_.starts_with("\xef\xbb\xbf")) // byte order mark
        text_.remove_prefix(3);
    const char first = text_.empty() ? '\0' : text_.front();
    if (first != '(') { // nearly all lines of a log begin with it
        if (first == '\t' && line_.frame.error)
            return What::explanation;
        if (is_candump_comment(text_))
            return What::comment;
        if (first == 'D' && is_drop_count(text_, lost_))
            return What::lost;
    }
    parse_candump_line(text_, where_, line_);
    absolute_time();
    return What::frame;
}

/// Whether a stamp of the file is ever below the one before: deltas fall, time since the first frame does not.
bool CandumpStream::stamps_fall() const {
    CandumpReading as_they_stand;
    as_they_stand.stamps = CandumpStamps::absolute;
    const auto falls = [](CandumpStream& other) {
        std::int64_t before = 0;
        for (What what = What::comment; what != What::end;) {
            try {
                what = other.next();
            } catch (const InputError& error) { // will be told in its turn
                if (error.where().line == 0)
                    return false;
                what = What::comment;
            }
            if (what != What::frame)
                continue;
            if (other.line().frame.time_ns < before)
                return true;
            before = other.line().frame.time_ns;
        }
        return false;
    };
    if (file_ < 0) {
        CandumpStream other(where_.file, whole_, as_they_stand);
        return falls(other);
    }
    CandumpStream other(where_.file, as_they_stand);
    return falls(other);
}

void CandumpStream::absolute_time() {
    const CandumpStyle& style = line_.style;
    std::int64_t& time_ns = line_.frame.time_ns;
    if (style.stamp_digits == 0)
        return;
    if (!seen_frame_) {
        stamps_ = reading_.stamps;
        if (stamps_ == CandumpStamps::by_themselves && style.second_digits == 3 && time_ns == 0 && !style.date) {
            if (style.form == CandumpStyle::Form::log)
                stamps_ = CandumpStamps::zero; // candump has no delta stamps in logs
            else if (from_pipe_)
                throw InputError(where_, "found stamps that start at 0", "to be told whether they are delta or zero stamps (--stamps)");
            else
                stamps_ = stamps_fall() ? CandumpStamps::delta : CandumpStamps::zero;
        }
        seen_frame_ = true;
        last_ns_ = reading_.first_ns;
    }
    const auto add = [&](std::int64_t to) {
        if (time_ns > std::numeric_limits<std::int64_t>::max() - to)
            throw InputError(where_, "found stamps that add up beyond the year 2262", "delta or zero stamps within it");
        time_ns += to;
    };
    if (stamps_ == CandumpStamps::zero) {
        add(reading_.first_ns);
    } else if (stamps_ == CandumpStamps::delta) {
        add(last_ns_);
        last_ns_ = time_ns;
    } else if (style.date) {
        time_ns -= reading_.utc_offset_s * 1'000'000'000;
        if (time_ns < 0)
            throw InputError(where_, "found a date before 1970 in UTC", "one from 1970 on");
    }
}

} // namespace fernlicht
