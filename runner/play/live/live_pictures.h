// Pictures of a live drive: the control thread says what may be drawn, the drawing thread takes what it can.
#pragma once

#include "scenarios/drives/play/moment.h"

#include <deque>
#include <mutex>
#include <optional>
#include <semaphore>

namespace fernlicht {

struct LivePicture {
    Moment moment;
    bool captured = false; ///< the drive wants it stored
};

/// Between the two threads. Moments that are to be stored wait, a few of them; of all others only the newest is kept.
class LivePictures {
  public:
    /// Whether a picture of this kind would be taken: making one costs the control thread time.
    bool wanted(bool captured);
    /// Never waits: false where the other thread was just looking; offer it again.
    bool offer(LivePicture& picture);
    /// Waits until there is one or all are told; nullopt: no more will come.
    std::optional<LivePicture> take();
    void end();

  private:
    static constexpr std::size_t max_captured = 16;
    std::mutex mutex_;
    std::counting_semaphore<> news_{0};
    std::deque<LivePicture> captured_;
    std::optional<LivePicture> newest_;
    bool ended_ = false;
};

} // namespace fernlicht
