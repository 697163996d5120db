// Where a live drive's frames come from and where its own go: an interface of the kernel, or a recording at its own pace.
#pragma once

#include "runner/play/live/can_socket.h"
#include "runner/play/live/live_figures.h"
#include "runner/play/live/tick_clock.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace fernlicht {

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

} // namespace fernlicht
