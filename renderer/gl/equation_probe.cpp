#include "renderer/equation_probe.h"

#include "renderer/gl/device/objects.h"
#include "renderer/gl/device/program.h"

#include <algorithm>

namespace fernlicht {
namespace {

constexpr int probe_width = 256;
constexpr std::size_t max_points = std::size_t{probe_width} * 256; ///< in one draw

} // namespace

struct EquationProbe::State {
    State(gl::Context& c, int equation)
        : context(c), program(c, "load.vert.glsl", "equations.frag.glsl", {{"EQUATION", std::to_string(equation)}}),
          texture(gl::make_texture(c, GL_RGBA32F, probe_width, static_cast<int>(max_points) / probe_width)),
          target(gl::make_framebuffer(c)), nothing(gl::make_vertex_array(c)), row_length(program.uniform("row_length")) {
        c.gl.NamedFramebufferTexture(target, GL_COLOR_ATTACHMENT0, texture, 0);
    }

    gl::Context& context;
    gl::Program program;
    gl::Texture texture;
    gl::Framebuffer target;
    gl::VertexArray nothing;
    GLint row_length;
};

EquationProbe::EquationProbe(Device& device, int equation) : state_(std::make_unique<State>(device.context(), equation)) {}

EquationProbe::~EquationProbe() = default;

std::vector<EquationValue> EquationProbe::at(const std::vector<EquationArguments>& points) {
    const GladGLContext& gl = state_->context.gl;
    std::vector<EquationValue> values;
    values.reserve(points.size());
    for (std::size_t first = 0; first < points.size(); first += max_points) {
        const std::size_t count = std::min(max_points, points.size() - first);
        const auto rows = static_cast<int>((count + probe_width - 1) / probe_width);
        std::vector<EquationArguments> batch(points.begin() + static_cast<std::ptrdiff_t>(first),
                                             points.begin() + static_cast<std::ptrdiff_t>(first + count));
        batch.resize(static_cast<std::size_t>(rows) * probe_width, batch.front());
        const gl::Buffer arguments = gl::make_buffer(state_->context, batch);
        gl.BindFramebuffer(GL_FRAMEBUFFER, state_->target);
        gl.BindVertexArray(state_->nothing);
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, arguments);
        gl.Viewport(0, 0, probe_width, rows);
        gl.Disable(GL_DEPTH_TEST);
        state_->program.use();
        gl.Uniform1i(state_->row_length, probe_width);
        gl.DrawArrays(GL_TRIANGLES, 0, 3);
        std::vector<EquationValue> read(batch.size());
        gl.BindFramebuffer(GL_READ_FRAMEBUFFER, state_->target);
        gl.NamedFramebufferReadBuffer(state_->target, GL_COLOR_ATTACHMENT0);
        gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
        gl.ReadPixels(0, 0, probe_width, rows, GL_RGBA, GL_FLOAT, read.data());
        values.insert(values.end(), read.begin(), read.begin() + static_cast<std::ptrdiff_t>(count));
    }
    gl.Enable(GL_DEPTH_TEST);
    state_->context.check("calling an equation");
    return values;
}

} // namespace fernlicht
