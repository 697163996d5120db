#include "scenarios/lamps/pixel_lamp.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <numbers>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr double finest_step_deg = 0.05; ///< pixels that are larger have several samples
constexpr double blur_ends = 5.0;        ///< standard deviations, where 3e-7 of the light are left

/// Samples of one axis of a raster: `parts` a pixel, evenly, and on until the blur ends.
struct RasterAxis {
    double from_deg, pixel_deg, spread_deg;
    int pixels;

    int parts() const { return std::max(1, static_cast<int>(std::ceil(pixel_deg / finest_step_deg - 1e-9))); }
    int beside(int parts_a_pixel) const { return static_cast<int>(std::ceil(blur_ends * spread_deg * parts_a_pixel / pixel_deg)); }
    double samples(int parts_a_pixel) const { return pixels * double(parts_a_pixel) + 2.0 * beside(parts_a_pixel); }
    std::vector<double> axis(int parts_a_pixel) const {
        std::vector<double> deg;
        const int more = beside(parts_a_pixel);
        for (int i = -more; i < pixels * parts_a_pixel + more; ++i)
            deg.push_back(from_deg + (i + 0.5) * pixel_deg / parts_a_pixel);
        return deg;
    }
    /// Share of an even field's intensity that pixel `i` has in a direction: its box blurred.
    double share(int i, double at_deg) const {
        const double from_centre = at_deg - (from_deg + (i + 0.5) * pixel_deg);
        const auto below = [&](double x) { return 0.5 * std::erfc(-x / (spread_deg * std::numbers::sqrt2)); };
        return below(from_centre + 0.5 * pixel_deg) - below(from_centre - 0.5 * pixel_deg);
    }
};

RasterAxis axis_across(const PixelRaster& r) {
    return {r.field.left_deg, (r.field.right_deg - r.field.left_deg) / r.columns, r.spread_h_deg, r.columns};
}
/// From the lowest row, as tables have it.
RasterAxis axis_up(const PixelRaster& r) {
    return {r.field.bottom_deg, (r.field.top_deg - r.field.bottom_deg) / r.rows, r.spread_v_deg, r.rows};
}

CandelaTable dark_table(std::vector<double> h_deg, std::vector<double> v_deg) {
    CandelaTable table{std::move(h_deg), std::move(v_deg), {}, {}, BetweenSamples::linear_cd};
    table.cd.assign(table.h_deg.size() * table.v_deg.size(), 0.0);
    return table;
}

CandelaTable raster_table(const PixelRaster& raster) {
    const RasterAxis across = axis_across(raster), up = axis_up(raster);
    int parts_h = across.parts(), parts_v = up.parts();
    while (across.samples(parts_h) * up.samples(parts_v) > static_cast<double>(PixelLamp::most_samples) && parts_h * parts_v > 1)
        --(parts_h >= parts_v ? parts_h : parts_v);
    if (const double samples = across.samples(parts_h) * up.samples(parts_v); samples > static_cast<double>(PixelLamp::most_samples))
        throw std::invalid_argument(fmt::format("{} x {} pixels with their blur need a table of {:.0f} samples, expected at most {}",
                                                raster.columns, raster.rows, samples, PixelLamp::most_samples));
    CandelaTable table = dark_table(across.axis(parts_h), up.axis(parts_v));
    if (table.v_deg.front() < -90.0 || table.v_deg.back() > 90.0)
        throw std::invalid_argument(fmt::format("with their blur the pixels light from V {:.1f} to {:.1f} degrees, expected -90 to 90",
                                                table.v_deg.front(), table.v_deg.back()));
    return table;
}

/// Axes of files made by different programs differ by roundings: what is the same place but for one becomes the same.
void settle(std::vector<double>& axis, const std::vector<double>& on) {
    constexpr double same_deg = 1e-7;
    std::vector<double> settled = axis;
    for (double& deg : settled)
        if (const auto near = std::ranges::lower_bound(on, deg - same_deg); near != on.end() && *near <= deg + same_deg)
            deg = *near;
    if (std::ranges::adjacent_find(settled, std::greater_equal<>()) == settled.end())
        axis = std::move(settled);
}

