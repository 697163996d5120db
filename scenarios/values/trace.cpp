#include "scenarios/values/trace.h"

#include <chrono>
#include <mutex>
#include <string_view>

namespace fernlicht {
namespace {

/// Of the process, and never destroyed: threads may end after main() did.
struct Recorder {
    std::mutex mutex;
    Trace trace;
    std::vector<bool> taken; ///< lanes of threads that live
};

Recorder& recorder() {
    static Recorder& one = *new Recorder;
    return one;
}

std::int64_t monotonic_ns() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The lane of a thread, given back when the thread ends.
class ThreadLane {
  public:
    ~ThreadLane() { give_back(); }

    std::size_t number() {
        if (!taken_)
            take("worker");
        return number_;
    }

    /// The first free lane of the role, or a new one.
    void take(std::string_view role) {
        give_back();
        Recorder& r = recorder();
        const std::lock_guard lock(r.mutex);
        for (number_ = 0; number_ < r.taken.size() && (r.taken[number_] || r.trace.lanes[number_] != role);)
            ++number_;
        if (number_ == r.taken.size()) {
            r.taken.push_back(false);
            r.trace.lanes.emplace_back(role);
        }
        r.taken[number_] = taken_ = true;
    }

  private:
    void give_back() {
        if (!std::exchange(taken_, false))
            return;
        Recorder& r = recorder();
        const std::lock_guard lock(r.mutex);
        r.taken[number_] = false;
    }

    bool taken_ = false;
    std::size_t number_ = 0;
};

thread_local ThreadLane lane_of_thread;

} // namespace

void start_tracing() {
    {
        Recorder& r = recorder();
        const std::lock_guard lock(r.mutex);
        r.trace.spans.clear();
        r.trace.left_out = 0;
    }
    lane_of_thread.take("main");
    tracing_is_on.store(true, std::memory_order_relaxed);
}

Trace stop_tracing() {
    tracing_is_on.store(false, std::memory_order_relaxed);
    Recorder& r = recorder();
    const std::lock_guard lock(r.mutex);
    Trace trace{std::move(r.trace.spans), r.trace.lanes, std::exchange(r.trace.left_out, 0)};
    r.trace.spans.clear();
    return trace;
}

void name_traced_thread(const char* role) {
    if (is_tracing())
        lane_of_thread.take(role);
}

void TraceSpan::begin(const char* name, const char* category) {
    open_ = std::make_unique<TracedSpan>(TracedSpan{.name = name, .category = category, .lane = lane_of_thread.number()});
    open_->begin_ns = monotonic_ns();
}

void TraceSpan::end() {
    open_->end_ns = monotonic_ns();
    Recorder& r = recorder();
    const std::lock_guard lock(r.mutex);
    if (!is_tracing()) // what began before the trace was taken
        return;
    if (r.trace.spans.size() < max_traced_spans)
        r.trace.spans.push_back(std::move(*open_));
    else
        ++r.trace.left_out;
}

} // namespace fernlicht
