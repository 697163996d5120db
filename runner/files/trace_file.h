// A run's trace as a file of Chrome's trace event format, which Perfetto and chrome://tracing open.
#pragma once

#include "scenarios/values/trace.h"

#include <filesystem>
#include <string>
#include <vector>

namespace fernlicht {

/// `{"traceEvents": [...]}`, an event a line: complete events (ph X, ts and dur in microseconds of CLOCK_MONOTONIC) and the names of
/// process and threads (ph M).
std::string trace_json(const Trace& trace, const std::string& process, int pid);

/// One file of those that trace_json() made in several processes of one machine; `out` may be among them, and is written durably. A file
/// that is not there or ends too soon, as of a process that was killed, is left out: gives a sentence for each. Throws DeviceError.
std::vector<std::string> merge_traces(const std::vector<std::filesystem::path>& files, const std::filesystem::path& out);

/// A file that another process writes with a TraceFile of its own: what it says goes into this process's, which removes it in the end, and
/// its folder where nothing else is in it. Named twice it is one file. Only while this one is traced.
void join_trace_of_process(const std::filesystem::path& file);

/// Records from its construction to its end, and writes then, durably, also when an error comes by.
class TraceFile {
  public:
    /// Records nothing for "". `process` names it on the timeline. `folder` is one that the run will make, "" for none. Throws InputError
    /// naming --trace for a file that is there already, or in a folder that is neither there nor below `folder`.
    TraceFile(std::filesystem::path path, std::string process, const std::filesystem::path& folder);
    /// As finish(), but what keeps it from being written is a warning. An error of the run says enough where there is no folder.
    ~TraceFile();
    TraceFile(const TraceFile&) = delete;
    TraceFile& operator=(const TraceFile&) = delete;

    /// Ends the trace and writes it. Throws DeviceError.
    void finish();

  private:
    std::filesystem::path path_;
    std::string process_;
};

} // namespace fernlicht
