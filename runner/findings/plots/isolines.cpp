#include "runner/findings/plots/isolines.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <stdexcept>

namespace fernlicht::plots {
namespace {

/// An edge of the grid by number: horizontal edges are even, vertical ones odd. A line crosses an edge at most once and meets at most
/// two segments there, so the segments form chains and rings.
using Edge = std::size_t;
using Segments = std::vector<std::pair<Edge, Edge>>;

Edge horizontal(const Grid& g, std::size_t ix, std::size_t iy) { return 2 * (iy * g.x.size() + ix); }
Edge vertical(const Grid& g, std::size_t ix, std::size_t iy) { return 2 * (iy * g.x.size() + ix) + 1; }

Point crossing(const Grid& g, Edge edge, double level) {
    const std::size_t ix = edge / 2 % g.x.size(), iy = edge / 2 / g.x.size();
    const std::size_t jx = edge % 2 == 0 ? ix + 1 : ix, jy = edge % 2 == 0 ? iy : iy + 1;
    const double a = g.at(ix, iy), b = g.at(jx, jy);
    const double t = (level - a) / (b - a);
    return {g.x[ix] + t * (g.x[jx] - g.x[ix]), g.y[iy] + t * (g.y[jy] - g.y[iy])};
}

void add_cell(const Grid& g, std::size_t ix, std::size_t iy, double level, Segments& segments) {
    const std::array<double, 4> corner{g.at(ix, iy), g.at(ix + 1, iy), g.at(ix + 1, iy + 1), g.at(ix, iy + 1)};
    const std::array<Edge, 4> edge{horizontal(g, ix, iy), vertical(g, ix + 1, iy), horizontal(g, ix, iy + 1), vertical(g, ix, iy)};
    std::array<bool, 4> inside{};
    double mean = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        if (!std::isfinite(corner[i]))
            return;
        inside[i] = corner[i] >= level;
        mean += corner[i] / 4.0;
    }
    std::vector<Edge> crossed; // edge i lies between corners i and i + 1
    for (std::size_t i = 0; i < 4; ++i)
        if (inside[i] != inside[(i + 1) % 4])
            crossed.push_back(edge[i]);
    if (crossed.size() == 2) {
        segments.emplace_back(crossed[0], crossed[1]);
    } else if (crossed.size() == 4) {
        // Saddle: with the middle like corner 0, corners 1 and 3 are cut off, each by the two edges that meet there; else 0 and 2.
        const bool like_first = (mean >= level) == inside[0];
        segments.emplace_back(edge[0], like_first ? edge[1] : edge[3]);
        segments.emplace_back(edge[2], like_first ? edge[3] : edge[1]);
    }
}

/// Walks one chain from `start` and removes its segments.
std::vector<Edge> chain_from(Edge start, std::multimap<Edge, std::size_t>& at, const Segments& segments, std::vector<bool>& used) {
    std::vector<Edge> chain{start};
    for (bool further = true; further;) {
        further = false;
        const auto [first, last] = at.equal_range(chain.back());
        for (auto it = first; it != last && !further; ++it) {
            if (used[it->second])
                continue;
            used[it->second] = true;
            const auto& [a, b] = segments[it->second];
            chain.push_back(a == chain.back() ? b : a);
            further = true;
        }
    }
    return chain;
}

} // namespace

std::vector<Polyline> isolines(const Grid& grid, double level) {
    if (grid.values.size() != grid.x.size() * grid.y.size())
        throw std::invalid_argument("isolines: as many values as x times y samples are needed");
    Segments segments;
    for (std::size_t iy = 0; iy + 1 < grid.y.size(); ++iy)
        for (std::size_t ix = 0; ix + 1 < grid.x.size(); ++ix)
            add_cell(grid, ix, iy, level, segments);

    std::multimap<Edge, std::size_t> at;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        at.emplace(segments[i].first, i);
        at.emplace(segments[i].second, i);
    }
    std::vector<bool> used(segments.size(), false);
    std::vector<Polyline> lines;
    const auto add_chain = [&](Edge start) {
        Polyline line;
        for (const Edge edge : chain_from(start, at, segments, used))
            line.push_back(crossing(grid, edge, level));
        if (line.size() > 1)
            lines.push_back(std::move(line));
    };
    for (const auto& [edge, segment] : at) // chains first, from their loose ends; what is left are rings
        if (!used[segment] && at.count(edge) == 1)
            add_chain(edge);
    for (std::size_t i = 0; i < segments.size(); ++i)
        if (!used[i])
            add_chain(segments[i].first);
    return lines;
}

} // namespace fernlicht::plots
