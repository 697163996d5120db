#include "renderer/gl/scene/beams.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht::gl {
namespace {

// A window of tangents beyond about 55 degrees would spend its texels at the sides: what lies outside it is lit without question.
constexpr double widest_tangent = 1.4, highest_tangent = 0.36, lowest_tangent = -0.45;

ShadowWindow window_of(const BeamTexture& g) {
    const auto tangent = [](double angle) { return std::tan(std::clamp(angle, -1.5, 1.5)); };
    const double top_angle = g.v_first_rad + (g.height - 1) * g.v_step_rad;
    ShadowWindow w{std::max(-widest_tangent, tangent(g.h_first_rad)),
                   std::min(widest_tangent, tangent(g.h_first_rad + (g.width - 1) * g.h_step_rad)),
                   std::max(lowest_tangent, 1.75 * std::min(tangent(g.v_first_rad), 0.0)),
                   std::min(highest_tangent, 1.75 * std::max(tangent(top_angle), 0.0))};
    // 1.75: at the window's side the tangent of a given V is larger by 1 / cos(H).
    if (w.right - w.left < 1e-3)
        w.right = w.left + 1e-3;
    if (w.top - w.bottom < 1e-3)
        w.top = w.bottom + 1e-3;
    return w;
}

std::vector<std::uint16_t> steps_of(std::span<const float> values, const BeamTexture& g) {
    std::vector<std::uint16_t> steps;
    if (g.bits < 32)
        for (const float cd : values)
            steps.push_back(static_cast<std::uint16_t>(
                g.scale_cd > 0.0 ? std::lround(static_cast<double>(cd) / g.scale_cd * largest_step(g.bits)) : 0));
    return steps;
}

std::vector<std::uint16_t> steps_of(const BeamTexture& g) { return steps_of(g.cd, g); }

bool same_grid(const BeamTexture& a, const BeamTexture& b) {
    return a.width == b.width && a.height == b.height && a.bits == b.bits && a.h_first_rad == b.h_first_rad &&
           a.v_first_rad == b.v_first_rad && a.h_step_rad == b.h_step_rad && a.v_step_rad == b.v_step_rad;
}

/// Whole rows, from `row` on.
void send_texels(Context& context, const Texture& texture, int row, int width, int rows, int bits, std::span<const float> values,
                 std::span<const std::uint16_t> steps) {
    context.gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const auto send = [&](GLenum type, const void* texels) {
        context.gl.TextureSubImage2D(texture, 0, 0, row, width, rows, GL_RED, type, texels);
    };
    if (bits == 32)
        send(GL_FLOAT, values.data());
    else if (bits == 16)
        send(GL_UNSIGNED_SHORT, steps.data());
    else
        send(GL_UNSIGNED_BYTE, std::vector<std::uint8_t>(steps.begin(), steps.end()).data());
}

constexpr int texels_a_cell = 32;
constexpr double slack_rad = 1e-3; // what the GPU's angles may differ, many times over

} // namespace

Texture make_texels(Context& context, int width, int height, int bits, std::span<const float> values,
                    std::span<const std::uint16_t> steps) {
    Texture texture = make_texture(context, bits == 32 ? GL_R32F : (bits == 16 ? GL_R16 : GL_R8), width, height);
    send_texels(context, texture, 0, width, height, bits, values, steps);
    return texture;
}

const Beam& Beams::of(const std::shared_ptr<const LampFile>& file) {
    const std::shared_ptr<const LampFile>& whole = file->state_of ? file->state_of : file;
    if (const auto known = known_.find(whole.get()); known != known_.end()) {
        if (known->second.shown != file)
            show(file, known->second);
        return known->second.beam;
    }
    Beam beam;
    beam.id = static_cast<int>(known_.size());
    beam.grid = made(whole->table);
    const BeamTexture& g = beam.grid;
    const auto same = std::ranges::find_if(
        known_, [&](const auto& known) { return known.second.beam.id == known.second.beam.shape && same_grid(known.second.beam.grid, g); });
    beam.shape = same == known_.end() ? beam.id : same->second.beam.shape;
    beam.bounds = BeamBounds(g);
    beam.window = window_of(g);
    constexpr double asin_reaches_rad = 0.5235; // 30 degrees
    beam.steep = g.v_first_rad < -asin_reaches_rad || g.v_first_rad + (g.height - 1) * g.v_step_rad > asin_reaches_rad;
    beam.texture = make_texels(context_, g.width, g.height, g.bits, g.cd, steps_of(g));
    beam.cd_a_unit = g.bits == 32 ? 1.0 : g.scale_cd;
    texture_bytes_ += static_cast<std::size_t>(g.bits / 8) * g.cd.size();
    context_.check("uploading a beam texture");
    if (!kept_ && !whole->pixels)
        beam.grid.cd = std::vector<float>(); // = {} would keep the memory
    Known& known = known_.emplace(whole.get(), Known{whole, whole, std::move(beam)}).first->second;
    if (file != whole)
        show(file, known);
    return known.beam;
}

