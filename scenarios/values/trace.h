// What a program spends its time on, as spans on threads. Off until start_tracing(); a span then costs one branch.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace fernlicht {

/// One piece of work of one thread.
struct TracedSpan {
    const char *name, *category;           ///< literals
    std::int64_t begin_ns = 0, end_ns = 0; ///< CLOCK_MONOTONIC, which all processes of a machine share
    std::size_t lane = 0;                  ///< of Trace::lanes
    std::vector<std::pair<const char*, std::variant<std::int64_t, std::string>>> details = {};
};

struct Trace {
    std::vector<TracedSpan> spans;  ///< in the order in which they ended
    std::vector<std::string> lanes; ///< what their threads do: "main", "writer". Threads that live one after the other share a lane
    std::size_t left_out = 0;       ///< spans beyond max_traced_spans
};

inline constexpr std::size_t max_traced_spans = 1'000'000; ///< of 64 bytes and more each

inline std::atomic<bool> tracing_is_on{false};
inline bool is_tracing() { return tracing_is_on.load(std::memory_order_relaxed); }

/// From here on spans are recorded, those of earlier calls are gone. The calling thread is "main".
void start_tracing();
/// Ends it and hands over what ended since; a span that is open now is lost.
Trace stop_tracing();

/// What the calling thread does, a literal; before its first span. Threads that do not say are "worker".
void name_traced_thread(const char* role);

/// From its construction to its end, of the thread that both happen on.
class TraceSpan {
  public:
    /// Both literals: "read back", "renderer".
    TraceSpan(const char* name, const char* category) {
        if (is_tracing())
            begin(name, category);
    }
    ~TraceSpan() {
        if (open_)
            end();
    }
    TraceSpan(const TraceSpan&) = delete;
    TraceSpan& operator=(const TraceSpan&) = delete;

    /// Whether it is recorded, so that nobody makes details for nothing.
    explicit operator bool() const { return open_ != nullptr; }
    /// `key` is a literal. Only where it is recorded.
    void tell(const char* key, std::variant<std::int64_t, std::string> value) { open_->details.emplace_back(key, std::move(value)); }

  private:
    void begin(const char* name, const char* category);
    void end();

    std::unique_ptr<TracedSpan> open_;
};

} // namespace fernlicht
