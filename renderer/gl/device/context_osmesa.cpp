// OSMesa: Mesa drawing into memory, opened at run time because newer Mesa versions no longer ship it.
#include "renderer/gl/device/context.h"

#include "scenarios/values/errors.h"

#include <array>
#include <dlfcn.h>

namespace fernlicht::gl {
namespace {

// From GL/osmesa.h (Mesa 22.3), named here so that the build does not need that header.
using OsMesaContext = struct osmesa_context*;
constexpr int osmesa_format = 0x22, osmesa_depth_bits = 0x30, osmesa_stencil_bits = 0x31, osmesa_profile = 0x33, osmesa_core_profile = 0x34,
              osmesa_major = 0x36, osmesa_minor = 0x37;

struct OsMesa {
    OsMesaContext (*create)(const int* attributes, OsMesaContext share) = nullptr;
    void (*destroy)(OsMesaContext) = nullptr;
    GLboolean (*make_current)(OsMesaContext, void* buffer, GLenum type, GLsizei width, GLsizei height) = nullptr;
    GLADapiproc (*get_proc)(const char*) = nullptr;
    std::string failure;
};

OsMesa load_osmesa() {
    OsMesa api;
    void* library = nullptr;
    for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"})
        if (library = ::dlopen(name, RTLD_NOW | RTLD_LOCAL); library != nullptr)
            break;
    if (library == nullptr) {
        api.failure = "osmesa: libOSMesa.so.8 is not installed (Debian: libosmesa6)";
        return api;
    }
    api.create = reinterpret_cast<decltype(api.create)>(::dlsym(library, "OSMesaCreateContextAttribs"));
    api.destroy = reinterpret_cast<decltype(api.destroy)>(::dlsym(library, "OSMesaDestroyContext"));
    api.make_current = reinterpret_cast<decltype(api.make_current)>(::dlsym(library, "OSMesaMakeCurrent"));
    api.get_proc = reinterpret_cast<decltype(api.get_proc)>(::dlsym(library, "OSMesaGetProcAddress"));
    if (api.create == nullptr || api.destroy == nullptr || api.make_current == nullptr || api.get_proc == nullptr)
        api.failure = "osmesa: the library lacks an entry point";
    return api;
}

const OsMesa& osmesa() {
    static const OsMesa loaded = load_osmesa();
    return loaded;
}

class OsMesaHolder final : public Context {
  public:
    OsMesaHolder() {
        const OsMesa& api = osmesa();
        if (!api.failure.empty())
            throw DeviceError(api.failure);
        const int attributes[][2] = {{osmesa_format, GL_RGBA},
                                     {osmesa_depth_bits, 0},
                                     {osmesa_stencil_bits, 0},
                                     {osmesa_profile, osmesa_core_profile},
                                     {osmesa_major, 4},
                                     {osmesa_minor, 5},
                                     {0, 0}};
        context_ = api.create(&attributes[0][0], nullptr);
        if (context_ == nullptr)
            throw DeviceError("osmesa: OSMesaCreateContextAttribs for OpenGL 4.5 core failed");
        if (api.make_current(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) != GL_TRUE) {
            api.destroy(context_);
            throw DeviceError("osmesa: OSMesaMakeCurrent failed");
        }
        load_functions(osmesa().get_proc, "osmesa");
    }
    ~OsMesaHolder() override {
        osmesa().make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
        osmesa().destroy(context_);
    }

  private:
    OsMesaContext context_ = nullptr;
    std::array<unsigned char, 16> pixel_{}; ///< the default framebuffer; everything is drawn into framebuffer objects
};

} // namespace

std::unique_ptr<Context> open_osmesa() { return std::make_unique<OsMesaHolder>(); }

} // namespace fernlicht::gl
