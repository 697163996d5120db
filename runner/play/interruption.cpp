#include "runner/play/interruption.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <ctime>

namespace fernlicht {
namespace {

std::atomic<bool> was_asked{false};
std::atomic<std::int64_t> asked_at_ns{0};        ///< CLOCK_MONOTONIC; 0: not yet
constexpr std::int64_t at_once_ns = 500'000'000; ///< what comes so soon was the same wish, sent to a process and to its group
int listening = 0;                               ///< by the one thread that plays
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free,
              "the handler may only touch what needs no lock");

extern "C" void on_signal(int signal) {
    const int error = errno;
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    const std::int64_t now_ns = std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
    std::int64_t first_ns = 0;
    const bool first = asked_at_ns.compare_exchange_strong(first_ns, now_ns);
    was_asked.store(true);
    if (!first && now_ns - first_ns >= at_once_ns) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
    errno = error;
}

} // namespace

Interruption::Interruption() {
    if (listening++ > 0)
        return;
    was_asked.store(false);
    asked_at_ns.store(0);
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
}

Interruption::~Interruption() {
    if (--listening > 0)
        return;
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool Interruption::asked() { return was_asked.load(); }

} // namespace fernlicht
