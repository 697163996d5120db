#include "renderer/gl/traffic_lights.h"

#include "renderer/gl/device/program.h"
#include "scenarios/light/light.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <limits>

namespace fernlicht::gl {
namespace {

constexpr double nearest_m = 0.05;    // from a lamp, as far as bounds go
constexpr double same_normal = 5e-4;  // two of the ground, in length of their difference
constexpr double min_height_m = 1e-3; // what floats may be off in a place on the ground
constexpr double same_axis = 1.0 - 1e-9;
constexpr std::uint32_t is_ground_bit = 0x80000000U;

bool is_pair(const LitLamp& a, const LitLamp& b) {
    return a.body >= 0 && a.body == b.body && a.file == b.file && a.intensity_factor == b.intensity_factor &&
           a.colour.linear_srgb == b.colour.linear_srgb && glm::dot(a.pose.forward(), b.pose.forward()) > same_axis &&
           glm::dot(a.pose.up(), b.pose.up()) > same_axis;
}

std::size_t texel_bytes(GLenum format) { return format == GL_RGBA32F ? 16 : format == GL_RG32F ? 8 : 4; }

/// As a solid angle, up to a factor.
double size_from_car(const glm::dvec3& centre_m, double radius_m) {
    return radius_m * radius_m / std::max(glm::dot(centre_m, centre_m), radius_m * radius_m);
}

/// Sine of the steepest normal's angle from the vertical.
double lean_of(const Piece& piece) {
    const double up = std::clamp(piece.min_up, 0.0, 1.0);
    return std::sqrt(1.0 - up * up);
}

} // namespace

template <class T> void TrafficLights::fill(Texels& texels, GLenum format, const std::vector<T>& values) {
    const GladGLContext& gl = context_.gl;
    if (texels.room < values.size() || texels.texture == 0) {
        GLint limit = 0;
        gl.GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
        const std::size_t room = std::max<std::size_t>(2 * values.size(), 64), most = static_cast<std::size_t>(limit) * texel_bytes(format);
        if (values.size() * sizeof(T) > most)
            throw DeviceError(fmt::format("{} fetches at most {} texels, other lamps take {}", context_.info.gl_renderer, limit,
                                          values.size() * sizeof(T) / texel_bytes(format)));
        texels.room = std::min(room, most / sizeof(T));
        texels.buffer = make_buffer(context_, std::vector<T>(texels.room), GL_DYNAMIC_STORAGE_BIT);
        texels.texture = new_texture(context_, GL_TEXTURE_BUFFER);
        gl.TextureBuffer(texels.texture, format, texels.buffer);
        context_.check("making texels of lamps");
    }
    update_buffer(context_, texels.buffer, values);
}

int TrafficLights::beam_offset(const Beam& beam) {
    const auto [known, fresh] = offsets_.try_emplace(beam.id, static_cast<int>(cd_.size()));
    if (fresh) {
        const BeamTexture grid = beams_.grid_of(beam);
        cd_.insert(cd_.end(), grid.cd.begin(), grid.cd.end());
        bounds_.emplace(beam.id, TrafficBeam(grid));
        cd_texels_.room = 0;
    }
    return known->second;
}

void TrafficLights::pack(const Unit& unit, int first, double min_lx) {
    const BeamTexture& g = unit.beam->grid;
    packed_.push_back({four(unit.at_m, min_lx), four(unit.middle.pose.forward(), unit.factor), four(unit.middle.pose.up(), first),
                       four(unit.apart_m, g.width), four(unit.middle.colour.linear_srgb, g.height),
                       glm::vec4(g.h_first_rad, g.v_first_rad, 1.0 / g.h_step_rad, 1.0 / g.v_step_rad)});
}

void TrafficLights::add_units(const Moment& moment) {
    units_.clear();
    packed_.clear();
    const std::vector<LitLamp>& lamps = moment.other_lamps;
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        if (!(lamps[i].intensity_factor > 0.0))
            continue;
        Unit unit;
        unit.beam = &beams_.of(lamps[i].file);
        unit.lamps = i + 1 < lamps.size() && is_pair(lamps[i], lamps[i + 1]) ? 2 : 1;
        unit.middle = lamps[i];
        unit.factor = unit.lamps * lamps[i].intensity_factor;
        unit.middle.intensity_factor = unit.factor;
        if (unit.lamps == 2) {
            const glm::dvec3 other = lamps[i + 1].pose.position_m;
            unit.apart_m = 0.5 * (other - lamps[i].pose.position_m);
            unit.middle.pose.position_m = 0.5 * (other + lamps[i].pose.position_m);
            unit.half_m = glm::length(unit.apart_m);
            unit.half_up_m = std::abs(glm::dot(unit.apart_m, unit.middle.pose.up()));
            ++i;
        }
        unit.at_m = unit.middle.pose.position_m - moment.ego.position_m;
        const int first = beam_offset(*unit.beam);
        unit.bounds = &bounds_.at(unit.beam->id);
        unit.reaches_m = std::sqrt(rounding * unit.factor * unit.bounds->max_cd() / moment.min_traffic_lx);
        pack(unit, first, moment.min_traffic_lx);
        units_.push_back(std::move(unit));
    }
}

