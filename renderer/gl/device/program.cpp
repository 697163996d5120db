#include "renderer/gl/device/program.h"

#include "scenarios/values/errors.h"
#include "shader_files.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <sstream>
#include <utility>

namespace fernlicht::gl {
namespace {

/// Source text with includes pasted in; `files[n]` is what `#line x n` means.
struct Expanded {
    std::string text;
    std::vector<std::string> files;
};

void paste(const std::string& file, Expanded& out) {
    if (std::find(out.files.begin(), out.files.end(), file) != out.files.end())
        return;
    const std::string_view content = shader_file(file);
    if (content.empty())
        throw DeviceError(fmt::format("there is no shader file {} in this build", file));
    const std::size_t number = out.files.size();
    out.files.push_back(file);
    out.text += fmt::format("#line 1 {}\n", number);
    std::istringstream lines{std::string(content)};
    constexpr std::string_view include = "#include \"";
    int line_number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++line_number;
        if (line.starts_with(include)) {
            paste(line.substr(include.size(), line.rfind('"') - include.size()), out);
            out.text += fmt::format("#line {} {}\n", line_number + 1, number);
        } else {
            out.text += line + "\n";
        }
    }
}

/// Mesa says "2:17(5): error", NVIDIA "2(17) : error": both get the file's name in place of its number.
std::string with_file_names(const std::string& log, const std::vector<std::string>& files) {
    std::string out;
    std::istringstream lines(log);
    for (std::string line; std::getline(lines, line); out += line + "\n") {
        const std::size_t digits = line.find_first_not_of("0123456789");
        std::size_t number = 0;
        if (digits == std::string::npos || (line[digits] != ':' && line[digits] != '(') ||
            std::from_chars(line.data(), line.data() + digits, number).ec != std::errc())
            continue;
        line.replace(0, digits + 1, (number < files.size() ? files[number] : line.substr(0, digits)) + ":");
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
        throw DeviceError(fmt::format("{} does not compile on {}: {}", file, context.info.gl_renderer, with_file_names(log, source.files)));
    }
    return shader;
}

} // namespace

Program::Program(Context& context, const std::string& vertex_file, const std::string& fragment_file, const std::vector<Define>& defines)
    : context_(&context) {
    std::string prologue = "#version 450 core\n"
                           "#define real float\n#define FN\n#define OUT(type) out type\n#define PRECISE precise\n";
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
    context.gl.DeleteShader(vertex);
    context.gl.DeleteShader(fragment);
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
