#include "renderer/gl/shadows/shadow_mask.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <tuple>

namespace fernlicht::gl {
namespace {

constexpr std::size_t max_canvases = 8;
constexpr GLuint target_bits_from = 8;

/// In maps, where parallel lines do not meet at infinity, hulls end this many times as far from the lamp as their casters: 500 m behind
/// what is 5 mm away.
constexpr double farthest_in_maps = 1e-5;

} // namespace

StencilVolumes::StencilVolumes(Context& context)
    : context_(context), program_(context, "shadow_volume.vert.glsl", "", {}), layout_(make_vertex_array(context)) {
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
    program_.set("clip_from_ego", glm::mat4(camera.clip_from_ego));
    program_.set("farthest", camera.is_map ? farthest_in_maps : 0.0);
    // What lies beyond a map's depth counts where it ends. A perspective has no end, and what is nearer than its near plane does not
    // matter: kept, its depth near / w would be so large that floats between it and infinity could not tell hull and surface apart.
    if (camera.is_map)
        gl.Enable(GL_DEPTH_CLAMP);
    gl.StencilFunc(GL_ALWAYS, 0, 0xFF);
    gl.StencilOpSeparate(GL_BACK, GL_KEEP, GL_INCR_WRAP, GL_KEEP);
    gl.StencilOpSeparate(GL_FRONT, GL_KEEP, GL_DECR_WRAP, GL_KEEP);
}

void StencilVolumes::draw(const Placed& placed) const {
    program_.set("offset_m", glm::vec3(placed.offset_m));
    program_.set("turn", placed.turn);
    program_.set("lamp_m", glm::vec3(placed.lamp_m));
    program_.set("gap", glm::vec3(placed.gap_m, placed.gap_share, placed.lowered_m));
    context_.gl.DrawArrays(GL_TRIANGLES, static_cast<GLint>(placed.first), static_cast<GLsizei>(placed.count));
}

void StencilVolumes::end() const { context_.gl.Disable(GL_DEPTH_CLAMP); }

ShadowMask::ShadowMask(Context& context, const SceneBuffers& scene, const ShadowSettings& settings, const ShadowUse& use)
    : Shadows(context, scene, settings), use_(use), depth_program_(depth_program(context, scene.moves())),
      mask_program_(context, "shadow_mask.vert.glsl", "shadow_mask.frag.glsl", {}), nothing_(make_vertex_array(context)),
      list_(context, scene) {}

void ShadowMask::set(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) {
    Shadows::set(lamps, beams, ego_m);
    set_lamps(lamps, ego_m);
}

void ShadowMask::set_lamps(const std::vector<LitLamp>& lamps, const glm::dvec3& ego_m) {
    lamps_ = lamps;
    ego_m_ = ego_m;
}

ShadowMask::Canvas ShadowMask::make_canvas(int width, int height) {
    Canvas canvas{width, height, make_texture(context_, GL_R16UI, width, height),
                  make_texture(context_, GL_DEPTH32F_STENCIL8, width, height), make_framebuffer(context_)};
    const GladGLContext& gl = context_.gl;
    gl.NamedFramebufferTexture(canvas.framebuffer, GL_COLOR_ATTACHMENT0, canvas.mask, 0);
    gl.NamedFramebufferTexture(canvas.framebuffer, GL_DEPTH_STENCIL_ATTACHMENT, canvas.depth, 0);
    if (const GLenum status = gl.CheckNamedFramebufferStatus(canvas.framebuffer, GL_FRAMEBUFFER); status != GL_FRAMEBUFFER_COMPLETE)
        throw DeviceError(fmt::format("{} cannot render a shadow mask of {} x {} pixels (status 0x{:04x})", context_.info.gl_renderer,
                                      width, height, status));
    return canvas;
}

const ShadowMask::Canvas& ShadowMask::canvas_for(const View& view) {
    const auto known =
        std::ranges::find_if(canvases_, [&](const Canvas& c) { return c.width == view.width_px && c.height == view.height_px; });
    if (known != canvases_.end()) {
        canvases_.splice(canvases_.begin(), canvases_, known);
        return canvases_.front();
    }
    canvases_.push_front(make_canvas(view.width_px, view.height_px));
    if (canvases_.size() > max_canvases)
        canvases_.pop_back();
    return canvases_.front();
}

/// What is in view, as the view itself will be drawn; pixels that show ground get ground_bit. Where only pieces in reach of a shadow are
/// looked up the others are left out: of a pixel that shows one of those nobody asks.
void ShadowMask::draw_depth(const Shot& shot) {
    const GladGLContext& gl = context_.gl;
    std::vector<std::tuple<bool, double, std::uint32_t>> sorted[2]; // closed first, by distance: what stands upright, ground
    const Frustum frustum(shot.camera.clip_from_ego);
    for (const std::uint32_t i : scene_.near(ego_m_)) {
        const Piece& piece = scene_.pieces()[i];
        const glm::dvec3 centre = centre_of(piece, ego_m_);
        const double distance = glm::length(centre) - piece.radius_m;
        if (!piece.is_shown(shot.camera.is_map) || distance > farthest_drawn_m || frustum.outside(centre, piece.radius_m))
            continue;
        if (use_.pruned && !reach(piece, shot.outputs.target ? use_.target_height_m : 0.0))
            continue;
        sorted[piece.ground ? 1 : 0].emplace_back(!piece.closed, distance, i);
    }
    depth_program_.use();
    depth_program_.set("clip_from_ego", glm::mat4(shot.camera.clip_from_ego));
    list_.start(ego_m_, scene_.moves());
    for (auto& pieces : sorted) {
        std::ranges::sort(pieces);
        std::vector<std::uint32_t> order;
        for (const auto& [open, distance, i] : pieces)
            order.push_back(i);
        list_.add(order);
        shot.work.draws += static_cast<int>(order.size());
    }
    list_.upload();
    gl.StencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    for (const int call : {0, 1}) {
        gl.StencilFunc(GL_ALWAYS, call == 1 && only_on_ground() ? static_cast<GLint>(ground_bit) : 0, 0xFF);
        list_.draw(call, &shot.camera.clip_from_ego);
    }
    ++shot.work.passes;
    shot.work.triangles += list_.triangles();
}

/// Where a count is not 0, and sets the counts back.
void ShadowMask::set_bits(GLuint bits) const {
    const GladGLContext& gl = context_.gl;
    mask_program_.use();
    gl.Uniform1ui(mask_program_.uniform("bits"), bits);
    gl.BindVertexArray(nothing_);
    const GLuint counts = only_on_ground() ? count_bits : 0xFFU;
    gl.StencilMask(counts);
    gl.StencilOp(GL_KEEP, GL_ZERO, GL_ZERO);
    only_on_ground() ? gl.StencilFunc(GL_LESS, static_cast<GLint>(ground_bit), 0xFF) : gl.StencilFunc(GL_NOTEQUAL, 0, 0xFF);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.Disable(GL_DEPTH_TEST);
    gl.Enable(GL_COLOR_LOGIC_OP);
    gl.LogicOp(GL_OR);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.Disable(GL_COLOR_LOGIC_OP);
    gl.Enable(GL_DEPTH_TEST);
    gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
}

void ShadowMask::draw(const Shot& shot) {
    const GladGLContext& gl = context_.gl;
    before_marking(shot);
    shot.clock.begin("shadow masks: depth");
    const Canvas& canvas = canvas_for(shot.view);
    gl.BindFramebuffer(GL_FRAMEBUFFER, canvas.framebuffer);
    gl.Viewport(0, 0, canvas.width, canvas.height);
    const GLuint seen[4] = {0, 0, 0, 0};
    gl.StencilMask(0xFF);
    gl.ClearNamedFramebufferuiv(canvas.framebuffer, GL_COLOR, 0, seen);
    gl.ClearNamedFramebufferfi(canvas.framebuffer, GL_DEPTH_STENCIL, 0, 0.0F, 0);
    bool any = false;
    for (std::size_t i = 0; i < lamps_.size(); ++i)
        any = any || hides_any(i);
    if (any) {
        gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        gl.Enable(GL_STENCIL_TEST);
        draw_depth(shot);
        shot.clock.end();
        shot.clock.begin(pass_title());
        gl.DepthMask(GL_FALSE);
        for (std::size_t i = 0; i < (one_for_all_lamps() ? std::min<std::size_t>(lamps_.size(), 1) : lamps_.size()); ++i)
            for (const bool raised : {false, true})
                if (hides_any(i) && (!raised || shot.outputs.target)) {
                    gl.StencilMask(only_on_ground() ? count_bits : 0xFFU);
                    mark_hidden(shot, i, raised ? use_.target_height_m : 0.0);
                    const GLuint bits = one_for_all_lamps() ? 0xFFU : 1U << i;
                    set_bits(raised ? bits << target_bits_from : bits);
                    ++shot.work.passes;
                }
        gl.StencilMask(0xFF);
        gl.Disable(GL_STENCIL_TEST);
        gl.DepthMask(GL_TRUE);
        gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }
    context_.check("rendering a shadow mask");
    gl.BindTextureUnit(shadow_unit(0), canvas.mask);
    shot.clock.end();
}

/// Into one pixel, which is let go: whether any picture will need a mask is not known yet.
void ShadowMask::compile(const Shot& /*shot*/) {
    const GladGLContext& gl = context_.gl;
    const Canvas canvas = make_canvas(1, 1);
    gl.BindFramebuffer(GL_FRAMEBUFFER, canvas.framebuffer);
    gl.Viewport(0, 0, canvas.width, canvas.height);
    gl.Enable(GL_STENCIL_TEST);
    gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    depth_program_.use();
    list_.draw_nothing(glm::dvec3(0.0), scene_.moves());
    set_bits(0);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.StencilMask(0xFF);
    gl.Disable(GL_STENCIL_TEST);
    context_.check("compiling shadow masks");
}

std::vector<Program::Define> ShadowMask::defines(const std::vector<const Beam*>& /*beams*/) const { return {{"SHADOW_MASK", "1"}}; }

std::size_t ShadowMask::texture_bytes() const {
    std::size_t bytes = 0;
    for (const Canvas& canvas : canvases_) // 2 of the mask, 8 of depth and stencil
        bytes += 10 * static_cast<std::size_t>(canvas.width) * static_cast<std::size_t>(canvas.height);
    return bytes;
}

} // namespace fernlicht::gl