/// Where the place is seen from midway between the lamps, with the lamps' own distance as a margin.
BeamWindow TrafficLights::window(const Unit& unit, const Place& place, const glm::dvec3& from) {
    const glm::dvec3 w = to_lamp_space(unit.middle, from);
    const double across = std::hypot(w.x, w.z), radius = place.radius_m + unit.half_m;
    if (across <= 1.001 * radius)
        return {-pi, pi, -0.5 * pi, 0.5 * pi};
    double low = w.y - radius, high = w.y + radius;
    if (place.ground) { // a flat box rather than a sphere
        const glm::dvec3 up = unit.middle.pose.up();
        const double height = 0.5 * (place.highest_m - place.lowest_m) * std::abs(up.z),
                     middle = w.y + (0.5 * (place.lowest_m + place.highest_m) - place.centre_m.z) * up.z,
                     more = height + place.radius_m * std::hypot(up.x, up.y) + unit.half_up_m;
        low = std::max(low, middle - more);
        high = std::min(high, middle + more);
    }
    const double h = std::atan2(w.x, w.z), spread = std::asin(radius / across);
    return {h - spread, h + spread, std::atan2(low, low < 0.0 ? across - radius : across + radius),
            std::atan2(high, high > 0.0 ? across - radius : across + radius)};
}

TrafficLights::Bound TrafficLights::bound(const Unit& unit, const Place& place, double min_lx) {
    const glm::dvec3 from = place.centre_m - unit.at_m;
    const double radius = place.radius_m + unit.half_m, d = glm::length(from);
    Bound bound;
    bound.near_m = std::max(d - radius, nearest_m);
    if (glm::dot(unit.middle.pose.forward(), from) < -radius)
        return bound; // behind
    double cosine = 1.0;
    if (place.ground) { // the lamp's height over its distance, and what the ground leans: sin(a + b) <= sin a + sin b
        const double height = std::max(unit.at_m.z - place.lowest_m, 0.0), beside = std::max(std::hypot(from.x, from.y) - radius, 0.0);
        cosine = place.normals != nullptr ? 0.0
                 : height > 0.0           ? std::min(1.0, height / std::hypot(height, beside) + place.lean)
                                          : std::min(1.0, place.lean);
    }
    if (place.normals != nullptr)
        for (const glm::dvec4& n : *place.normals) // the lamps' height over the ground's planes, over the distance
            cosine = std::max(cosine, std::min(1.0, (glm::dot(glm::dvec3(n), unit.at_m) + std::abs(glm::dot(glm::dvec3(n), unit.apart_m)) -
                                                     n.w + min_height_m) /
                                                            bound.near_m +
                                                        same_normal));
    bound.lx_a_cd = rounding * cosine * unit.factor / (bound.near_m * bound.near_m);
    bound.max_lx = unit.bounds->max_cd() * bound.lx_a_cd;
    if (bound.max_lx > min_lx) {
        bound.window = window(unit, place, from);
        bound.max_lx = unit.bounds->max_cd(bound.window) * bound.lx_a_cd;
    }
    return bound;
}

