#include "renderer/gl/device/pass_clock.h"

#include <utility>

namespace fernlicht::gl {

PassClock::PassClock(PassClock&& other) noexcept
    : context_(other.context_), finish_(other.finish_), query_(other.query_), passes_(std::exchange(other.passes_, {})),
      since_(other.since_) {}

PassClock::~PassClock() {
    for (const Pass& pass : passes_)
        if (pass.query != 0)
            context_->gl.DeleteQueries(1, &pass.query);
}

void PassClock::begin(const char* name) {
    if (is_tracing())
        traced_.emplace(name, "pass");
    if (!finish_ && !query_)
        return;
    passes_.push_back({name, 0, 0.0});
    if (query_) {
        context_->gl.GenQueries(1, &passes_.back().query);
        context_->gl.BeginQuery(GL_TIME_ELAPSED, passes_.back().query);
        return;
    }
    context_->gl.Finish();
    since_ = std::chrono::steady_clock::now();
}

void PassClock::end() {
    if (query_)
        context_->gl.EndQuery(GL_TIME_ELAPSED);
    if (finish_) {
        context_->gl.Finish();
        passes_.back().seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - since_).count();
    }
    traced_.reset();
}

std::vector<std::pair<std::string, double>> PassClock::seconds() {
    std::vector<std::pair<std::string, double>> result;
    for (const Pass& pass : passes_) {
        double seconds = pass.seconds;
        if (pass.query != 0) {
            GLuint64 nanoseconds = 0;
            context_->gl.GetQueryObjectui64v(pass.query, GL_QUERY_RESULT, &nanoseconds);
            seconds = 1e-9 * static_cast<double>(nanoseconds);
        }
        result.emplace_back(pass.name, seconds);
    }
    return result;
}

} // namespace fernlicht::gl
