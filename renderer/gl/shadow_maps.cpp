#include "renderer/gl/shadow_maps.h"

#include "renderer/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace fernlicht::gl {
namespace {

constexpr double margin_texels = 2.6; // a look-up takes texels up to 1 away, from a point raised by 1.5 (see SHADOW_SPREAD)
constexpr double margin_m = 0.05;     // or raised by the tolerance
constexpr double tangents_from_m = 0.1;

Corners in_lamp_space(const LitLamp& lamp, const glm::dvec3& offset_from_lamp, const Corners& corners) {
    Corners out{};
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = to_lamp_space(lamp, offset_from_lamp + corners[i]);
    return out;
}

} // namespace

glm::dmat4 lamp_clip(const LitLamp& lamp, const ShadowWindow& w, const glm::dvec3& ego_m) {
    const glm::dvec3 axes[3] = {-lamp.pose.left(), lamp.pose.up(), lamp.pose.forward()}, at = lamp.pose.position_m - ego_m;
    glm::dmat4 lamp_from_ego(1.0);
    for (int column = 0; column < 3; ++column)
        lamp_from_ego[column] = {axes[0][column], axes[1][column], axes[2][column], 0.0};
    lamp_from_ego[3] = {-glm::dot(axes[0], at), -glm::dot(axes[1], at), -glm::dot(axes[2], at), 1.0};
    return tangent_projection(w.left, w.right, w.bottom, w.top, shadow_near_m) * lamp_from_ego;
}

double texel_tangent(const ShadowWindow& window, const ShadowSize& size) {
    return std::max((window.right - window.left) / (size.width - 2), (window.top - window.bottom) / (size.height - 2));
}

ShadowMaps::ShadowMaps(Context& context, const SceneBuffers& scene, ShadowSize size)
    : context_(context), scene_(scene), size_(size),
      program_(context, "depth.vert.glsl", "",
               scene.moves() ? std::vector<Program::Define>{{"MOVING", "1"}} : std::vector<Program::Define>{}),
      matrix_(program_.uniform("clip_from_ego")), list_(context, scene), target_(make_framebuffer(context)) {}

bool ShadowMaps::faces_lamp(const Piece& piece, const glm::dvec3& lamp_m) const {
    const glm::vec3 lamp(lamp_m + ego_m_ - piece.origin_m);
    const auto first = scene_.planes().begin() + static_cast<std::ptrdiff_t>(piece.first_plane);
    return std::all_of(first, first + static_cast<std::ptrdiff_t>(piece.planes),
                       [&](const glm::vec4& plane) { return glm::dot(glm::vec3(plane), lamp) + plane.w > 0.0F; });
}

void ShadowMaps::set(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) {
    ego_m_ = ego_m;
    maps_.clear();
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        Map map;
        map.lamp = lamps[i];
        map.lamp_m = lamps[i].pose.position_m - ego_m;
        map.clip = lamp_clip(lamps[i], beams[i]->window, ego_m);
        const Frustum frustum(map.clip);
        for (const std::uint32_t k : scene_.near(ego_m)) {
            const Piece& piece = scene_.pieces()[k];
            const glm::dvec3 from_lamp = centre_of(piece, ego_m) - map.lamp_m;
            const double distance = glm::length(from_lamp), nearest = distance - piece.radius_m;
            if (nearest > shadow_farthest_m || frustum.outside(centre_of(piece, ego_m), piece.radius_m))
                continue;
            if (!piece.casts || (piece.ground && !piece.above_ground && faces_lamp(piece, map.lamp_m)))
                continue;
            const double most_cd = beams[i]->bounds.most_towards(to_lamp_space(lamps[i], from_lamp), piece.radius_m);
            if (most_cd == 0.0 || (nearest > 0.0 && most_cd < last_contour_lx * nearest * nearest))
                continue;
            map.pieces.push_back(k);
            for (const Corners& body : piece.bodies_m)
                map.casters.push_back(caster_of(in_lamp_space(map.lamp, piece.origin_m - ego_m - map.lamp_m, body),
                                                margin_texels * texel_tangent(beams[i]->window, size_)));
        }
        maps_.push_back(std::move(map));
    }
}

bool ShadowMaps::needed() const {
    return std::any_of(maps_.begin(), maps_.end(), [](const Map& map) { return !map.pieces.empty(); });
}

ShadowMaps::Caster ShadowMaps::caster_of(const Corners& box, double margin) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Caster caster{infinity, -infinity, infinity, -infinity, infinity, false};
    for (const glm::dvec3& corner : box) {
        caster.around = caster.around || corner.z < tangents_from_m;
        caster.left = std::min(caster.left, corner.x / corner.z - margin);
        caster.right = std::max(caster.right, corner.x / corner.z + margin);
        caster.bottom = std::min(caster.bottom, corner.y / corner.z - margin);
        caster.top = std::max(caster.top, corner.y / corner.z + margin);
        caster.nearest_m = std::min(caster.nearest_m, corner.z - margin_m);
    }
    return caster;
}

