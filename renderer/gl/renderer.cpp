#include "renderer/renderer.h"
#include "renderer/gl/device/pass_clock.h"
#include "renderer/gl/naive_lighting.h"
#include "renderer/gl/photometric_lighting.h"
#include "renderer/gl/published_lighting.h"
#include "renderer/gl/scene/lighting.h"
#include "scenarios/display/tone_mapper.h"
#include "scenarios/photometry.h"
#include "scenarios/values/trace.h"

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <list>

namespace fernlicht {
namespace {

using gl::PassClock;
using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Views of so many sizes and wishes keep their targets; a drive's maps may change size with every moment.
constexpr std::size_t max_targets = 8;
constexpr int frames = 9; // of check_read_back

/// The lighting of a technique by its name. Throws InputError.
std::unique_ptr<gl::Lighting> make_lighting(gl::Context& context, const Scene& scene, const RendererSettings& settings) {
    const Technique& technique = technique_named(settings.technique);
    if (technique.kind != TechniqueKind::ours)
        return std::make_unique<gl::PublishedLighting>(context, scene, settings);
    if (technique.name == "photometric-naive")
        return std::make_unique<gl::NaiveLighting>(context, scene, settings);
    return std::make_unique<gl::PhotometricLighting>(context, scene, settings, technique.name != "photometric-unpruned");
}

/// Median time of a frame of four results over an empty night scene, two always on their way when overlapped.
double frame_time(Device& device, ReadBack way) {
    const Scene scene;
    RendererSettings settings;
    settings.read_back = way;
    Renderer renderer(device, scene, settings);
    const View view;
    const FrameOutputs outputs{.colour = true, .illuminance = true, .luminance = true, .depth = true};
    std::vector<double> seconds;
    Pending earlier = renderer.submit({}, view, outputs);
    for (int i = 0; i < frames; ++i) {
        const Clock::time_point start = Clock::now();
        Pending next = renderer.submit({}, view, outputs);
        earlier();
        earlier = std::move(next);
        seconds.push_back(seconds_since(start));
    }
    earlier();
    std::ranges::sort(seconds);
    return seconds[frames / 2];
}

} // namespace

struct Renderer::State {
    State(Device& device, const Scene& scene, const RendererSettings& wishes)
        : context(device.context()), settings(wishes), technique(technique_named(wishes.technique)),
          programs_before(context.compiled_programs), lighting(make_lighting(context, scene, wishes)) {}

    struct KnownTargets {
        int width, height;
        FrameOutputs outputs;
        std::shared_ptr<gl::Targets> targets;
    };
    std::shared_ptr<gl::Targets> targets_for(const View& view, const FrameOutputs& outputs);
    /// Counts what it takes.
    Work shoot(const Moment& moment, const View& view, const FrameOutputs& outputs, PassClock& clock,
               void (gl::Lighting::*take)(const gl::Shot&) = &gl::Lighting::draw, Work work = {});

