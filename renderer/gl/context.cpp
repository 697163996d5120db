#include "renderer/gl/context.h"

#include "scenarios/values/errors.h"

#include <fmt/format.h>
#include <utility>

namespace fernlicht::gl {
namespace {

void GLAD_API_PTR on_debug_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length, const GLchar* message,
                                   const void* user) {
    static_cast<void>(source);
    static_cast<void>(type);
    static_cast<void>(id);
    if (severity == GL_DEBUG_SEVERITY_HIGH)
        static_cast<Context*>(const_cast<void*>(user))->last_error.assign(message, static_cast<std::size_t>(length));
}

std::string text(const GladGLContext& gl, GLenum name) {
    const GLubyte* value = gl.GetString(name);
    return value == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(value));
}

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

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
    info.software =
        contains(info.gl_renderer, "llvmpipe") || contains(info.gl_renderer, "softpipe") || contains(info.gl_renderer, "swrast");
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

namespace fernlicht {
namespace {

std::unique_ptr<gl::Context> open_named(const std::string& name) {
    if (name == "egl")
        return gl::open_egl_surfaceless();
    if (name == "osmesa")
        return gl::open_osmesa();
    const std::string digits = name.substr(std::string("egl-device=").size());
    return gl::open_egl_device(std::stoi(digits));
}

bool is_known(const std::string& name) {
    const std::string prefix = "egl-device=";
    if (name.starts_with(prefix)) {
        const std::string digits = name.substr(prefix.size());
        return !digits.empty() && digits.size() <= 3 && digits.find_first_not_of("0123456789") == std::string::npos;
    }
    return name == "egl" || name == "osmesa";
}

std::vector<std::string> order_of_auto() {
    std::vector<std::string> names;
    for (const gl::EglDevice& device : gl::list_egl_devices())
        if (!device.software)
            names.push_back(fmt::format("egl-device={}", device.index));
    names.insert(names.end(), {"egl", "osmesa"});
    return names;
}

} // namespace

Device::Device(std::unique_ptr<gl::Context> context) : context_(std::move(context)) {}
Device::~Device() = default;
Device::Device(Device&&) noexcept = default;
const DeviceInfo& Device::info() const { return context_->info; }

Device open_device(const std::string& backend) {
    if (backend != "auto" && !is_known(backend))
        throw InputError({{}, 0, 0, "--backend"}, "found '" + printable(backend) + "'", "auto, egl, egl-device=N or osmesa");
    if (backend != "auto")
        return Device(open_named(backend));
    std::string failures;
    for (const std::string& name : order_of_auto()) {
        try {
            return Device(open_named(name));
        } catch (const DeviceError& error) {
            failures += (failures.empty() ? "" : "; ") + std::string(error.what());
        }
    }
    throw DeviceError("nothing here can draw: " + failures);
}

std::vector<BackendAttempt> try_all_backends() {
    std::vector<std::string> names{"egl"};
    for (const gl::EglDevice& device : gl::list_egl_devices())
        names.push_back(fmt::format("egl-device={}", device.index));
    names.emplace_back("osmesa");
    std::vector<BackendAttempt> attempts;
    for (const std::string& name : names) {
        BackendAttempt attempt{name, false, {}, {}};
        try {
            attempt.info = open_named(name)->info;
            attempt.works = true;
        } catch (const DeviceError& error) {
            attempt.failure = error.what();
        }
        attempts.push_back(std::move(attempt));
    }
    return attempts;
}

} // namespace fernlicht
