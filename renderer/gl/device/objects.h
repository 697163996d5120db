// OpenGL names with owners: a buffer, texture, framebuffer or vertex array lives as long as its C++ object.
#pragma once

#include "renderer/gl/device/context.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace fernlicht::gl {

/// A GL name freed by `Free` (a member of GladGLContext). The context must outlive it.
template <auto Free> class Name {
  public:
    Name() = default;
    Name(Context& context, GLuint name) : context_(&context), name_(name) {}
    Name(Name&& other) noexcept : context_(std::exchange(other.context_, nullptr)), name_(std::exchange(other.name_, 0)) {}
    Name& operator=(Name&& other) noexcept {
        std::swap(context_, other.context_);
        std::swap(name_, other.name_);
        return *this;
    }
    ~Name() {
        if (context_ != nullptr && name_ != 0)
            (context_->gl.*Free)(1, &name_);
    }
    operator GLuint() const { return name_; }

  private:
    Context* context_ = nullptr;
    GLuint name_ = 0;
};

using Buffer = Name<&GladGLContext::DeleteBuffers>;
using Texture = Name<&GladGLContext::DeleteTextures>;
using Framebuffer = Name<&GladGLContext::DeleteFramebuffers>;
using VertexArray = Name<&GladGLContext::DeleteVertexArrays>;

/// Immutable storage holding `bytes`; empty content still gets one byte, because GL forbids buffers of size 0.
Buffer make_buffer(Context& context, std::span<const std::byte> bytes, GLbitfield flags = 0);
/// A buffer that the GPU writes and the CPU maps for reading.
Buffer make_read_buffer(Context& context, std::size_t bytes);
template <class T> Buffer make_buffer(Context& context, const std::vector<T>& values, GLbitfield flags = 0) {
    return make_buffer(context, std::as_bytes(std::span(values)), flags);
}
template <class T> void update_buffer(Context& context, GLuint buffer, const std::vector<T>& values) {
    if (!values.empty())
        context.gl.NamedBufferSubData(buffer, 0, static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data());
}

/// A buffer with room for more than it holds.
struct GrowingBuffer {
    Buffer buffer;
    std::size_t room = 0;

    template <class T> void fill(Context& context, const std::vector<T>& values) {
        if (room < values.size() || buffer == 0) {
            room = std::max<std::size_t>(2 * values.size(), 16);
            buffer = make_buffer(context, std::vector<T>(room), GL_DYNAMIC_STORAGE_BIT);
        }
        update_buffer(context, buffer, values);
    }
};

Texture new_texture(Context& context, GLenum target);
/// One level, nearest filter, clamped to the edge. Throws DeviceError when the driver's size limit is exceeded.
Texture make_texture(Context& context, GLenum internal_format, int width, int height);

VertexArray make_vertex_array(Context& context);
Framebuffer make_framebuffer(Context& context);

} // namespace fernlicht::gl
