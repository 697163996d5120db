#include "runner/play/live/live_loop.h"

#include "runner/play/capture.h"
#include "scenarios/drives/play/advance.h"

#include <algorithm>
#include <limits>
#include <memory>

namespace fernlicht {
namespace {

constexpr std::int64_t listening_step_ns = 5'000'000;
constexpr std::size_t max_pending = 16;

double seconds_of(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

constexpr std::int64_t stamp_step_ns = 1000;

std::int64_t stamp_before(std::int64_t time_ns) {
    const std::int64_t over_ns = time_ns % stamp_step_ns;
    return time_ns - (over_ns < 0 ? over_ns + stamp_step_ns : over_ns);
}

} // namespace

void LiveLoop::sleep_until(std::int64_t time_ns) const {
    if (parts_.wait)
        parts_.clock.sleep_until(time_ns);
}

void LiveLoop::receive(std::int64_t now_ns) {
    batch_.clear();
    parts_.bus.receive(batch_, parts_.clock, now_ns);
    for (CanFrame& frame : batch_)
        order_.add(std::move(frame), now_ns);
}

void LiveLoop::send(const std::vector<CanFrame>& frames, LiveFigures& figures) {
    figures.outputs += frames.size();
    for (const CanFrame& frame : frames) {
        parts_.bus.send(frame);
        parts_.sent.add(frame);
    }
}

/// What signals are before the first tick.
bool LiveLoop::listen() {
    for (std::int64_t at_ns = -parts_.listen_ns; parts_.wait && at_ns < 0; at_ns += listening_step_ns) {
        sleep_until(at_ns);
        if (parts_.interrupted())
            return false;
        receive(parts_.clock.now_ns());
    }
    return true;
}

/// Settled moments that the drawing thread may want.
void LiveLoop::offer_pictures(LiveFigures& figures) {
    for (const int settled = parts_.play.moments(); next_moment_ < settled; ++next_moment_) {
        const bool captured = is_captured(parts_.drive.capture, next_moment_, parts_.drive.step_s);
        ++figures.moments;
        figures.captures += captured ? 1 : 0;
        if (parts_.pictures && pending_.size() < max_pending && parts_.pictures->wanted(captured))
            pending_.push_back({parts_.play.moment(next_moment_), captured});
    }
    while (!pending_.empty() && parts_.pictures->offer(pending_.front()))
        pending_.pop_front();
}

bool LiveLoop::tick(LiveFigures& figures) {
    BusDrive& play = parts_.play;
    const std::int64_t time_ns = play.next_tick_ns();
    for (std::int64_t due_ns = play.next_output_ns(); due_ns < time_ns; due_ns = play.next_output_ns()) {
        sleep_until(due_ns);
        send(play.send_until(due_ns), figures);
    }
    sleep_until(time_ns);
    if (parts_.interrupted())
        return false;
    const std::int64_t begun_ns = now_ns(time_ns);
    receive(begun_ns);
    for (const CanFrame& frame : order_.due(time_ns)) {
        play.take(frame);
        parts_.recording.add(frame);
        ++figures.used;
    }
    send(play.step(), figures);
    const std::int64_t done_ns = now_ns(time_ns);
    figures.late_s.push_back(seconds_of(begun_ns - time_ns));
    figures.work_s.push_back(seconds_of(done_ns - begun_ns));
    figures.overruns += done_ns > time_ns + std::llround(1e9 * figures.period_s) ? 1U : 0U;
    offer_pictures(figures);
    return true;
}

void LiveLoop::play(LiveFigures& figures) {
    const auto planned = static_cast<std::size_t>(figures.ticks_planned) + 1;
    figures.late_s.reserve(planned);
    figures.work_s.reserve(planned);
    interrupted_ = !listen();
    while (!interrupted_ && !parts_.play.done())
        interrupted_ = !tick(figures);
}

void LiveLoop::run(LiveFigures& figures) {
    const auto account = [&] {
        if (parts_.wait)
            receive(parts_.clock.now_ns());
        figures.unused = order_.waiting();
        figures.late = order_.late();
        figures.latest_s = seconds_of(order_.latest_ns());
        figures.from_future = order_.from_future();
        figures.clock_set_by_ns = parts_.clock.set_by_ns();
        parts_.bus.account(figures, parts_.clock);
        if (parts_.pictures)
            parts_.pictures->end();
    };
    try {
        play(figures);
    } catch (...) {
        account();
        throw;
    }
    account();
}

FrameOrder::FrameOrder() : earliest_ns_(std::numeric_limits<std::int64_t>::min()), last_tick_ns_(earliest_ns_) {}

void FrameOrder::add(CanFrame frame, std::int64_t now_ns) {
    if (frame.time_ns > now_ns) {
        ++from_future_;
        frame.time_ns = now_ns;
    }
    if (frame.time_ns <= last_tick_ns_) {
        ++late_;
        latest_ns_ = std::max(latest_ns_, last_tick_ns_ - frame.time_ns);
    }
    frame.time_ns = std::max(stamp_before(frame.time_ns), earliest_ns_);
    earliest_ns_ = frame.time_ns;
    waiting_.push_back(std::move(frame));
}

std::span<const CanFrame> FrameOrder::due(std::int64_t tick_ns) {
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(handed_over_));
    const auto later = std::ranges::upper_bound(waiting_, tick_ns, {}, &CanFrame::time_ns);
    handed_over_ = static_cast<std::size_t>(later - waiting_.begin());
    last_tick_ns_ = tick_ns;
    earliest_ns_ = std::max(earliest_ns_, stamp_before(tick_ns) + stamp_step_ns);
    return {waiting_.data(), handed_over_};
}

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
