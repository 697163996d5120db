#include "runner/experiments/accuracy/studies/studies.h"

#include <chrono>

namespace fernlicht {

Interval timed(const std::function<void()>& work) {
    using Clock = std::chrono::steady_clock;
    constexpr double enough_s = 0.1;
    constexpr std::size_t fewest = 3, most = 25;
    std::vector<double> seconds;
    for (double sum = 0.0; seconds.size() < fewest || (sum < enough_s && seconds.size() < most); sum += seconds.back()) {
        const Clock::time_point start = Clock::now();
        work();
        seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    }
    return time_of(seconds).value();
}

} // namespace fernlicht