    gl::Context& context;
    RendererSettings settings;
    const Technique& technique;
    int programs_before;
    std::unique_ptr<gl::Lighting> lighting;
    std::list<KnownTargets> targets; ///< used last stands first
    std::optional<Frame> lit;        ///< the picture drawn last, where the CPU lit it
    LightPassesUsed light_passes;
    ShadowMapsUsed shadow_maps;
    void add(const Work& work) {
        shadow_maps.used += work.shadow_maps;
        shadow_maps.drawn += work.shadow_maps_drawn;
    }
};

std::shared_ptr<gl::Targets> Renderer::State::targets_for(const View& view, const FrameOutputs& outputs) {
    for (auto it = targets.begin(); it != targets.end(); ++it)
        if (it->width == view.width_px && it->height == view.height_px && it->outputs == outputs) {
            targets.splice(targets.begin(), targets, it);
            return it->targets;
        }
    targets.push_front(
        {view.width_px, view.height_px, outputs, std::make_shared<gl::Targets>(context, view.width_px, view.height_px, outputs)});
    if (targets.size() > max_targets)
        targets.pop_back(); // a frame on its way holds its own
    return targets.front().targets;
}

Work Renderer::State::shoot(const Moment& moment, const View& view, const FrameOutputs& outputs, PassClock& clock,
                            void (gl::Lighting::*take)(const gl::Shot&), Work work) {
    const double sky_luminance = moment.daylight.horizontal_illuminance_lx / pi;
    const bool ours = technique.kind == TechniqueKind::ours; // what was published knows no colours of lamps, and so no white but D65
    const glm::dvec3 sky = (ours ? settings.white.value_or(glm::dmat3(1.0)) : glm::dmat3(1.0)) * glm::dvec3(1.0);
    const double sky_share = toned(settings.tone_mapper, sky_luminance) / glm::dot(glm::dvec3(0.2126, 0.7152, 0.0722), sky);
    glm::vec3 shown_sky;
    for (int i = 0; i < 3; ++i)
        shown_sky[i] = static_cast<float>(photometry::srgb_encoded(std::clamp(sky_share * sky[i], 0.0, 1.0)));
    const Camera camera = camera_of(moment, view);
    const std::shared_ptr<gl::Targets> target = targets_for(view, outputs);
    const gl::Shot shot{moment, view, outputs, camera, *target, shown_sky, static_cast<float>(sky_luminance), clock, work, lit};
    (*lighting.*take)(shot);
    if (take == &gl::Lighting::draw) {
        ++(lit ? light_passes.cpu : light_passes.shader);
        if (!lit && light_pass_for(context.info, settings.light_pass) == LightPass::cpu)
            light_passes.why_shader = lighting->why_shader(shot);
    }
    return work;
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

const Technique& Renderer::technique() const { return state_->technique; }

FrameOutputs Renderer::available(FrameOutputs outputs) const {
    const Technique& t = state_->technique;
    outputs.illuminance = outputs.illuminance && t.illuminance;
    outputs.target = outputs.target && t.target;
    outputs.luminance = outputs.luminance && t.luminance;
    outputs.light = outputs.light && t.luminance;
    return outputs;
}

Pending Renderer::submit(const Moment& moment, const View& view, const FrameOutputs& asked) {
    TraceSpan span("submit", "renderer");
    if (span)
        span.tell("view", view.name);
    State& s = *state_;
    const FrameOutputs outputs = available(asked);
    const Clock::time_point start = Clock::now();
    PassClock passes(s.context, s.settings.profile, s.settings.gpu_clock);
    s.add(s.shoot(moment, view, outputs, passes));
    if (s.lit) {
        const auto frame = std::make_shared<Frame>(std::move(*s.lit));
        s.lit.reset();
        frame->cpu_s = seconds_since(start);
        frame->pass_s = passes.seconds();
        return [frame] { return std::move(*frame); };
    }
    const std::shared_ptr<gl::Targets> targets = s.targets_for(view, outputs);
    if (s.settings.read_back == ReadBack::overlapped) {
        const auto reading = std::make_shared<gl::Targets::Reading>(targets->start_read());
        const auto times = std::make_shared<PassClock>(std::move(passes));
        return [targets, reading, times, start] {
            const TraceSpan collecting("read back", "pass");
            Frame frame = targets->finish_read(std::move(*reading));
            frame.pass_s = times->seconds();
            frame.cpu_s = seconds_since(start);
            return frame;
        };
    }
    passes.begin("read back");
    const auto frame = std::make_shared<Frame>(targets->read());
    passes.end();
    frame->cpu_s = seconds_since(start);
    frame->pass_s = passes.seconds();
    return [frame] { return std::move(*frame); };
}

void Renderer::render(const Moment& moment, const View& view, const FrameOutputs& outputs) {
    PassClock passes(state_->context, false, false);
    state_->add(state_->shoot(moment, view, available(outputs), passes));
    state_->context.gl.Flush();
}

void Renderer::finish() { state_->context.gl.Finish(); }

void Renderer::prepare(const std::vector<Moment>& moments, const View& view, const FrameOutputs& outputs, bool here) {
    TraceSpan span("compile", "renderer");
    if (span)
        span.tell("view", view.name);
    PassClock passes(state_->context, false, false);
    for (const Moment& moment : moments)
        state_->shoot(moment, view, available(outputs), passes, here ? &gl::Lighting::prepare_here : &gl::Lighting::prepare);
    finish();
}

void Renderer::keep_programs_of(const std::vector<Moment>& moments) { state_->lighting->keep_programs_of(moments); }

Work Renderer::count(const Moment& moment, const View& view, const FrameOutputs& outputs, bool light) {
    PassClock passes(state_->context, false, false);
    gl::FragmentCount fragments(state_->context);
    Work asked;
    if (light)
        asked.light.emplace();
    Work work = state_->shoot(moment, view, available(outputs), passes, &gl::Lighting::draw, asked);
    work.fragments = fragments.result();
    if (!state_->lit)
        work.light.reset();
    return work;
}

std::vector<PrunedFeature> Renderer::pruned() const { return state_->lighting->pruned(); }
std::optional<double> Renderer::beam_error(const LampFile& lamp) const { return state_->lighting->beam_error(lamp); }
Renderer::LightPassesUsed Renderer::light_passes_used() const { return state_->light_passes; }
Renderer::ShadowMapsUsed Renderer::shadow_maps_used() const { return state_->shadow_maps; }

int Renderer::compiled_programs() const { return state_->context.compiled_programs - state_->programs_before; }

ReadBackCheck check_read_back(Device& device) { return {frame_time(device, ReadBack::plain), frame_time(device, ReadBack::overlapped)}; }

} // namespace fernlicht
