// An OpenGL 4.5 core context without a window, and the functions it gives.
#pragma once

#include "renderer/device.h"

#include <glad/gl.h>

namespace fernlicht::gl {

/// RAII: opened and current on construction, released and destroyed at the end. Not copyable, not movable.
class Context {
  public:
    virtual ~Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    GladGLContext gl{};
    DeviceInfo info;
    int compiled_programs = 0;                               ///< so far
    SurfaceFilter surface_filter = SurfaceFilter::mipmapped; ///< of surface textures uploaded from now on
    std::string last_error;                                  ///< of high severity, from the debug callback; "" if none

    /// Throws DeviceError if the driver reported an error of high severity or glGetError says so. `doing` names what was done.
    void check(const char* doing);

  protected:
    Context() = default;
    /// Loads every function through `load`, checks the version, installs the debug callback, fills `info`.
    void load_functions(GLADapiproc (*load)(const char*), const std::string& backend);
};

/// Throw DeviceError with the reason.
std::unique_ptr<Context> open_egl_surfaceless();
std::unique_ptr<Context> open_egl_device(int index);
std::unique_ptr<Context> open_osmesa();

struct EglDevice {
    int index = 0;
    bool software = false;
};
/// Devices that EGL enumerates; empty when it cannot.
std::vector<EglDevice> list_egl_devices();

} // namespace fernlicht::gl