/// The part of the box that lies beyond the caster's front against the frustum behind the caster: apart, where all of it is on the
/// far side of one of the frustum's planes.
bool ShadowMaps::shades(const Caster& caster, const Corners& box) {
    if (caster.around)
        return true;
    std::array<glm::dvec3, 20> points; // corners beyond the front, and where edges cross it
    std::size_t count = 0;
    const double front = std::max(caster.nearest_m, tangents_from_m);
    for (std::size_t i = 0; i < box.size(); ++i) {
        if (box[i].z >= front)
            points[count++] = box[i];
        for (const std::size_t axis : {1U, 2U, 4U})
            if (const std::size_t k = i | axis; k != i && (box[i].z < front) != (box[k].z < front))
                points[count++] = box[i] + (box[k] - box[i]) * ((front - box[i].z) / (box[k].z - box[i].z));
    }
    const auto all = [&](auto outside) {
        for (std::size_t i = 0; i < count; ++i)
            if (!outside(points[i]))
                return false;
        return true;
    };
    return !(all([&](const glm::dvec3& p) { return p.x < caster.left * p.z - margin_m; }) ||
             all([&](const glm::dvec3& p) { return p.x > caster.right * p.z + margin_m; }) ||
             all([&](const glm::dvec3& p) { return p.y < caster.bottom * p.z - margin_m; }) ||
             all([&](const glm::dvec3& p) { return p.y > caster.top * p.z + margin_m; }));
}

bool ShadowMaps::reach(const Piece& piece, double raised_m) const {
    Corners raised = piece.corners_m; // bits 0 to 3: the box's bottom, 4 to 7: its top
    for (std::size_t i = 4; i < raised.size(); ++i)
        raised[i].z += raised_m;
    for (const Map& map : maps_) {
        if (map.casters.empty())
            continue;
        const Corners box = in_lamp_space(map.lamp, piece.origin_m - ego_m_ - map.lamp_m, raised);
        if (std::ranges::any_of(map.casters, [&](const Caster& caster) { return shades(caster, box); }))
            return true;
    }
    return false;
}

void ShadowMaps::draw(Work& work) {
    const GladGLContext& gl = context_.gl;
    while (textures_.size() < maps_.size()) {
        Texture texture = make_texture(context_, GL_DEPTH_COMPONENT32F, size_.width, size_.height);
        gl.TextureParameteri(texture, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        gl.TextureParameteri(texture, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
        gl.TextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        gl.TextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        textures_.push_back(std::move(texture));
    }
    std::vector<glm::dmat4> clips;
    std::vector<std::vector<std::uint32_t>> pieces;
    for (const Map& map : maps_) {
        clips.push_back(map.clip);
        pieces.push_back(map.pieces);
    }
    work.shadow_maps += static_cast<int>(maps_.size());
    if (clips != drawn_clips_ || pieces != drawn_pieces_ || ego_m_ != drawn_ego_m_ || scene_.placed() != drawn_placed_) {
        program_.use();
        // The outermost texels stay empty: what lies outside the window is lit.
        gl.Viewport(1, 1, size_.width - 2, size_.height - 2);
        gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE); // row 0 is the lowest tangent, as the look-up takes it
        gl.Enable(GL_SCISSOR_TEST);
        for (std::size_t i = 0; i < maps_.size(); ++i) {
            gl.NamedFramebufferTexture(target_, GL_DEPTH_ATTACHMENT, textures_[i], 0);
            gl.NamedFramebufferDrawBuffer(target_, GL_NONE);
            gl.BindFramebuffer(GL_FRAMEBUFFER, target_);
            const float far_away = 0.0F;
            gl.Scissor(0, 0, size_.width, size_.height);
            gl.ClearNamedFramebufferfv(target_, GL_DEPTH, 0, &far_away);
            gl.Scissor(1, 1, size_.width - 2, size_.height - 2);
            const glm::mat4 clip(maps_[i].clip);
            gl.UniformMatrix4fv(matrix_, 1, GL_FALSE, &clip[0][0]);
            list_.start(ego_m_, scene_.moves());
            list_.add(maps_[i].pieces);
            list_.upload();
            list_.draw(0);
            ++work.passes;
            work.draws += static_cast<int>(maps_[i].pieces.size());
            work.triangles += list_.triangles();
        }
        gl.Disable(GL_SCISSOR_TEST);
        gl.ClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
        context_.check("drawing shadow maps");
        drawn_clips_ = std::move(clips);
        drawn_pieces_ = std::move(pieces);
        drawn_ego_m_ = ego_m_;
        drawn_placed_ = scene_.placed();
    }
    for (std::size_t i = 0; i < maps_.size(); ++i)
        gl.BindTextureUnit(first_shadow_unit + static_cast<GLuint>(i), textures_[i]);
}

void ShadowMaps::compile() {
    const GladGLContext& gl = context_.gl;
    const Texture scratch = make_texture(context_, GL_DEPTH_COMPONENT32F, size_.width, size_.height);
    gl.NamedFramebufferTexture(target_, GL_DEPTH_ATTACHMENT, scratch, 0);
    gl.NamedFramebufferDrawBuffer(target_, GL_NONE);
    gl.BindFramebuffer(GL_FRAMEBUFFER, target_);
    program_.use();
    list_.start(glm::dvec3(0.0), scene_.moves());
    list_.add_nothing();
    list_.upload();
    list_.draw(0);
    context_.check("compiling the shadow pass");
}

std::size_t ShadowMaps::texture_bytes() const {
    return textures_.size() * 4 * static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height);
}

} // namespace fernlicht::gl
