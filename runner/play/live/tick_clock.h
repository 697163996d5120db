// The time of a live drive: when its ticks are due, and when on it a frame came that the kernel stamped.
#pragma once

#include <cstdint>
#include <string>

namespace fernlicht {

/// Times of the drive in ns from its 0 s. By CLOCK_MONOTONIC, which nobody sets; stamps of CLOCK_REALTIME are brought over by the
/// difference of both at the time of reading, so that a clock that is set or slewed meanwhile moves no tick.
class TickClock {
  public:
    /// The drive's 0 s is `ahead_ns` from now, moved to the next whole microsecond of CLOCK_REALTIME.
    explicit TickClock(std::int64_t ahead_ns);

    std::int64_t now_ns() const;
    /// Sleeps until then (clock_nanosleep, absolute); not at all when that is over. Also ends when a signal comes in.
    void sleep_until(std::int64_t time_ns) const;
    /// Of the drive, for a stamp of CLOCK_REALTIME that lies shortly before now.
    std::int64_t of_stamp(std::int64_t realtime_ns) const { return realtime_ns - realtime_offset_ns_; }
    std::int64_t of_monotonic(std::int64_t monotonic_ns) const { return monotonic_ns - start_monotonic_ns_; }
    /// Measures the difference of both clocks anew; to be called before of_stamp().
    void look();

    std::int64_t start_realtime_ns() const { return start_realtime_ns_; } ///< of the drive's 0 s: whole microseconds
    /// Largest change of the difference between both clocks since the start: NTP's slewing, or somebody set the clock.
    std::int64_t set_by_ns() const { return set_by_ns_; }

  private:
    std::int64_t start_monotonic_ns_ = 0, start_realtime_ns_ = 0;
    std::int64_t realtime_offset_ns_ = 0; ///< CLOCK_REALTIME minus time of the drive
    std::int64_t set_by_ns_ = 0;
};

/// What the calling thread got of what makes it punctual; "" where it got it, else why not.
struct Punctuality {
    std::string no_priority;     ///< SCHED_FIFO
    std::string no_locked_pages; ///< mlockall: pages that were touched stay in memory
};
Punctuality be_punctual();

} // namespace fernlicht
