// How long each pass of a frame takes: by the GPU's clock where it can be believed, or from finish to finish.
#pragma once

#include "renderer/gl/device/context.h"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht::gl {

class PassClock {
  public:
    /// finish: wait for the GPU at each border (the frame gets slower). query: GL_TIME_ELAPSED. Neither: measures nothing.
    PassClock(Context& context, bool finish, bool query) : context_(&context), finish_(finish), query_(query && !finish) {}
    PassClock(PassClock&& other) noexcept;
    PassClock& operator=(PassClock&&) = delete;
    ~PassClock();

    void begin(const char* name);
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
};

} // namespace fernlicht::gl
