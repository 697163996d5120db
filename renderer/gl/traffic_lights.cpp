#include "renderer/gl/traffic_lights.h"

#include "scenarios/light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace fernlicht::gl {
namespace {

constexpr double rounding = 1.001; // what floats on the GPU may be above the bound in double
constexpr double nearest_m = 0.05; // from a lamp, as far as bounds go
constexpr double same_axis = 1.0 - 1e-9;
constexpr std::uint32_t is_ground_bit = 0x80000000U;

glm::vec4 four(const glm::dvec3& v, double w = 0.0) { return {glm::vec3(v), static_cast<float>(w)}; }

bool is_pair(const LitLamp& a, const LitLamp& b) {
    return a.body >= 0 && a.body == b.body && a.file == b.file && a.intensity_factor == b.intensity_factor &&
           a.colour.linear_srgb == b.colour.linear_srgb && glm::dot(a.pose.forward(), b.pose.forward()) > same_axis &&
           glm::dot(a.pose.up(), b.pose.up()) > same_axis;
}

/// Sine of the steepest normal's angle from the vertical.
double lean_of(const Piece& piece) {
    const double up = std::clamp(piece.least_up, 0.0, 1.0);
    return std::sqrt(1.0 - up * up);
}

/// By samples n to each side: the most of |I(h - n) + I(h + n) - 2 I(h)| over the table, and over all smaller n. The last holds for all
/// more.
std::vector<double> merging_error(const BeamTexture& g) {
    std::vector<double> most(1, 0.0);
    const auto at = [&](int x, int y) {
        return x < 0 || x >= g.width
                   ? 0.0
                   : static_cast<double>(
                         g.cd[static_cast<std::size_t>(y) * static_cast<std::size_t>(g.width) + static_cast<std::size_t>(x)]);
    };
    for (int n = 1; n <= 32; ++n) {
        double worst = most.back();
        for (int y = 0; y < g.height; ++y)
            for (int x = -n; x < g.width + n; ++x)
                worst = std::max(worst, std::abs(at(x - n, y) + at(x + n, y) - 2.0 * at(x, y)));
        most.push_back(worst);
    }
    return most;
}

template <class T> void fill(Context& context, Buffer& buffer, std::size_t& room, const std::vector<T>& values) {
    if (room < values.size() || buffer == 0) {
        room = std::max<std::size_t>(2 * values.size(), 64);
        buffer = make_buffer(context, std::vector<T>(room), GL_DYNAMIC_STORAGE_BIT);
    }
    update_buffer(context, buffer, values);
}

} // namespace

int TrafficLights::beam_offset(const Beam& beam) {
    const auto [known, fresh] = offsets_.try_emplace(beam.id, static_cast<int>(cd_.size()));
    if (fresh) {
        cd_.insert(cd_.end(), beam.grid.cd.begin(), beam.grid.cd.end());
        merging_cd_[beam.id] = merging_error(beam.grid);
        cd_room_ = 0;
    }
    return known->second;
}

void TrafficLights::pack(const LitLamp& lamp, const Beam& beam, const Moment& moment, double factor, double least_lx) {
    const BeamTexture& g = beam.grid;
    packed_.push_back({four(lamp.pose.position_m - moment.ego.position_m, least_lx), four(-lamp.pose.left()), four(lamp.pose.up()),
                       four(lamp.pose.forward()), four(lamp.colour.linear_srgb, factor),
                       glm::vec4(g.h_first_rad, g.v_first_rad, 1.0 / g.h_step_rad, 1.0 / g.v_step_rad),
                       glm::vec4(beam_offset(beam), g.width, g.height, 0.0)});
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
        unit.first = static_cast<int>(packed_.size());
        unit.middle = lamps[i];
        unit.factor = unit.lamps * lamps[i].intensity_factor;
        const double least = moment.least_traffic_lx;
        for (int k = 0; k < unit.lamps; ++k)
            pack(lamps[i + static_cast<std::size_t>(k)], *unit.beam, moment, lamps[i].intensity_factor, least / unit.lamps);
        if (unit.lamps == 2) {
            const glm::dvec3 other = lamps[i + 1].pose.position_m;
            unit.half_m = 0.5 * glm::length(other - lamps[i].pose.position_m);
            unit.middle.pose.position_m = 0.5 * (other + lamps[i].pose.position_m);
            pack(unit.middle, *unit.beam, moment, unit.factor, least);
            ++i;
        }
        unit.merging_cd = &merging_cd_[unit.beam->id];
        unit.at_m = unit.middle.pose.position_m - moment.ego.position_m;
        unit.middle.intensity_factor = unit.factor;
        units_.push_back(std::move(unit));
    }
}

