// The program's exit codes.
#pragma once

namespace fernlicht {

enum class ExitCode {
    within_limits = 0,
    limits_exceeded = 1,
    users_input = 2,
    device = 3,
    ours = 4,
    interrupted = 130, ///< as a shell has it for what SIGINT ended
    terminated = 143   ///< the same for SIGTERM
};

struct ExitMeaning {
    ExitCode code;
    const char* meaning;
};

constexpr ExitMeaning exit_meanings[] = {
    {ExitCode::within_limits, "done; what was judged is within limits"},
    {ExitCode::limits_exceeded,
     "a limit or a baseline exceeded, a requested reading not measured, a class of strictness not kept, a case failed, or a "
     "run interrupted"},
    {ExitCode::users_input, "what was given cannot be used: a file, a flag, a folder for the results"},
    {ExitCode::device, "the machine cannot do it"},
    {ExitCode::ours, "a bug in fernlicht"},
    {ExitCode::interrupted, "Ctrl-C before the first picture, in stability, or in live, which leaves its report"},
    {ExitCode::terminated, "SIGTERM before the first picture"},
};

} // namespace fernlicht
