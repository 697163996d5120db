#include "renderer/gl/lamps_seen.h"

#include "renderer/gl/device/program.h"
#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

namespace fernlicht::gl {
namespace {

constexpr double nearest_pass_m = 1e-3;
constexpr GLuint lamps_at = 6, beams_at = 7; // bindings in lamps_in_fog.glsl

/// No ray of the picture passes nearer by a place than this; relative to the car.
double apart_m(const Camera& camera, const glm::dvec3& place_m) {
    const glm::dvec3 to_place = place_m - camera.eye_m;
    const double distance = glm::length(to_place), half = std::atan(std::hypot(camera.half_extent.x, camera.half_extent.y)),
                 beside = std::atan2(glm::length(glm::cross(camera.axis, to_place)), glm::dot(camera.axis, to_place)) - half;
    return beside >= 0.5 * pi ? distance : std::max(distance * std::sin(std::max(beside, 0.0)), nearest_pass_m);
}

/// The most luminance that the lamp can add along any ray that passes it no nearer than `apart`.
double max_airlight_cdm2(const LitLamp& lamp, const Beam& beam, const Weather& weather, double distance_m, double apart) {
    return rounding * weather.extinction_per_m * weather.scattering_albedo * lamp.intensity_factor * beam.bounds.most() *
           photometry::henyey_greenstein(1.0, weather.asymmetry) * pi / apart * air_transmittance(weather, distance_m);
}

} // namespace

int LampsInFog::beam_offset(const Beam& beam) {
    const auto [known, fresh] = offsets_.try_emplace(beam.id, static_cast<int>(cd_.size()));
    if (fresh) {
        const BeamTexture grid = beams_.grid_of(beam);
        cd_.insert(cd_.end(), grid.cd.begin(), grid.cd.end());
        cd_buffer_.fill(context_, cd_);
    }
    return known->second;
}

void LampsInFog::set(const Moment& moment, const Camera& camera) {
    packed_.clear();
    left_out_ = 0;
    min_cdm2_ = static_cast<float>(min_airlight_cdm2(moment.min_traffic_lx));
    if (moment.weather.extinction_per_m <= 0.0)
        return;
    for (const LitLamp& lamp : moment.other_lamps) {
        if (!(lamp.intensity_factor > 0.0))
            continue;
        const Beam& beam = beams_.of(lamp.file);
        const glm::dvec3 at_m = lamp.pose.position_m - moment.ego.position_m;
        const double most = max_airlight_cdm2(lamp, beam, moment.weather, glm::length(at_m - camera.eye_m), apart_m(camera, at_m));
        if (pruned_ && most <= static_cast<double>(min_cdm2_)) {
            ++left_out_;
            continue;
        }
        const BeamTexture& g = beam.grid;
        packed_.push_back({four(at_m, rounding * beam.bounds.most() * lamp.intensity_factor), four(-lamp.pose.left()), four(lamp.pose.up()),
                           four(lamp.pose.forward()), four(lamp.colour.linear_srgb, lamp.intensity_factor),
                           glm::vec4(g.h_first_rad, g.v_first_rad, 1.0 / g.h_step_rad, 1.0 / g.v_step_rad),
                           glm::vec4(beam_offset(beam), g.width, g.height, 0.0)});
    }
    if (!packed_.empty())
        lamp_buffer_.fill(context_, packed_);
    else if (lamp_buffer_.buffer == 0) // for a shader that finds no lamps to look at
        lamp_buffer_.fill(context_, std::vector<Packed>(1)), cd_buffer_.fill(context_, std::vector<float>(1));
}

void LampsInFog::bind() const {
    if (lamp_buffer_.buffer == 0)
        return;
    context_.gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, lamps_at, lamp_buffer_.buffer);
    context_.gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, beams_at, cd_buffer_.buffer);
}

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
    add_tone_defines(d, tone_, white_);
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
