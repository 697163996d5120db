#include "metrics/shadows/shadow_edges.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace fernlicht {
namespace {

constexpr double cm_per_m = 100.0;

/// Of the step before: the edge of the same direction nearest to where this one was; nullptr where that is another one.
const MatchedEdge* same_edge(const EdgeMatch& step, const MatchedEdge& edge) {
    const MatchedEdge* nearest = nullptr;
    for (const MatchedEdge& other : step.matched)
        if (other.truth.direction == edge.truth.direction &&
            (!nearest || std::abs(other.truth.at_m - edge.truth.at_m) < std::abs(nearest->truth.at_m - edge.truth.at_m)))
            nearest = &other;
    return nearest && std::abs(nearest->truth.at_m - edge.truth.at_m) <= 0.5 * same_edge_m ? nearest : nullptr;
}

} // namespace

std::vector<ShadowEdge> shadow_edges(const std::vector<std::optional<double>>& lit_shares, double pitch_m) {
    constexpr double half = 0.5;
    std::vector<ShadowEdge> edges;
    for (std::size_t i = 1; i < lit_shares.size(); ++i) {
        const std::optional<double>&a = lit_shares[i - 1], &b = lit_shares[i];
        if (!a || !b || (*a >= half) == (*b >= half))
            continue;
        edges.push_back({pitch_m * (static_cast<double>(i - 1) + (half - *a) / (*b - *a)), *b > *a ? 1 : -1});
    }
    return edges;
}

EdgeMatch match_edges(const std::vector<ShadowEdge>& truth, const std::vector<ShadowEdge>& drawn, double same_m) {
    // Needleman and Wunsch's alignment (1970): cost[i][j] of the first i true and j drawn edges.
    const std::size_t rows = truth.size() + 1, columns = drawn.size() + 1;
    const double alone = 0.5 * same_m;
    std::vector<double> cost(rows * columns, 0.0);
    const auto at = [&](std::size_t i, std::size_t j) -> double& { return cost[i * columns + j]; };
    const auto together = [&](std::size_t i, std::size_t j) {
        const ShadowEdge &t = truth[i - 1], &d = drawn[j - 1];
        return t.direction == d.direction ? std::abs(t.at_m - d.at_m) : std::numeric_limits<double>::infinity();
    };
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t j = 0; j < columns; ++j) {
            if (i == 0 || j == 0)
                at(i, j) = alone * static_cast<double>(i + j);
            else
                at(i, j) = std::min({at(i - 1, j - 1) + together(i, j), at(i - 1, j) + alone, at(i, j - 1) + alone});
        }
    EdgeMatch match;
    std::size_t i = truth.size(), j = drawn.size();
    while (i > 0 || j > 0) {
        if (i > 0 && j > 0 && together(i, j) < same_m && at(i, j) == at(i - 1, j - 1) + together(i, j)) {
            match.matched.push_back({truth[i - 1], drawn[j - 1].at_m - truth[i - 1].at_m});
            --i, --j;
        } else if (i > 0 && (j == 0 || at(i, j) == at(i - 1, j) + alone)) {
            ++match.lost;
            --i;
        } else {
            ++match.invented;
            --j;
        }
    }
    std::ranges::reverse(match.matched);
    return match;
}

EdgeMatch section_edges(const ShadowImages& images, int row, double pitch_m, double floor_lx) {
    check_sizes(images);
    std::vector<std::optional<double>> drawn, truth;
    for (int x = 0; x < images.true_lx.width(); ++x) {
        const auto degrees = shadow_degrees(images, x, row, floor_lx);
        drawn.push_back(degrees ? std::optional(1.0 - degrees->drawn) : std::nullopt);
        truth.push_back(degrees ? std::optional(1.0 - degrees->truth) : std::nullopt);
    }
    return match_edges(shadow_edges(truth, pitch_m), shadow_edges(drawn, pitch_m));
}

EdgeError edge_error(const std::vector<EdgeMatch>& sections) {
    EdgeError result;
    double squares = 0.0, worst = 0.0;
    for (const EdgeMatch& section : sections) {
        result.lost += section.lost;
        result.invented += section.invented;
        for (const MatchedEdge& edge : section.matched) {
            ++result.edges;
            squares += edge.error_m * edge.error_m;
            worst = std::max(worst, std::abs(edge.error_m));
        }
    }
    if (result.edges > 0) {
        result.rms_cm = cm_per_m * std::sqrt(squares / static_cast<double>(result.edges));
        result.worst_cm = cm_per_m * worst;
    }
    return result;
}

