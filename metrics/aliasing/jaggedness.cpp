#include "metrics/aliasing/jaggedness.h"

#include "metrics/aliasing/spatial_aliasing.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

namespace fernlicht {
namespace {

constexpr double around_px = 32.0;
constexpr std::size_t fewest_points = 16;

struct Deviation {
    double x = 0.0, y = 0.0; ///< pixels, centres at .5
    double across_px = 0.0;
};

/// Where a straight line of samples at first, first + step ... crosses the level, as a coordinate; nullopt where it does not.
std::optional<double> crossing(double a, double b, double level, double at_a, double step) {
    if ((a < level) == (b < level))
        return std::nullopt;
    return at_a + step * (level - a) / (b - a);
}

/// The reference's crossing nearest to `at` along a row or a column of its samples, that rises as the tested one does.
std::optional<double> nearest_crossing(const Image<float>& reference, int k, double level, bool along_x, double at, double beside,
                                       bool rises, double search_px) {
    const int count = along_x ? reference.width() : reference.height(), lines = along_x ? reference.height() : reference.width();
    // The centre of a pixel lies between two lines of samples when k is even.
    const int line = std::clamp(static_cast<int>(std::lround(beside * k - 0.5)), 0, lines - 1);
    const auto value = [&](int i) { return static_cast<double>(along_x ? reference.at(i, line) : reference.at(line, i)); };
    const int first = std::max(0, static_cast<int>(std::floor((at - search_px) * k - 0.5)));
    const int last = std::min(count - 1, static_cast<int>(std::ceil((at + search_px) * k - 0.5)));
    std::optional<double> nearest;
    for (int i = first; i < last; ++i) {
        const auto found = crossing(value(i), value(i + 1), level, (i + 0.5) / k, 1.0 / k);
        if (found && (value(i) < level) == rises && std::abs(*found - at) <= search_px &&
            (!nearest || std::abs(*found - at) < std::abs(*nearest - at)))
            nearest = found;
    }
    return nearest;
}

/// How the picture rises about (x, y): under the derivative of a Gaussian of 2 pixels, which finds the direction of a step and not that of
/// its stairs (Canny 1986). In no particular unit.
std::pair<double, double> gradient(const Image<float>& picture, int x, int y) {
    constexpr int reach = 5;
    double along_x = 0.0, along_y = 0.0;
    for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx) {
            const double value =
                static_cast<double>(picture.at(std::clamp(x + dx, 0, picture.width() - 1), std::clamp(y + dy, 0, picture.height() - 1)));
            const double weighted = value * std::exp(-0.125 * (dx * dx + dy * dy));
            along_x += dx * weighted;
            along_y += dy * weighted;
        }
    return {along_x, along_y};
}

void add_crossings(const Image<float>& tested, const Image<float>& reference, int k, double level, bool along_x, double search_px,
                   const Image<std::uint8_t>& where, std::vector<Deviation>& deviations, Jaggedness& found) {
    for (int y = 0; y + (along_x ? 0 : 1) < tested.height(); ++y)
        for (int x = 0; x + (along_x ? 1 : 0) < tested.width(); ++x) {
            const double a = static_cast<double>(tested.at(x, y));
            const double b = static_cast<double>(along_x ? tested.at(x + 1, y) : tested.at(x, y + 1));
            const auto at = crossing(a, b, level, (along_x ? x : y) + 0.5, 1.0);
            if (!at || (!where.empty() && (where.at(x, y) == 0 || (along_x ? where.at(x + 1, y) : where.at(x, y + 1)) == 0)))
                continue;
            const auto [first_x, first_y] = gradient(tested, x, y);
            const auto [second_x, second_y] = gradient(tested, along_x ? x + 1 : x, along_x ? y : y + 1);
            const double gx = std::abs(first_x + second_x), gy = std::abs(first_y + second_y);
            if (along_x ? gx < gy : gy <= gx)
                continue; // the other direction takes this piece of the line
            const double beside = (along_x ? y : x) + 0.5;
            const auto expected = nearest_crossing(reference, k, level, along_x, *at, beside, a < level, search_px);
            if (!expected) {
                ++found.without;
                continue;
            }
            const double cosine = (along_x ? gx : gy) / std::hypot(gx, gy);
            deviations.push_back({along_x ? *at : beside, along_x ? beside : *at, (*at - *expected) * cosine});
        }
}

/// Each less the mean of those within around_px.
std::vector<double> without_slow(const std::vector<Deviation>& deviations) {
    std::vector<double> fast;
    for (const Deviation& one : deviations) {
        double sum = 0.0;
        std::size_t count = 0;
        for (const Deviation& other : deviations)
            if (std::abs(other.x - one.x) <= around_px && std::abs(other.y - one.y) <= around_px) {
                sum += other.across_px;
                ++count;
            }
        fast.push_back(one.across_px - sum / static_cast<double>(count));
    }
    return fast;
}

struct Piece {
    double points = 0.0, squares = 0.0;
};

/// Of the root of `mean`, a ratio of sums over pieces (Cochran 1977, Sampling Techniques, 6.4): neighbouring points go up and down
/// together.
double standard_error(const std::map<std::pair<int, int>, Piece>& pieces, double mean, std::size_t points) {
    if (pieces.size() < 2 || !(mean > 0.0))
        return 0.0;
    double spread = 0.0;
    for (const auto& [place, piece] : pieces)
        spread += (piece.squares - mean * piece.points) * (piece.squares - mean * piece.points);
    const double count = static_cast<double>(pieces.size());
    return std::sqrt(count / (count - 1.0) * spread) / static_cast<double>(points) / (2.0 * std::sqrt(mean));
}

} // namespace

