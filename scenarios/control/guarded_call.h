// Calls code of others so that its crash, or its not coming back, is an error and no end.
#pragma once

#include <functional>
#include <string>

namespace fernlicht {

struct CallOutcome {
    std::string failed;   ///< "" or what happened: "a segmentation fault", "no return within 10 s", "an exception: ..."
    double seconds = 0.0; ///< wall clock
};

/// Runs `call` on this thread. Caught: exceptions, the signals SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT (stack overflow included), and a
/// call longer than `give_up_s`. After one of them what the callee held is lost, its library must not be called again, and the process
/// should soon end: memory may be damaged. exit() ends the process with code 2 and a sentence. Not caught: other threads that the callee
/// started, writes to memory that is not its own. One guarded call at a time in a process.
CallOutcome guarded_call(const std::function<void()>& call, double give_up_s);

} // namespace fernlicht
