#include "renderer/renderer.h"

#include "renderer/camera.h"
#include "renderer/gl/lamp_lights.h"
#include "renderer/gl/pass_clock.h"
#include "renderer/gl/targets.h"
#include "scenarios/photometry.h"
#include "scenarios/values/errors.h"

#include <chrono>
#include <fmt/format.h>
#include <map>
#include <tuple>

namespace fernlicht {
namespace {

using gl::PassClock;
using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

int bits(const Wanted& w) {
    return (w.colour ? 1 : 0) | (w.illuminance ? 2 : 0) | (w.target ? 4 : 0) | (w.luminance ? 8 : 0) | (w.depth ? 16 : 0) |
           (w.ids ? 32 : 0);
}

double toned(const ToneMapper& tone, double luminance) {
    switch (tone.kind) {
    case ToneMapperKind::linear:
        return photometry::tone_linear(luminance, tone.l_max_cdm2);
    case ToneMapperKind::rational:
        return photometry::tone_rational(luminance, tone.l_max_cdm2, tone.s);
    case ToneMapperKind::logarithmic:
        break;
    }
    return photometry::tone_logarithmic(luminance, tone.l_max_cdm2, tone.s);
}

constexpr double farthest_drawn_m = 2000.0;

} // namespace

struct Renderer::State {
    State(Device& device, const Scene& scene, const RendererSettings& wishes)
        : context(device.context()), settings(wishes), buffers(context, scene), lights(context, wishes.shadow_width, wishes.shadow_height) {
    }

    struct Variant {
        gl::Program program;
        GLint clip_from_ego, eye, eye_direction, eye_axis, sky, target_height, tone, shadow_tolerance;
    };
    /// lamps, shadows, sky, retro, wanted
    using Features = std::tuple<int, bool, bool, bool, int>;

    const Variant& variant(const Features& features, const Wanted& wanted);
    void draw_scene(const Moment& moment, const View& view, const Wanted& wanted, const Camera& camera, bool shadows);
    /// All passes of a frame, timed by `passes`.
    void draw_frame(const Moment& moment, const View& view, const Wanted& wanted, PassClock& passes);
    gl::Targets& targets_for(const View& view, const Wanted& wanted);

    gl::Context& context;
    RendererSettings settings;
    gl::SceneBuffers buffers;
    gl::LampLights lights;
    std::map<Features, Variant> variants;
    std::map<std::tuple<int, int, int>, gl::Targets> targets;
};

const Renderer::State::Variant& Renderer::State::variant(const Features& features, const Wanted& wanted) {
    if (const auto known = variants.find(features); known != variants.end())
        return known->second;
    const auto [lamps, shadows, sky, retro, wanted_bits] = features;
    std::vector<gl::Program::Define> defines = gl::Targets::defines(wanted);
    defines.push_back({"LAMP_COUNT", std::to_string(lamps)});
    defines.push_back({"SHADOWS", shadows ? "1" : "0"});
    defines.push_back({"SKY", sky ? "1" : "0"});
    defines.push_back({"RETRO", retro ? "1" : "0"});
    gl::Program program(context, "scene.vert.glsl", "photometric.frag.glsl", defines);
    Variant variant{std::move(program), 0, 0, 0, 0, 0, 0, 0, 0};
    variant.clip_from_ego = variant.program.uniform("clip_from_ego");
    variant.eye = variant.program.uniform("eye_m");
    variant.eye_direction = variant.program.uniform("eye_direction");
    variant.eye_axis = variant.program.uniform("eye_axis");
    variant.sky = variant.program.uniform("sky_lx");
    variant.target_height = variant.program.uniform("target_height_m");
    variant.tone = variant.program.uniform("tone");
    variant.shadow_tolerance = variant.program.uniform("shadow_tolerance_m");
    return variants.emplace(features, std::move(variant)).first->second;
}

gl::Targets& Renderer::State::targets_for(const View& view, const Wanted& wanted) {
    return targets.try_emplace({view.width_px, view.height_px, bits(wanted)}, context, view.width_px, view.height_px, wanted).first->second;
}

void Renderer::State::draw_scene(const Moment& moment, const View& view, const Wanted& wanted, const Camera& camera, bool shadows) {
    const GladGLContext& gl = context.gl;
    const double sky_lx = moment.daylight.horizontal_illuminance_lx;
    const double sky_luminance = sky_lx / pi;
    const float grey = static_cast<float>(photometry::srgb_encoded(toned(settings.tone_mapper, sky_luminance)));
    gl::Targets& target = targets_for(view, wanted);
    target.begin(glm::vec3(grey), static_cast<float>(sky_luminance));
    const Variant& v = variant({lights.count(), shadows, sky_lx > 0.0, buffers.retroreflecting(), bits(wanted)}, wanted);
    v.program.use();
    const glm::mat4 clip(camera.clip_from_ego);
    const glm::vec3 eye(camera.eye_m), direction(camera.is_map ? -camera.axis : glm::dvec3(0.0)), axis(camera.axis);
    gl.UniformMatrix4fv(v.clip_from_ego, 1, GL_FALSE, &clip[0][0]);
    gl.Uniform3fv(v.eye, 1, &eye[0]);
    gl.Uniform3fv(v.eye_direction, 1, &direction[0]);
    gl.Uniform4f(v.eye_axis, axis.x, axis.y, axis.z, 0.0F);
    gl.Uniform1f(v.sky, static_cast<float>(sky_lx));
    gl.Uniform1f(v.target_height, static_cast<float>(settings.target_height_m));
    gl.Uniform1f(v.shadow_tolerance, static_cast<float>(settings.shadow_tolerance_m));
    const auto kind = static_cast<float>(settings.tone_mapper.kind);
    gl.Uniform4f(v.tone, kind, static_cast<float>(settings.tone_mapper.s), static_cast<float>(settings.tone_mapper.l_max_cdm2), 0.0F);
    lights.bind();
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffers.materials());
    buffers.draw(camera.clip_from_ego, camera.is_map, farthest_drawn_m);
}