std::optional<Jaggedness> measure_jaggedness(const Image<float>& tested, const Image<float>& reference, int k, double level,
                                             double search_px, const Image<std::uint8_t>& where) {
    if (k < 1 || (!where.empty() && (where.width() != tested.width() || where.height() != tested.height())) || tested.empty() ||
        reference.width() != k * tested.width() || reference.height() != k * tested.height() || !std::isfinite(level) || !(search_px > 0.0))
        throw std::invalid_argument(fmt::format("lines at {} in {}x{} pixels cannot be held against {}x{}, {} times as fine", level,
                                                tested.width(), tested.height(), reference.width(), reference.height(), k));
    Jaggedness found;
    std::vector<Deviation> deviations;
    add_crossings(tested, reference, k, level, true, search_px, where, deviations, found);
    add_crossings(tested, reference, k, level, false, search_px, where, deviations, found);
    if (deviations.size() < fewest_points)
        return std::nullopt;
    found.points = deviations.size();
    double squares = 0.0;
    std::map<std::pair<int, int>, Piece> pieces;
    const std::vector<double> fast = without_slow(deviations);
    for (std::size_t i = 0; i < fast.size(); ++i) {
        squares += fast[i] * fast[i];
        Piece& piece = pieces[{static_cast<int>(deviations[i].x / around_px), static_cast<int>(deviations[i].y / around_px)}];
        piece.points += 1.0;
        piece.squares += fast[i] * fast[i];
        found.worst_px = std::max(found.worst_px, std::abs(fast[i]));
    }
    const double mean = squares / static_cast<double>(found.points);
    found.rms_px = std::sqrt(mean);
    found.standard_error_px = standard_error(pieces, mean, found.points);
    return found;
}

namespace {

// How far a drawn line may lie from the true one and still be the same line: texels of a coarse beam are many pixels wide, a mark's border
// is drawn within one. The others stand in the header.
constexpr int reach_px = 2;
constexpr double shadow_share = 0.02, min_contrast = 2.0, background_px = 4.0, straight_px = 2.0, cut_off_search_px = 16.0,
                 mark_search_px = 1.0;

void check(const Image<float>& tested, const EdgeReference& reference, const Image<float>& fine) {
    const auto fits = [&](const auto& picture) {
        return picture.width() == reference.k * tested.width() && picture.height() == reference.k * tested.height();
    };
    if (reference.k < 1 || tested.empty() || !fits(fine) || !fits(reference.ground))
        throw std::invalid_argument(fmt::format("edges in {}x{} pixels cannot be held against {}x{}, {} times as fine", tested.width(),
                                                tested.height(), fine.width(), fine.height(), reference.k));
}

/// For each pixel, the mean of `value(x, y)` over its k x k samples.
template <class Value> cv::Mat means(int width, int height, int k, Value value) {
    cv::Mat out(height, width, CV_32FC1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double sum = 0.0;
            for (int j = y * k; j < (y + 1) * k; ++j)
                for (int i = x * k; i < (x + 1) * k; ++i)
                    sum += value(i, j);
            out.at<float>(y, x) = static_cast<float>(sum / (k * k));
        }
    return out;
}

/// The largest within reach_px each way.
cv::Mat largest_around(const cv::Mat& picture) {
    cv::Mat out;
    cv::dilate(picture, out, cv::getStructuringElement(cv::MORPH_RECT, {2 * reach_px + 1, 2 * reach_px + 1}));
    return out;
}

template <class Pixel> Image<Pixel> image_of(const cv::Mat& values) {
    Image<Pixel> out(values.cols, values.rows);
    std::copy(values.begin<Pixel>(), values.end<Pixel>(), out.pixels().begin());
    return out;
}

Image<float> averaged(const Image<float>& fine, int k) {
    return image_of<float>(means(fine.width() / k, fine.height() / k, k, [&](int x, int y) { return static_cast<double>(fine.at(x, y)); }));
}

std::optional<EdgeJaggedness> with_floor(const Image<float>& tested, const Image<float>& perfect, const Image<float>& line, int k,
                                         double level, double search_px, const Image<std::uint8_t>& where) {
    const auto found = measure_jaggedness(tested, line, k, level, search_px, where);
    if (!found)
        return std::nullopt;
    const auto least = measure_jaggedness(perfect, line, k, level, search_px, where);
    return EdgeJaggedness{*found, least ? least->rms_px : 0.0};
}

/// Brightness of one kind of ground around each pixel: the mean of its samples under a Gaussian; 0 where there are none within reach.
cv::Mat brightness_of(Ground kind, const EdgeReference& reference, const cv::Mat& share) {
    const cv::Mat sum = means(share.cols, share.rows, reference.k, [&](int x, int y) {
        return reference.ground.at(x, y) == kind ? static_cast<double>(reference.luminance_cdm2.at(x, y)) : 0.0;
    });
    cv::Mat above, below, out(share.rows, share.cols, CV_32FC1, cv::Scalar(0.0));
    cv::GaussianBlur(sum, above, {0, 0}, background_px);
    cv::GaussianBlur(share, below, {0, 0}, background_px);
    for (int y = 0; y < share.rows; ++y)
        for (int x = 0; x < share.cols; ++x)
            if (below.at<float>(y, x) > 1e-3F)
                out.at<float>(y, x) = above.at<float>(y, x) / below.at<float>(y, x);
    return out;
}

/// (L - road) / (mark - road): 0 on the road, 1 on a mark.
Image<float> between(const Image<float>& luminance, const cv::Mat& road, const cv::Mat& mark, const Image<std::uint8_t>& where) {
    Image<float> out(luminance.width(), luminance.height());
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            if (where.at(x, y) != 0)
                out.at(x, y) = (luminance.at(x, y) - road.at<float>(y, x)) / (mark.at<float>(y, x) - road.at<float>(y, x));
    return out;
}

/// Of each sample of the reference, how much of a pixel's area around it is mark.
Image<float> coverage(const EdgeReference& reference) {
    cv::Mat is_mark(reference.ground.height(), reference.ground.width(), CV_32FC1), blurred;
    std::ranges::transform(reference.ground.pixels(), is_mark.begin<float>(), [](Ground g) { return g == Ground::mark ? 1.0F : 0.0F; });
    const int blur_px = reference.k + (reference.k % 2 == 0 ? 1 : 0); // odd, so that it moves nothing
    cv::blur(is_mark, blurred, {blur_px, blur_px});
    return image_of<float>(blurred);
}

} // namespace

