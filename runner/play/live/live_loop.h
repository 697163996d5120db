// The control thread of a live drive: ticks on time, frames in, frames out.
#pragma once

#include "runner/play/live/can_socket.h"
#include "runner/play/live/live_figures.h"
#include "runner/play/live/live_pictures.h"
#include "runner/play/live/log_writer.h"
#include "runner/play/live/tick_clock.h"
#include "scenarios/can/can_frame.h"
#include "scenarios/drives/play/bus_drive.h"

#include <filesystem>
#include <functional>
#include <span>
#include <vector>

namespace fernlicht {

/// Which control tick a frame counts for, so that a recording of what was used is the live run again.
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

/// Where a live drive's frames come from and where its own go: an interface of the kernel, or a recording at its own pace.
struct LiveBus {
    /// Appends the frames that have come until now, stamped from the drive's 0 s, error frames left out.
    std::function<void(std::vector<CanFrame>& frames, TickClock& clock, std::int64_t now_ns)> receive;
    std::function<void(const CanFrame& frame)> send;
    /// Puts down what was lost. `clock`: by which outages are told.
    std::function<void(LiveFigures& figures, const TickClock& clock)> account;
};

/// Throws as CanSocket does.
LiveBus live_bus_of(CanSocketOptions options);
/// `frames`: stamped from the drive's 0 s, in order. What is sent goes nowhere.
LiveBus live_bus_of(std::vector<CanFrame> frames);

/// What the loop works with; all of it outlives the loop.
struct LiveParts {
    const Drive& drive;
    BusDrive& play;
    LiveBus& bus;
    TickClock& clock;
    LogWriter &recording, &sent; ///< frames as they were used, frames as they were due
    LivePictures* pictures;      ///< nullptr: none are drawn
    std::function<bool()> interrupted;
    bool wait = true; ///< false: a tick follows the other at once, and is on time by definition
    std::int64_t listen_ns = 0;
};

class LiveLoop {
  public:
    explicit LiveLoop(LiveParts parts) : parts_(std::move(parts)) {}

    /// Until the drive's end, its route's, or an interruption. What it counts goes into `figures`. Throws what a policy, a law or the
    /// socket throws, with the figures as they were then.
    void run(LiveFigures& figures);
    bool was_interrupted() const { return interrupted_; }

  private:
    void play(LiveFigures& figures);
    bool listen();
    bool tick(LiveFigures& figures);
    void receive(std::int64_t now_ns);
    void send(const std::vector<CanFrame>& frames, LiveFigures& figures);
    void offer_pictures(LiveFigures& figures);
    std::int64_t now_ns(std::int64_t at_ns) const { return parts_.wait ? parts_.clock.now_ns() : at_ns; }
    void sleep_until(std::int64_t time_ns) const;

    LiveParts parts_;
    FrameOrder order_;
    std::vector<CanFrame> batch_;
    int next_moment_ = 0;
    std::deque<LivePicture> pending_;
    bool interrupted_ = false;
};

} // namespace fernlicht
