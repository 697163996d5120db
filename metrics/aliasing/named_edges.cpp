#include "metrics/aliasing/named_edges.h"

#include "metrics/aliasing/spatial_aliasing.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace fernlicht {
namespace {

// How far a drawn line may lie from the true one and still be the same line: texels of a coarse beam are many pixels wide, a mark's border
// is drawn within one. The others stand in the header.
constexpr int reach_px = 2;
constexpr double shadow_share = 0.02, least_contrast = 2.0, background_px = 4.0, straight_px = 2.0, cut_off_search_px = 16.0,
                 mark_search_px = 1.0;

void check(const Image<float>& tested, const EdgeReference& reference, const Image<float>& fine) {
    const auto fits = [&](const auto& picture) {
        return picture.width() == reference.k * tested.width() && picture.height() == reference.k * tested.height();
    };
    if (reference.k < 1 || tested.empty() || !fits(fine) || !fits(reference.ground))
        throw std::invalid_argument(fmt::format("edges in {}x{} pixels cannot be held against {}x{}, {} times as fine", tested.width(),
                                                tested.height(), fine.width(), fine.height(), reference.k));
}

/// For each pixel, the share of its samples of which `is` is true.
template <class Is> cv::Mat shares(int width, int height, int k, Is is) {
    cv::Mat out(height, width, CV_32FC1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            int count = 0;
            for (int j = y * k; j < (y + 1) * k; ++j)
                for (int i = x * k; i < (x + 1) * k; ++i)
                    count += is(i, j) ? 1 : 0;
            out.at<float>(y, x) = static_cast<float>(count) / static_cast<float>(k * k);
        }
    return out;
}

/// The largest within reach_px each way.
cv::Mat largest_around(const cv::Mat& picture) {
    cv::Mat out;
    cv::dilate(picture, out, cv::getStructuringElement(cv::MORPH_RECT, {2 * reach_px + 1, 2 * reach_px + 1}));
    return out;
}

Image<std::uint8_t> where_true(const cv::Mat& condition) {
    Image<std::uint8_t> out(condition.cols, condition.rows);
    for (int y = 0; y < condition.rows; ++y)
        for (int x = 0; x < condition.cols; ++x)
            out.at(x, y) = condition.at<std::uint8_t>(y, x) != 0 ? 1 : 0;
    return out;
}

/// The mean of each group of k x k.
Image<float> averaged(const Image<float>& fine, int k) {
    Image<float> out(fine.width() / k, fine.height() / k);
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x) {
            double sum = 0.0;
            for (int j = 0; j < k; ++j)
                for (int i = 0; i < k; ++i)
                    sum += static_cast<double>(fine.at(x * k + i, y * k + j));
            out.at(x, y) = static_cast<float>(sum / (k * k));
        }
    return out;
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
    const int k = reference.k;
    cv::Mat sum(share.rows, share.cols, CV_32FC1);
    for (int y = 0; y < share.rows; ++y)
        for (int x = 0; x < share.cols; ++x) {
            double of = 0.0;
            for (int j = y * k; j < (y + 1) * k; ++j)
                for (int i = x * k; i < (x + 1) * k; ++i)
                    of += reference.ground.at(i, j) == kind ? static_cast<double>(reference.luminance_cdm2.at(i, j)) : 0.0;
            sum.at<float>(y, x) = static_cast<float>(of / (k * k));
        }
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
    for (int y = 0; y < is_mark.rows; ++y)
        for (int x = 0; x < is_mark.cols; ++x)
            is_mark.at<float>(y, x) = reference.ground.at(x, y) == Ground::mark ? 1.0F : 0.0F;
    const int blur_px = reference.k + (reference.k % 2 == 0 ? 1 : 0); // odd, so that it moves nothing
    cv::blur(is_mark, blurred, {blur_px, blur_px});
    Image<float> out(is_mark.cols, is_mark.rows);
    for (int y = 0; y < is_mark.rows; ++y)
        for (int x = 0; x < is_mark.cols; ++x)
            out.at(x, y) = blurred.at<float>(y, x);
    return out;
}

} // namespace

std::optional<EdgeJaggedness> cut_off_jaggedness(const Image<float>& tested_lx, const EdgeReference& reference, double level_lx) {
    check(tested_lx, reference, reference.illuminance_lx);
    check(tested_lx, reference, reference.unshadowed_lx);
    const cv::Mat disturbed = shares(tested_lx.width(), tested_lx.height(), reference.k, [&](int x, int y) {
        const double lit = static_cast<double>(reference.illuminance_lx.at(x, y));
        const double free = static_cast<double>(reference.unshadowed_lx.at(x, y));
        return reference.ground.at(x, y) == Ground::other || std::abs(lit - free) > shadow_share * free;
    });
    const Image<std::uint8_t> where = where_true(largest_around(disturbed) <= 0.0);
    return with_floor(tested_lx, averaged(reference.illuminance_lx, reference.k), reference.illuminance_lx, reference.k, level_lx,
                      cut_off_search_px, where);
}

std::optional<EdgeJaggedness> mark_jaggedness(const Image<float>& tested_cdm2, const EdgeReference& reference) {
    check(tested_cdm2, reference, reference.luminance_cdm2);
    const auto share_of = [&](Ground kind) {
        return shares(tested_cdm2.width(), tested_cdm2.height(), reference.k,
                      [&](int x, int y) { return reference.ground.at(x, y) == kind; });
    };
    const cv::Mat road_share = share_of(Ground::road), mark_share = share_of(Ground::mark), other_share = share_of(Ground::other);
    const cv::Mat road = brightness_of(Ground::road, reference, road_share), mark = brightness_of(Ground::mark, reference, mark_share);
    const cv::Mat lit = (mark - road >= least_seen_cdm2) & (mark >= least_contrast * road);
    cv::Mat around; // half along a straight border, less at corners, at the ends of dashes and on marks too narrow to tell
    cv::GaussianBlur(mark_share, around, {0, 0}, straight_px);
    const cv::Mat straight = (around >= 0.3) & (around <= 0.7);
    const Image<std::uint8_t> where = where_true((largest_around(other_share) <= 0.0) & (largest_around(road_share) >= 1.0) &
                                                 (largest_around(mark_share) >= 1.0) & straight & lit);
    const Image<float> perfect = between(averaged(reference.luminance_cdm2, reference.k), road, mark, where);
    return with_floor(between(tested_cdm2, road, mark, where), perfect, coverage(reference), reference.k, 0.5, mark_search_px, where);
}

} // namespace fernlicht