void TrafficLights::list(std::size_t number, const Place& place, double least, Lists& lists, Work* work) {
    Unit& unit = units_[number];
    const Bound bounds = bound(unit, place, least);
    const double most = bounds.max_lx;
    if (most <= least) {
        lists.left_out_lx += most;
        report_.left_out += most > 0.0 && work != nullptr ? 1 : 0;
        if (pruned_)
            return;
    }
    const bool coarse = levels_ && most > least;
    const double merging = !coarse || unit.lamps == 1 ? 0.0
                                                      : unit.bounds->merging_lx(unit.half_m / bounds.near_m, unit.half_up_m / bounds.near_m,
                                                                                bounds.window, bounds.lx_a_cd, most);
    TrafficShare share{0.0, 1.0, 0.0, 0.0};
    if (coarse)
        share = traffic_share(most, merging, least, unit.lamps == 2, !place.ground && !place.retro);
    else if (unit.lamps == 2)
        share = {};
    const auto add = [&](std::vector<glm::vec4>& entries, double each, double one, double cd) {
        if (each > 0.0 || one > 0.0)
            entries.emplace_back(static_cast<float>(number), static_cast<float>(each), static_cast<float>(one), static_cast<float>(cd));
    };
    const std::size_t before = lists.fragment.size();
    add(lists.fragment, share.each, share.merged, -1.0);
    if (lists.fragment.size() > before)
        lists.receivers.push_back({static_cast<std::uint32_t>(number), 0, static_cast<std::uint32_t>(before), most});
    add(lists.vertex, 0.0, share.by_vertex, -1.0);
    if (share.point > 0.0)
        add(lists.vertex, 0.0, share.point, intensity_towards_cd(unit.middle, unit.middle.pose.position_m + place.centre_m - unit.at_m));
    if (most <= least)
        return;
    unit.used = true;
    lists.drawn_lx += traffic_error_lx(share, most, merging, least);
    if (work == nullptr)
        return;
    const bool one_lamp = unit.lamps == 1 && share.merged > 0.0;
    work->traffic_full += share.each > 0.0 ? 2 : one_lamp ? 1 : 0;
    work->traffic_merged += unit.lamps == 2 && share.merged > 0.0 ? 1 : 0;
    work->traffic_by_vertex += share.by_vertex > 0.0 ? 1 : 0;
    work->traffic_point += share.point > 0.0 ? 1 : 0;
    report_.each += share.each > 0.0 || one_lamp ? 1 : 0;
    report_.merged += unit.lamps == 2 && share.merged > 0.0 ? 1 : 0;
    report_.by_vertex += share.by_vertex > 0.0 ? 1 : 0;
    report_.point += share.point > 0.0 ? 1 : 0;
}

/// `work`: null where the place is counted elsewhere.
TrafficLights::Lists TrafficLights::lists_of(const Place& place, std::span<const std::size_t> units, double least, Work* work) {
    Lists lists;
    for (const std::size_t number : units) {
        const Unit& unit = units_[number];
        const glm::dvec3 from = place.centre_m - unit.at_m;
        const double radius = place.radius_m + unit.half_m, d2 = glm::dot(from, from), reach = unit.reaches_m + radius;
        if (pruned_ && d2 > reach * reach) { // too far, wherever it aims: at least d reaches / reach away
            if (glm::dot(unit.middle.pose.forward(), from) > -radius)
                lists.left_out_lx += least * reach * reach / d2;
            continue;
        }
        list(number, place, least, lists, work);
    }
    if (work != nullptr) {
        report_.worst_drawn_lx = std::max(report_.worst_drawn_lx, lists.drawn_lx);
        report_.worst_left_out_lx = std::max(report_.worst_left_out_lx, lists.left_out_lx);
    }
    return lists;
}

std::vector<std::size_t> TrafficLights::reaching(const glm::dvec3& centre_m, double radius_m) const {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < units_.size(); ++i)
        if (!pruned_ || glm::length(centre_m - units_[i].at_m) < radius_m + units_[i].half_m + units_[i].reaches_m)
            numbers.push_back(i);
    return numbers;
}

std::pair<std::uint32_t, std::uint32_t> TrafficLights::keep(const std::vector<glm::vec4>& entries) {
    const auto first = static_cast<std::uint32_t>(entries_.size());
    entries_.insert(entries_.end(), entries.begin(), entries.end());
    return {first, static_cast<std::uint32_t>(entries.size())};
}

std::pair<std::uint32_t, std::uint32_t> TrafficLights::keep(Lists& lists, const TrafficPlace& place) {
    const auto [first, count] = keep(lists.fragment);
    for (TrafficReceiver receiver : lists.receivers) {
        receiver.entry += first;
        receiver.place = static_cast<std::uint32_t>(places_.size());
        receivers_.push_back(receiver);
    }
    places_.push_back(place);
    return {first, count};
}

