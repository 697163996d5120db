#include "renderer/gl/traffic_shadows.h"

#include "renderer/gl/shadows/shadow_maps.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace fernlicht::gl {
namespace {

constexpr GLuint map_unit = 22, map_texel_unit = 23;
constexpr double spread_texels = 1.5;   // what look-ups are raised by, see docs/decisions/0005
constexpr double narrowest = 0.02;      // window, as a tangent
constexpr double beyond_casters = 1e-3; // of a window
/// What a lamp that is fixed in the world and hangs with its axis down (x along the road) lights: 24 m to both sides from a height of 6 m.
constexpr ShadowWindow hanging{-4.0, 4.0, -2.0, 2.0};

ShadowWindow widest_window(const TrafficSource& unit) {
    return unit.middle.body == -2 && unit.middle.pose.forward().z < -0.7 ? hanging : unit.beam->window;
}

/// Texels of one map: half of those of an own lamp's across and up.
ShadowSettings traffic_map_settings(ShadowSettings settings) {
    settings.width = std::max(16, settings.width / 2);
    settings.height = std::max(16, settings.height / 2);
    return settings;
}

/// All of it lies beside or behind the lamp, where no map begins: the own body.
bool behind_lamp(const Corners& box) {
    return std::ranges::all_of(box, [](const glm::dvec3& corner) { return corner.z < shadow_near_m; });
}

} // namespace

TrafficShadows::TrafficShadows(Context& context, const SceneBuffers& scene, const ShadowSettings& settings, bool pruned)
    : context_(context), scene_(scene), settings_(traffic_map_settings(settings)), pruned_(pruned), pass_(context, scene, scene.moves()),
      map_buffer_(make_buffer(context, std::vector<glm::vec4>(4 * max_traffic_maps), GL_DYNAMIC_STORAGE_BIT)), layers_(max_traffic_maps) {
    map_texels_ = new_texture(context_, GL_TEXTURE_BUFFER);
    context_.gl.TextureBuffer(map_texels_, GL_RGBA32F, map_buffer_);
    maps_ = make_shadow_texture(context_, {settings_.width, settings_.height, static_cast<int>(max_traffic_maps), "other lamps",
                                           "a smaller map_texels, or shadows: none"});
}

/// What stands where the unit brings more than `min_lx` to a surface facing it: nothing in the shadow of all else gets more than that.
std::vector<std::uint32_t> TrafficShadows::pieces_near(const TrafficSource& unit, double min_lx) const {
    std::vector<std::uint32_t> pieces;
    const glm::dvec3 at_m = unit.middle.pose.position_m - ego_m_;
    const double half_m = glm::length(unit.apart_m);
    for (const std::uint32_t k : casters_) {
        const Piece& piece = scene_.pieces()[k];
        const glm::dvec3 from = centre_of(piece, ego_m_) - at_m;
        const double radius = piece.radius_m + half_m, nearest = glm::length(from) - radius;
        if (glm::dot(unit.middle.pose.forward(), from) < -radius)
            continue;
        const double brightest = rounding * unit.middle.intensity_factor;
        if (nearest > 0.0 && brightest * unit.beam->bounds.most() <= min_lx * nearest * nearest)
            continue;
        const double max_cd = brightest * unit.beam->bounds.max_towards(to_lamp_space(unit.middle, from), radius);
        if (max_cd == 0.0 || (nearest > 0.0 && max_cd <= min_lx * nearest * nearest))
            continue;
        if (piece.ground && !piece.above_ground && faces_lamp(scene_, piece, at_m + unit.apart_m, ego_m_) &&
            faces_lamp(scene_, piece, at_m - unit.apart_m, ego_m_))
            continue;
        pieces.push_back(k);
    }
    return pieces;
}

/// A map as wide as what casts in it. `lamp`: 0 or 1.
TrafficShadows::Map TrafficShadows::map_of(const TrafficSource& unit, int lamp, const std::vector<std::uint32_t>& pieces) const {
    Map map;
    map.lamp = unit.middle;
    map.lamp.pose.position_m += (unit.lamps == 2 ? 2.0 * lamp - 1.0 : 0.0) * unit.apart_m;
    map.lamp_m = map.lamp.pose.position_m - ego_m_;
    const ShadowWindow widest = widest_window(unit);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    ShadowWindow w{infinity, -infinity, infinity, -infinity};
    for (const std::uint32_t k : pieces) {
        const Piece& piece = scene_.pieces()[k];
        bool inside = false;
        for (const Corners& body : piece.bodies_m) {
            const Corners box = in_lamp_space(map.lamp, piece.origin_m - ego_m_ - map.lamp_m, body);
            Caster caster = caster_of(box, 0.0);
            if (behind_lamp(box))
                continue;
            if (caster.around) {
                w = widest;
            } else {
                if (caster.left >= widest.right || caster.right <= widest.left || caster.bottom >= widest.top ||
                    caster.top <= widest.bottom)
                    continue;
                w = {std::min(w.left, std::max(caster.left, widest.left)), std::max(w.right, std::min(caster.right, widest.right)),
                     std::min(w.bottom, std::max(caster.bottom, widest.bottom)), std::max(w.top, std::min(caster.top, widest.top))};
            }
            map.bodies.push_back(caster);
            inside = true;
        }
        if (inside)
            map.pieces.push_back(k);
    }
    if (map.bodies.empty()) {
        map.window = widest;
        return map;
    }
    const double across = std::max(narrowest, beyond_casters * (w.right - w.left)),
                 up = std::max(narrowest, beyond_casters * (w.top - w.bottom));
    map.window = {w.left - 0.5 * across, w.right + 0.5 * across, w.bottom - 0.5 * up, w.top + 0.5 * up};
    const double margin = caster_margin_texels * texel_tangent(map.window, settings_);
    for (Caster& caster : map.bodies)
        widen(caster, margin);
    return map;
}

