#include "renderer/gpu_timer.h"
#include "renderer/gl/device/objects.h"
#include "renderer/gl/device/pass_clock.h"
#include "renderer/gl/device/program.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>

namespace fernlicht {

struct GpuTimer::State {
    explicit State(gl::Context& c) : context(c), clock(std::in_place, c, false, true) {}
    gl::Context& context;
    std::optional<gl::PassClock> clock;
};

GpuTimer::GpuTimer(Device& device) : state_(std::make_unique<State>(device.context())) {}
GpuTimer::~GpuTimer() = default;

void GpuTimer::begin() { state_->clock->begin("piece"); }
void GpuTimer::end() { state_->clock->end(); }

double GpuTimer::seconds() {
    double sum = 0.0;
    for (const auto& [name, seconds] : state_->clock->seconds())
        sum += seconds;
    state_->clock.emplace(state_->context, false, true);
    return sum;
}

namespace {

constexpr int width = 512, height = 512, rounds = 7;
constexpr double wanted_s = 0.010;

double median(std::array<double, rounds> values) {
    std::ranges::sort(values);
    return values[rounds / 2];
}

} // namespace

bool TimerCheck::agrees() const { return finish_s > 0.0 && std::abs(query_s / finish_s - 1.0) < 0.1; }

TimerCheck check_timer(Device& device) {
    gl::Context& context = device.context();
    const GladGLContext& gl = context.gl;
    const gl::Program program(context, "load.vert.glsl", "load.frag.glsl", {});
    const gl::Framebuffer target = gl::make_framebuffer(context);
    const gl::Texture texture = gl::make_texture(context, GL_R32F, width, height);
    const gl::VertexArray nothing = gl::make_vertex_array(context);
    gl.NamedFramebufferTexture(target, GL_COLOR_ATTACHMENT0, texture, 0);
    gl.BindFramebuffer(GL_FRAMEBUFFER, target);
    gl.BindVertexArray(nothing);
    gl.Viewport(0, 0, width, height);
    gl.Disable(GL_DEPTH_TEST);
    program.use();
    const auto draw = [&](int steps) {
        gl::PassClock clock(context, false, true);
        gl.Finish();
        const auto start = std::chrono::steady_clock::now();
        gl.Uniform1i(program.uniform("steps"), steps);
        clock.begin("load");
        gl.DrawArrays(GL_TRIANGLES, 0, 3);
        clock.end();
        gl.Finish();
        const double finish_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return TimerCheck{clock.seconds().front().second, finish_s};
    };
    draw(16); // compiles
    int steps = 64;
    while (steps < (1 << 22) && draw(steps).finish_s < wanted_s)
        steps *= 2;
    std::array<double, rounds> by_query{}, by_finish{};
    for (std::size_t i = 0; i < rounds; ++i) {
        const TimerCheck once = draw(steps);
        by_query[i] = once.query_s;
        by_finish[i] = once.finish_s;
    }
    gl.Enable(GL_DEPTH_TEST);
    context.check("checking the driver's clock");
    return {median(by_query), median(by_finish)};
}

} // namespace fernlicht