void TrafficLights::Cell::add(const glm::dvec4& normal) {
    for (glm::dvec4& known : normals)
        if (glm::length(glm::dvec3(known - normal)) <= same_normal) {
            known.w = std::min(known.w, normal.w);
            return;
        }
    normals.push_back(normal);
}

std::vector<TrafficLights::Cell> TrafficLights::cells_of(const Moment& moment, const std::vector<std::uint32_t>& drawn) const {
    std::vector<Cell> cells(static_cast<std::size_t>(traffic_cells_ahead) * static_cast<std::size_t>(traffic_cells_across));
    const glm::dvec2 left(-ahead_.y, ahead_.x);
    const auto column = [](double m) { return static_cast<int>(std::floor((m + traffic_behind_m) / traffic_cell_m)); };
    const auto row = [](double m) { return static_cast<int>(std::floor((m + traffic_beside_m) / traffic_cell_m)); };
    const double farthest_m = std::hypot(traffic_cells_ahead * traffic_cell_m, traffic_cells_across * traffic_cell_m);
    for (const std::uint32_t i : drawn) {
        const Piece& piece = scene_.pieces()[i];
        if (!piece.ground || glm::length(centre_of(piece, moment.ego.position_m)) > farthest_m + piece.radius_m)
            continue;
        const glm::dvec3 origin = piece.origin_m - moment.ego.position_m;
        for (std::size_t t = piece.first_plane; t < piece.first_plane + piece.planes; ++t) {
            const GroundTriangle& triangle = scene_.ground()[t];
            glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
            double lowest = low.x, highest = high.x;
            for (const glm::vec3& corner : triangle.corners_m) {
                const glm::dvec3 p = origin + glm::dvec3(corner);
                const glm::dvec2 at(glm::dot(glm::dvec2(p), ahead_), glm::dot(glm::dvec2(p), left));
                low = glm::min(low, at - 0.1);
                high = glm::max(high, at + 0.1);
                lowest = std::min(lowest, p.z);
                highest = std::max(highest, p.z);
            }
            for (int y = std::max(0, row(low.y)); y <= std::min(traffic_cells_across - 1, row(high.y)); ++y)
                for (int x = std::max(0, column(low.x)); x <= std::min(traffic_cells_ahead - 1, column(high.x)); ++x) {
                    Cell& cell = cells[static_cast<std::size_t>(y * traffic_cells_ahead + x)];
                    cell.low = std::min(cell.low, lowest);
                    cell.high = std::max(cell.high, highest);
                    for (const glm::vec4& n : triangle.normals) {
                        const glm::dvec3 normal(n);
                        cell.add({normal, static_cast<double>(n.w) + glm::dot(normal, origin)});
                    }
                }
        }
    }
    return cells;
}

/// A cell is bounded by a sphere round what ground stands in it.
void TrafficLights::list_cells(const Moment& moment, const std::vector<std::uint32_t>& drawn, Work& work) {
    const std::vector<Cell> ground = cells_of(moment, drawn);
    const glm::dvec2 left(-ahead_.y, ahead_.x);
    cells_.assign(ground.size(), glm::vec2(0.0F));
    double low = 0.0, high = 0.0;
    for (const Cell& cell : ground)
        if (cell.high >= cell.low) {
            low = std::min(low, cell.low);
            high = std::max(high, cell.high);
        }
    const double length = traffic_cells_ahead * traffic_cell_m, width = traffic_cells_across * traffic_cell_m;
    const glm::dvec2 middle = ahead_ * (0.5 * length - traffic_behind_m) + left * (0.5 * width - traffic_beside_m);
    const std::vector<std::size_t> units =
        reaching({middle.x, middle.y, 0.5 * (low + high)}, 0.5 * std::hypot(length, width, high - low) + 1.0);
    for (std::size_t i = 0; i < ground.size(); ++i) {
        const Cell& cell = ground[i];
        if (cell.high < cell.low)
            continue;
        const std::size_t column = i % traffic_cells_ahead, row = i / traffic_cells_ahead;
        const double a = (static_cast<double>(column) + 0.5) * traffic_cell_m - traffic_behind_m,
                     b = (static_cast<double>(row) + 0.5) * traffic_cell_m - traffic_beside_m;
        const glm::dvec2 at = ahead_ * a + left * b;
        const double half = 0.5 * traffic_cell_m + 0.01, up = 0.5 * (cell.high - cell.low);
        const glm::dvec3 centre(at, 0.5 * (cell.low + cell.high));
        const Place place{centre, std::sqrt(2.0 * half * half + up * up), cell.low, cell.high, 0.0, true, false, &cell.normals};
        Lists lists = lists_of(place, units, moment.min_traffic_lx, &work);
        TrafficPlace stands{{}, size_from_car(place.centre_m, place.radius_m)};
        for (std::size_t k = 0; k < stands.box_m.size(); ++k)
            stands.box_m[k] = glm::dvec3(at + ahead_ * ((k & 1) != 0 ? half : -half) + left * ((k & 2) != 0 ? half : -half),
                                         (k & 4) != 0 ? cell.high : cell.low);
        const auto [first, count] = keep(lists, stands);
        cells_[i] = {first, count};
    }
}