TrafficShadows::Candidate TrafficShadows::candidate(std::uint32_t number, const TrafficSource& unit, double min_lx) const {
    Candidate found;
    found.unit = number;
    const std::vector<std::uint32_t> pieces = pieces_near(unit, min_lx);
    for (int lamp = 0; lamp < unit.lamps; ++lamp)
        found.maps.push_back(map_of(unit, lamp, pieces));
    return found;
}

bool TrafficShadows::shaded(const Candidate& candidate, const Corners& box_m) {
    return std::ranges::any_of(candidate.maps, [&](const Map& map) {
        if (map.bodies.empty())
            return false;
        const Corners box = in_lamp_space(map.lamp, -map.lamp_m, box_m);
        return std::ranges::any_of(map.bodies, [&](const Caster& caster) { return shades(caster, box); });
    });
}

void TrafficShadows::choose(const Moment& moment, std::span<const TrafficSource> units, std::span<const TrafficReceiver> receivers,
                            std::span<const TrafficPlace> places, std::vector<glm::vec4>& entries) {
    ego_m_ = moment.ego.position_m;
    chosen_.clear();
    reached_.assign(scene_.pieces().size(), false);
    casters_.clear();
    const double min_lx = min_traffic_shadow * moment.min_traffic_lx;
    const auto counts = [&](const TrafficReceiver& r) { return r.max_lx > min_lx; };
    std::vector<std::vector<std::uint32_t>> by_unit(units.size());
    std::vector<double> at_most(units.size(), 0.0); // score, were everything in shadow
    for (std::uint32_t r = 0; r < receivers.size(); ++r)
        if (counts(receivers[r])) {
            by_unit[receivers[r].unit].push_back(r);
            at_most[receivers[r].unit] += receivers[r].max_lx * places[receivers[r].place].weight;
        }
    std::vector<std::uint32_t> order;
    for (std::uint32_t u = 0; u < units.size(); ++u)
        if (!by_unit[u].empty())
            order.push_back(u);
    if (order.empty())
        return;
    std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) { return at_most[a] > at_most[b]; });
    for (const std::uint32_t k : scene_.near(ego_m_))
        if (scene_.pieces()[k].casts)
            casters_.push_back(k);

    // Units by what may be in shadow, looked at only as long as one to come could be among the strongest, or be the strongest left out.
    std::vector<Candidate> candidates;
    std::vector<bool> shadowed(receivers.size(), false);
    std::size_t looked_at = 0;
    const auto stronger = [](const Candidate& a, const Candidate& b) {
        return a.score > b.score || (a.score == b.score && a.unit < b.unit);
    };
    for (; looked_at < order.size(); ++looked_at) {
        const std::uint32_t u = order[looked_at];
        std::size_t maps = 0;
        for (const Candidate& known : candidates)
            maps += known.score >= at_most[u] ? known.maps.size() : 0;
        if (maps > max_traffic_maps)
            break;
        Candidate found = candidate(u, units[u], min_lx);
        bool any = false;
        for (const std::uint32_t r : by_unit[u])
            if (shaded(found, places[receivers[r].place].box_m)) {
                shadowed[r] = any = true;
                found.score += receivers[r].max_lx * places[receivers[r].place].weight;
            }
        if (any)
            candidates.push_back(std::move(found));
    }
    std::ranges::sort(candidates, stronger);
    double strongest_left_out = 0.0;
    std::vector<int> first_map(units.size(), -1);
    std::vector<bool> left_out(units.size(), false);
    std::size_t without = 0;
    for (std::size_t i = looked_at; i < order.size(); ++i) {
        left_out[order[i]] = true;
        for (const std::uint32_t r : by_unit[order[i]])
            shadowed[r] = true; // as far as is known
    }
    for (Candidate& one : candidates) {
        if (without > 0 || chosen_.size() + one.maps.size() > max_traffic_maps) {
            strongest_left_out = without > 0 ? strongest_left_out : one.score;
            left_out[one.unit] = true;
            ++without;
            continue;
        }
        first_map[one.unit] = static_cast<int>(chosen_.size());
        for (Map& map : one.maps) {
            map.weight = one.score; // by what is left out, below
            chosen_.push_back(std::move(map));
        }
    }
    max_units_left_out_ = std::max(max_units_left_out_, without + order.size() - looked_at);
    for (Map& map : chosen_)
        map.weight = strongest_left_out > 0.0
                         ? std::clamp((map.weight - strongest_left_out) / (traffic_map_handover * strongest_left_out), 0.0, 1.0)
                         : 1.0;

    std::vector<double> missing_lx(places.size(), 0.0);
    for (std::size_t r = 0; r < receivers.size(); ++r) {
        const TrafficReceiver& one = receivers[r];
        const int first = first_map[one.unit];
        if (first >= 0 && (shadowed[r] || !pruned_)) {
            entries[one.entry].w = static_cast<float>(-2 - 2 * first - (units[one.unit].lamps == 2 ? 1 : 0));
            if (const std::uint32_t piece = places[one.place].piece; piece != TrafficPlace::no_piece)
                reached_[piece] = true;
        }
        if (left_out[one.unit] && shadowed[r])
            missing_lx[one.place] += one.max_lx;
    }
    worst_left_out_lx_ = std::max(worst_left_out_lx_, *std::ranges::max_element(missing_lx));
}