TrafficLights::Bound TrafficLights::bound(const Unit& unit, const Place& place, double least_lx) const {
    const glm::dvec3 from = place.centre_m - unit.at_m;
    const double radius = place.radius_m + unit.half_m, d = glm::length(from);
    Bound bound;
    bound.near_m = std::max(d - radius, nearest_m);
    if (glm::dot(unit.middle.pose.forward(), from) < -radius)
        return bound; // behind
    double cosine = 1.0;
    if (place.ground) { // the lamp's height over its distance, and what the ground leans: sin(a + b) <= sin a + sin b
        const double height = std::max(unit.at_m.z - place.lowest_m, 0.0), beside = std::max(std::hypot(from.x, from.y) - radius, 0.0);
        cosine = height > 0.0 ? std::min(1.0, height / std::hypot(height, beside) + place.lean) : std::min(1.0, place.lean);
    }
    bound.lx_a_cd = rounding * cosine * unit.factor / (bound.near_m * bound.near_m);
    bound.most_lx = unit.beam->bounds.most() * bound.lx_a_cd;
    if (bound.most_lx > least_lx)
        bound.most_lx = unit.beam->bounds.most_towards(to_lamp_space(unit.middle, from), radius) * bound.lx_a_cd;
    return bound;
}

/// |E of two lamps - E of one midway|: the beams' second difference for the angle between them, and the distances' (3 / 2 of the square of
/// that angle for each of d^2 and the cosine, taken double).
double TrafficLights::merging_lx(const Unit& unit, const Bound& bound) {
    const double angle = unit.half_m / bound.near_m;
    const auto samples = static_cast<std::size_t>(std::ceil(angle / unit.beam->grid.h_step_rad));
    if (angle > 0.2 || samples >= unit.merging_cd->size())
        return 2.0 * bound.most_lx;
    return std::min(2.0 * bound.most_lx, 0.5 * (*unit.merging_cd)[samples] * bound.lx_a_cd + 6.0 * angle * angle * bound.most_lx);
}

void TrafficLights::list(Unit& unit, const Place& place, double least, Lists& lists, Work& work) {
    const Bound bounds = bound(unit, place, least);
    const double most = bounds.most_lx;
    if (most <= least && pruned_)
        return;
    const auto add = [](std::vector<glm::vec4>& entries, int lamp, double weight, double cd) {
        if (weight > 0.0)
            entries.emplace_back(static_cast<float>(lamp), static_cast<float>(weight), static_cast<float>(cd), 0.0F);
    };
    double by_fragment = 1.0;
    const int merged = unit.first + (unit.lamps == 2 ? 2 : 0);
    if (levels_ && most > least && !place.ground && !place.retro) {
        const double by_vertex = std::clamp((4.0 * least - most) / least, 0.0, 1.0),
                     point = std::clamp((2.0 * least - most) / (0.5 * least), 0.0, 1.0);
        by_fragment = 1.0 - by_vertex;
        add(lists.vertex, merged, by_vertex * (1.0 - point), -1.0);
        if (by_vertex * point > 0.0)
            add(lists.vertex, merged, by_vertex * point,
                intensity_towards_cd(unit.middle, unit.middle.pose.position_m + place.centre_m - unit.at_m));
        work.traffic_by_vertex += by_vertex * (1.0 - point) > 0.0 ? 1 : 0;
        work.traffic_point += by_vertex * point > 0.0 ? 1 : 0;
    }
    double each = 1.0;
    if (unit.lamps == 2 && levels_ && most > least)
        each = std::clamp((merging_lx(unit, bounds) - 2.0 * least) / (2.0 * least), 0.0, 1.0);
    for (int k = 0; k < unit.lamps; ++k)
        add(lists.fragment, unit.first + k, by_fragment * each, -1.0);
    if (unit.lamps == 2)
        add(lists.fragment, merged, by_fragment * (1.0 - each), -1.0);
    work.traffic_full += by_fragment * each > 0.0 ? unit.lamps : 0;
    work.traffic_merged += unit.lamps == 2 && by_fragment * (1.0 - each) > 0.0 ? 1 : 0;
    unit.used = unit.used || most > least;
}

std::pair<std::uint32_t, std::uint32_t> TrafficLights::keep(const std::vector<glm::vec4>& entries) {
    const auto first = static_cast<std::uint32_t>(entries_.size());
    entries_.insert(entries_.end(), entries.begin(), entries.end());
    return {first, static_cast<std::uint32_t>(entries.size())};
}

