#include "renderer/gl/lamp_lights.h"

#include "renderer/camera.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht::gl {
namespace {

constexpr double shadow_near_m = 0.05;
constexpr double shadow_farthest_m = 300.0;
// A window of tangents beyond about 55 degrees would spend its texels at the sides: what lies outside it is lit without question.
constexpr double widest_tangent = 1.4, highest_tangent = 0.36, lowest_tangent = -0.45;

} // namespace

LampLights::LampLights(Context& context, int shadow_width, int shadow_height)
    : context_(context), shadow_width_(shadow_width), shadow_height_(shadow_height), depth_program_(context, "depth.vert.glsl", "", {}),
      depth_matrix_(depth_program_.uniform("clip_from_ego")),
      block_(make_buffer(context, std::vector<Packed>(most_lamps), GL_DYNAMIC_STORAGE_BIT)), shadow_target_(make_framebuffer(context)) {}

const LampLights::Beam& LampLights::beam(const std::shared_ptr<const LampFile>& file) {
    if (const auto known = beams_.find(file.get()); known != beams_.end())
        return known->second.second;
    Beam beam;
    beam.grid = make_beam_texture(file->table);
    beam.texture = make_texture(context_, GL_R32F, beam.grid.width, beam.grid.height);
    context_.gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    context_.gl.TextureSubImage2D(beam.texture, 0, 0, 0, beam.grid.width, beam.grid.height, GL_RED, GL_FLOAT, beam.grid.cd.data());
    context_.check("uploading a beam texture");
    return beams_.emplace(file.get(), std::pair(file, std::move(beam))).first->second.second;
}

double LampLights::beam_error(const LampFile& lamp) {
    const auto known = beams_.find(&lamp);
    return known == beams_.end() ? make_beam_texture(lamp.table).worst_error_of_peak : known->second.second.grid.worst_error_of_peak;
}

LampLights::Window LampLights::window_of(const Beam& beam) {
    const BeamTexture& g = beam.grid;
    const auto tangent = [](double angle) { return std::tan(std::clamp(angle, -1.5, 1.5)); };
    const double top_angle = g.v_first_rad + (g.height - 1) * g.v_step_rad;
    Window w{std::max(-widest_tangent, tangent(g.h_first_rad)),
             std::min(widest_tangent, tangent(g.h_first_rad + (g.width - 1) * g.h_step_rad)),
             std::max(lowest_tangent, 1.75 * std::min(tangent(g.v_first_rad), 0.0)),
             std::min(highest_tangent, 1.75 * std::max(tangent(top_angle), 0.0))};
    // 1.75: at the window's side the tangent of a given V is larger by 1 / cos(H).
    if (w.right - w.left < 1e-3)
        w.right = w.left + 1e-3;
    if (w.top - w.bottom < 1e-3)
        w.top = w.bottom + 1e-3;
    return w;
}

void LampLights::set(const Moment& moment, bool shadows) {
    lit_.clear();
    packed_.clear();
    for (const LitLamp& lamp : moment.lamps)
        if (lamp.intensity_factor > 0.0 && peak_of(lamp.file->table).cd > 0.0)
            lit_.push_back(lamp);
    if (lit_.size() > most_lamps)
        throw InputError({{}, 0, 0, "lamps"}, fmt::format("{} lamps are on at {} s", lit_.size(), moment.time_s),
                         fmt::format("at most {}", most_lamps));
    for (const LitLamp& lamp : lit_) {
        const Beam& b = beam(lamp.file);
        const BeamTexture& g = b.grid;
        const Window w = window_of(b);
        const auto four = [](const glm::dvec3& v) { return glm::vec4(glm::vec3(v), 0.0F); };
        packed_.push_back({four(lamp.pose.position_m - moment.ego.position_m), four(-lamp.pose.left()), four(lamp.pose.up()),
                           four(lamp.pose.forward()), glm::vec4(g.h_first_rad, g.v_first_rad, 1.0 / g.h_step_rad, 1.0 / g.v_step_rad),
                           glm::vec4(g.width, g.height, lamp.intensity_factor, shadows ? 1.0 : 0.0), four(lamp.colour.linear_srgb),
                           glm::vec4(w.left, w.bottom, shadow_width_ / (w.right - w.left), shadow_height_ / (w.top - w.bottom))});
    }
    update_buffer(context_, block_, packed_);
}

void LampLights::draw_shadow_maps(SceneBuffers& scene, const glm::dvec3& ego_m) {
    const GladGLContext& gl = context_.gl;
    while (shadow_maps_.size() < lit_.size())
        shadow_maps_.push_back(make_texture(context_, GL_DEPTH_COMPONENT32F, shadow_width_, shadow_height_));
    depth_program_.use();
    gl.Viewport(0, 0, shadow_width_, shadow_height_);
    gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE); // row 0 is the lowest tangent, as texel_lit() takes it
    for (std::size_t i = 0; i < lit_.size(); ++i) {
        gl.NamedFramebufferTexture(shadow_target_, GL_DEPTH_ATTACHMENT, shadow_maps_[i], 0);
        gl.NamedFramebufferDrawBuffer(shadow_target_, GL_NONE);
        gl.BindFramebuffer(GL_FRAMEBUFFER, shadow_target_);
        const float far_away = 0.0F;
        gl.ClearNamedFramebufferfv(shadow_target_, GL_DEPTH, 0, &far_away);
        const Window w = window_of(beam(lit_[i].file));
        const Pose& pose = lit_[i].pose;
        const glm::dvec3 axes[3] = {-pose.left(), pose.up(), pose.forward()};
        const glm::dvec3 at = pose.position_m - ego_m;
        glm::dmat4 lamp_from_ego(1.0);
        for (int column = 0; column < 3; ++column)
            lamp_from_ego[column] = {axes[0][column], axes[1][column], axes[2][column], 0.0};
        lamp_from_ego[3] = {-glm::dot(axes[0], at), -glm::dot(axes[1], at), -glm::dot(axes[2], at), 1.0};
        const glm::dmat4 clip = tangent_projection(w.left, w.right, w.bottom, w.top, shadow_near_m) * lamp_from_ego;
        const glm::mat4 clip_float(clip);
        gl.UniformMatrix4fv(depth_matrix_, 1, GL_FALSE, &clip_float[0][0]);
        scene.draw(clip, false, shadow_farthest_m);
    }
    gl.ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    context_.check("drawing shadow maps");
}

void LampLights::bind() const {
    const GladGLContext& gl = context_.gl;
    gl.BindBufferBase(GL_UNIFORM_BUFFER, 0, block_);
    for (std::size_t i = 0; i < lit_.size(); ++i) {
        gl.BindTextureUnit(static_cast<GLuint>(i), beams_.at(lit_[i].file.get()).second.texture);
        if (i < shadow_maps_.size())
            gl.BindTextureUnit(static_cast<GLuint>(8 + i), shadow_maps_[i]);
    }
}

} // namespace fernlicht::gl
