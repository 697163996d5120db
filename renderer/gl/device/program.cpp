#include "renderer/gl/device/program.h"

#include "scenarios/values/errors.h"
#include "shader_files.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <set>
#include <sstream>
#include <utility>

namespace fernlicht::gl {
namespace {

/// Source text with includes pasted in, and where each of its lines comes from. `#line` would not do: Mesa forgets the file's number.
struct Expanded {
    std::string text;
    std::set<std::string> files;
    std::vector<std::pair<const std::string*, int>> places; ///< in `files`
};

void paste(const std::string& file, Expanded& out) {
    const auto [name, is_new] = out.files.insert(file);
    if (!is_new)
        return;
    const std::string_view content = shader_file(file);
    if (content.empty())
        throw DeviceError(fmt::format("there is no shader file {} in this build", file));
    std::istringstream lines{std::string(content)};
    constexpr std::string_view include = "#include \"";
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        if (line.starts_with(include)) {
            paste(line.substr(include.size(), line.rfind('"') - include.size()), out);
        } else {
            out.text += line + "\n";
            out.places.emplace_back(&*name, number);
        }
    }
}

/// Mesa says "0:117(5): error", NVIDIA "0(117) : error": both get the place of that line of the text, which begins with `prologue`.
std::string with_places(const std::string& log, const std::string& prologue, const Expanded& source) {
    const auto before = static_cast<std::size_t>(std::ranges::count(prologue, '\n'));
    std::string out;
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line); out += line + "\n") {
        std::size_t number = 0;
        if (!line.starts_with("0:") && !line.starts_with("0("))
            continue;
        const auto [end, failed] = std::from_chars(line.data() + 2, line.data() + line.size(), number);
        if (failed == std::errc() && number > before && number <= before + source.places.size()) {
            const auto& [file, in_file] = source.places[number - before - 1];
            line.replace(0, static_cast<std::size_t>(end - line.data()) + (line[1] == '(' ? 1 : 0), fmt::format("{}:{}", *file, in_file));
        }
    }
    return out;
}

/// What the driver says of a shader or program.
template <class Get> std::string log_of(Get get, GLuint name) {
    std::string log(8192, '\0');
    GLsizei length = 0;
    get(name, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    return log;
}

GLuint compile(Context& context, GLenum stage, const std::string& file, const std::string& prologue) {
    Expanded source;
    paste(file, source);
    const std::string text = prologue + source.text;
    const GLuint shader = context.gl.CreateShader(stage);
    const char* pointer = text.c_str();
    context.gl.ShaderSource(shader, 1, &pointer, nullptr);
    context.gl.CompileShader(shader);
    GLint ok = GL_FALSE;
    context.gl.GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok != GL_TRUE) {
        const std::string log = log_of(context.gl.GetShaderInfoLog, shader);
        context.gl.DeleteShader(shader);
        throw DeviceError(fmt::format("{} does not compile on {}: {}", file, context.info.gl_renderer, with_places(log, prologue, source)));
    }
    return shader;
}

} // namespace

Program::Program(Context& context, const std::string& vertex_file, const std::string& fragment_file, const std::vector<Define>& defines)
    : context_(&context) {
    std::string prologue = "#version 450 core\n"
                           "#define real float\n#define FN\n#define OUT(type) out type\n#define PRECISE precise\n"
                           "#define SELECT(condition, a, b) ((condition) ? (a) : (b))\n";
    for (const Define& define : defines)
        prologue += "#define " + define.name + " " + define.value + "\n";
    const GLuint vertex = compile(context, GL_VERTEX_SHADER, vertex_file, prologue + "#define STAGE_IO out\n");
    const GLuint fragment =
        fragment_file.empty() ? 0 : compile(context, GL_FRAGMENT_SHADER, fragment_file, prologue + "#define STAGE_IO in\n");
    ++context.compiled_programs;
    program_ = context.gl.CreateProgram();
    context.gl.AttachShader(program_, vertex);
    if (fragment != 0)
        context.gl.AttachShader(program_, fragment);
    context.gl.LinkProgram(program_);
    for (const GLuint shader : {vertex, fragment})
        if (shader != 0) {
            context.gl.DetachShader(program_, shader); // else it stays with all that the compiler made of it
            context.gl.DeleteShader(shader);
        }
    GLint ok = GL_FALSE;
    context.gl.GetProgramiv(program_, GL_LINK_STATUS, &ok);
    if (ok != GL_TRUE) {
        const std::string log = log_of(context.gl.GetProgramInfoLog, program_);
        context.gl.DeleteProgram(program_);
        throw DeviceError(fmt::format("{} and {} do not link on {}: {}", vertex_file, fragment_file, context.info.gl_renderer, log));
    }
}

Program::Program(Program&& other) noexcept : context_(other.context_), program_(std::exchange(other.program_, 0)) {}

Program::~Program() {
    if (program_ != 0)
        context_->gl.DeleteProgram(program_);
}

void Program::use() const { context_->gl.UseProgram(program_); }

GLint Program::uniform(const char* name) const { return context_->gl.GetUniformLocation(program_, name); }

} // namespace fernlicht::gl
