#include "runner/findings/pixel_levels.h"

#include "runner/files/clean_text.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace fernlicht {
namespace {

constexpr int strip_px = 512; ///< of columns that are not alike
constexpr std::size_t most_lines = 800;
constexpr plots::Colour oncoming_colour{70, 200, 255}, ahead_colour{255, 90, 80}, shade{25, 25, 45}, no_part{200, 200, 200};

std::string box_text(const AngleBox& box) {
    return fmt::format("{:.6g}:{:.6g}/{:.6g}:{:.6g}", box.left_deg, box.right_deg, box.bottom_deg, box.top_deg);
}

/// Moments in one line of the picture: of a long drive several, of which it has the mean.
std::size_t moments_a_line(const PixelLevels& lamp) { return (lamp.rows.size() + most_lines - 1) / most_lines; }

/// Columns of a raster are alike and a pixel each; those between the edges of segments are not.
Image<float> strip_of(const PixelLevels& lamp) {
    const double from = lamp.columns_deg.front().first, to = lamp.columns_deg.back().second;
    const int columns = std::max(strip_px, static_cast<int>(lamp.columns_deg.size()));
    const std::size_t each = moments_a_line(lamp);
    Image<float> strip(columns, static_cast<int>((lamp.rows.size() + each - 1) / each));
    for (int x = 0; x < columns; ++x) {
        const double h_deg = from + (to - from) * (x + 0.5) / columns;
        const auto next = std::ranges::upper_bound(lamp.columns_deg, h_deg, {}, [](const auto& one) { return one.first; });
        const auto column = static_cast<std::size_t>(next - lamp.columns_deg.begin()) - 1;
        for (int y = 0; y < strip.height(); ++y) {
            const std::size_t first = static_cast<std::size_t>(y) * each, end = std::min(first + each, lamp.rows.size());
            for (std::size_t row = first; row < end; ++row)
                strip.at(x, y) += lamp.rows[row].pixels.columns[column] * static_cast<float>(lamp.rows[row].level);
            strip.at(x, y) /= static_cast<float>(end - first);
        }
    }
    return strip;
}

} // namespace

std::string levels_csv(const std::vector<PixelLevels>& lamps) {
    std::size_t told = 0, moments = 0;
    for (const PixelLevels& lamp : lamps) {
        told = std::max(told, lamp.count <= most_told_levels ? lamp.count : 0);
        moments = std::max(moments, lamp.rows.size());
    }
    std::string out = "time_s,lamp,level,lit,of,flux,dark";
    for (std::size_t i = 1; i <= told; ++i)
        out += fmt::format(",level_{}", i);
    out += "\r\n";
    for (std::size_t moment = 0; moment < moments; ++moment)
        for (const PixelLevels& lamp : lamps) {
            if (moment >= lamp.rows.size())
                continue;
            const PixelLevels::Row& row = lamp.rows[moment];
            std::string dark;
            for (const AngleBox& box : row.pixels.dark)
                dark += (dark.empty() ? "" : " ") + box_text(box);
            if (row.pixels.more_dark > 0)
                dark += fmt::format(" and {} more", row.pixels.more_dark);
            out += fmt::format("{:.9g},{},{:.6g},{},{},{:.6g},{}", row.time_s, csv_text(lamp.lamp), row.level, row.pixels.lit, lamp.count,
                               row.pixels.flux, dark);
            for (std::size_t i = 0; i < told; ++i)
                out += i < row.levels.size() ? fmt::format(",{:.6g}", row.levels[i]) : ",";
            out += "\r\n";
        }
    return out;
}

std::optional<plots::Figure> levels_figure(const PixelLevels& lamp, const std::string& lamp_set) {
    if (lamp.rows.empty() || lamp.columns_deg.empty() || lamp.columns_deg.front().first >= lamp.columns_deg.back().second)
        return std::nullopt;
    plots::Figure figure;
    figure.title = short_text(lamp_set, 24) + ", " + short_text(lamp.lamp, 24);
    figure.subtitle = fmt::format("{} parts; seen as by the driver, time runs downwards", lamp.count);
    figure.width_px = 640.0;
    figure.height_px = 440.0;
    const std::size_t each = moments_a_line(lamp), lines = (lamp.rows.size() + each - 1) / each;
    const double first_s = lamp.rows.front().time_s,
                 step_s = lamp.rows.size() > 1 ? (lamp.rows.back().time_s - first_s) / static_cast<double>(lamp.rows.size() - 1) : 1.0,
                 end_s = first_s + step_s * static_cast<double>(lines * each);
    figure.x = {"H", "deg", lamp.columns_deg.front().first, lamp.columns_deg.back().second};
    figure.y = {"time", "s", end_s, first_s};
    figure.grid = false;
    figure.colour_bar = plots::ColourBar{{"mean level of the column", "", 0.0, 1.0}};
    figure.rasters.push_back(
        {plots::heat_map(strip_of(lamp), figure.colour_bar->axis, no_part), figure.x.from, figure.x.to, first_s, end_s});
    constexpr double gap = std::numeric_limits<double>::quiet_NaN();
    std::vector<std::pair<std::string, bool>> users;
    for (const PixelLevels::Row& row : lamp.rows)
        for (const PixelLevels::Other& other : row.others)
            if (std::ranges::find(users, std::pair(other.name, other.oncoming)) == users.end())
                users.emplace_back(other.name, other.oncoming);
    bool named[2] = {};
    for (const auto& user : users) {
        const bool oncoming = user.second;
        plots::Series edges[2];
        for (std::size_t i = 0; i < lamp.rows.size(); i += each) {
            const PixelLevels::Row& row = lamp.rows[i];
            const auto other = std::ranges::find_if(
                row.others, [&](const PixelLevels::Other& one) { return one.name == user.first && one.oncoming == oncoming; });
            const bool there = other != row.others.end();
            edges[0].points.push_back({there ? other->left_deg : gap, row.time_s + 0.5 * step_s});
            edges[1].points.push_back({there ? other->right_deg : gap, row.time_s + 0.5 * step_s});
        }
        for (plots::Series& edge : edges) { // bright on dark, so that it shows on lit and dark columns alike
            figure.series.push_back({.points = edge.points, .colour = shade, .width_px = 3.0});
            edge.colour = oncoming ? oncoming_colour : ahead_colour;
            edge.width_px = 1.4;
        }
        if (!std::exchange(named[oncoming ? 1 : 0], true))
            edges[0].name = oncoming ? "edges of oncoming road users" : "edges of preceding road users";
        for (plots::Series& edge : edges)
            figure.series.push_back(std::move(edge));
    }
    return figure;
}

} // namespace fernlicht
