#include "renderer/beam_texture.h"

#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr double finest_needed_deg = 0.05; // a cut-off of G = 0.4 runs over about 0.25 degrees

/// First and last index of the axis that a lit part needs, one dark sample kept on either side, H clipped to the front half.
struct Range {
    std::size_t first = 0, last = 0;
};

bool lit(const CandelaTable& table, std::size_t index, bool across) {
    const std::size_t other = across ? table.v_deg.size() : table.h_deg.size();
    for (std::size_t k = 0; k < other; ++k)
        if ((across ? table.at(k, index) : table.at(index, k)) > 0.0)
            return true;
    return false;
}

Range lit_range(const CandelaTable& table, bool across) {
    const std::size_t count = across ? table.h_deg.size() : table.v_deg.size();
    std::size_t first = 0, last = count - 1;
    while (first < last && !lit(table, first, across))
        ++first;
    while (last > first && !lit(table, last, across))
        --last;
    return {first > 0 ? first - 1 : 0, std::min(last + 1, count - 1)};
}

/// The largest step of at most 0.05 degrees on which all samples of [first, last] fall; 0.05 where there is none.
double common_step(const std::vector<double>& axis, Range range) {
    double narrowest = 360.0;
    for (std::size_t i = range.first; i < range.last; ++i)
        narrowest = std::min(narrowest, axis[i + 1] - axis[i]);
    for (int parts = std::max(1, static_cast<int>(std::ceil(narrowest / finest_needed_deg - 1e-9))); parts <= 64; ++parts) {
        const double step = narrowest / parts;
        if (step < 0.004)
            break;
        const bool all = std::all_of(axis.begin() + static_cast<std::ptrdiff_t>(range.first),
                                     axis.begin() + static_cast<std::ptrdiff_t>(range.last) + 1, [&](double angle) {
                                         const double texels = (angle - axis[range.first]) / step;
                                         return std::abs(texels - std::round(texels)) < 1e-6 * std::max(1.0, texels);
                                     });
        if (all)
            return step;
    }
    return finest_needed_deg;
}

struct Axis {
    double first_deg = 0.0, step_deg = 0.0;
    std::size_t count = 2;
    double at(double index) const { return first_deg + index * step_deg; }
};

Axis choose_axis(const std::vector<double>& samples, Range range, double lowest, double highest, double coarsening) {
    const double from = std::max(samples[range.first], lowest), to = std::min(samples[range.last], highest);
    if (!(to > from))
        return {from, finest_needed_deg, 2};
    double step = common_step(samples, range) * coarsening;
    const double texels = (to - from) / step;
    std::size_t intervals = static_cast<std::size_t>(std::ceil(texels - 1e-6));
    intervals = std::max<std::size_t>(intervals, 1);
    if (std::abs(texels - static_cast<double>(intervals)) > 1e-6 * texels || from != samples[range.first])
        step = (to - from) / static_cast<double>(intervals); // no common step: end exactly on the last sample
    return {from, step, intervals + 1};
}

/// Where on an axis the table's own samples fall between texels, in texels.
std::vector<double> between_texels(const std::vector<double>& samples, const Axis& axis) {
    std::vector<double> places;
    for (const double angle : samples) {
        const double place = (angle - axis.first_deg) / axis.step_deg;
        if (place > 0.0 && place < static_cast<double>(axis.count - 1) && std::abs(place - std::round(place)) > 1e-6)
            places.push_back(place);
    }
    return places;
}

