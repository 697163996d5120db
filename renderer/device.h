// A machine that can draw: an offscreen OpenGL 4.5 context and what it says of itself.
// How the pictures of surfaces are looked up.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace fernlicht {
namespace gl {
class Context;
}

struct DeviceInfo {
    std::string backend; ///< "egl", "egl-device=0", "osmesa"
    std::string gl_version, gl_renderer, gl_vendor;
    bool software = false; ///< llvmpipe, softpipe, swrast
};

/// An open context, current on the thread that opened it. One at a time per process: a second one would draw into the first.
class Device {
  public:
    explicit Device(std::unique_ptr<gl::Context> context);
    ~Device();
    Device(Device&&) noexcept;
    Device& operator=(Device&&) = delete;

    const DeviceInfo& info() const;
    gl::Context& context() { return *context_; }

  private:
    std::unique_ptr<gl::Context> context_;
};

inline constexpr const char* backend_names = "auto, egl, egl-device=N, osmesa or software";

/// Opens one of `backend_names`. auto: the first hardware EGL device, else EGL without a surface, else OSMesa. software: Mesa on the CPU,
/// whatever GPU there is, by EGL or else by OSMesa. Throws InputError for an unknown name, DeviceError with every attempt and why it
/// failed.
Device open_device(const std::string& backend);

/// What `doctor` tells of one way to draw.
struct BackendAttempt {
    std::string backend;
    bool works = false;
    DeviceInfo info;     ///< when it works
    std::string failure; ///< when it does not
};
/// Tries every backend there is, each in a process of its own, so that a driver that crashes is told of like one that fails.
/// Call it before any device is opened.
std::vector<BackendAttempt> try_all_backends();

/// mipmapped: linear within the nearest mipmap level. none: the nearest texel of the finest. trilinear: linear between two levels, too.
enum class SurfaceFilter { mipmapped, none, trilinear };

/// For all renderers that are made on this device from now on. Without it: mipmapped.
void use_surface_filter(Device& device, SurfaceFilter filter);

} // namespace fernlicht
