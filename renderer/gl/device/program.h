// Shader programs from the embedded files, one per set of features.
#pragma once

#include "renderer/gl/device/context.h"

#include <string>
#include <vector>

namespace fernlicht::gl {

/// A linked program. `#include "name.glsl"` lines are resolved among the embedded shader files (each file once), so that the driver's
/// messages can be given with file and line. Throws DeviceError with the driver's message on failure.
class Program {
  public:
    struct Define {
        std::string name, value;
    };
    Program(Context& context, const std::string& vertex_file, const std::string& fragment_file, const std::vector<Define>& defines);
    ~Program();
    Program(Program&& other) noexcept;
    Program& operator=(Program&&) = delete;

    void use() const;
    /// Location, or -1 where the variant has no use for it (setting it is then a no-op).
    GLint uniform(const char* name) const;

  private:
    Context* context_;
    GLuint program_ = 0;
};

} // namespace fernlicht::gl
