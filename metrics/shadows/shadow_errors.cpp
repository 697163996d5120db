#include "metrics/shadows/shadow_errors.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace fernlicht {
namespace {

/// `area(x, y)`: of a pixel.
template <class Area> ShadowArea summed(const ShadowImages& images, double floor_lx, Area area) {
    if (!(floor_lx > 0.0))
        throw std::invalid_argument("shadows: the floor is not above 0 lx");
    ShadowArea sum;
    for (int y = 0; y < images.true_lx.height(); ++y)
        for (int x = 0; x < images.true_lx.width(); ++x) {
            const std::optional<ShadowDegrees> degrees = shadow_degrees(images, x, y, floor_lx);
            const double of_pixel = area(x, y);
            if (!degrees || !(of_pixel > 0.0))
                continue;
            sum.counted += of_pixel;
            sum.shadowed += of_pixel * degrees->truth;
            sum.wrongly_lit += of_pixel * std::max(0.0, degrees->truth - degrees->drawn);
            sum.wrongly_dark += of_pixel * std::max(0.0, degrees->drawn - degrees->truth);
        }
    return sum;
}

} // namespace

ShadowArea& ShadowArea::operator+=(const ShadowArea& other) {
    counted += other.counted;
    shadowed += other.shadowed;
    wrongly_lit += other.wrongly_lit;
    wrongly_dark += other.wrongly_dark;
    return *this;
}

void check_sizes(const ShadowImages& images) {
    const int width = images.true_lx.width(), height = images.true_lx.height();
    const auto fits = [&](const auto& image, bool may_be_empty) {
        return (may_be_empty && image.empty()) || (image.width() == width && image.height() == height);
    };
    if (!fits(images.drawn_lx, false) || !fits(images.unshadowed_lx, false) || !fits(images.drawn_unshadowed_lx, true) ||
        !fits(images.counts, true))
        throw std::invalid_argument("shadows: images of different sizes");
}

std::optional<ShadowDegrees> shadow_degrees(const ShadowImages& images, int x, int y, double floor_lx) {
    if (!images.counts.empty() && images.counts.at(x, y) == 0)
        return std::nullopt;
    const double free = static_cast<double>(images.unshadowed_lx.at(x, y)),
                 drawn_free = images.drawn_unshadowed_lx.empty() ? free : static_cast<double>(images.drawn_unshadowed_lx.at(x, y)),
                 drawn = static_cast<double>(images.drawn_lx.at(x, y)), truth = static_cast<double>(images.true_lx.at(x, y));
    if (!(free >= floor_lx) || !(drawn_free > 0.0) || !std::isfinite(free + drawn_free + drawn + truth))
        return std::nullopt;
    const auto degree = [](double lx, double free_lx) { return std::clamp(1.0 - lx / free_lx, 0.0, 1.0); };
    return ShadowDegrees{degree(drawn, drawn_free), degree(truth, free)};
}

ShadowArea shadow_area(const ShadowImages& images, double pixel_area, double floor_lx) {
    check_sizes(images);
    if (!(pixel_area > 0.0))
        throw std::invalid_argument("shadows: the area of a pixel is not above 0");
    return summed(images, floor_lx, [&](int, int) { return pixel_area; });
}

ShadowArea shadow_area(const ShadowImages& images, const Image<float>& areas, double floor_lx) {
    check_sizes(images);
    if (areas.width() != images.true_lx.width() || areas.height() != images.true_lx.height())
        throw std::invalid_argument("shadows: areas of another size than the images");
    return summed(images, floor_lx, [&](int x, int y) { return static_cast<double>(areas.at(x, y)); });
}

Image<float> shadow_differences(const ShadowImages& images, double floor_lx) {
    check_sizes(images);
    Image<float> out(images.true_lx.width(), images.true_lx.height());
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            if (const auto degrees = shadow_degrees(images, x, y, floor_lx))
                out.at(x, y) = static_cast<float>(degrees->truth - degrees->drawn);
    return out;
}

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

/// Connected spots and their pixels.
void count(const cv::Mat& wrong, std::size_t& spots, std::size_t& pixels) {
    cv::Mat labels;
    spots = static_cast<std::size_t>(cv::connectedComponents(wrong, labels, 8)) - 1; // the first is all that is right
    pixels = static_cast<std::size_t>(cv::countNonZero(wrong));
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
    ShadowSpots found;
    if (images.true_lx.empty())
        return found;
    cv::Mat lit(images.true_lx.height(), images.true_lx.width(), CV_8UC1, cv::Scalar(0)), shadowed = lit.clone(), dark = lit.clone();
    for (int y = 0; y < lit.rows; ++y)
        for (int x = 0; x < lit.cols; ++x)
            if (const auto degrees = shadow_degrees(images, x, y, floor_lx)) {
                lit.at<std::uint8_t>(y, x) = degrees->truth <= 1.0 - surely ? 255 : 0;
                shadowed.at<std::uint8_t>(y, x) = degrees->truth >= surely ? 255 : 0;
                dark.at<std::uint8_t>(y, x) = degrees->drawn > 0.5 ? 255 : 0;
            }
    for (cv::Mat* sure : {&lit, &shadowed}) {
        cv::erode(*sure, *sure, cv::getStructuringElement(cv::MORPH_RECT, {2 * doubt_px + 1, 2 * doubt_px + 1}));
        found.sure_px += static_cast<std::size_t>(cv::countNonZero(*sure));
    }
    count(lit & dark, found.acne, found.acne_px);
    count(shadowed & ~dark, found.leaks, found.leaks_px);
    return found;
}

} // namespace fernlicht
