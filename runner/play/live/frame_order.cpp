#include "runner/play/live/frame_order.h"

#include <algorithm>
#include <limits>

namespace fernlicht {
namespace {

constexpr std::int64_t stamp_step_ns = 1000;

std::int64_t stamp_before(std::int64_t time_ns) {
    const std::int64_t over_ns = time_ns % stamp_step_ns;
    return time_ns - (over_ns < 0 ? over_ns + stamp_step_ns : over_ns);
}

} // namespace

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

} // namespace fernlicht
