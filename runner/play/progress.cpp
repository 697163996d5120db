#include "runner/play/progress.h"

#include <algorithm>
#include <fmt/format.h>
#include <unistd.h>

namespace fernlicht {
namespace {

constexpr int bar_width = 24;

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

std::string clock_text(double s) { return fmt::format("{}:{:02}", static_cast<int>(s) / 60, static_cast<int>(s) % 60); }

} // namespace

Progress::Progress(std::string label, int total, bool quiet, std::string counted)
    : label_(std::move(label)), counted_(std::move(counted)), total_(total), quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()), shown_(start_) {}

Progress::~Progress() { show(true); }

void Progress::done(int count) {
    count_ = count;
    show(false);
}

void Progress::show(bool last) {
    if (quiet_ || total_ <= 0)
        return;
    const auto now = std::chrono::steady_clock::now();
    const double elapsed = seconds(now - start_), rate = elapsed > 0.0 ? count_ / elapsed : 0.0;
    const double left = rate > 0.0 ? (total_ - count_) / rate : 0.0;
    if (terminal_) {
        if (!last && seconds(now - shown_) < 0.1)
            return;
        shown_ = now;
        const int filled = bar_width * count_ / total_;
        fmt::print(stderr, "\r{} [{}{}] {}/{} {:.1f}/s, {} left {}", label_, std::string(static_cast<std::size_t>(filled), '#'),
                   std::string(static_cast<std::size_t>(bar_width - filled), '.'), count_, total_, rate, clock_text(left),
                   last ? "\n" : "");
        return;
    }
    const int tenth = 10 * count_ / total_;
    if (last ? tenth_shown_ == 10 : tenth == tenth_shown_)
        return;
    tenth_shown_ = last ? 10 : tenth;
    fmt::print(stderr, "{}: {}/{} {}, {:.1f}/s, {} left\n", label_, count_, total_, counted_, rate, clock_text(left));
}

} // namespace fernlicht
