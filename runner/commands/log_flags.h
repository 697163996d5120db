// Flags with which the tools of `fernlicht can` read logs of candump.
#pragma once

#include "scenarios/can/candump_stream.h"

#include <cstdint>
#include <string>

namespace CLI {
class App;
}

namespace fernlicht {

struct LogFlags {
    std::string stamps, start, utc_offset; ///< "": by itself, 0, UTC
    bool lenient = false;                  ///< lines that are no frames are skipped and told
};

/// --stamps, --start, --utc-offset, --lenient
void add_log_flags(CLI::App& command, LogFlags& flags);

/// Throws InputError naming the flag.
CandumpReading reading_of(const LogFlags& flags);

/// Seconds with up to nine digits behind the point, exactly; a sign where `negative` is allowed. Throws InputError naming the flag.
std::int64_t nanoseconds_of(const char* flag, const std::string& text, bool negative = false);

/// A stream that steps over bad lines where the flags say so: the first is told on standard error, the others are counted.
class LenientStream {
  public:
    LenientStream(const std::filesystem::path& path, const LogFlags& flags);
    /// As CandumpStream::next.
    CandumpStream::What next();
    const CandumpStream& log() const { return log_; }

  private:
    CandumpStream log_;
    bool lenient_;
    std::uint64_t skipped_ = 0;
};

} // namespace fernlicht
