#include "scenarios/control/guarded_call.h"

#include <array>
#include <chrono>
#include <cmath>
#include <csetjmp>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fmt/format.h>
#include <string_view>
#include <sys/syscall.h>
#include <unistd.h>
#include <vector>

namespace fernlicht {
namespace {

constexpr std::array caught{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM};

sigjmp_buf way_out;
volatile std::sig_atomic_t inside = 0;
pid_t caller = 0;

/// Only the thread that makes the call jumps; another's crash takes its usual course.
void on_signal(int number) {
    if (inside != 0 && static_cast<pid_t>(::syscall(SYS_gettid)) == caller) {
        inside = 0;
        siglongjmp(way_out, number);
    }
    if (number == SIGALRM)
        return;
    std::signal(number, SIG_DFL);
    std::raise(number);
}

/// exit() cannot be undone; but a run that is not finished must not look like one that is.
void on_exit_inside() {
    if (inside == 0)
        return;
    constexpr std::string_view text = "fernlicht: a control plug-in called exit(), expected it to return\n";
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
    ::_exit(2);
}

std::string word(int number, double give_up_s) {
    switch (number) {
    case SIGSEGV:
        return "a segmentation fault";
    case SIGBUS:
        return "a bus error";
    case SIGFPE:
        return "an arithmetic fault";
    case SIGILL:
        return "an illegal instruction";
    case SIGABRT:
        return "abort()";
    default:
        return fmt::format("no return within {:g} s", give_up_s);
    }
}

/// Handlers and their own stack, as long as it lives; what was there before comes back.
class Handlers {
  public:
    Handlers() : stack_(std::size_t{64} << 10) {
        stack_t own{};
        own.ss_sp = stack_.data();
        own.ss_size = stack_.size();
        ::sigaltstack(&own, &old_stack_);
        struct sigaction action {};
        action.sa_handler = on_signal;
        action.sa_flags = SA_ONSTACK | SA_NODEFER;
        for (std::size_t i = 0; i < caught.size(); ++i)
            ::sigaction(caught[i], &action, &old_[i]);
    }
    Handlers(const Handlers&) = delete;
    Handlers& operator=(const Handlers&) = delete;
    ~Handlers() {
        for (std::size_t i = 0; i < caught.size(); ++i)
            ::sigaction(caught[i], &old_[i], nullptr);
        ::sigaltstack(&old_stack_, nullptr);
    }

  private:
    std::vector<char> stack_;
    stack_t old_stack_{};
    std::array<struct sigaction, caught.size()> old_{};
};

/// SIGALRM to this thread after a time.
class Alarm {
  public:
    explicit Alarm(double seconds) {
        sigevent event{};
        event.sigev_notify = SIGEV_THREAD_ID;
        event.sigev_signo = SIGALRM;
        event._sigev_un._tid = caller;
        armed_ = ::timer_create(CLOCK_MONOTONIC, &event, &timer_) == 0;
        itimerspec after{};
        const double whole = std::floor(seconds);
        after.it_value = {static_cast<time_t>(whole), static_cast<long>((seconds - whole) * 1e9) + 1};
        if (armed_)
            ::timer_settime(timer_, 0, &after, nullptr);
    }
    Alarm(const Alarm&) = delete;
    Alarm& operator=(const Alarm&) = delete;
    ~Alarm() {
        if (armed_)
            ::timer_delete(timer_);
    }

  private:
    timer_t timer_{};
    bool armed_ = false;
};

/// Exceptions end here, on the callee's side of the jump.
std::string called(const std::function<void()>& call) {
    try {
        call();
        return {};
    } catch (const std::exception& error) {
        return fmt::format("an exception: {}", error.what());
    } catch (...) {
        return "an exception";
    }
}

} // namespace

CallOutcome guarded_call(const std::function<void()>& call, double give_up_s) {
    CallOutcome outcome;
    [[maybe_unused]] static const int registered = std::atexit(on_exit_inside);
    caller = static_cast<pid_t>(::syscall(SYS_gettid));
    const auto start = std::chrono::steady_clock::now();
    {
        const Handlers handlers;
        const Alarm alarm(give_up_s);
        if (const int number = sigsetjmp(way_out, 1); number != 0) {
            outcome.failed = word(number, give_up_s);
        } else {
            inside = 1;
            outcome.failed = called(call);
            inside = 0;
        }
    }
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return outcome;
}

} // namespace fernlicht
