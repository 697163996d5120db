// Logs of candump line by line: from a file, from memory, or from a pipe that does not end.
#pragma once

#include "scenarios/can/candump_log.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

/// What the stamps of a log count from.
enum class CandumpStamps {
    by_themselves, ///< log form: as they stand. Screen form that starts at 0: delta if a stamp ever falls, else zero; files only
    absolute,      ///< as they stand
    zero,          ///< since the first frame (-tz)
    delta,         ///< since the frame before (-td)
};

struct CandumpReading {
    CandumpStamps stamps = CandumpStamps::by_themselves;
    std::int64_t first_ns = 0;     ///< when the first frame came, of zero and delta stamps
    std::int64_t utc_offset_s = 0; ///< of dates (-tA): local time minus UTC
    bool (*stopped)() = nullptr;   ///< asked while a pipe has nothing: true ends the log there
};

class CandumpStream {
  public:
    enum class What {
        frame,
        lost,        ///< DROPCOUNT: the socket of a channel lost frames
        explanation, ///< of the error frame before (candump -e)
        comment,     ///< a blank line, or one that begins with # or ;
        end
    };
    struct Lost {
        std::string channel;
        std::uint64_t frames = 0, total = 0; ///< since the last such line, and altogether
    };
    static constexpr std::size_t longest_line = std::size_t{1} << 14;

    /// "-" is standard input. Throws InputError where there is nothing to read.
    explicit CandumpStream(const std::filesystem::path& path, const CandumpReading& reading = {});
    /// `text` must outlive it; `path` is for messages.
    CandumpStream(const std::filesystem::path& path, std::string_view text, const CandumpReading& reading = {});
    ~CandumpStream();
    CandumpStream(const CandumpStream&) = delete;
    CandumpStream& operator=(const CandumpStream&) = delete;

    /// The next line. Throws InputError with file, line and column for what is none of these; the line is taken then, and a further call
    /// goes on behind it.
    What next();

    const CandumpLine& line() const { return line_; } ///< the last frame, its time absolute as far as stamps and `first_ns` tell
    const Lost& lost() const { return lost_; }        ///< the last DROPCOUNT
    std::string_view text() const { return text_; }   ///< the line as it stood, without its end
    bool ended() const { return ended_; }             ///< the line had an end; false: the file stops within it
    std::size_t line_number() const { return where_.line; }
    CandumpStamps stamps() const { return stamps_; } ///< what they were taken for; by_themselves: as they stood
    const std::filesystem::path& path() const { return where_.file; }
    bool from_pipe() const { return from_pipe_; } ///< or a terminal: more may come
    /// The next line is not here yet: next() may wait for it.
    bool may_wait() const;

  private:
    bool fetch_line();
    void skip_line();
    bool fill();
    bool has_more_to_read() const;
    void absolute_time();
    bool stamps_fall() const;

    InputError::Where where_;
    CandumpReading reading_;
    int file_ = -1;
    bool from_pipe_ = false, at_end_ = false, skip_line_ = false, ended_ = true, seen_frame_ = false;
    CandumpStamps stamps_ = CandumpStamps::by_themselves;
    std::int64_t last_ns_ = 0;
    std::vector<char> buffer_;
    std::string_view rest_, text_, whole_; ///< not yet taken; the line at hand; all of a text in memory
    CandumpLine line_;
    Lost lost_;
};

} // namespace fernlicht
