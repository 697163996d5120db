// Shader programs from the embedded files, one per set of features.
// What a feature's shader is told: numbers as text, vectors of four, and which outputs are wanted.
#pragma once

#include "renderer/gl/device/context.h"
#include "scenarios/drives/play/frame.h"

#include <fmt/format.h>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <optional>
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
    /// Sets a uniform of the program in use; nothing where the variant has no use for it. Doubles are rounded to floats.
    void set(const char* name, double x) const { context_->gl.Uniform1f(uniform(name), static_cast<float>(x)); }
    void set(const char* name, const glm::vec2& v) const { context_->gl.Uniform2fv(uniform(name), 1, &v[0]); }
    void set(const char* name, const glm::vec3& v) const { context_->gl.Uniform3fv(uniform(name), 1, &v[0]); }
    void set(const char* name, const glm::vec4& v) const { context_->gl.Uniform4fv(uniform(name), 1, &v[0]); }
    void set(const char* name, const glm::mat3& m) const { context_->gl.UniformMatrix3fv(uniform(name), 1, GL_FALSE, &m[0][0]); }
    void set(const char* name, const glm::mat4& m) const { context_->gl.UniformMatrix4fv(uniform(name), 1, GL_FALSE, &m[0][0]); }
    /// Location, or -1 where the variant has no use for it.
    GLint uniform(const char* name) const;

  private:
    Context* context_;
    GLuint program_ = 0;
};

/// WANTED of the shaders: one bit an output.
inline int output_bits(const FrameOutputs& w) {
    return (w.colour ? 1 : 0) | (w.illuminance ? 2 : 0) | (w.target ? 4 : 0) | (w.luminance ? 8 : 0) | (w.depth ? 16 : 0) |
           (w.ids ? 32 : 0) | (w.light ? 64 : 0);
}

inline const char* flag(bool on) { return on ? "1" : "0"; }

/// A constant of the source; it reads back as the same float.
inline std::string literal(double value) { return fmt::format("{:.9e}", static_cast<float>(value)); }

/// LAMP_COUNT, and EACH_LAMP, which calls a macro for each lamp, with its number and the names of its samplers. These take constant indices
/// alone: llvmpipe of Mesa 25 ends the process where a shader fetches by a variable index from an array of samplers and has an array
/// texture beside it.
inline void add_lamp_defines(std::vector<Program::Define>& defines, std::size_t lamps) {
    std::string calls;
    for (std::size_t i = 0; i < lamps; ++i)
        calls += fmt::format("OF({0}, beam_{0}, shadow_{0}) ", i);
    defines.push_back({"LAMP_COUNT", std::to_string(lamps)});
    defines.push_back({"EACH_LAMP(OF)", calls});
}

/// How light is shown, for shaders that are compiled for it.
inline void add_tone_defines(std::vector<Program::Define>& defines, const ToneMapper& tone, const std::optional<glm::dmat3>& white) {
    for (int i = 0; white && i < 3; ++i)
        defines.push_back({std::string("WHITE_") + "RGB"[i],
                           fmt::format("vec3({}, {}, {})", literal((*white)[0][i]), literal((*white)[1][i]), literal((*white)[2][i]))});
    defines.push_back({"TONE_KIND", std::to_string(static_cast<int>(tone.kind))});
    defines.push_back({"TONE_S", literal(tone.s)});
    defines.push_back({"TONE_L_MAX", literal(tone.l_max_cdm2)});
}

/// What floats on the GPU may be above a bound in double, as a factor.
inline constexpr double rounding = 1.001;

inline glm::vec4 four(const glm::dvec3& v, double w = 0.0) { return {glm::vec3(v), static_cast<float>(w)}; }

} // namespace fernlicht::gl
