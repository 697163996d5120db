#include "renderer/gl/shadows/shadow_maps.h"

#include "renderer/gl/device/program.h"
#include "renderer/gl/shadows/projected_maps.h"
#include "renderer/renderer.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace fernlicht::gl {

ShadowMaps::ShadowMaps(Context& context, const SceneBuffers& scene, const ShadowSettings& settings)
    : Shadows(context, scene, settings), pass_(context, scene, scene.moves()) {}

void ShadowMaps::draw_maps(std::vector<Texture>& textures, double ground_lowered, Work& work) {
    const std::vector<LampCasters>& lamps = casters_.lamps();
    while (textures.size() < lamps.size())
        textures.push_back(
            make_shadow_texture(context_, {settings_.width, settings_.height, 0, fmt::format("each lamp by '{}'", name(settings_.method)),
                                           "a smaller map_texels"}));
    pass_.begin(settings_.width, settings_.height);
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        pass_.set_pieces(casters_.ego_m(), lamps[i].pieces);
        pass_.draw(textures[i], lamps[i].clip, work, -1, ground_lowered);
    }
    pass_.end("rendering shadow maps");
}

void ShadowMaps::draw(const Shot& shot) {
    shot.clock.begin("shadow maps");
    Work& work = shot.work;
    const std::vector<LampCasters>& lamps = casters_.lamps();
    const glm::dvec3 ego_m = casters_.ego_m();
    Drawn now{{}, {}, ego_m, scene_.placed()};
    for (const LampCasters& lamp : lamps) {
        now.clips.push_back(lamp.clip);
        now.pieces.push_back(lamp.pieces);
    }
    if (now != drawn_) {
        draw_maps(textures_, spread(), work);
        drawn_ = std::move(now);
        on_cpu_stands_ = targets_drawn_ = false;
    }
    targets_apart_ = shot.outputs.target && std::ranges::any_of(lamps, &LampCasters::ground);
    work.shadow_maps += static_cast<int>(lamps.size() * (targets_apart_ ? 2 : 1));
    if (targets_apart_ && !targets_drawn_) {
        draw_maps(target_textures_, 0.0, work);
        targets_drawn_ = true;
        targets_on_cpu_stand_ = false;
    }
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        context_.gl.BindTextureUnit(shadow_unit(i), textures_[i]);
        if (shot.outputs.target)
            context_.gl.BindTextureUnit(target_shadow_unit(i), targets_apart_ ? target_textures_[i] : textures_[i]);
    }
    shot.clock.end();
}

void ShadowMaps::compile(const Shot& /*shot*/) { pass_.compile(settings_.width, settings_.height); }

std::vector<Program::Define> ShadowMaps::defines(const std::vector<const Beam*>& beams) const {
    double spread = 0.0;
    std::string windows; // each within the empty outermost texels
    for (const Beam* const beam : beams) {
        const ShadowWindow& window = beam->window;
        spread = std::max(spread, 1.5 * texel_tangent(window, settings_));
        const double across = (settings_.width - 2.0) / settings_.width / (window.right - window.left),
                     up = (settings_.height - 2.0) / settings_.height / (window.top - window.bottom);
        windows += fmt::format("{}vec4({}, {}, {}, {})", windows.empty() ? "" : ", ", literal(across), literal(up),
                               literal(1.0 / settings_.width - window.left * across), literal(1.0 / settings_.height - window.bottom * up));
    }
    return {{"SHADOW_MAPS", "1"},
            {"SHADOW_LIFT", "1"},
            {"SHADOW_NEAR", literal(shadow_near_m)},
            {"SHADOW_TOLERANCE", literal(settings_.tolerance_m)},
            {"SHADOW_SPREAD", literal(spread)},
            {"SHADOW_WINDOWS", windows}};
}

double ShadowMaps::spread() const {
    double spread = 0.0;
    for (const LampCasters& lamp : casters_.lamps())
        spread = std::max(spread, 1.5 * texel_tangent(lamp.window, settings_));
    return spread;
}

std::span<const ShadowLookUp> ShadowMaps::look_ups() {
    const std::vector<LampCasters>& lamps = casters_.lamps();
    for (std::vector<MapOnCpu>* maps : {&on_cpu_, &targets_on_cpu_})
        maps->resize(std::max(maps->size(), lamps.size()));
    look_ups_.assign(lamps.size(), {});
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        const LampCasters& lamp = lamps[i];
        if (!on_cpu_stands_)
            on_cpu_[i].read(context_, textures_[i], settings_, 1, drawn_texels(lamp, settings_));
        const MapPlan plan{lamp.lamp.pose, window_homography(lamp.window, settings_.width, settings_.height), spread(), {}, {}};
        ShadowLookUp& look_up = look_ups_[i];
        look_up.texture_from_ego = texture_from_ego(plan, casters_.ego_m());
        look_up.near_m = shadow_near_m;
        look_up.tolerance_m = settings_.tolerance_m;
        on_cpu_[i].tell(look_up);
        if (targets_apart_ && !targets_on_cpu_stand_)
            targets_on_cpu_[i].read(context_, target_textures_[i], settings_, 1, drawn_texels(lamp, settings_));
        if (targets_apart_)
            look_up.target_depth = targets_on_cpu_[i].depth();
    }
    on_cpu_stands_ = true;
    targets_on_cpu_stand_ = targets_on_cpu_stand_ || targets_apart_;
    return look_ups_;
}

std::size_t ShadowMaps::texture_bytes() const {
    return (textures_.size() + target_textures_.size()) * 4 * static_cast<std::size_t>(settings_.width) *
           static_cast<std::size_t>(settings_.height);
}

namespace {

/// Throws ShadowMemoryError where making the texture failed; what the driver noted of it is taken away, for what is drawn next.
void check_room(Context& context, const ShadowTextureAsked& asked) {
    std::string said = std::exchange(context.last_error, {});
    while (const GLenum error = context.gl.GetError())
        said = said.empty() ? fmt::format("OpenGL error 0x{:04x}", error) : said;
    if (said.empty())
        return;
    const int maps = std::max(asked.layers, 1);
    throw ShadowMemoryError(
        fmt::format("shadows: found {} of {} x {} texels for {}, {:.0f} MiB, for which {} has no room ({}), expected {}",
                    maps == 1 ? "a map" : fmt::format("{} maps", maps), asked.width, asked.height, asked.owner,
                    4.0 * asked.width * asked.height * maps / (1 << 20), context.info.gl_renderer, said, asked.smaller));
}

} // namespace

Texture make_shadow_texture(Context& context, const ShadowTextureAsked& asked) {
    const GladGLContext& gl = context.gl;
    GLint limit = 0;
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (std::max(asked.width, asked.height) > limit)
        throw ShadowMemoryError(fmt::format("shadows: found a map of {} x {} texels for {}, expected at most {} each way (map_texels), "
                                            "which {} renders",
                                            asked.width, asked.height, asked.owner, limit, context.info.gl_renderer));
    context.check("rendering before a shadow map was made");
    Texture texture = new_texture(context, asked.layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D);
    if (asked.layers > 0)
        gl.TextureStorage3D(texture, 1, GL_DEPTH_COMPONENT32F, asked.width, asked.height, asked.layers);
    else
        gl.TextureStorage2D(texture, 1, GL_DEPTH_COMPONENT32F, asked.width, asked.height);
    check_room(context, asked);
    gl.TextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.TextureParameteri(texture, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl.TextureParameteri(texture, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
    gl.TextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    context.check("making a shadow map");
    return texture;
}

} // namespace fernlicht::gl
