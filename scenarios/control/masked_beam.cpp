#include "scenarios/control/masked_beam.h"

#include <algorithm>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr double same_deg = 1.0e-6; ///< samples nearer than this are one

double level_at(double h_deg, const std::vector<std::pair<double, double>>& windows_deg, const std::vector<double>& levels) {
    double level = 1.0;
    for (std::size_t i = 0; i < windows_deg.size(); ++i)
        if (h_deg >= windows_deg[i].first - same_deg && h_deg <= windows_deg[i].second + same_deg)
            level = std::min(level, levels[i]);
    return level;
}

/// The table's samples, and those where windows begin and end.
std::vector<double> axis_of(const CandelaTable& table, const std::vector<std::pair<double, double>>& windows_deg) {
    std::vector<double> wanted;
    for (const auto& [from, to] : windows_deg)
        for (const double edge : {from - window_edge_deg, from, to, to + window_edge_deg})
            if (edge > table.h_deg.front() && edge < table.h_deg.back())
                wanted.push_back(edge);
    std::vector<double> axis = table.h_deg;
    for (const double edge : wanted)
        if (std::ranges::none_of(axis, [&](double h) { return std::abs(h - edge) < same_deg; }))
            axis.push_back(edge);
    std::ranges::sort(axis);
    return axis;
}

} // namespace

CandelaTable masked(const CandelaTable& table, const std::vector<std::pair<double, double>>& windows_deg,
                    const std::vector<double>& levels) {
    if (levels.size() != windows_deg.size())
        throw std::invalid_argument("masked: as many levels as windows");
    CandelaTable out;
    out.h_deg = axis_of(table, windows_deg);
    out.v_deg = table.v_deg;
    out.rule = table.rule;
    for (const double v : out.v_deg)
        for (const double h : out.h_deg)
            out.cd.push_back(intensity_cd(table, h, v) * level_at(h, windows_deg, levels));
    if (table.gaps.empty())
        return out;
    const std::size_t cells = table.h_deg.size() - 1;
    for (std::size_t v = 0; v + 1 < out.v_deg.size(); ++v)
        for (std::size_t h = 0; h + 1 < out.h_deg.size(); ++h) {
            const double middle = 0.5 * (out.h_deg[h] + out.h_deg[h + 1]);
            const auto next = std::ranges::upper_bound(table.h_deg, middle);
            out.gaps.push_back(table.gaps[v * cells + static_cast<std::size_t>(next - table.h_deg.begin()) - 1]);
        }
    return out;
}

} // namespace fernlicht
