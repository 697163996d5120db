#include "renderer/gl/shadows/projected_maps.h"

#include "renderer/gl/device/program.h"
#include "renderer/gl/shadows/shadow_maps.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace fernlicht::gl {
namespace {

constexpr double shadow_texels_to_spare = 2.6; // as ShadowCasters: a look-up's point is raised by 1.5, and texels up to 1 away are weighed

/// Texture coordinates to clip space, depth = shadow_near_m / w.
glm::dmat4 clip_from_shadow_texture(const glm::dmat4& texture) {
    glm::dmat4 clip(0.0);
    for (int column = 0; column < 4; ++column) {
        const glm::dvec4& t = texture[column];
        clip[column] = {2.0 * t.x - t.z, 2.0 * t.y - t.z, column == 3 ? shadow_near_m : 0.0, t.z};
    }
    return clip;
}

/// Of lamp space (x right, y up, z forward), relative to `ego_m`.
glm::dmat4 ego_from_lamp_space(const Pose& pose, const glm::dvec3& ego_m) {
    return {glm::dvec4(-pose.left(), 0.0), glm::dvec4(pose.up(), 0.0), glm::dvec4(pose.forward(), 0.0),
            glm::dvec4(pose.position_m - ego_m, 1.0)};
}

bool covered_by(const MapPlan& map, const MapPlan& now, int width, int height) {
    const glm::dmat4 texture = texture_from_ego(map, now.from.position_m) * ego_from_lamp_space(now.from, now.from.position_m);
    const double x = shadow_texels_to_spare / width, y = shadow_texels_to_spare / height;
    return std::ranges::all_of(now.to_cover, [&](const glm::dvec3& point) {
        const glm::dvec4 q = texture * glm::dvec4(point, 1.0);
        return q.z > 0.0 && q.x > x * q.z && q.x < (1.0 - x) * q.z && q.y > y * q.z && q.y < (1.0 - y) * q.z;
    });
}

/// What lies nearer and at the side of a beam may be lit for want of texels: to hold it too would take texels from all the rest.
constexpr double one_map_from_m = 3.0;
/// 72 degrees: of a lamp that looks elsewhere, such as a cornering lamp, only so much is in the map.
constexpr double one_map_widest_tangent = 3.0;

} // namespace

glm::dmat3 window_homography(const ShadowWindow& window, int width, int height) {
    const double across = (width - 2.0) / width / (window.right - window.left), up = (height - 2.0) / height / (window.top - window.bottom);
    return {{across, 0.0, 0.0}, {0.0, up, 0.0}, {1.0 / width - window.left * across, 1.0 / height - window.bottom * up, 1.0}};
}

double spread_of(const glm::dmat3& texture_from_lamp, int width, int height) {
    const glm::dmat3 lamp_from_texture = glm::inverse(texture_from_lamp);
    const glm::dvec3 across = lamp_from_texture[0] / static_cast<double>(width), up = lamp_from_texture[1] / static_cast<double>(height);
    // Along the diagonal, too, where the two are not at right angles: of a square texel it is the square root of 2.
    const double diagonal = std::max(glm::length(across + up), glm::length(across - up)) / std::sqrt(2.0);
    return 1.5 * std::max({glm::length(across), glm::length(up), diagonal});
}

glm::dmat4 texture_from_ego(const MapPlan& plan, const glm::dvec3& ego_m) {
    glm::dmat4 texture_from_lamp(0.0);
    for (int column = 0; column < 3; ++column)
        texture_from_lamp[column] = glm::dvec4(plan.texture_from_lamp[column], plan.spread * plan.texture_from_lamp[column].z);
    return texture_from_lamp * lamp_from_ego(plan.from, ego_m);
}

