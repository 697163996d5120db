#include "renderer/gl/shadow_maps.h"

#include "renderer/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht::gl {
namespace {

constexpr double margin_rad = 0.01; // the look-up's four texels and its raised point
constexpr double raised_m = 0.6;    // targets stand this high at most above the surface whose sphere is asked for

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
    : context_(context), scene_(scene), size_(size), program_(context, "depth.vert.glsl", "", {}),
      matrix_(program_.uniform("clip_from_ego")), list_(context, scene), target_(make_framebuffer(context)) {}

bool ShadowMaps::faces_lamp(const Piece& piece, const glm::dvec3& lamp_m) const {
    const glm::vec3 lamp(lamp_m + ego_m_ - piece.origin_m);
    const auto first = scene_.planes().begin() + static_cast<std::ptrdiff_t>(piece.first_plane);
    return std::all_of(first, first + static_cast<std::ptrdiff_t>(piece.planes),
                       [&](const glm::vec4& plane) { return glm::dot(glm::vec3(plane), lamp) + plane.w > 0.0F; });
}

void ShadowMaps::set(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m, bool all) {
    ego_m_ = ego_m;
    maps_.clear();
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        Map map;
        map.lamp_m = lamps[i].pose.position_m - ego_m;
        map.clip = lamp_clip(lamps[i], beams[i]->window, ego_m);
        const Frustum frustum(map.clip);
        for (std::uint32_t k = 0; k < scene_.pieces().size(); ++k) {
            const Piece& piece = scene_.pieces()[k];
            const glm::dvec3 from_lamp = centre_of(piece, ego_m) - map.lamp_m;
            const double distance = glm::length(from_lamp), nearest = distance - piece.radius_m;
            if (nearest > shadow_farthest_m || frustum.outside(centre_of(piece, ego_m), piece.radius_m))
                continue;
            if (piece.ground && !piece.above_ground && faces_lamp(piece, map.lamp_m))
                continue;
            const double most_cd = beams[i]->bounds.most_towards(to_lamp_space(lamps[i], from_lamp), piece.radius_m);
            if (!all && (most_cd == 0.0 || (nearest > 0.0 && most_cd < last_contour_lx * nearest * nearest)))
                continue;
            map.pieces.push_back(k);
            Caster caster;
            caster.around = distance <= piece.radius_m;
            caster.direction = distance > 0.0 ? from_lamp / distance : glm::dvec3(1.0, 0.0, 0.0);
            const double angle = caster.around ? pi : std::asin(piece.radius_m / distance) + margin_rad;
            caster.cosine = std::cos(angle);
            caster.sine = std::sin(angle);
            caster.nearest_m = nearest;
            map.casters.push_back(caster);
        }
        maps_.push_back(std::move(map));
    }
}

bool ShadowMaps::needed() const {
    return std::any_of(maps_.begin(), maps_.end(), [](const Map& map) { return !map.pieces.empty(); });
}

int ShadowMaps::casters() const {
    std::size_t count = 0;
    for (const Map& map : maps_)
        count += map.pieces.size();
    return static_cast<int>(count);
}

bool ShadowMaps::reach(const glm::dvec3& centre_m, double radius_m) const {
    for (const Map& map : maps_) {
        const glm::dvec3 from_lamp = centre_m - map.lamp_m;
        const double distance = glm::length(from_lamp), radius = radius_m + raised_m;
        if (map.casters.empty())
            continue;
        if (distance <= radius)
            return true;
        const double sine = radius / distance, cosine = std::sqrt(1.0 - sine * sine);
        for (const Caster& caster : map.casters) {
            if (caster.around)
                return true;
            if (distance + radius < caster.nearest_m)
                continue;
            // The cones meet where the angle between their axes is at most the sum of their half angles.
            const double sum = caster.cosine * cosine - caster.sine * sine;
            if (glm::dot(caster.direction, from_lamp) >= sum * distance)
                return true;
        }
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
    if (clips != drawn_clips_ || pieces != drawn_pieces_ || ego_m_ != drawn_ego_m_) {
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
            list_.start(ego_m_);
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
    list_.start(glm::dvec3(0.0));
    list_.add_nothing();
    list_.upload();
    list_.draw(0);
    context_.check("compiling the shadow pass");
}

std::size_t ShadowMaps::texture_bytes() const {
    return textures_.size() * 4 * static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height);
}

} // namespace fernlicht::gl
