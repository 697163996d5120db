#include "renderer/gl/naive_lighting.h"

#include "renderer/gl/shadows/shadow_maps.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace fernlicht::gl {
NaiveLighting::NaiveLighting(Context& context, const Scene& scene, const RendererSettings& settings)
    : context_(context), settings_(settings), scene_(context, scene, false), beams_(context, settings.beams), list_(context, scene_),
      depth_(depth_program(context, scene_.moves())), block_(make_buffer(context, std::vector<Packed>(max_lamps), GL_DYNAMIC_STORAGE_BIT)),
      shadow_target_(make_framebuffer(context)) {}

const Program& NaiveLighting::variant(std::size_t lamps, const Shot& shot) {
    const std::pair key(lamps, output_bits(shot.outputs));
    if (const auto known = variants_.find(key); known != variants_.end())
        return known->second;
    std::vector<Program::Define> d = Targets::defines(shot.outputs);
    add_lamp_defines(d, lamps);
    d.push_back({"SHADOWS", settings_.shadows.any() ? "1" : "0"});
    if (scene_.moves())
        d.push_back({"MOVING", "1"});
    d.push_back({"GLOSS", scene_.has([](const SurfaceClass& c) { return c.glossy; }) ? "1" : "0"});
    d.push_back({"TEXTURED", scene_.texture_bytes() > 0 ? "1" : "0"});
    return variants_.emplace(key, Program(context_, "naive.vert.glsl", "naive.frag.glsl", d)).first->second;
}

void NaiveLighting::set_lamps(const Moment& moment) {
    lamps_ = shining(moment, false);
    packed_.clear();
    for (const LitLamp& lamp : lamps_) {
        const Beam& beam = beams_.of(lamp.file);
        const BeamTexture& g = beam.grid;
        const ShadowWindow& w = beam.window;
        packed_.push_back(
            {four(lamp.pose.position_m - moment.ego.position_m), four(-lamp.pose.left()), four(lamp.pose.up()), four(lamp.pose.forward()),
             glm::vec4(g.h_first_rad, g.v_first_rad, 1.0 / g.h_step_rad, 1.0 / g.v_step_rad),
             glm::vec4(g.width, g.height, lamp.intensity_factor * beam.cd_a_unit, settings_.shadows.any() ? 1.0 : 0.0),
             four(lamp.colour.linear_srgb),
             glm::vec4(w.left, w.bottom, settings_.shadows.width / (w.right - w.left), settings_.shadows.height / (w.top - w.bottom))});
    }
    update_buffer(context_, block_, packed_);
}

void NaiveLighting::draw_pieces(const glm::dmat4& clip, const glm::dvec3& ego_m, bool in_map, double farthest_m, Work& work) {
    const Frustum frustum(clip);
    std::vector<std::uint32_t> seen;
    for (const std::uint32_t i : scene_.near(ego_m)) {
        const Piece& piece = scene_.pieces()[i];
        const glm::dvec3 centre = centre_of(piece, ego_m);
        if (piece.is_shown(in_map) && glm::length(centre) - piece.radius_m <= farthest_m && !frustum.outside(centre, piece.radius_m))
            seen.push_back(i);
    }
    list_.start(ego_m, scene_.moves());
    list_.add(seen);
    list_.upload();
    list_.draw(0);
    ++work.passes;
    ++work.calls;
    work.draws += static_cast<int>(seen.size());
    work.triangles += list_.triangles();
}

void NaiveLighting::draw_shadow_maps(const Shot& shot) {
    const GladGLContext& gl = context_.gl;
    while (shadow_maps_.size() < lamps_.size())
        shadow_maps_.push_back(make_texture(context_, GL_DEPTH_COMPONENT32F, settings_.shadows.width, settings_.shadows.height));
    depth_.use();
    gl.Viewport(0, 0, settings_.shadows.width, settings_.shadows.height);
    gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE); // row 0 is the lowest tangent, as texel_lit() takes it
    for (std::size_t i = 0; i < lamps_.size(); ++i) {
        gl.NamedFramebufferTexture(shadow_target_, GL_DEPTH_ATTACHMENT, shadow_maps_[i], 0);
        gl.NamedFramebufferDrawBuffer(shadow_target_, GL_NONE);
        gl.BindFramebuffer(GL_FRAMEBUFFER, shadow_target_);
        const float far_away = 0.0F;
        gl.ClearNamedFramebufferfv(shadow_target_, GL_DEPTH, 0, &far_away);
        const glm::dmat4 clip = lamp_clip(lamps_[i], beams_.of(lamps_[i].file).window, shot.moment.ego.position_m);
        depth_.set("clip_from_ego", glm::mat4(clip));
        draw_pieces(clip, shot.moment.ego.position_m, false, shadow_farthest_m, shot.work);
        ++shot.work.shadow_maps;
        ++shot.work.shadow_maps_drawn;
    }
    gl.ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
}

void NaiveLighting::draw(const Shot& shot) {
    const GladGLContext& gl = context_.gl;
    set_lamps(shot.moment);
    scene_.place(shot.moment.bodies);
    if (settings_.shadows.any() && !lamps_.empty()) {
        shot.clock.begin("shadow maps");
        draw_shadow_maps(shot);
        shot.clock.end();
    }
    shot.clock.begin("scene");
    shot.targets.begin(shot.background, shot.sky_luminance_cdm2);
    const Program& program = variant(lamps_.size(), shot);
    program.use();
    program.set("clip_from_ego", glm::mat4(shot.camera.clip_from_ego));
    program.set("eye_m", glm::vec3(shot.camera.eye_m));
    program.set("eye_direction", glm::vec3(shot.camera.is_map ? -shot.camera.axis : glm::dvec3(0.0)));
    program.set("eye_axis", four(shot.camera.axis));
    program.set("sky_lx", shot.moment.daylight.horizontal_illuminance_lx);
    program.set("target_height_m", settings_.target_height_m);
    program.set("shadow_tolerance_m", settings_.shadows.tolerance_m);
    const ToneMapper& tone = settings_.tone_mapper;
    program.set("tone", glm::vec4(static_cast<float>(tone.kind), tone.s, tone.l_max_cdm2, 0.0));
    const glm::mat3 rows(glm::transpose(settings_.white.value_or(glm::dmat3(1.0))));
    gl.Uniform3fv(program.uniform("white"), 3, &rows[0][0]);
    gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, block_);
    for (std::size_t i = 0; i < lamps_.size(); ++i) {
        gl.BindTextureUnit(static_cast<GLuint>(i), beams_.of(lamps_[i].file).texture);
        if (i < shadow_maps_.size())
            gl.BindTextureUnit(shadow_unit(i), shadow_maps_[i]);
    }
    draw_pieces(shot.camera.clip_from_ego, shot.moment.ego.position_m, shot.camera.is_map, farthest_drawn_m, shot.work);
    shot.clock.end();
    context_.check("rendering the scene");
    shot.work.lamps = static_cast<int>(lamps_.size());
    shot.work.samplers = static_cast<int>(lamps_.size()) * (settings_.shadows.any() ? 2 : 1) + (scene_.texture_bytes() > 0 ? 1 : 0);
    shot.work.texture_bytes =
        beams_.texture_bytes() + scene_.texture_bytes() +
        shadow_maps_.size() * 4 * static_cast<std::size_t>(settings_.shadows.width) * static_cast<std::size_t>(settings_.shadows.height);
}

void NaiveLighting::prepare(const Shot& shot) { draw(shot); }

} // namespace fernlicht::gl
