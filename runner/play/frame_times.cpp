#include "runner/play/frame_times.h"

#include <algorithm>
#include <sys/resource.h>

namespace fernlicht {
namespace {

std::optional<double> mean(const std::vector<double>& samples) {
    const std::optional<Spread> spread = spread_of(samples);
    return spread ? std::optional(spread->mean) : std::nullopt;
}

/// Largest resident memory of this process until now. Linux counts in KiB.
double peak_memory_mib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

} // namespace

bool FrameTimes::begin_moment(const std::string& kind) {
    ++moment_;
    moment_s_ = 0.0;
    alone_ = false;
    kind_ = nullptr;
    if (!no_times_.empty())
        return false;
    if (moment_ < warm_up_)
        return always_alone_;
    if (moment_ == warm_up_)
        warm_ = Clock::now();
    kind_ = &kinds_[kind];
    ++kind_->moments;
    alone_ = always_alone_ || kind_->last_alone < 0 || moment_ - kind_->last_alone >= alone_every;
    if (alone_)
        kind_->last_alone = moment_;
    return alone_;
}

void FrameTimes::add_sample(const std::string& pass, double seconds) {
    auto known = std::ranges::find(passes_, pass, &PassTime::name);
    if (known == passes_.end())
        known = passes_.insert(known, {pass, {}});
    known->seconds.push_back(seconds);
}

void FrameTimes::add(const std::string& name, const Frame& frame) {
    add(frame);
    if (!alone_)
        return;
    add_sample(name, frame.cpu_s);
    for (const auto& [pass, seconds] : frame.pass_s)
        add_sample(name + ": " + pass, seconds);
}

void FrameTimes::end_moment() {
    if (alone_)
        kind_->drawing_s.push_back(moment_s_);
}

void FrameTimes::finish(PlayedCell& played) const {
    if (played.no_times = no_times_; !no_times_.empty()) {
        played.throughput.peak_memory_mib = peak_memory_mib();
        return;
    }
    played.passes = passes_;
    played.warm_up_dropped = std::min(warm_up_, moment_ + 1);
    Throughput& result = played.throughput;
    result.peak_memory_mib = peak_memory_mib();
    result.moments = std::max(0, moment_ + 1 - warm_up_);
    if (result.moments == 0)
        return;
    result.wall_s = std::chrono::duration<double>(Clock::now() - warm_).count();
    const auto frame = std::ranges::find(passes_, std::string("frame"), &PassTime::name);
    result.view_s = frame == passes_.end() ? std::nullopt : mean(frame->seconds);
    result.drawing_s = 0.0;
    for (const auto& [name, kind] : kinds_) // each has a sample: its first moment is drawn alone
        *result.drawing_s += mean(kind.drawing_s).value_or(0.0) * kind.moments / result.moments;
}

} // namespace fernlicht