/// Texture and table both run bilinearly between their own samples, so that they differ most where samples of the one or the other
/// meet: at texels they agree, so that at least one axis is at a sample of the table.
double worst_at_samples(const CandelaTable& table, const BeamTexture& texture, const Axis& h, const Axis& v) {
    std::vector<double> across = between_texels(table.h_deg, h), up = between_texels(table.v_deg, v);
    const std::size_t own_across = across.size(), own_up = up.size();
    if (own_up > 0)
        for (std::size_t x = 0; x < h.count; ++x)
            across.push_back(static_cast<double>(x));
    if (own_across > 0)
        for (std::size_t y = 0; y < v.count; ++y)
            up.push_back(static_cast<double>(y));
    double worst = 0.0;
    std::vector<double> across_deg;
    for (const double texels : across)
        across_deg.push_back(h.at(texels));
    IntensityAcross true_cd(table, across_deg);
    for (std::size_t j = 0; j < up.size(); ++j) {
        const std::vector<double>& truth_cd = true_cd.at(v.at(up[j]));
        const std::size_t y = std::min(static_cast<std::size_t>(up[j]), v.count - 2), columns = j < own_up ? across.size() : own_across;
        const double fy = up[j] - static_cast<double>(y);
        for (std::size_t i = 0; i < columns; ++i) {
            const std::size_t x = std::min(static_cast<std::size_t>(across[i]), h.count - 2);
            const double fx = across[i] - static_cast<double>(x);
            const auto texel = [&](std::size_t row, std::size_t column) { return static_cast<double>(texture.cd[row * h.count + column]); };
            const double drawn = (texel(y, x) * (1.0 - fx) + texel(y, x + 1) * fx) * (1.0 - fy) +
                                 (texel(y + 1, x) * (1.0 - fx) + texel(y + 1, x + 1) * fx) * fy;
            worst = std::max(worst, std::abs(drawn - truth_cd[i]));
        }
    }
    return worst;
}

double worst_error(const CandelaTable& table, const BeamTexture& texture, const Axis& h, const Axis& v) {
    double worst = worst_at_samples(table, texture, h, v); // exact for linear_cd; the middles of texels are for log_cd
    const std::size_t skip_v = std::max<std::size_t>(1, h.count * v.count / 400'000);
    std::vector<double> middles_deg;
    for (std::size_t x = 0; x + 1 < h.count; ++x)
        middles_deg.push_back(h.at(static_cast<double>(x) + 0.5));
    IntensityAcross true_cd(table, middles_deg);
    for (std::size_t y = 0; y + 1 < v.count; y += skip_v) {
        const std::vector<double>& truth_cd = true_cd.at(v.at(static_cast<double>(y) + 0.5));
        for (std::size_t x = 0; x + 1 < h.count; ++x) {
            const auto texel = [&](std::size_t row, std::size_t column) { return static_cast<double>(texture.cd[row * h.count + column]); };
            const double middle = 0.25 * (texel(y, x) + texel(y, x + 1) + texel(y + 1, x) + texel(y + 1, x + 1));
            worst = std::max(worst, std::abs(middle - truth_cd[x]));
        }
    }
    return worst;
}

/// The table on the texels' angles: a row in cd at a time, from low V.
template <class Take> void sample(const CandelaTable& table, const Axis& h, const Axis& v, Take take) {
    // The last texel may lie a rounding error beyond the table's edge, where the table is dark: stay inside.
    const auto inside = [](double angle, const std::vector<double>& axis) { return std::clamp(angle, axis.front(), axis.back()); };
    std::vector<double> h_deg;
    for (std::size_t x = 0; x < h.count; ++x)
        h_deg.push_back(inside(h.at(static_cast<double>(x)), table.h_deg));
    IntensityAcross across(table, h_deg);
    for (std::size_t y = 0; y < v.count; ++y)
        take(y, across.at(inside(v.at(static_cast<double>(y)), table.v_deg)));
}

float in_steps(float cd, double step_cd) { return static_cast<float>(std::round(static_cast<double>(cd) / step_cd) * step_cd); }

BeamTexture sampled(const CandelaTable& table, const Axis& h, const Axis& v, int bits) {
    BeamTexture texture;
    texture.width = static_cast<int>(h.count);
    texture.height = static_cast<int>(v.count);
    texture.h_first_rad = radians(h.first_deg);
    texture.v_first_rad = radians(v.first_deg);
    texture.h_step_rad = radians(h.step_deg);
    texture.v_step_rad = radians(v.step_deg);
    texture.bits = bits;
    texture.cd.reserve(h.count * v.count);
    sample(table, h, v, [&](std::size_t, const std::vector<double>& row) {
        for (const double cd : row)
            texture.cd.push_back(static_cast<float>(cd));
    });
    texture.scale_cd = static_cast<double>(*std::ranges::max_element(texture.cd));
    if (bits < 32 && texture.scale_cd > 0.0)
        for (float& cd : texture.cd)
            cd = in_steps(cd, texture.scale_cd / largest_step(bits));
    if (const double peak = peak_of(table).cd; peak > 0.0)
        texture.worst_error_of_peak = worst_error(table, texture, h, v) / peak;
    return texture;
}

/// The axes of make_beam_texture(table, texels).
std::pair<Axis, Axis> axes_of_texels(const CandelaTable& table, const BeamTexels& texels) {
    const auto axis = [](const std::vector<double>& samples, Range range, int count) {
        const double from = std::max(samples[range.first], -90.0), to = std::min(samples[range.last], 90.0);
        return Axis{from, to > from ? (to - from) / (count - 1) : finest_needed_deg, static_cast<std::size_t>(count)};
    };
    return {axis(table.h_deg, lit_range(table, true), texels.width), axis(table.v_deg, lit_range(table, false), texels.height)};
}

std::pair<Axis, Axis> axes_within(const CandelaTable& table, std::size_t max_texels) {
    const Range across = lit_range(table, true), up = lit_range(table, false);
    double coarser_h = 1.0, coarser_v = 1.0;
    Axis h = choose_axis(table.h_deg, across, -90.0, 90.0, coarser_h);
    Axis v = choose_axis(table.v_deg, up, -90.0, 90.0, coarser_v);
    while (h.count * v.count > max_texels) {
        (coarser_h < 8.0 * coarser_v ? coarser_h : coarser_v) *= 2.0;
        h = choose_axis(table.h_deg, across, -90.0, 90.0, coarser_h);
        v = choose_axis(table.v_deg, up, -90.0, 90.0, coarser_v);
    }
    return {h, v};
}

} // namespace