void Beams::show(const std::shared_ptr<const LampFile>& state, Known& known) {
    BeamTexture& g = known.beam.grid;
    const auto [first, end] = draw_state(state->table, known.file->table, texels_, g);
    known.shown = state;
    if (first == end)
        return;
    const auto rows = std::span(g.cd).subspan(static_cast<std::size_t>(first * g.width), static_cast<std::size_t>((end - first) * g.width));
    send_texels(context_, known.beam.texture, first, g.width, end - first, g.bits, rows, steps_of(rows, g));
    context_.check("uploading a beam's state");
}

BeamTexture Beams::grid_of(const Beam& beam) const {
    const auto known = std::ranges::find_if(known_, [&](const auto& other) { return other.second.beam.id == beam.id; });
    return beam.grid.cd.empty() ? made(known->second.file->table) : beam.grid;
}

std::vector<LitLamp> shining(const Moment& moment, bool all) {
    std::vector<LitLamp> lamps;
    for (const LitLamp& lamp : moment.lamps)
        if (all || lamp.intensity_factor > 0.0)
            lamps.push_back(lamp);
    if (lamps.size() > max_lamps)
        throw InputError({{}, 0, 0, "lamps"},
                         all ? fmt::format("{} lamps are mounted, and an unpruned technique renders those that are off, too", lamps.size())
                             : fmt::format("{} lamps are on at {} s", lamps.size(), moment.time_s),
                         fmt::format("at most {}", max_lamps));
    return lamps;
}

glm::dvec3 to_lamp_space(const LitLamp& lamp, const glm::dvec3& direction) {
    return {-glm::dot(lamp.pose.left(), direction), glm::dot(lamp.pose.up(), direction), glm::dot(lamp.pose.forward(), direction)};
}

BeamBounds::BeamBounds(const BeamTexture& beam)
    : h_first_(beam.h_first_rad), v_first_(beam.v_first_rad), h_cell_(texels_a_cell * beam.h_step_rad),
      v_cell_(texels_a_cell * beam.v_step_rad), columns_((beam.width + texels_a_cell - 1) / texels_a_cell),
      rows_((beam.height + texels_a_cell - 1) / texels_a_cell),
      max_of_cell_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0F) {
    for (int y = 0; y < beam.height; ++y)
        for (int x = 0; x < beam.width; ++x) {
            const float cd = beam.cd[static_cast<std::size_t>(y * beam.width + x)];
            most_ = std::max(most_, static_cast<double>(cd));
            // A sample on a border belongs to the cells on both sides.
            for (int row = std::max(0, (y - 1) / texels_a_cell); row <= y / texels_a_cell; ++row)
                for (int column = std::max(0, (x - 1) / texels_a_cell); column <= x / texels_a_cell; ++column) {
                    float& most = max_of_cell_[static_cast<std::size_t>(row * columns_ + column)];
                    most = std::max(most, cd);
                }
        }
}

double BeamBounds::max_towards(const glm::dvec3& centre, double radius) const {
    const double distance = glm::length(centre);
    if (distance <= radius)
        return most_;
    const double cone = std::asin(radius / distance) + slack_rad;
    const double v = std::atan2(centre.y, std::hypot(centre.x, centre.z)), h = std::atan2(centre.x, centre.z);
    // Across, a cone about a raised direction spans more of H than its own angle, and all of H where it holds the pole.
    const double spread = std::sin(std::min(cone, 0.5 * pi)) / std::max(std::cos(v), 1e-9);
    const double across = std::abs(v) + cone >= 0.5 * pi || spread >= 1.0 ? pi : std::asin(spread);
    const auto cells = [](double from, double to, double first, double size, int count) {
        return std::pair(std::max(0, static_cast<int>(std::floor((from - first) / size))),
                         std::min(count - 1, static_cast<int>(std::floor((to - first) / size))));
    };
    const auto [left, right] = cells(h - across, h + across, h_first_, h_cell_, columns_);
    const auto [low, high] = cells(v - cone, v + cone, v_first_, v_cell_, rows_);
    float most = 0.0F;
    for (int row = low; row <= high; ++row)
        for (int column = left; column <= right; ++column)
            most = std::max(most, max_of_cell_[static_cast<std::size_t>(row * columns_ + column)]);
    return static_cast<double>(most);
}

} // namespace fernlicht::gl