/// On the axes of both, each by its own rule there.
CandelaTable on_axes_of_both(const CandelaTable& a, const CandelaTable& b) {
    CandelaTable both = sum(a, b);
    both.rule = BetweenSamples::linear_cd;
    both.gaps.clear();
    return both;
}

} // namespace

PixelLamp::PixelLamp(PixelParts parts) : parts_(std::move(parts)) {
    if (parts_.raster.size() > 1 || parts_.raster.empty() == parts_.segments.empty())
        throw std::invalid_argument("found neither or both, expected a raster or segments");
    if (!parts_.raster.empty())
        dark_ = raster_table(parts_.raster.front());
    else
        dark_ = parts_.segments.front().table;
    const auto unite = [this](CandelaTable& table) {
        settle(table.h_deg, dark_.h_deg);
        settle(table.v_deg, dark_.v_deg);
        dark_ = on_axes_of_both(dark_, table);
        if (dark_.cd.size() > most_samples)
            throw std::invalid_argument(
                fmt::format("the tables together need {} samples or more, expected at most {}", dark_.cd.size(), most_samples));
    };
    for (PixelSegment& segment : parts_.segments)
        unite(segment.table);
    std::ranges::fill(dark_.cd, 0.0);
    if (!parts_.base.empty())
        unite(parts_.base.front());
    if (parts_.raster.empty()) {
        dead_.resize(parts_.segments.size());
        for (const PixelSegment& segment : parts_.segments) {
            const auto place = [](const std::vector<double>& axis, double at) {
                return static_cast<std::size_t>(std::ranges::lower_bound(axis, at) - axis.begin());
            };
            Patch& patch = patches_.emplace_back();
            patch.h = place(dark_.h_deg, segment.table.h_deg.front());
            patch.v = place(dark_.v_deg, segment.table.v_deg.front());
            patch.columns = place(dark_.h_deg, segment.table.h_deg.back()) + 1 - patch.h;
            patch.rows = place(dark_.v_deg, segment.table.v_deg.back()) + 1 - patch.v;
            for (std::size_t v = 0; v < patch.rows; ++v)
                for (std::size_t h = 0; h < patch.columns; ++h)
                    patch.cd.push_back(intensity_cd(segment.table, dark_.h_deg[patch.h + h], dark_.v_deg[patch.v + v]));
        }
    } else {
        const PixelRaster& raster = parts_.raster.front();
        dead_.resize(raster.cd.size());
        const auto shares = [](const RasterAxis& axis, const std::vector<double>& at_deg) {
            std::vector<Share> all;
            const double reach = blur_ends * axis.spread_deg + 0.5 * axis.pixel_deg;
            for (const double deg : at_deg) {
                const double middle = (deg - axis.from_deg) / axis.pixel_deg - 0.5, wide = reach / axis.pixel_deg;
                const int first = std::clamp(static_cast<int>(std::ceil(middle - wide)), 0, axis.pixels);
                const int end = std::clamp(static_cast<int>(std::floor(middle + wide)) + 1, first, axis.pixels);
                Share& share = all.emplace_back(Share{first, {}});
                for (int i = first; i < end; ++i)
                    share.of.push_back(axis.share(i, deg));
            }
            return all;
        };
        across_ = shares(axis_across(raster), dark_.h_deg);
        up_ = shares(axis_up(raster), dark_.v_deg);
    }
    for (const std::size_t pixel : parts_.dead)
        dead_.at(pixel) = true;
}

AngleBox PixelLamp::lights(std::size_t pixel) const {
    if (parts_.raster.empty())
        return parts_.segments[pixel].lights;
    const PixelRaster& raster = parts_.raster.front();
    const RasterAxis across = axis_across(raster), up = axis_up(raster);
    const auto columns = static_cast<std::size_t>(raster.columns), row = pixel / columns;
    const double column = static_cast<double>(pixel % columns), row_up = raster.rows - 1.0 - static_cast<double>(row);
    const double left = across.from_deg + column * across.pixel_deg, bottom = up.from_deg + row_up * up.pixel_deg;
    return {left, left + across.pixel_deg, bottom, bottom + up.pixel_deg};
}

