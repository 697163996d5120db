// Which control tick a frame counts for, so that a recording of what was used is the live run again.
#pragma once

#include "scenarios/can/can_frame.h"

#include <span>
#include <vector>

namespace fernlicht {

/// Stamps leave as whole microseconds (a candump log holds no more), never before that of the frame ahead, and behind every tick that has
/// been asked for: a frame that came too late for the tick of its stamp counts for the next, is stamped so, and is counted.
class FrameOrder {
  public:
    FrameOrder();
    /// In the order of reception. `frame.time_ns`: of the drive, from its 0 s. `now_ns`: likewise; a stamp after it, of a clock that was
    /// set back, becomes it.
    void add(CanFrame frame, std::int64_t now_ns);
    /// The frames for this tick: stamped until it. They are gone with the next call. Ticks ascend.
    std::span<const CanFrame> due(std::int64_t tick_ns);

    std::uint64_t late() const { return late_; }                           ///< frames
    std::int64_t latest_ns() const { return latest_ns_; }                  ///< the largest time that one came behind its tick
    std::uint64_t from_future() const { return from_future_; }             ///< frames stamped after they were read
    std::size_t waiting() const { return waiting_.size() - handed_over_; } ///< for later ticks

  private:
    std::vector<CanFrame> waiting_;
    std::size_t handed_over_ = 0; ///< the first so many of them
    std::int64_t earliest_ns_;    ///< of the next stamp
    std::int64_t last_tick_ns_;
    std::uint64_t late_ = 0, from_future_ = 0;
    std::int64_t latest_ns_ = 0;
};

} // namespace fernlicht