/// A layer that holds already what a map would show keeps it.
void TrafficShadows::place_in_layers(std::vector<char>& to_draw) {
    if (drawn_ego_m_ != ego_m_ || drawn_placed_ != scene_.placed())
        layers_.assign(max_traffic_maps, {});
    drawn_ego_m_ = ego_m_;
    drawn_placed_ = scene_.placed();
    std::vector<bool> taken(layers_.size(), false);
    to_draw.assign(chosen_.size(), 1);
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
        const glm::dmat4 clip = lamp_clip(chosen_[i].lamp, chosen_[i].window, ego_m_);
        for (std::size_t k = 0; k < layers_.size() && to_draw[i] != 0; ++k)
            if (!taken[k] && layers_[k].clip == clip && layers_[k].pieces == chosen_[i].pieces) {
                taken[k] = true;
                chosen_[i].layer = k;
                to_draw[i] = 0;
            }
    }
    for (std::size_t i = 0, free = 0; i < chosen_.size(); ++i)
        if (to_draw[i] != 0) {
            while (taken[free])
                ++free;
            taken[free] = true;
            chosen_[i].layer = free;
            layers_[free] = {lamp_clip(chosen_[i].lamp, chosen_[i].window, ego_m_), chosen_[i].pieces};
        }
}

void TrafficShadows::draw(const Shot& shot) {
    shot.work.shadow_maps += static_cast<int>(chosen_.size());
    std::vector<char> to_draw;
    place_in_layers(to_draw);
    if (std::ranges::count(to_draw, 1) > 0) {
        pass_.begin(settings_.width, settings_.height);
        for (std::size_t i = 0; i < chosen_.size(); ++i)
            if (to_draw[i] != 0) {
                pass_.set_pieces(ego_m_, chosen_[i].pieces);
                pass_.draw(maps_, layers_[chosen_[i].layer].clip, shot.work, static_cast<GLint>(chosen_[i].layer),
                           spread_texels * texel_tangent(chosen_[i].window, settings_));
            }
        pass_.end("rendering shadow maps of other lamps");
    }
    std::vector<glm::vec4> texels; // as in traffic_shadows.glsl
    for (const Map& map : chosen_) {
        const ShadowWindow& w = map.window;
        const double across = (settings_.width - 2.0) / settings_.width / (w.right - w.left),
                     up = (settings_.height - 2.0) / settings_.height / (w.top - w.bottom);
        const glm::dvec3 forward = map.lamp.pose.forward(),
                         x = -across * map.lamp.pose.left() + (1.0 / settings_.width - w.left * across) * forward,
                         y = up * map.lamp.pose.up() + (1.0 / settings_.height - w.bottom * up) * forward;
        texels.push_back(four(x, -glm::dot(x, map.lamp_m)));
        texels.push_back(four(y, -glm::dot(y, map.lamp_m)));
        texels.push_back(four(forward, -glm::dot(forward, map.lamp_m)));
        texels.emplace_back(static_cast<float>(spread_texels * texel_tangent(w, settings_)), static_cast<float>(map.layer),
                            static_cast<float>(map.weight), 0.0F);
    }
    update_buffer(context_, map_buffer_, texels);
}

void TrafficShadows::compile() {
    pass_.compile(settings_.width, settings_.height);
    layers_.assign(max_traffic_maps, {});
}

void TrafficShadows::bind() const {
    context_.gl.BindTextureUnit(map_unit, maps_);
    context_.gl.BindTextureUnit(map_texel_unit, map_texels_);
}

std::vector<Program::Define> TrafficShadows::defines() const {
    return {{"SHADOW_LIFT", "1"},
            {"TRAFFIC_SHADOW_NEAR", literal(shadow_near_m)},
            {"TRAFFIC_SHADOW_TOLERANCE", literal(settings_.tolerance_m)},
            {"TRAFFIC_SHADOW_LEAST", literal(min_traffic_shadow)}};
}

std::size_t TrafficShadows::texture_bytes() const {
    return 4 * max_traffic_maps * static_cast<std::size_t>(settings_.width) * static_cast<std::size_t>(settings_.height);
}

} // namespace fernlicht::gl
