#include "runner/files/trace_file.h"

#include "runner/files/durable_files.h"
#include "runner/files/json_text.h"
#include "runner/files/log.h"
#include "runner/files/output_folder.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "scenarios/values/version.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <set>
#include <sstream>
#include <unistd.h>
#include <utility>

namespace fernlicht {
namespace {

constexpr const char* beginning = "{\"displayTimeUnit\":\"ms\",\"otherData\":{";
constexpr const char* first_event = "},\"traceEvents\":[";
constexpr const char* ending = "]}";
constexpr std::size_t max_trace_bytes = std::size_t{1} << 30;

std::string file_of(const std::string& about, const std::vector<std::string>& events) {
    return beginning + about + first_event + "\n" + fmt::format("{}", fmt::join(events, ",\n")) + "\n" + ending + "\n";
}

std::string name_event(const char* what, int pid, std::size_t tid, const std::string& name) {
    return fmt::format(R"({{"ph":"M","pid":{},"tid":{},"name":"{}","args":{{"name":{}}}}})", pid, tid, what, json_quoted(name));
}

std::string span_event(const TracedSpan& span, int pid) {
    const auto us = [](std::int64_t ns) { return fmt::format("{}.{:03}", ns / 1000, ns % 1000); };
    std::string details;
    for (const auto& [key, value] : span.details)
        details += fmt::format("{}\"{}\":{}", details.empty() ? "" : ",", key,
                               std::holds_alternative<std::int64_t>(value) ? fmt::format("{}", std::get<std::int64_t>(value))
                                                                           : json_quoted(std::get<std::string>(value)));
    return fmt::format(R"({{"ph":"X","pid":{},"tid":{},"ts":{},"dur":{},"name":"{}","cat":"{}","args":{{{}}}}})", pid, span.lane + 1,
                       us(span.begin_ns), us(span.end_ns - span.begin_ns), span.name, span.category, details);
}

/// The events of a file of trace_json(). Throws InputError for any other.
std::vector<std::string> events_of(const std::filesystem::path& file) {
    FilesRead ignored;
    std::istringstream lines(read_file(file, ignored, max_trace_bytes));
    std::vector<std::string> events;
    std::string line;
    if (!std::getline(lines, line) || !line.starts_with(beginning) || !line.ends_with(first_event))
        throw InputError({file, 1, 0, ""}, "found no trace of fernlicht");
    while (std::getline(lines, line) && line != ending) {
        if (line.ends_with(','))
            line.pop_back();
        events.push_back(std::move(line));
    }
    if (line != ending)
        throw InputError({file, events.size() + 2, 0, ""}, "found the end of the file within the trace");
    return events;
}

/// Of processes that this one started.
std::vector<std::filesystem::path>& other_traces() {
    static std::vector<std::filesystem::path> files;
    return files;
}

/// Into the trace of this process.
void take_other_traces(const std::filesystem::path& path) {
    const std::vector<std::filesystem::path> others = std::exchange(other_traces(), {});
    if (others.empty())
        return;
    std::vector<std::filesystem::path> all{path};
    all.insert(all.end(), others.begin(), others.end());
    for (const std::string& sentence : merge_traces(all, path))
        tell(LogLevel::warning, sentence);
    std::error_code ignored;
    for (const std::filesystem::path& file : others) {
        std::filesystem::remove(file, ignored);
        std::filesystem::remove(file.parent_path(), ignored);
    }
}

} // namespace

void join_trace_of_process(const std::filesystem::path& file) {
    if (std::ranges::find(other_traces(), file) == other_traces().end())
        other_traces().push_back(file);
}

std::string trace_json(const Trace& trace, const std::string& process, int pid) {
    std::vector<std::string> events{name_event("process_name", pid, 0, process)};
    std::set<std::size_t> lanes;
    for (const TracedSpan& span : trace.spans)
        lanes.insert(span.lane);
    for (const std::size_t lane : lanes)
        events.push_back(name_event("thread_name", pid, lane + 1, trace.lanes[lane]));
    for (const TracedSpan& span : trace.spans)
        events.push_back(span_event(span, pid));
    return file_of(
        fmt::format(R"("program":"fernlicht {}","clock":"CLOCK_MONOTONIC","spans_left_out":{})", program_version, trace.left_out), events);
}

std::vector<std::string> merge_traces(const std::vector<std::filesystem::path>& files, const std::filesystem::path& out) {
    std::vector<std::string> all, left_out;
    for (const std::filesystem::path& file : files)
        try {
            std::vector<std::string> events = events_of(file);
            all.insert(all.end(), std::move_iterator(events.begin()), std::move_iterator(events.end()));
        } catch (const InputError& error) {
            left_out.push_back(fmt::format("left out of the trace: {}", error.what()));
        }
    write_durably(out, file_of(fmt::format(R"("program":"fernlicht {}","clock":"CLOCK_MONOTONIC")", program_version), all));
    return left_out;
}

TraceFile::TraceFile(std::filesystem::path path, std::string process, const std::filesystem::path& folder)
    : path_(std::move(path)), process_(std::move(process)) {
    if (path_.empty())
        return;
    refuse_unwritable("--trace", path_, folder);
    other_traces().clear();
    start_tracing();
}

TraceFile::~TraceFile() {
    try {
        finish();
    } catch (const std::exception& error) {
        tell(LogLevel::warning, error.what());
    }
}

void TraceFile::finish() {
    const std::filesystem::path path = std::exchange(path_, {});
    if (path.empty())
        return;
    const Trace trace = stop_tracing();
    std::error_code ignored;
    if (const std::filesystem::path folder = path.parent_path(); !folder.empty() && !std::filesystem::is_directory(folder, ignored))
        return; // the run made none
    write_durably(path, trace_json(trace, process_, ::getpid()));
    take_other_traces(path);
    if (trace.left_out > 0)
        tell(LogLevel::warning, fmt::format("the trace has the first {} spans; {} more are left out", trace.spans.size(), trace.left_out));
}

} // namespace fernlicht
