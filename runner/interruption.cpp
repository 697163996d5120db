#include "runner/interruption.h"

#include <atomic>
#include <csignal>

namespace fernlicht {
namespace {

std::atomic<bool> was_asked{false};
int listening = 0; ///< by the one thread that plays
static_assert(std::atomic<bool>::is_always_lock_free, "the handler may only touch what needs no lock");

extern "C" void on_signal(int signal) {
    was_asked.store(true);
    std::signal(signal, SIG_DFL);
}

} // namespace

Interruption::Interruption() {
    if (listening++ > 0)
        return;
    was_asked.store(false);
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