void TrafficLights::set(const Moment& moment, const std::vector<std::uint32_t>& drawn, Work& work, TrafficShadows* shadows) {
    add_units(moment);
    entries_.clear();
    receivers_.clear();
    places_.clear();
    lists_.assign(scene_.pieces().size(), {});
    left_out_ = 0;
    if (units_.empty()) {
        if (shadows != nullptr)
            shadows->choose(moment, {}, {}, {}, entries_);
        return;
    }
    const glm::dvec2 forward(moment.ego.forward());
    ahead_ = glm::length(forward) > 1e-6 ? glm::normalize(forward) : glm::dvec2(1.0, 0.0);
    bool on_ground = false;
    const std::vector<std::size_t> all = reaching({}, farthest_drawn_m);
    for (const std::uint32_t i : drawn) {
        const Piece& piece = scene_.pieces()[i];
        const double car_z = moment.ego.position_m.z;
        const glm::dvec3 centre = centre_of(piece, moment.ego.position_m);
        const Place place{centre,         piece.radius_m, piece.lowest_m - car_z,       piece.highest_m - car_z,
                          lean_of(piece), piece.ground,   piece.surface.retroreflecting};
        Lists lists = lists_of(place, all, moment.min_traffic_lx, piece.ground ? nullptr : &work); // ground is counted by its cells
        TrafficPlace stands{piece.corners_m, piece.ground ? 0.0 : size_from_car(place.centre_m, place.radius_m), i};
        for (glm::dvec3& corner : stands.box_m)
            corner += piece.origin_m - moment.ego.position_m;
        std::uint32_t* const traffic = lists_[i].traffic;
        std::tie(traffic[0], traffic[1]) = keep(lists, stands);
        std::tie(traffic[2], traffic[3]) = keep(lists.vertex);
        if (piece.ground && traffic[1] != 0) {
            traffic[1] |= is_ground_bit;
            on_ground = true;
        }
    }
    cells_.assign(static_cast<std::size_t>(traffic_cells_ahead) * static_cast<std::size_t>(traffic_cells_across), glm::vec2(0.0F));
    if (on_ground)
        list_cells(moment, drawn, work);
    left_out_ = static_cast<int>(std::ranges::count(units_, false, &Unit::used));
    if (shadows != nullptr)
        shadows->choose(moment, std::vector<TrafficSource>(units_.begin(), units_.end()), receivers_, places_, entries_);
    fill(unit_texels_, GL_RGBA32F, packed_);
    fill(entry_texels_, GL_RGBA32F, entries_);
    if (cd_texels_.room == 0)
        fill(cd_texels_, GL_R32F, cd_);
    fill(cell_texels_, GL_RG32F, cells_);
}

glm::vec4 TrafficLights::grid() const { return {ahead_.x, ahead_.y, -traffic_behind_m, -traffic_beside_m}; }

void TrafficLights::bind() const {
    const GladGLContext& gl = context_.gl;
    gl.BindTextureUnit(18, unit_texels_.texture);
    gl.BindTextureUnit(19, entry_texels_.texture);
    gl.BindTextureUnit(20, cd_texels_.texture);
    gl.BindTextureUnit(21, cell_texels_.texture);
}

} // namespace fernlicht::gl