std::vector<double> PixelLamp::light_of(std::span<const float> levels) const {
    if (levels.size() != count())
        throw std::invalid_argument(fmt::format("{} levels, expected {}", levels.size(), count()));
    std::vector<double> light(levels.size());
    for (std::size_t i = 0; i < levels.size(); ++i)
        if (!dead_[i] && levels[i] > 0.0F)
            light[i] = parts_.answer.exponent == 1.0 ? static_cast<double>(levels[i])
                                                     : std::pow(static_cast<double>(levels[i]), parts_.answer.exponent);
    return light;
}

CandelaTable PixelLamp::table(std::span<const float> levels) const {
    const std::vector<double> light = light_of(levels);
    CandelaTable table = dark_;
    for (std::size_t i = 0; i < patches_.size(); ++i)
        if (const Patch& patch = patches_[i]; light[i] > 0.0)
            for (std::size_t v = 0; v < patch.rows; ++v)
                for (std::size_t h = 0; h < patch.columns; ++h)
                    table.at(patch.v + v, patch.h + h) += light[i] * patch.cd[v * patch.columns + h];
    if (!parts_.raster.empty())
        add_raster(light, table);
    return table;
}

void PixelLamp::add_raster(const std::vector<double>& light, CandelaTable& table) const {
    const PixelRaster& raster = parts_.raster.front();
    const auto columns = static_cast<std::size_t>(raster.columns), rows = static_cast<std::size_t>(raster.rows);
    const double kept = 1.0 - raster.crosstalk, to_each = 0.25 * raster.crosstalk;
    const std::size_t width = table.h_deg.size();
    // Across first: a line of the table's columns for each row of pixels, from the lowest.
    std::vector<double> lines(rows * width), cd(columns);
    for (std::size_t up = 0; up < rows; ++up) {
        const std::size_t row = rows - 1 - up;
        bool lit = false;
        for (std::size_t column = 0; column < columns; ++column) {
            const std::size_t i = row * columns + column;
            double shines = light[i] * raster.cd[i];
            if (raster.crosstalk > 0.0) {
                shines *= kept;
                const auto from = [&](bool there, std::size_t neighbour) { return there ? light[neighbour] * raster.cd[neighbour] : 0.0; };
                shines += to_each * (from(column > 0, i - 1) + from(column + 1 < columns, i + 1) + from(row > 0, i - columns) +
                                     from(row + 1 < rows, i + columns));
            }
            cd[column] = shines;
            lit = lit || shines > 0.0;
        }
        if (!lit)
            continue;
        double* const line = &lines[up * width];
        for (std::size_t x = 0; x < width; ++x) {
            const Share& share = across_[x];
            double sum = 0.0;
            for (std::size_t k = 0; k < share.of.size(); ++k)
                sum += share.of[k] * cd[static_cast<std::size_t>(share.first) + k];
            line[x] = sum;
        }
    }
    for (std::size_t y = 0; y < table.v_deg.size(); ++y) {
        double* const out = &table.cd[y * width];
        for (std::size_t k = 0; k < up_[y].of.size(); ++k) {
            const double* const line = &lines[(static_cast<std::size_t>(up_[y].first) + k) * width];
            const double share = up_[y].of[k];
            for (std::size_t x = 0; x < width; ++x)
                out[x] += share * line[x];
        }
    }
}

PixelLamp PixelLamp::mirrored() const {
    const auto turned = [](AngleBox box) { return AngleBox{-box.right_deg, -box.left_deg, box.bottom_deg, box.top_deg}; };
    PixelParts other = parts_;
    for (PixelRaster& raster : other.raster) {
        raster.field = turned(raster.field);
        const auto columns = static_cast<std::size_t>(raster.columns);
        for (auto row = raster.cd.begin(); row != raster.cd.end(); row += raster.columns)
            std::reverse(row, row + raster.columns);
        for (std::size_t& pixel : other.dead)
            pixel = pixel / columns * columns + (columns - 1 - pixel % columns);
    }
    for (PixelSegment& segment : other.segments) {
        segment.table = fernlicht::mirrored(segment.table);
        segment.lights = turned(segment.lights);
    }
    for (CandelaTable& base : other.base)
        base = fernlicht::mirrored(base);
    return PixelLamp(std::move(other));
}

} // namespace fernlicht
