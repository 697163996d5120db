#include "renderer/gl/shadows/stencil_volumes.h"

#include <algorithm>

namespace fernlicht::gl {
namespace {

/// In maps, where parallel lines do not meet at infinity, hulls end this many times as far from the lamp as their casters: 500 m behind
/// what is 5 mm away.
constexpr float farthest_in_maps = 1e-5F;

} // namespace

StencilVolumes::StencilVolumes(Context& context)
    : context_(context), program_(context, "shadow_volume.vert.glsl", "", {}), clip_(program_.uniform("clip_from_ego")),
      offset_(program_.uniform("offset_m")), turn_(program_.uniform("turn")), lamp_(program_.uniform("lamp_m")),
      gap_(program_.uniform("gap")), farthest_(program_.uniform("farthest")), layout_(make_vertex_array(context)) {
    const GladGLContext& gl = context.gl;
    gl.EnableVertexArrayAttrib(layout_, 0);
    gl.VertexArrayAttribFormat(layout_, 0, 4, GL_FLOAT, GL_FALSE, 0);
    gl.VertexArrayAttribBinding(layout_, 0, 0);
}

void StencilVolumes::upload(const std::vector<glm::vec4>& corners) {
    if (corners.size() > capacity_) {
        capacity_ = std::max(corners.size(), 2 * capacity_);
        std::vector<glm::vec4> all = corners;
        all.resize(capacity_);
        corners_ = make_buffer(context_, all, GL_DYNAMIC_STORAGE_BIT);
        context_.gl.VertexArrayVertexBuffer(layout_, 0, corners_, 0, sizeof(glm::vec4));
    } else {
        update_buffer(context_, corners_, corners);
    }
}

void StencilVolumes::begin(const Camera& camera) const {
    const GladGLContext& gl = context_.gl;
    program_.use();
    gl.BindVertexArray(layout_);
    const glm::mat4 clip(camera.clip_from_ego);
    gl.UniformMatrix4fv(clip_, 1, GL_FALSE, &clip[0][0]);
    gl.Uniform1f(farthest_, camera.is_map ? farthest_in_maps : 0.0F);
    // What lies beyond a map's depth counts where it ends. A perspective has no end, and what is nearer than its near plane does not
    // matter: kept, its depth near / w would be so large that floats between it and infinity could not tell hull and surface apart.
    if (camera.is_map)
        gl.Enable(GL_DEPTH_CLAMP);
    gl.StencilFunc(GL_ALWAYS, 0, 0xFF);
    gl.StencilOpSeparate(GL_BACK, GL_KEEP, GL_INCR_WRAP, GL_KEEP);
    gl.StencilOpSeparate(GL_FRONT, GL_KEEP, GL_DECR_WRAP, GL_KEEP);
}

void StencilVolumes::draw(const Placed& placed) const {
    const GladGLContext& gl = context_.gl;
    const glm::vec3 offset(placed.offset_m), lamp(placed.lamp_m);
    gl.Uniform3fv(offset_, 1, &offset[0]);
    gl.Uniform4fv(turn_, 1, &placed.turn[0]);
    gl.Uniform3fv(lamp_, 1, &lamp[0]);
    gl.Uniform3f(gap_, static_cast<float>(placed.gap_m), static_cast<float>(placed.gap_share), static_cast<float>(placed.lowered_m));
    gl.DrawArrays(GL_TRIANGLES, static_cast<GLint>(placed.first), static_cast<GLsizei>(placed.count));
}

void StencilVolumes::end() const { context_.gl.Disable(GL_DEPTH_CLAMP); }

} // namespace fernlicht::gl
