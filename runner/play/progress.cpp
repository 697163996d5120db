#include "runner/play/progress.h"

#include "runner/files/log.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <fmt/format.h>
#include <string_view>
#include <unistd.h>

namespace fernlicht {
namespace {

constexpr int bar_width = 24;

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

std::string clock_text(double s) { return fmt::format("{}:{:02}", static_cast<int>(s) / 60, static_cast<int>(s) % 60); }

std::atomic<bool> was_requested{false};
std::atomic<int> requested_by{0};                ///< the first signal
std::atomic<std::int64_t> requested_at_ns{0};    ///< CLOCK_MONOTONIC; 0: not yet
constexpr std::int64_t at_once_ns = 500'000'000; ///< what comes so soon was the same wish, sent to a process and to its group
int listening = 0;                               ///< by the one thread that plays
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free,
              "the handler may only touch what needs no lock");

void (*before_terminated)(int) = SIG_DFL;

extern "C" void on_signal(int signal) {
    const int error = errno;
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    const std::int64_t now_ns = std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
    std::int64_t first_ns = 0;
    const bool first = requested_at_ns.compare_exchange_strong(first_ns, now_ns);
    if (first)
        requested_by.store(signal);
    was_requested.store(true);
    if (!first && now_ns - first_ns >= at_once_ns) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
    errno = error;
}

} // namespace

bool is_for_eyes() {
    const char* const terminal = std::getenv("TERM");
    return ::isatty(STDERR_FILENO) == 1 && !log_settings().json && !(terminal != nullptr && std::string_view(terminal) == "dumb");
}

Progress::Progress(std::string label, int total, bool quiet, std::string counted)
    : label_(std::move(label)), counted_(std::move(counted)), total_(total), quiet_(quiet || !is_told(LogLevel::info)),
      terminal_(is_for_eyes()), start_(std::chrono::steady_clock::now()), shown_(start_) {}

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
    if (log_settings().json ? (last ? tenth_shown_ == 10 : tenth == tenth_shown_) : last || seconds(now - shown_) < 60.0)
        return;
    tenth_shown_ = last ? 10 : tenth;
    shown_ = now;
    tell(LogLevel::info, fmt::format("{}: {}/{} {}", label_, count_, total_, counted_),
         {{"progress", label_}, {"done", std::int64_t{count_}}, {"total", std::int64_t{total_}}, {"per_s", rate}, {"left_s", left}});
}

Interruption::Interruption() {
    if (listening++ > 0)
        return;
    was_requested.store(false);
    requested_at_ns.store(0);
    std::signal(SIGINT, on_signal);
    before_terminated = std::signal(SIGTERM, on_signal);
}

Interruption::~Interruption() {
    if (--listening > 0)
        return;
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, before_terminated);
}

bool Interruption::requested() { return was_requested.load(); }

std::string Interruption::words() { return requested_by.load() == SIGTERM ? "interrupted by SIGTERM" : "interrupted by the user"; }

} // namespace fernlicht
