// The control thread of a live drive: ticks on time, frames in, frames out.
#pragma once

#include "runner/play/live/frame_order.h"
#include "runner/play/live/live_bus.h"
#include "runner/play/live/live_pictures.h"
#include "runner/play/live/log_writer.h"
#include "scenarios/drives/play/bus_drive.h"

namespace fernlicht {

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
