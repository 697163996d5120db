// How many fragments pass the depth test between construction and result(). A driver may shade more: llvmpipe shades whole blocks.
#pragma once

#include "renderer/gl/device/context.h"

namespace fernlicht::gl {

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