double edge_shift(const MapPlan& then, const MapPlan& now) {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    const glm::dvec3 moved = now.from.position_m - then.from.position_m;
    const glm::dvec3 m(std::abs(glm::dot(moved, now.from.left())), std::abs(glm::dot(moved, now.from.up())),
                       std::abs(glm::dot(moved, now.from.forward())));
    double most = 0.0;
    for (const Caster& body : now.bodies) {
        // (X - m_x) / (Z - m_z) - X / Z = (X / Z * m_z - m_x) / (Z - m_z), and so for Y
        const double nearest = body.nearest_m - m.z;
        if (nearest <= 0.0)
            return unknown;
        const double aside = std::max(std::abs(body.left), std::abs(body.right)),
                     above = std::max(std::abs(body.bottom), std::abs(body.top));
        most = std::max(most, std::hypot(aside * m.z + m.x, above * m.z + m.y) / nearest);
    }
    return most;
}

ProjectedMaps::ProjectedMaps(Context& context, const SceneBuffers& scene, const ShadowSettings& settings, std::vector<glm::dvec2> places)
    : Shadows(context, scene, settings), places_(std::move(places)), pass_(context, scene, scene.moves()) {}

Texture ProjectedMaps::make_map() const {
    return make_shadow_texture(context_, {settings_.width, settings_.height, layered() ? static_cast<int>(places_.size()) : 0,
                                          fmt::format("each lamp by '{}'", name(settings_.method)),
                                          layered() ? "a smaller map_texels or fewer lamp_places" : "a smaller map_texels"});
}

/// Lamps of one name are told apart by their order.
std::string ProjectedMaps::name_of(std::size_t lamp) const {
    const std::vector<LampCasters>& lamps = casters_.lamps();
    const std::string& name = lamps[lamp].lamp.name;
    const auto before = std::count_if(lamps.begin(), lamps.begin() + static_cast<std::ptrdiff_t>(lamp), [&](const LampCasters& other) {
        return other.lamp.name == name && other.lamp.intensity_factor > 0.0;
    });
    return fmt::format("{}{} {}", lamps[lamp].lamp.intensity_factor > 0.0 ? "" : "off ", before, name);
}

double ProjectedMaps::kept_tangent(const LampCasters& lamp) const {
    return settings_.redraw_texels * texel_tangent(lamp.window, settings_);
}

void ProjectedMaps::choose_casters(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) {
    casters_.set(lamps, beams, ego_m);
}

void ProjectedMaps::set(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) {
    lamps_ = lamps;
    choose_casters(lamps, beams, ego_m);
    // A lamp that goes out, or has nothing in its beam, begins anew: what is kept must not depend on what is drawn for nothing.
    std::vector<std::string> in_use;
    for (std::size_t i = 0; i < casters_.lamps().size(); ++i) {
        const LampCasters& lamp = casters_.lamps()[i];
        if (settings_.redraw_texels > 0.0)
            casters_.widen(i, 2.0 * kept_tangent(lamp));
        if (lamp.lamp.intensity_factor > 0.0 && !lamp.pieces.empty())
            in_use.push_back(name_of(i));
    }
    for (auto& [name, kept] : kept_)
        kept.drawn = kept.drawn && std::ranges::find(in_use, name) != in_use.end();
}

MapPlan ProjectedMaps::plain(const LampCasters& lamp) const {
    ShadowWindow window = lamp.window;
    widen(window, kept_tangent(lamp));
    MapPlan plan{lamp.lamp.pose, window_homography(window, settings_.width, settings_.height), 0.0, lamp.pieces, lamp.bodies};
    plan.spread = 1.5 * texel_tangent(window, settings_);
    return plan;
}

std::vector<MapPlan> ProjectedMaps::plan(const Shot& /*shot*/) {
    std::vector<MapPlan> plans;
    for (const LampCasters& lamp : casters_.lamps())
        plans.push_back(plain(lamp));
    return plans;
}