std::optional<double> shadow_crawl_cm(const std::vector<EdgeMatch>& steps) {
    std::vector<double> changes;
    for (std::size_t k = 1; k < steps.size(); ++k) {
        if (steps[k].true_edges() != steps[k - 1].true_edges())
            continue;
        for (const MatchedEdge& edge : steps[k].matched)
            if (const MatchedEdge* const before = same_edge(steps[k - 1], edge))
                changes.push_back(cm_per_m * (edge.error_m - before->error_m));
    }
    if (changes.size() < 2)
        return std::nullopt;
    return spread_of(changes)->standard_deviation;
}

namespace {

constexpr double surely = 0.9;

enum class Sure : std::uint8_t { no, lit, shadowed };

/// Least of each row's runs of 2 n + 1, then of the columns': whether all around are the same.
Image<Sure> beyond_doubt(const Image<Sure>& truth, int n) {
    const auto agree = [&](const Image<Sure>& from, int step_x, int step_y) {
        Image<Sure> out(from.width(), from.height());
        for (int y = 0; y < from.height(); ++y)
            for (int x = 0; x < from.width(); ++x) {
                Sure here = from.at(x, y);
                for (int i = -n; i <= n && here != Sure::no; ++i) {
                    const int nx = std::clamp(x + i * step_x, 0, from.width() - 1), ny = std::clamp(y + i * step_y, 0, from.height() - 1);
                    here = from.at(nx, ny) == here ? here : Sure::no;
                }
                out.at(x, y) = here;
            }
        return out;
    };
    return agree(agree(truth, 1, 0), 0, 1);
}

/// Empties the spot that holds a pixel; its size.
std::size_t take_spot(Image<std::uint8_t>& wrong, int x, int y) {
    const std::uint8_t kind = wrong.at(x, y);
    std::vector<std::pair<int, int>> open{{x, y}};
    wrong.at(x, y) = 0;
    std::size_t size = 0;
    while (!open.empty()) {
        const auto [px, py] = open.back();
        open.pop_back();
        ++size;
        for (int ny = std::max(0, py - 1); ny <= std::min(wrong.height() - 1, py + 1); ++ny)
            for (int nx = std::max(0, px - 1); nx <= std::min(wrong.width() - 1, px + 1); ++nx)
                if (wrong.at(nx, ny) == kind) {
                    wrong.at(nx, ny) = 0;
                    open.emplace_back(nx, ny);
                }
    }
    return size;
}

} // namespace

ShadowSpots& ShadowSpots::operator+=(const ShadowSpots& other) {
    acne += other.acne;
    acne_px += other.acne_px;
    leaks += other.leaks;
    leaks_px += other.leaks_px;
    sure_px += other.sure_px;
    return *this;
}

ShadowSpots shadow_spots(const ShadowImages& images, int doubt_px, double floor_lx) {
    check_sizes(images);
    if (doubt_px < 0)
        throw std::invalid_argument("shadows: a distance in doubt below 0");
    const int width = images.true_lx.width(), height = images.true_lx.height();
    constexpr std::uint8_t dark = 1, lit = 2;
    Image<Sure> truth(width, height);
    Image<std::uint8_t> wrong(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (const auto degrees = shadow_degrees(images, x, y, floor_lx)) {
                truth.at(x, y) = degrees->truth >= surely ? Sure::shadowed : degrees->truth <= 1.0 - surely ? Sure::lit : Sure::no;
                const bool drawn_dark = degrees->drawn > 0.5;
                if (truth.at(x, y) == Sure::lit && drawn_dark)
                    wrong.at(x, y) = dark;
                if (truth.at(x, y) == Sure::shadowed && !drawn_dark)
                    wrong.at(x, y) = lit;
            }
    const Image<Sure> sure = beyond_doubt(truth, doubt_px);
    ShadowSpots found;
    for (std::size_t i = 0; i < wrong.size(); ++i) {
        if (sure.pixels()[i] == Sure::no)
            wrong.pixels()[i] = 0;
        else
            ++found.sure_px;
    }
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (const std::uint8_t kind = wrong.at(x, y); kind != 0) {
                const std::size_t size = take_spot(wrong, x, y);
                ++(kind == dark ? found.acne : found.leaks);
                (kind == dark ? found.acne_px : found.leaks_px) += size;
            }
    return found;
}

} // namespace fernlicht
