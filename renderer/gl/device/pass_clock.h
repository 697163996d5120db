// How long each pass of a frame takes: by the GPU's clock where it is reliable, or from finish to finish.
// How many fragments pass the depth test between construction and result(). A driver may shade more: llvmpipe shades whole blocks.
#pragma once

#include "renderer/gl/device/context.h"
#include "scenarios/values/trace.h"

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht::gl {

class PassClock {
  public:
    /// finish: wait for the GPU at each border (the frame gets slower). query: GL_TIME_ELAPSED. Neither: measures nothing. A trace has each
    /// pass as the CPU sees it: with `finish` what the GPU does, else what it is asked for.
    PassClock(Context& context, bool finish, bool query) : context_(&context), finish_(finish), query_(query && !finish) {}
    PassClock(PassClock&& other) noexcept;
    PassClock& operator=(PassClock&&) = delete;
    ~PassClock();

    void begin(const char* name); ///< a literal
    void end();
    /// Waits for the queries. Seconds by pass, in their order.
    std::vector<std::pair<std::string, double>> seconds();

  private:
    struct Pass {
        std::string name;
        GLuint query = 0;
        double seconds = 0.0;
    };
    Context* context_;
    bool finish_, query_;
    std::vector<Pass> passes_;
    std::chrono::steady_clock::time_point since_;
    std::optional<TraceSpan> traced_; ///< of the pass between begin() and end()
};

class FragmentCount {
  public:
    explicit FragmentCount(Context& context) : context_(context) {
        context_.gl.GenQueries(1, &query_);
        context_.gl.BeginQuery(GL_SAMPLES_PASSED, query_);
    }
    ~FragmentCount() { context_.gl.DeleteQueries(1, &query_); }
    FragmentCount(const FragmentCount&) = delete;
    FragmentCount& operator=(const FragmentCount&) = delete;

    /// Ends the count and waits for it. Once.
    std::uint64_t result() const {
        context_.gl.EndQuery(GL_SAMPLES_PASSED);
        GLuint64 count = 0;
        context_.gl.GetQueryObjectui64v(query_, GL_QUERY_RESULT, &count);
        return count;
    }

  private:
    Context& context_;
    GLuint query_ = 0;
};

} // namespace fernlicht::gl
