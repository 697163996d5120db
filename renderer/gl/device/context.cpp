#include "renderer/gl/device/context.h"

#include "scenarios/values/errors.h"

#include <fmt/format.h>
#include <utility>

namespace fernlicht::gl {
namespace {

void GLAD_API_PTR on_debug_message(GLenum /*source*/, GLenum /*type*/, GLuint /*id*/, GLenum severity, GLsizei length,
                                   const GLchar* message, const void* user) {
    if (severity == GL_DEBUG_SEVERITY_HIGH)
        static_cast<Context*>(const_cast<void*>(user))->last_error.assign(message, static_cast<std::size_t>(length));
}

std::string text(const GladGLContext& gl, GLenum name) {
    const GLubyte* value = gl.GetString(name);
    return value == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(value));
}

bool is_software(const std::string& renderer) {
    const auto contains = [&](const char* part) { return renderer.find(part) != std::string::npos; };
    return contains("llvmpipe") || contains("softpipe") || contains("swrast");
}

} // namespace

void Context::load_functions(GLADapiproc (*load)(const char*), const std::string& backend) {
    const int version = gladLoadGLContext(&gl, load);
    if (version < GLAD_MAKE_VERSION(4, 5))
        throw DeviceError(
            fmt::format("{}: OpenGL {}.{} is too old, 4.5 is needed", backend, GLAD_VERSION_MAJOR(version), GLAD_VERSION_MINOR(version)));
    info.backend = backend;
    info.gl_version = text(gl, GL_VERSION);
    info.gl_renderer = text(gl, GL_RENDERER);
    info.gl_vendor = text(gl, GL_VENDOR);
    info.software = is_software(info.gl_renderer);
    gl.Enable(GL_DEBUG_OUTPUT);
    gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    gl.DebugMessageCallback(on_debug_message, this);
}

void Context::check(const char* doing) {
    if (!last_error.empty())
        throw DeviceError(fmt::format("{}: {} says: {}", doing, info.gl_renderer, std::exchange(last_error, {})));
    if (const GLenum error = gl.GetError(); error != GL_NO_ERROR)
        throw DeviceError(fmt::format("{}: OpenGL error 0x{:04x} from {}", doing, error, info.gl_renderer));
}

} // namespace fernlicht::gl
