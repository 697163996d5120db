#include "renderer/gl/lamp_faces.h"

#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <tuple>

namespace fernlicht::gl {
namespace {

constexpr double before_body_m = 0.25; // nearer than the lamp's place: its own body does not hide it
constexpr double grazing = 0.1;        // least cosine that the face is seen under
constexpr double min_share = 1e-7;     // of a pixel's area that is still drawn

} // namespace

std::vector<LampFaces::Face> LampFaces::seen(const Shot& shot) const {
    std::vector<Face> faces;
    const glm::dvec3 eye_m = shot.moment.ego.position_m + shot.camera.eye_m;
    const glm::dvec2 picture(shot.view.width_px, shot.view.height_px);
    for (const LitLamp& lamp : shot.moment.other_lamps) {
        const double area = lamp.face_m.x * lamp.face_m.y;
        if (!(area > 0.0))
            continue;
        const glm::dvec3 to_eye = eye_m - lamp.pose.position_m;
        const double d = glm::length(to_eye), cd = intensity_towards_cd(lamp, eye_m);
        if (!(cd > 0.0) || d < 2.0 * before_body_m)
            continue;
        const double depth = glm::dot(-to_eye, shot.camera.axis);
        if (depth < 0.1)
            continue;
        const glm::dvec4 clip = shot.camera.clip_from_ego * glm::dvec4(lamp.pose.position_m - shot.moment.ego.position_m, 1.0);
        const glm::dvec3 nearer = lamp.pose.position_m + to_eye * (before_body_m / d) - shot.moment.ego.position_m;
        const glm::dvec4 before = shot.camera.clip_from_ego * glm::dvec4(nearer, 1.0);
        const glm::dvec2 at_px = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * picture;
        const double seen_under = std::max(glm::dot(lamp.pose.forward(), to_eye) / d, grazing);
        const double wider = std::sqrt(seen_under * d / depth); // of both sides, so that the solid angle is right in the picture's plane
        const glm::dvec2 a_metre = 0.5 * picture / shot.camera.half_extent / depth, size_px = lamp.face_m * wider * a_metre;
        if (at_px.x + size_px.x < -1.0 || at_px.y + size_px.y < -1.0 || at_px.x - size_px.x > picture.x + 1.0 ||
            at_px.y - size_px.y > picture.y + 1.0 || size_px.x * size_px.y < min_share)
            continue;
        const glm::dvec3 light = lamp.colour.linear_srgb * (cd * air_transmittance(shot.moment.weather, d) / (area * seen_under));
        faces.push_back({glm::vec4(glm::vec2(at_px), glm::vec2(size_px)), glm::vec4(glm::vec3(light), before.z / before.w)});
    }
    return faces;
}

const Program& LampFaces::program(const FrameOutputs& outputs) {
    if (const auto known = programs_.find(output_bits(outputs)); known != programs_.end())
        return known->second;
    std::vector<Program::Define> d = Targets::defines(outputs);
    add_tone_defines(d, tone_);
    return programs_.emplace(output_bits(outputs), Program(context_, "lamp_face.vert.glsl", "lamp_face.frag.glsl", d)).first->second;
}

void LampFaces::draw_faces(const Shot& shot, const std::vector<Face>& faces) {
    const GladGLContext& gl = context_.gl;
    const Program& p = program(shot.outputs);
    if (layout_ == 0)
        layout_ = make_vertex_array(context_);
    buffer_.fill(context_, faces);
    p.use();
    p.set("picture_px", glm::vec2(shot.view.width_px, shot.view.height_px));
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 6, buffer_.buffer);
    gl.BindVertexArray(layout_);
    // Luminance adds up, the shown colour takes the brighter, and the rest is the surface's.
    gl.DepthMask(GL_FALSE);
    const FrameOutputs& w = shot.outputs;
    GLuint slot = 0;
    for (const auto& [drawn, blended, how] :
         {std::tuple(w.colour, true, GL_MAX), std::tuple(w.illuminance, false, 0), std::tuple(w.target, false, 0),
          std::tuple(w.luminance, true, GL_FUNC_ADD), std::tuple(w.light, true, GL_FUNC_ADD), std::tuple(w.depth, false, 0),
          std::tuple(w.ids, false, 0)}) {
        if (!drawn)
            continue;
        if (blended) {
            gl.Enablei(GL_BLEND, slot);
            gl.BlendEquationi(slot, static_cast<GLenum>(how));
            gl.BlendFunci(slot, GL_ONE, GL_ONE);
        } else {
            gl.ColorMaski(slot, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        }
        ++slot;
    }
    gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(faces.size()));
    for (GLuint i = 0; i < slot; ++i) {
        gl.ColorMaski(i, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        gl.Disablei(GL_BLEND, i);
        gl.BlendEquationi(i, GL_FUNC_ADD);
    }
    gl.DepthMask(GL_TRUE);
}

void LampFaces::draw(const Shot& shot) {
    if (shot.camera.is_map || shot.moment.other_lamps.empty() || !shot.outputs.seen())
        return;
    const std::vector<Face> faces = seen(shot);
    shot.work.traffic_faces += static_cast<int>(faces.size());
    if (!faces.empty())
        draw_faces(shot, faces);
}

void LampFaces::compile(const Shot& shot) {
    if (shot.camera.is_map || !shot.outputs.seen())
        return;
    draw_faces(shot, {Face{glm::vec4(-10.0F, -10.0F, 1.0F, 1.0F), glm::vec4(0.0F, 0.0F, 0.0F, 0.5F)}});
}

} // namespace fernlicht::gl
