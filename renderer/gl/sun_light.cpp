#include "renderer/gl/sun_light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace fernlicht::gl {
namespace {

constexpr double depth_m = 2.0 * farthest_drawn_m;                       // to both sides of the map's centre, along the light
constexpr double texel_m = 2.0 * sun_window_m / (sun_map_texels - 2);    // the outermost texels stay empty
constexpr double window_share = (sun_map_texels - 2.0) / sun_map_texels; // of the map
constexpr double ground_raised_m = 0.02;
constexpr double raised_m = 1.5 * texel_m; // a look-up takes texels up to 1.42 away

double to_grid(double m) { return texel_m * std::round(m / texel_m); }

} // namespace

SunLight::SunLight(Context& context, const SceneBuffers& scene) : context_(context), scene_(scene), pass_(context, scene, false) {}

bool SunLight::faces_light(const Piece& piece) const {
    const glm::vec3 light(towards_);
    const auto first = scene_.planes().begin() + static_cast<std::ptrdiff_t>(piece.first_plane);
    return std::all_of(first, first + static_cast<std::ptrdiff_t>(piece.planes),
                       [&](const glm::vec4& plane) { return glm::dot(glm::vec3(plane), light) > 0.0F; });
}

void SunLight::set(const Moment& moment, bool shadows) {
    casters_.clear();
    ground_casts_ = false;
    const DirectLight* light = moment.daylight.direct();
    illuminance_lx_ = light ? light->illuminance_lx : 0.0;
    if (light == nullptr)
        return;
    towards_ = light->towards();
    right_ = std::abs(towards_.z) < 0.999 ? glm::normalize(glm::cross({0.0, 0.0, 1.0}, towards_)) : glm::dvec3(1.0, 0.0, 0.0);
    up_ = glm::cross(towards_, right_);
    ego_m_ = moment.ego.position_m;
    // On the texels of a grid that stands still in the world, so that edges do not creep as the car moves.
    const glm::dvec3 wanted = ego_m_ + sun_window_ahead_m * moment.ego.forward();
    centre_m_ =
        to_grid(glm::dot(wanted, right_)) * right_ + to_grid(glm::dot(wanted, up_)) * up_ + glm::dot(wanted, towards_) * towards_ - ego_m_;
    if (!shadows)
        return;
    for (const std::uint32_t i : scene_.near(ego_m_)) {
        const Piece& piece = scene_.pieces()[i];
        const glm::dvec3 from_centre = centre_of(piece, ego_m_) - centre_m_;
        const double reach = sun_window_m + piece.radius_m;
        if (std::abs(glm::dot(from_centre, right_)) > reach || std::abs(glm::dot(from_centre, up_)) > reach)
            continue;
        if (!piece.casts || (piece.ground && !piece.above_ground && faces_light(piece)))
            continue;
        casters_.push_back(i);
        ground_casts_ = ground_casts_ || piece.ground;
    }
}

glm::dmat4 SunLight::window_from_ego() const {
    glm::dmat4 m(0.0);
    const glm::dvec3 rows[3] = {right_ / sun_window_m, up_ / sun_window_m, towards_ / (2.0 * depth_m)};
    const double shift[3] = {0.0, 0.0, 0.5};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            m[column][row] = rows[row][column];
        m[3][row] = shift[row] - glm::dot(rows[row], centre_m_);
    }
    m[3][3] = 1.0;
    return m;
}

void SunLight::make_map() {
    const GladGLContext& gl = context_.gl;
    map_.emplace(make_texture(context_, GL_DEPTH_COMPONENT32F, sun_map_texels, sun_map_texels));
    gl.TextureParameteri(*map_, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl.TextureParameteri(*map_, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
    gl.TextureParameteri(*map_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TextureParameteri(*map_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
}

void SunLight::draw(Work& work) {
    if (!map_)
        make_map();
    const glm::dmat4 window = window_from_ego();
    ++work.shadow_maps;
    if (drawn_window_ != window || casters_ != drawn_ || ego_m_ != drawn_ego_m_) {
        pass_.begin(sun_map_texels, sun_map_texels);
        pass_.set_pieces(ego_m_, casters_);
        pass_.draw(*map_, window, work);
        pass_.end("rendering the sun's shadow map");
        drawn_window_ = window;
        drawn_ = casters_;
        drawn_ego_m_ = ego_m_;
    }
    context_.gl.BindTextureUnit(sun_shadow_unit, *map_);
}

void SunLight::compile() {
    if (!map_)
        make_map();
    pass_.compile(sun_map_texels, sun_map_texels);
    drawn_window_.reset();
    context_.gl.BindTextureUnit(sun_shadow_unit, *map_);
}

void SunLight::set_uniforms(const Program& program) const {
    program.set("sun_towards_lx", four(towards_, illuminance_lx_));
    glm::dmat4 to_map(1.0);
    to_map[0][0] = to_map[1][1] = 0.5 * window_share;
    to_map[3][0] = to_map[3][1] = 0.5;
    program.set("sun_map_from_ego", glm::mat4(to_map * window_from_ego()));
    program.set("sun_raised_m", glm::vec2(raised_m, ground_casts_ ? raised_m : ground_raised_m));
}

std::size_t SunLight::texture_bytes() const { return map_ ? std::size_t{4} * sun_map_texels * sun_map_texels : 0; }

} // namespace fernlicht::gl