/// Whether the map may be looked up as it was drawn.
bool ProjectedMaps::stands(const Kept& kept, const MapPlan& plan, const LampCasters& lamp) const {
    if (!kept.drawn || kept.plan.pieces != plan.pieces)
        return false;
    const double bound = kept_tangent(lamp);
    const bool same_fit = kept.plan.texture_from_lamp == plan.texture_from_lamp;
    if (kept.plan.from == plan.from && same_fit && kept.scene_placed == scene_.placed() && kept.ego_m == casters_.ego_m())
        return true;
    if (bound == 0.0)
        return false;
    if (plan.to_cover.empty()
            ? !same_fit
            : !covered_by(kept.plan, plan, settings_.width, settings_.height) || kept.plan.max_raise > shadow_kept_slack * plan.max_raise)
        return false;
    double turned = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        turned = std::max(turned, glm::length(kept.plan.from.axes[axis] - plan.from.axes[axis]));
    double moved = 0.0; // casters
    std::size_t body = 0;
    for (std::size_t i = 0; i < plan.pieces.size(); ++i) {
        const Piece& piece = scene_.pieces()[plan.pieces[i]];
        // A turn by a moves a quaternion by 2 sin(a / 4), and a point at r by less than a r.
        const double by =
            glm::length(piece.origin_m - kept.placed[i].first) +
            2.3 * static_cast<double>(glm::length(piece.turn - kept.placed[i].second)) * (glm::length(piece.centre_m) + piece.radius_m);
        for (const std::size_t end = body + piece.bodies_m.size(); body < end; ++body) {
            const Caster& c = plan.bodies[body];
            const double widest = std::max({std::abs(c.left), std::abs(c.right), std::abs(c.bottom), std::abs(c.top)});
            if (by > 0.0)
                moved = std::max(moved, c.nearest_m <= by ? 2.0 * bound + 1.0 : by * (1.0 + widest) / (c.nearest_m - by));
        }
    }
    return turned <= bound && edge_shift(kept.plan, plan) + moved <= bound;
}

void ProjectedMaps::draw_map(const Kept& kept, GLuint texture_drawn, double ground_lowered, const Shot& shot) {
    const glm::dmat4 texture = texture_from_ego(kept.plan, kept.ego_m);
    const glm::dmat4 ego_from_lamp = ego_from_lamp_space(kept.plan.from, kept.ego_m);
    pass_.begin(settings_.width, settings_.height, 0);
    pass_.set_pieces(kept.ego_m, kept.plan.pieces);
    for (std::size_t k = 0; k < places_.size(); ++k) {
        glm::dmat4 from_place = texture; // of a point that lies as much to the other side
        from_place[3] -= texture * (ego_from_lamp[0] * places_[k].x + ego_from_lamp[1] * places_[k].y);
        pass_.draw(texture_drawn, clip_from_shadow_texture(from_place), shot.work, layered() ? static_cast<GLint>(k) : -1, ground_lowered);
    }
    pass_.end("rendering a shadow map");
}

void ProjectedMaps::draw(const Shot& shot) {
    shot.clock.begin("shadow maps");
    const std::vector<MapPlan> plans = plan(shot);
    const glm::dvec3 ego_m = casters_.ego_m();
    textures_from_ego_.clear();
    for (std::size_t i = 0; i < plans.size(); ++i) {
        Kept& kept = kept_[name_of(i)];
        if (kept.texture == 0)
            kept.texture = make_map();
        if (!stands(kept, plans[i], casters_.lamps()[i])) {
            kept.plan = plans[i];
            kept.drawn = true;
            kept.on_cpu_stands = false;
            kept.placed.clear();
            for (const std::uint32_t k : kept.plan.pieces)
                kept.placed.emplace_back(scene_.pieces()[k].origin_m, scene_.pieces()[k].turn);
            kept.scene_placed = scene_.placed();
            kept.ego_m = ego_m;
            draw_map(kept, kept.texture, kept.plan.spread, shot);
            kept.target_drawn = false;
        }
        kept.target_apart = shot.outputs.target && casters_.lamps()[i].ground;
        shot.work.shadow_maps += static_cast<int>((kept.target_apart ? 2 : 1) * places_.size());
        if (kept.target_apart && !kept.target_drawn) {
            if (kept.target_texture == 0)
                kept.target_texture = make_map();
            draw_map(kept, kept.target_texture, 0.0, shot);
            kept.target_drawn = true;
            kept.target_on_cpu_stands = false;
        }
        textures_from_ego_.push_back(texture_from_ego(kept.plan, ego_m));
        context_.gl.BindTextureUnit(shadow_unit(i), kept.texture);
        if (shot.outputs.target)
            context_.gl.BindTextureUnit(target_shadow_unit(i), kept.target_apart ? kept.target_texture : kept.texture);
    }
    from_lamps_.clear();
    for (std::size_t i = 0; i < lamps_.size(); ++i)
        from_lamps_.emplace_back(textures_from_ego_[std::min(i, plans.size() - 1)] * ego_from_lamp_space(lamps_[i].pose, ego_m));
    shot.clock.end();
}

