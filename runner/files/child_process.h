// Other programs, started as child processes.
#pragma once

#include <cstdio>
#include <string>
#include <sys/types.h>
#include <vector>

namespace fernlicht {

/// Its standard streams; what is negative stays this program's.
struct ChildStreams {
    int in = -1, out = -1, error = -1;
};

/// Starts words[0], found by the PATH, with its words. No shell is between: words stay words. Its process group is its own: Ctrl-C on the
/// terminal is for this program alone. Throws DeviceError where it cannot be started: "ffmpeg cannot be started: ...".
pid_t start_program(std::vector<std::string> words, const ChildStreams& streams);

/// Waits for its end; gives the status of waitpid().
int end_of_program(pid_t program);

} // namespace fernlicht
