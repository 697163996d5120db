#include "runner/play/live/tick_clock.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <system_error>

namespace fernlicht {
namespace {

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr int fifo_priority = 20; ///< above all that is not real-time; below threads of the kernel's interrupts (50)

std::int64_t read_clock_ns(clockid_t clock) {
    timespec now{};
    ::clock_gettime(clock, &now);
    return std::int64_t{now.tv_sec} * second_ns + now.tv_nsec;
}

/// CLOCK_REALTIME minus CLOCK_MONOTONIC. Of a few tries the one between whose readings the least time went by.
std::int64_t clocks_apart_ns() {
    std::int64_t best_ns = second_ns, apart_ns = 0;
    for (int i = 0; i < 3; ++i) {
        const std::int64_t before_ns = read_clock_ns(CLOCK_MONOTONIC), real_ns = read_clock_ns(CLOCK_REALTIME);
        const std::int64_t after_ns = read_clock_ns(CLOCK_MONOTONIC);
        if (after_ns - before_ns < best_ns) {
            best_ns = after_ns - before_ns;
            apart_ns = real_ns - (before_ns + (after_ns - before_ns) / 2);
        }
    }
    return apart_ns;
}

} // namespace

TickClock::TickClock(std::int64_t ahead_ns) {
    const std::int64_t apart_ns = clocks_apart_ns();
    start_realtime_ns_ = (read_clock_ns(CLOCK_MONOTONIC) + ahead_ns + apart_ns + 999) / 1000 * 1000;
    start_monotonic_ns_ = start_realtime_ns_ - apart_ns;
    realtime_offset_ns_ = start_realtime_ns_;
}

std::int64_t TickClock::now_ns() const { return read_clock_ns(CLOCK_MONOTONIC) - start_monotonic_ns_; }

void TickClock::sleep_until(std::int64_t time_ns) const {
    const std::int64_t until_ns = start_monotonic_ns_ + time_ns;
    const timespec until{until_ns / second_ns, until_ns % second_ns};
    ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

void TickClock::look() {
    realtime_offset_ns_ = clocks_apart_ns() + start_monotonic_ns_;
    set_by_ns_ = std::max(set_by_ns_, std::abs(realtime_offset_ns_ - start_realtime_ns_));
}

Punctuality be_punctual() {
    Punctuality got;
    const sched_param parameters{fifo_priority};
    if (const int error = ::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &parameters); error != 0)
        got.no_priority = std::generic_category().message(error);
    if (::mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) != 0)
        got.no_locked_pages = std::generic_category().message(errno);
    return got;
}

} // namespace fernlicht