std::span<const ShadowLookUp> ProjectedMaps::look_ups() {
    look_ups_.assign(lamps_.size(), {});
    for (std::size_t i = 0; i < lamps_.size(); ++i) {
        const std::size_t map = std::min(i, textures_from_ego_.size() - 1);
        Kept& kept = kept_[name_of(map)];
        if (!kept.on_cpu_stands)
            kept.on_cpu.read(context_, kept.texture, settings_, static_cast<int>(places_.size()),
                             {0, settings_.width, 0, settings_.height});
        kept.on_cpu_stands = true;
        ShadowLookUp& look_up = look_ups_[i];
        look_up.texture_from_ego = textures_from_ego_[map];
        look_up.near_m = shadow_near_m;
        look_up.tolerance_m = settings_.tolerance_m;
        const glm::dmat4 from_lamp = textures_from_ego_[map] * ego_from_lamp_space(lamps_[i].pose, casters_.ego_m());
        look_up.shifts.clear();
        for (const glm::dvec2& place : places_)
            look_up.shifts.emplace_back(place.x * glm::dvec2(from_lamp[0]) + place.y * glm::dvec2(from_lamp[1]));
        kept.on_cpu.tell(look_up);
        if (kept.target_apart && !kept.target_on_cpu_stands) {
            kept.target_on_cpu.read(context_, kept.target_texture, settings_, static_cast<int>(places_.size()),
                                    {0, settings_.width, 0, settings_.height});
            kept.target_on_cpu_stands = true;
        }
        if (kept.target_apart)
            look_up.target_depth = kept.target_on_cpu.depth();
    }
    return look_ups_;
}

void ProjectedMaps::set_uniforms(const Program& program) const {
    if (!from_lamps_.empty())
        context_.gl.UniformMatrix4fv(program.uniform("shadow_from_lamp"), static_cast<GLsizei>(from_lamps_.size()), GL_FALSE,
                                     &from_lamps_.front()[0][0]);
}

void ProjectedMaps::compile(const Shot& /*shot*/) { pass_.compile(settings_.width, settings_.height); }

std::vector<Program::Define> ProjectedMaps::defines(const std::vector<const Beam*>& /*beams*/) const {
    std::vector<Program::Define> defines{{"PROJECTED_SHADOW_MAPS", "1"},
                                         {"SHADOW_LIFT", "1"},
                                         {"SHADOW_NEAR", literal(shadow_near_m)},
                                         {"SHADOW_TOLERANCE", literal(settings_.tolerance_m)}};
    if (layered()) {
        std::string disc;
        for (const glm::dvec2& place : places_)
            disc += fmt::format("{}vec2({}, {})", disc.empty() ? "" : ", ", literal(place.x), literal(place.y));
        defines.push_back({"SHADOW_LAYERS", std::to_string(places_.size())});
        defines.push_back({"SHADOW_DISC", disc});
    }
    return defines;
}

std::size_t ProjectedMaps::texture_bytes() const {
    const auto apart = std::ranges::count_if(kept_, [](const auto& map) { return map.second.target_texture != 0; });
    return (kept_.size() + static_cast<std::size_t>(apart)) * places_.size() * 4 * static_cast<std::size_t>(settings_.width) *
           static_cast<std::size_t>(settings_.height);
}