void Renderer::State::draw_frame(const Moment& moment, const View& view, const Wanted& wanted, PassClock& passes) {
    const bool shadows = settings.shadows && !buffers.flat();
    buffers.place(moment.ego.position_m);
    lights.set(moment, shadows);
    if (shadows && lights.count() > 0) {
        passes.begin("shadow maps");
        lights.draw_shadow_maps(buffers, moment.ego.position_m);
        passes.end();
    }
    passes.begin("scene");
    draw_scene(moment, view, wanted, camera_of(moment, view), shadows && lights.count() > 0);
    passes.end();
}

Renderer::Renderer(Device& device, const Scene& scene, const RendererSettings& settings)
    : state_(std::make_unique<State>(device, scene, settings)) {
    const GladGLContext& gl = state_->context.gl;
    gl.ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_GREATER);
    gl.Disable(GL_BLEND);
    gl.Disable(GL_DITHER);
    gl.Disable(GL_CULL_FACE);
    gl.Disable(GL_MULTISAMPLE);
    state_->context.check("setting up");
}

Renderer::~Renderer() = default;

Pending Renderer::submit(const Moment& moment, const View& view, const Wanted& wanted) {
    State& s = *state_;
    const Clock::time_point start = Clock::now();
    PassClock passes(s.context, s.settings.profile, s.settings.gpu_clock);
    s.draw_frame(moment, view, wanted, passes);
    gl::Targets& targets = s.targets_for(view, wanted);
    if (s.settings.read_back == ReadBack::overlapped) {
        const auto reading = std::make_shared<gl::Targets::Reading>(targets.start_read());
        const auto times = std::make_shared<PassClock>(std::move(passes));
        return [&targets, reading, times, start] {
            Frame frame = targets.finish_read(std::move(*reading));
            frame.pass_s = times->seconds();
            frame.cpu_s = seconds_since(start);
            return frame;
        };
    }
    passes.begin("read back");
    const auto frame = std::make_shared<Frame>(targets.read());
    passes.end();
    frame->cpu_s = seconds_since(start);
    frame->pass_s = passes.seconds();
    return [frame] { return std::move(*frame); };
}

void Renderer::render(const Moment& moment, const View& view, const Wanted& wanted) {
    PassClock untimed(state_->context, false, false);
    state_->draw_frame(moment, view, wanted, untimed);
    state_->context.gl.Flush();
}

void Renderer::finish() {
    state_->context.gl.Finish();
    state_->context.check("finishing");
}

double Renderer::beam_error(const LampFile& lamp) const { return state_->lights.beam_error(lamp); }
int Renderer::compiled_programs() const { return static_cast<int>(state_->variants.size()) + 1; }

std::vector<std::string> Renderer::left_out(const Moment& moment) const {
    std::vector<std::string> reasons;
    const State& s = *state_;
    if (!s.settings.shadows)
        reasons.emplace_back("shadow maps: the drive switches them off");
    else if (s.buffers.flat())
        reasons.emplace_back("shadow maps: the scene is flat, nothing stands in a beam");
    if (moment.daylight.horizontal_illuminance_lx == 0.0)
        reasons.emplace_back("sky light: it is night");
    if (!s.buffers.retroreflecting())
        reasons.emplace_back("retroreflection: no material of the scene retroreflects");
    int off = 0;
    for (const LitLamp& lamp : moment.lamps)
        off += lamp.intensity_factor > 0.0 ? 0 : 1;
    if (off > 0)
        reasons.push_back(fmt::format("{} of {} lamps: off at the start", off, moment.lamps.size()));
    return reasons;
}

} // namespace fernlicht
