// EGL without a window system: surfaceless on Mesa, enumerated devices on GPUs. libEGL is opened at run time, so that a machine
// without it can still draw through OSMesa.
#include "renderer/gl/device/context.h"

#include "scenarios/values/errors.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <array>
#include <cstring>
#include <dlfcn.h>
#include <fmt/format.h>

namespace fernlicht::gl {
namespace {

/// libEGL.so.1 and the entry points used. Stays open for the life of the process: drivers do not like to be unloaded.
struct Egl {
    decltype(&::eglGetProcAddress) get_proc = nullptr;
    decltype(&::eglInitialize) initialize = nullptr;
    decltype(&::eglTerminate) terminate = nullptr;
    decltype(&::eglBindAPI) bind_api = nullptr;
    decltype(&::eglChooseConfig) choose_config = nullptr;
    decltype(&::eglCreateContext) create_context = nullptr;
    decltype(&::eglDestroyContext) destroy_context = nullptr;
    decltype(&::eglMakeCurrent) make_current = nullptr;
    decltype(&::eglGetError) get_error = nullptr;
    decltype(&::eglReleaseThread) release_thread = nullptr;
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display = nullptr;
    PFNEGLQUERYDEVICESEXTPROC query_devices = nullptr;
    PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string = nullptr;
    std::string failure;
};

template <class F> void take(void* library, const char* name, F& function, std::string& failure) {
    function = reinterpret_cast<F>(::dlsym(library, name));
    if (function == nullptr && failure.empty())
        failure = fmt::format("libEGL.so.1 lacks {}", name);
}

Egl load_egl() {
    Egl egl;
    void* library = ::dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
        egl.failure = fmt::format("libEGL.so.1 cannot be opened: {}", ::dlerror());
        return egl;
    }
    take(library, "eglGetProcAddress", egl.get_proc, egl.failure);
    take(library, "eglInitialize", egl.initialize, egl.failure);
    take(library, "eglTerminate", egl.terminate, egl.failure);
    take(library, "eglBindAPI", egl.bind_api, egl.failure);
    take(library, "eglChooseConfig", egl.choose_config, egl.failure);
    take(library, "eglCreateContext", egl.create_context, egl.failure);
    take(library, "eglDestroyContext", egl.destroy_context, egl.failure);
    take(library, "eglMakeCurrent", egl.make_current, egl.failure);
    take(library, "eglGetError", egl.get_error, egl.failure);
    take(library, "eglReleaseThread", egl.release_thread, egl.failure);
    if (!egl.failure.empty())
        return egl;
    egl.get_platform_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(egl.get_proc("eglGetPlatformDisplayEXT"));
    egl.query_devices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl.get_proc("eglQueryDevicesEXT"));
    egl.query_device_string = reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(egl.get_proc("eglQueryDeviceStringEXT"));
    if (egl.get_platform_display == nullptr)
        egl.failure = "libEGL.so.1 lacks eglGetPlatformDisplayEXT";
    return egl;
}

const Egl& egl() {
    static const Egl loaded = load_egl();
    return loaded;
}

std::vector<EGLDeviceEXT> enumerate_devices() {
    const Egl& api = egl();
    EGLint count = 0;
    if (!api.failure.empty() || api.query_devices == nullptr || api.query_devices(0, nullptr, &count) != EGL_TRUE || count <= 0)
        return {};
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    if (api.query_devices(count, devices.data(), &count) != EGL_TRUE)
        return {};
    devices.resize(static_cast<std::size_t>(count));
    return devices;
}

class EglContext final : public Context {
  public:
    EglContext(EGLDisplay display, const std::string& backend) : display_(display) {
        try {
            open(backend);
        } catch (...) {
            close();
            throw;
        }
    }
    ~EglContext() override { close(); }

  private:
    [[noreturn]] static void fail(const std::string& backend, const char* what) {
        throw DeviceError(fmt::format("{}: {} failed (EGL error 0x{:04x})", backend, what, egl().get_error()));
    }

    void open(const std::string& backend) {
        const Egl& api = egl();
        if (display_ == EGL_NO_DISPLAY)
            fail(backend, "eglGetPlatformDisplay");
        EGLint major = 0, minor = 0;
        if (api.initialize(display_, &major, &minor) != EGL_TRUE) {
            display_ = EGL_NO_DISPLAY;
            fail(backend, "eglInitialize");
        }
        if (api.bind_api(EGL_OPENGL_API) != EGL_TRUE)
            fail(backend, "eglBindAPI");
        const std::array config_wishes{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (api.choose_config(display_, config_wishes.data(), &config, 1, &count) != EGL_TRUE || count < 1)
            fail(backend, "eglChooseConfig");
        const std::array wishes{EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
        context_ = api.create_context(display_, config, EGL_NO_CONTEXT, wishes.data());
        if (context_ == EGL_NO_CONTEXT)
            fail(backend, "eglCreateContext for OpenGL 4.5 core");
        if (api.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE)
            fail(backend, "eglMakeCurrent without a surface");
        load_functions([](const char* name) { return reinterpret_cast<GLADapiproc>(egl().get_proc(name)); }, backend);
    }

    void close() {
        const Egl& api = egl();
        if (display_ == EGL_NO_DISPLAY)
            return;
        api.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context_ != EGL_NO_CONTEXT)
            api.destroy_context(display_, context_);
        api.terminate(display_);
        api.release_thread();
        display_ = EGL_NO_DISPLAY;
    }

    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

const Egl& loaded_egl(const std::string& backend) {
    const Egl& api = egl();
    if (!api.failure.empty())
        throw DeviceError(backend + ": " + api.failure);
    return api;
}

} // namespace

std::unique_ptr<Context> open_egl_surfaceless() {
    const Egl& api = loaded_egl("egl");
    return std::make_unique<EglContext>(api.get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr), "egl");
}

std::unique_ptr<Context> open_egl_device(int index) {
    const std::string backend = fmt::format("egl-device={}", index);
    const Egl& api = loaded_egl(backend);
    const std::vector<EGLDeviceEXT> devices = enumerate_devices();
    if (index < 0 || static_cast<std::size_t>(index) >= devices.size())
        throw DeviceError(fmt::format("{}: there are {} EGL devices", backend, devices.size()));
    return std::make_unique<EglContext>(
        api.get_platform_display(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(index)], nullptr), backend);
}

std::vector<EglDevice> list_egl_devices() {
    std::vector<EglDevice> list;
    for (EGLDeviceEXT device : enumerate_devices()) {
        const char* extensions = egl().query_device_string == nullptr ? nullptr : egl().query_device_string(device, EGL_EXTENSIONS);
        const bool software = extensions != nullptr && std::strstr(extensions, "EGL_MESA_device_software") != nullptr;
        list.push_back({static_cast<int>(list.size()), software});
    }
    return list;
}

} // namespace fernlicht::gl