LitLamp midway(const std::vector<LitLamp>& lamps) {
    LitLamp between = lamps.front();
    glm::dvec3 place(0.0), forward(0.0), up(0.0);
    double count = 0.0;
    for (const LitLamp& lamp : lamps)
        if (lamp.intensity_factor > 0.0) {
            place += lamp.pose.position_m - lamps.front().pose.position_m;
            forward += lamp.pose.forward();
            up += lamp.pose.up();
            count += 1.0;
        }
    if (count == 0.0)
        return between;
    between.name = "midway";
    between.intensity_factor = 1.0;
    between.pose.position_m += place / count;
    if (glm::length(forward) > 0.1 * count && glm::length(glm::cross(up, forward)) > 0.1 * glm::length(forward)) {
        forward = glm::normalize(forward);
        const glm::dvec3 left = glm::normalize(glm::cross(up, forward));
        between.pose.axes = {forward, left, glm::cross(forward, left)};
    }
    return between;
}

ShadowWindow window_over(const LitLamp& from, const std::vector<LitLamp>& lamps, const std::vector<ShadowWindow>& windows, double from_m) {
    ShadowWindow over{1.0, -1.0, 1.0, -1.0};
    bool first = true;
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        if (lamps[i].intensity_factor <= 0.0)
            continue;
        const Pose& pose = lamps[i].pose;
        for (const double x : {windows[i].left, windows[i].right})
            for (const double y : {windows[i].bottom, windows[i].top})
                for (const double distance : {from_m, shadow_farthest_m}) { // in between the tangents lie in between
                    const glm::dvec3 p =
                        pose.position_m + distance * (pose.forward() - x * pose.left() + y * pose.up()) - from.pose.position_m;
                    const glm::dvec3 q = to_lamp_space(from, p);
                    const auto tangent = [&](double along) {
                        return std::clamp(along / std::max(q.z, 1e-3), -one_map_widest_tangent, one_map_widest_tangent);
                    };
                    const glm::dvec2 t(tangent(q.x), tangent(q.y));
                    over = first ? ShadowWindow{t.x, t.x, t.y, t.y}
                                 : ShadowWindow{std::min(over.left, t.x), std::max(over.right, t.x), std::min(over.bottom, t.y),
                                                std::max(over.top, t.y)};
                    first = false;
                }
    }
    return over;
}

void OneMap::choose_casters(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) {
    ProjectedMaps::choose_casters(lamps, beams, ego_m);
    if (std::ranges::none_of(lamps, [](const LitLamp& lamp) { return lamp.intensity_factor > 0.0; }))
        return;
    std::vector<ShadowWindow> windows;
    for (const Beam* const beam : beams)
        windows.push_back(beam->window);
    const LitLamp from = midway(lamps);
    casters_.merge(from, window_over(from, lamps, windows, one_map_from_m));
}

std::vector<Program::Define> OneMap::defines(const std::vector<const Beam*>& beams) const {
    std::vector<Program::Define> defines = ProjectedMaps::defines(beams);
    defines.push_back({"SHADOW_ONE_MAP", "1"});
    return defines;
}

std::vector<glm::dvec2> places_on_disc(double radius_m, int count) {
    if (count == 1)
        return {{0.0, 0.0}}; // a point, looked up as a single map is
    const double golden_angle = pi * (3.0 - std::sqrt(5.0));
    std::vector<glm::dvec2> places;
    for (int k = 0; k < count; ++k) {
        const double r = radius_m * std::sqrt((k + 0.5) / count), angle = k * golden_angle;
        places.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    return places;
}

void SoftMaps::choose_casters(const std::vector<LitLamp>& lamps, const std::vector<const Beam*>& beams, const glm::dvec3& ego_m) {
    ProjectedMaps::choose_casters(lamps, beams, ego_m);
    casters_.soften(settings_.lamp_radius_m);
}

} // namespace fernlicht::gl
