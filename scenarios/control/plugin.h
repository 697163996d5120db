// A control law from a shared library (fernlicht_control.h) or an FMU (fmu_law.h), called and watched.
// Calls code of others so that its crash, or its not coming back, is an error and no end.
#pragma once

#include "scenarios/control/lamp_controller.h"
#include "scenarios/values/errors.h"

#include <functional>
#include <string>

namespace fernlicht {

class ControlPlugin {
  public:
    /// Loads the library and makes the law's state. Throws InputError naming the library for a file that is none, a missing function, a
    /// wrong version, and a state that could not be made; for an FMU as FmuLaw does.
    ControlPlugin(const PluginParameters& parameters, const std::vector<ControlledLamp>& lamps, double control_period_s);
    ControlPlugin(ControlPlugin&&) noexcept;
    ~ControlPlugin();

    /// Calls the law when its period is over, with the table as the laws before left it, and takes its commands into table and segments.
    /// Between calls its last commands hold. A command that is no number or out of range is left out and counted. Throws InputError when
    /// the law crashes, throws, reports a failure, or takes longer than `give_up_s`.
    void step(SignalTable& table, std::vector<std::vector<double>>& segments, const Surroundings& surroundings);

    /// How it went: calls, time over the budget, commands left out. Times are the machine's: they go into notes and nowhere else.
    std::vector<std::string> notes() const;
    /// What ends the drive where not one command of the law could be used: most of its calls had some that were no numbers or out of
    /// range, and none changed anything. nullopt: some were used, or none was given.
    std::optional<InputError> unusable() const;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

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