/// A cell is bounded by a sphere round what ground stands in it.
void TrafficLights::list_cells(const Moment& moment, const std::vector<std::uint32_t>& drawn, Work& work) {
    struct Cell {
        double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity(), lean = 0.0;
    };
    std::vector<Cell> ground(static_cast<std::size_t>(traffic_cells_ahead) * static_cast<std::size_t>(traffic_cells_across));
    const glm::dvec2 left(-ahead_.y, ahead_.x);
    const auto column = [](double m) { return static_cast<int>(std::floor((m + traffic_behind_m) / traffic_cell_m)); };
    const auto row = [](double m) { return static_cast<int>(std::floor((m + traffic_beside_m) / traffic_cell_m)); };
    for (const std::uint32_t i : drawn) {
        const Piece& piece = scene_.pieces()[i];
        if (!piece.ground)
            continue;
        glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-std::numeric_limits<double>::infinity());
        for (const glm::dvec3& corner : piece.corners_m) {
            const glm::dvec2 p(piece.origin_m - moment.ego.position_m + corner), at(glm::dot(p, ahead_), glm::dot(p, left));
            low = glm::min(low, at - 0.1);
            high = glm::max(high, at + 0.1);
        }
        const double lean = lean_of(piece);
        for (int y = std::max(0, row(low.y)); y <= std::min(traffic_cells_across - 1, row(high.y)); ++y)
            for (int x = std::max(0, column(low.x)); x <= std::min(traffic_cells_ahead - 1, column(high.x)); ++x) {
                Cell& cell = ground[static_cast<std::size_t>(y * traffic_cells_ahead + x)];
                cell.low = std::min(cell.low, piece.lowest_m - moment.ego.position_m.z);
                cell.high = std::max(cell.high, piece.highest_m - moment.ego.position_m.z);
                cell.lean = std::max(cell.lean, lean);
            }
    }
    cells_.assign(2 * ground.size(), 0);
    for (std::size_t i = 0; i < ground.size(); ++i) {
        const Cell& cell = ground[i];
        if (cell.high < cell.low)
            continue;
        const double a = (static_cast<double>(i % traffic_cells_ahead) + 0.5) * traffic_cell_m - traffic_behind_m,
                     b = (static_cast<double>(i / traffic_cells_ahead) + 0.5) * traffic_cell_m - traffic_beside_m;
        const glm::dvec2 at = ahead_ * a + left * b;
        const double half = 0.5 * traffic_cell_m + 0.01, up = 0.5 * (cell.high - cell.low);
        const Place place{
            {at.x, at.y, 0.5 * (cell.low + cell.high)}, std::sqrt(2.0 * half * half + up * up), cell.low, cell.lean, true, false};
        Lists lists;
        for (Unit& unit : units_)
            list(unit, place, moment.least_traffic_lx, lists, work);
        const auto [first, count] = keep(lists.fragment);
        cells_[2 * i] = first;
        cells_[2 * i + 1] = count;
    }
}

void TrafficLights::set(const Moment& moment, const std::vector<std::uint32_t>& drawn, Work& work) {
    add_units(moment);
    entries_.clear();
    lists_.assign(scene_.pieces().size(), {});
    left_out_ = 0;
    if (units_.empty())
        return;
    const glm::dvec2 forward(moment.ego.forward());
    ahead_ = glm::length(forward) > 1e-6 ? glm::normalize(forward) : glm::dvec2(1.0, 0.0);
    bool on_ground = false;
    Work uncounted; // ground is counted by its cells
    for (const std::uint32_t i : drawn) {
        const Piece& piece = scene_.pieces()[i];
        const Place place{centre_of(piece, moment.ego.position_m),         piece.radius_m, piece.lowest_m - moment.ego.position_m.z,
                          std::acos(std::clamp(piece.least_up, 0.0, 1.0)), piece.ground,   piece.surface.retroreflecting};
        Lists lists;
        for (Unit& unit : units_)
            list(unit, place, moment.least_traffic_lx, lists, piece.ground ? uncounted : work);
        std::uint32_t* const traffic = lists_[i].traffic;
        std::tie(traffic[0], traffic[1]) = keep(lists.fragment);
        std::tie(traffic[2], traffic[3]) = keep(lists.vertex);
        if (piece.ground && traffic[1] != 0) {
            traffic[1] |= is_ground_bit;
            on_ground = true;
        }
    }
    cells_.assign(2 * static_cast<std::size_t>(traffic_cells_ahead) * static_cast<std::size_t>(traffic_cells_across), 0);
    if (on_ground)
        list_cells(moment, drawn, work);
    left_out_ = static_cast<int>(std::ranges::count(units_, false, &Unit::used));
    fill(context_, lamp_buffer_, lamp_room_, packed_);
    fill(context_, entry_buffer_, entry_room_, entries_);
    if (cd_room_ == 0)
        fill(context_, cd_buffer_, cd_room_, cd_);
    std::size_t cell_room = cells_.size();
    fill(context_, cell_buffer_, cell_room, cells_);
}

glm::vec4 TrafficLights::grid() const { return {ahead_.x, ahead_.y, -traffic_behind_m, -traffic_beside_m}; }

void TrafficLights::bind() const {
    const GladGLContext& gl = context_.gl;
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, lamp_buffer_);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 3, entry_buffer_);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, cd_buffer_);
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, cell_buffer_);
}

} // namespace fernlicht::gl