std::optional<EdgeJaggedness> cut_off_jaggedness(const Image<float>& tested_lx, const EdgeReference& reference, double level_lx) {
    check(tested_lx, reference, reference.illuminance_lx);
    check(tested_lx, reference, reference.unshadowed_lx);
    const cv::Mat disturbed = means(tested_lx.width(), tested_lx.height(), reference.k, [&](int x, int y) {
        const double lit = static_cast<double>(reference.illuminance_lx.at(x, y));
        const double free = static_cast<double>(reference.unshadowed_lx.at(x, y));
        return reference.ground.at(x, y) == Ground::other || std::abs(lit - free) > shadow_share * free ? 1.0 : 0.0;
    });
    const Image<std::uint8_t> where = image_of<std::uint8_t>(largest_around(disturbed) <= 0.0);
    return with_floor(tested_lx, averaged(reference.illuminance_lx, reference.k), reference.illuminance_lx, reference.k, level_lx,
                      cut_off_search_px, where);
}

std::optional<EdgeJaggedness> mark_jaggedness(const Image<float>& tested_cdm2, const EdgeReference& reference) {
    check(tested_cdm2, reference, reference.luminance_cdm2);
    const auto share_of = [&](Ground kind) {
        return means(tested_cdm2.width(), tested_cdm2.height(), reference.k,
                     [&](int x, int y) { return reference.ground.at(x, y) == kind ? 1.0 : 0.0; });
    };
    const cv::Mat road_share = share_of(Ground::road), mark_share = share_of(Ground::mark), other_share = share_of(Ground::other);
    const cv::Mat road = brightness_of(Ground::road, reference, road_share), mark = brightness_of(Ground::mark, reference, mark_share);
    const cv::Mat lit = (mark - road >= min_seen_cdm2) & (mark >= min_contrast * road);
    cv::Mat around; // half along a straight border, less at corners, at the ends of dashes and on marks too narrow to tell
    cv::GaussianBlur(mark_share, around, {0, 0}, straight_px);
    const cv::Mat straight = (around >= 0.3) & (around <= 0.7);
    const Image<std::uint8_t> where = image_of<std::uint8_t>((largest_around(other_share) <= 0.0) & (largest_around(road_share) >= 1.0) &
                                                             (largest_around(mark_share) >= 1.0) & straight & lit);
    const Image<float> perfect = between(averaged(reference.luminance_cdm2, reference.k), road, mark, where);
    return with_floor(between(tested_cdm2, road, mark, where), perfect, coverage(reference), reference.k, 0.5, mark_search_px, where);
}

} // namespace fernlicht