BeamTexture make_beam_texture(const CandelaTable& table, std::size_t max_texels) {
    const auto [h, v] = axes_within(table, max_texels);
    return sampled(table, h, v, 32);
}

BeamTexture make_beam_texture(const CandelaTable& table, const BeamTexels& texels) {
    for (const int texels_each_way : {texels.width, texels.height})
        if (texels_each_way < min_beam_texels || texels_each_way > max_beam_texels)
            throw std::invalid_argument(fmt::format("beam texture: {} x {} texels, expected {} to {} each way", texels.width, texels.height,
                                                    min_beam_texels, max_beam_texels));
    const auto [h, v] = axes_of_texels(table, texels);
    return sampled(table, h, v, texels.bits);
}

std::pair<int, int> draw_state(const CandelaTable& table, const CandelaTable& full, const std::optional<BeamTexels>& texels,
                               BeamTexture& texture) {
    const auto [h, v] = texels ? axes_of_texels(full, *texels) : axes_within(full, default_max_texels);
    int first = texture.height, end = 0;
    const double step_cd = texture.bits < 32 ? texture.scale_cd / largest_step(texture.bits) : 0.0;
    sample(table, h, v, [&, count = h.count](std::size_t y, const std::vector<double>& row) {
        bool changed = false;
        float* const to = &texture.cd[y * count];
        for (std::size_t x = 0; x < count; ++x) {
            const float cd = step_cd > 0.0 ? in_steps(static_cast<float>(row[x]), step_cd) : static_cast<float>(row[x]);
            changed = changed || cd != to[x];
            to[x] = cd;
        }
        if (changed) {
            first = std::min(first, static_cast<int>(y));
            end = static_cast<int>(y) + 1;
        }
    });
    ++texture.state;
    return {std::min(first, end), end};
}

} // namespace fernlicht
