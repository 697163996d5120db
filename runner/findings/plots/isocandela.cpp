#include "runner/findings/plots/isocandela.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht::plots {
namespace {

/// Round step for the window's edges: a few of them across it.
double edge_step(double width_deg) { return width_deg > 120.0 ? 10.0 : width_deg > 30.0 ? 5.0 : width_deg > 5.0 ? 2.0 : 0.5; }

/// The directions with at least `min_cd` and a little room round them. It shows what lies outside the table only where the table
/// ends in the midst of such light.
AngleWindow window_of(const CandelaTable& t, double min_cd) {
    AngleWindow w{t.h_deg.back(), t.h_deg.front(), t.v_deg.back(), t.v_deg.front()};
    for (std::size_t v = 0; v < t.v_deg.size(); ++v) {
        for (std::size_t h = 0; h < t.h_deg.size(); ++h) {
            if (t.at(v, h) < min_cd)
                continue;
            w = {std::min(w.left_deg, t.h_deg[h]), std::max(w.right_deg, t.h_deg[h]), std::min(w.bottom_deg, t.v_deg[v]),
                 std::max(w.top_deg, t.v_deg[v])};
        }
    }
    const double h_step = edge_step(w.right_deg - w.left_deg), v_step = edge_step(w.top_deg - w.bottom_deg);
    const auto below = [](double edge, double step, double room, double table_edge, double limit) {
        return std::max(step * std::floor(edge / step - room), edge > table_edge ? table_edge : limit);
    };
    const auto above = [](double edge, double step, double room, double table_edge, double limit) {
        return std::min(step * std::ceil(edge / step + room), edge < table_edge ? table_edge : limit);
    };
    return {below(w.left_deg, h_step, 0.5, t.h_deg.front(), -180.0), above(w.right_deg, h_step, 0.5, t.h_deg.back(), 180.0),
            below(w.bottom_deg, v_step, 1.0, t.v_deg.front(), -90.0), above(w.top_deg, v_step, 1.0, t.v_deg.back(), 90.0)};
}

/// A direction the table says something of.
bool known(const CandelaTable& t, double h, double v) {
    if (h < t.h_deg.front() || h > t.h_deg.back() || v < t.v_deg.front() || v > t.v_deg.back())
        return false;
    if (t.gaps.empty())
        return true;
    const auto cell = [](const std::vector<double>& axis, double at) {
        const auto above = static_cast<std::size_t>(std::upper_bound(axis.begin(), axis.end(), at) - axis.begin());
        return std::min(above, axis.size() - 1) - 1;
    };
    return t.gaps[cell(t.v_deg, v) * (t.h_deg.size() - 1) + cell(t.h_deg, h)] == 0;
}

/// 1, 2, 5, 10 ... that lie between low and high.
std::vector<double> round_levels(double low, double high) {
    std::vector<double> levels;
    for (double decade = std::pow(10.0, std::floor(std::log10(low))); decade <= high; decade *= 10.0)
        for (const double digit : {1.0, 2.0, 5.0})
            if (digit * decade >= low && digit * decade <= high)
                levels.push_back(digit * decade);
    return levels;
}

/// Lux over the window, row by row from the top; NaN where the table says nothing.
Grid sampled(const CandelaTable& t, const AngleWindow& w, int columns, int rows) {
    Grid g;
    for (int i = 0; i < columns; ++i)
        g.x.push_back(w.left_deg + (w.right_deg - w.left_deg) * (i + 0.5) / columns);
    for (int j = 0; j < rows; ++j)
        g.y.push_back(w.top_deg - (w.top_deg - w.bottom_deg) * (j + 0.5) / rows);
    for (const double v : g.y)
        for (const double h : g.x)
            g.values.push_back(known(t, h, v) ? intensity_cd(t, h, v) / cd_per_lx_at_25_m : std::numeric_limits<double>::quiet_NaN());
    return g;
}

Image<float> image_of(const Grid& g) {
    Image<float> image(static_cast<int>(g.x.size()), static_cast<int>(g.y.size()));
    std::transform(g.values.begin(), g.values.end(), image.pixels().begin(), [](double lx) { return static_cast<float>(lx); });
    return image;
}

} // namespace

/// Degrees of H and V are shown equally long unless the picture would become a ribbon or a tower.
void fit_height(Figure& f, const AngleWindow& w) {
    constexpr double beside_px = 160.0, around_px = 130.0;
    const double height = (f.width_px - beside_px) * (w.top_deg - w.bottom_deg) / (w.right_deg - w.left_deg) + around_px;
    f.equal_units = height >= 260.0 && height <= 900.0;
    f.height_px = std::clamp(std::round(height), 260.0, 900.0);
}

AngleWindow beam_window(const CandelaTable& table) { return window_of(table, 0.05 * peak_of(table).cd); }

std::vector<double> isocandela_levels_lx(double peak_cd) {
    return round_levels(peak_cd / cd_per_lx_at_25_m / 300.0, peak_cd / cd_per_lx_at_25_m);
}

Grid lux_over(const CandelaTable& table, const AngleWindow& w) {
    const int columns = 880,
              rows = std::clamp(static_cast<int>(columns * (w.top_deg - w.bottom_deg) / (w.right_deg - w.left_deg)), 400, 1200);
    return sampled(table, w, columns, rows);
}

Figure isocandela_diagram(const CandelaTable& table, const std::string& title, const std::optional<AngleWindow>& window,
                          double scale_peak_cd) {
    Figure f;
    f.title = title;
    f.width_px = 1040.0;
    const Peak peak = peak_of(table);
    if (!(peak.cd > 0.0)) {
        f.subtitle = "no light in any direction";
        f.x = {"H, right positive", "°", -10.0, 10.0};
        f.y = {"V, up positive", "°", -5.0, 5.0};
        return f;
    }
    const double peak_lx = peak.cd / cd_per_lx_at_25_m;
    const double scale_lx = scale_peak_cd > 0.0 ? scale_peak_cd / cd_per_lx_at_25_m : peak_lx;
    const AngleWindow w = window ? *window : beam_window(table);
    f.subtitle = fmt::format("lux at 25 m on a target facing the lamp (1 lx = 625 cd); peak {:.3g} lx at H {:.2f}°, V {:.2f}°", peak_lx,
                             peak.h_deg, peak.v_deg);
    f.x = {"H, right positive", "°", w.left_deg, w.right_deg};
    f.y = {"V, up positive", "°", w.bottom_deg, w.top_deg};
    fit_height(f, w);

    const double brightest = round_levels(scale_lx, 10.0 * scale_lx).front();
    f.colour_bar = ColourBar{{"E at 25 m", "lx", brightest / 1000.0, brightest, Scale::logarithmic}};
    const Grid grid = lux_over(table, w);
    f.rasters.push_back({heat_map(image_of(grid), f.colour_bar->axis, {225, 225, 225}), w.left_deg, w.right_deg, w.top_deg, w.bottom_deg});
    for (const double level : isocandela_levels_lx(scale_lx * cd_per_lx_at_25_m))
        f.isolines.push_back({number(level) + " lx", isolines(grid, level), {255, 255, 255}, 1.2});
    f.marks.push_back({Mark::Across::at_x, 0.0, "V-V", {235, 235, 235}});
    f.marks.push_back({Mark::Across::at_y, 0.0, "H-H", {235, 235, 235}});
    f.notes.push_back({peak.h_deg, peak.v_deg, "", {20, 20, 20}, true});
    return f;
}

} // namespace fernlicht::plots
