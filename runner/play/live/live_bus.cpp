#include "runner/play/live/live_bus.h"

#include <memory>

namespace fernlicht {

LiveBus live_bus_of(CanSocketOptions options) {
    const auto socket = std::make_shared<CanSocket>(std::move(options));
    const auto batch = std::make_shared<std::vector<CanFrame>>();
    LiveBus bus;
    bus.receive = [socket, batch](std::vector<CanFrame>& frames, TickClock& clock, std::int64_t) {
        batch->clear();
        socket->receive(*batch);
        if (batch->empty())
            return;
        clock.look();
        for (CanFrame& frame : *batch) {
            frame.time_ns = clock.of_stamp(frame.time_ns);
            if (!frame.error)
                frames.push_back(std::move(frame));
        }
    };
    bus.send = [socket](const CanFrame& frame) { socket->send(frame); };
    bus.account = [socket](LiveFigures& figures, const TickClock& clock) {
        figures.socket = socket->figures();
        for (CanOutage& outage : figures.socket.outages) {
            outage.from_ns = clock.of_monotonic(outage.from_ns);
            outage.until_ns = outage.until_ns == 0 ? 0 : clock.of_monotonic(outage.until_ns);
        }
    };
    return bus;
}

LiveBus live_bus_of(std::vector<CanFrame> recorded) {
    const auto all = std::make_shared<const std::vector<CanFrame>>(std::move(recorded));
    LiveBus bus;
    bus.receive = [all, next = std::size_t{0}](std::vector<CanFrame>& frames, TickClock&, std::int64_t now_ns) mutable {
        for (; next < all->size() && (*all)[next].time_ns <= now_ns; ++next)
            if (!(*all)[next].error)
                frames.push_back((*all)[next]);
    };
    bus.send = [](const CanFrame&) {};
    bus.account = [](LiveFigures&, const TickClock&) {};
    return bus;
}

} // namespace fernlicht
