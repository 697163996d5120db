#include "metrics/aliasing/optical_flow.h"

#include "metrics/aliasing/spatial_aliasing.h"
#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <optional>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr int min_px = 32;
constexpr double structure_px = 4.0, full_rms = 4.0;
constexpr int contrast_window_px = 9;
/// Of pixels that are off by rounding alone, 1/12 each in the square: their difference over two pixels, halved.
constexpr double rounding_eigenvalue = 1.0 / 24.0;

void check(const Image<float>& from, const Image<float>& to) {
    if (from.width() != to.width() || from.height() != to.height() || std::min(from.width(), from.height()) < min_px)
        throw std::invalid_argument(fmt::format("motion from {}x{} to {}x{} pixels cannot be told; both must have one size of at least "
                                                "{} each way",
                                                from.width(), from.height(), to.width(), to.height(), min_px));
    for (const Image<float>* picture : {&from, &to})
        for (const float value : picture->pixels())
            if (!std::isfinite(value))
                throw std::invalid_argument(fmt::format("a pixel is {}", value));
}

double level_of(float luminance_cdm2) { return std::log1p(std::max(0.0, static_cast<double>(luminance_cdm2)) / min_seen_cdm2); }

/// Headlamps light the road alike from frame to frame, so what they do to it stands on the screen while the road moves: taken out.
cv::Mat structure_of(const Image<float>& picture) {
    cv::Mat levels(picture.height(), picture.width(), CV_32FC1), slow;
    std::ranges::transform(picture.pixels(), levels.begin<float>(), [](float v) { return static_cast<float>(level_of(v)); });
    cv::GaussianBlur(levels, slow, {0, 0}, structure_px);
    return levels - slow;
}

/// The contrast that fills a byte.
double full_of(const cv::Mat& a, const cv::Mat& b) {
    return std::max(1e-3, full_rms * std::sqrt(0.5 * (a.dot(a) + b.dot(b)) / static_cast<double>(a.total())));
}

cv::Mat bytes_of(const cv::Mat& structure, double full) {
    cv::Mat bytes;
    structure.convertTo(bytes, CV_8UC1, 127.0 / full, 128.0);
    return bytes;
}

/// Between pixels' centres, linear; (x, y) are pixels with centres at whole numbers, clamped to the picture.
double between_pixels(const Image<float>& picture, double x, double y) {
    x = std::clamp(x, 0.0, picture.width() - 1.0);
    y = std::clamp(y, 0.0, picture.height() - 1.0);
    const int left = static_cast<int>(x), upper = static_cast<int>(y);
    const int right = std::min(left + 1, picture.width() - 1), lower = std::min(upper + 1, picture.height() - 1);
    const auto value = [&](int i, int j) { return static_cast<double>(picture.at(i, j)); };
    const double tx = x - left, ty = y - upper;
    return (1.0 - ty) * ((1.0 - tx) * value(left, upper) + tx * value(right, upper)) +
           ty * ((1.0 - tx) * value(left, lower) + tx * value(right, lower));
}

} // namespace

Flow optical_flow(const Image<float>& from, const Image<float>& to, FlowMethod method) {
    check(from, to);
    const cv::Mat a = structure_of(from), b = structure_of(to);
    const double full = full_of(a, b);
    const cv::Mat first = bytes_of(a, full), second = bytes_of(b, full);
    cv::Mat flow;
    if (method == FlowMethod::dis) {
        const cv::Ptr<cv::DISOpticalFlow> search = cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_MEDIUM);
        search->setFinestScale(0); // the preset's 1 stops at half the resolution
        search->setPatchStride(3);
        search->setGradientDescentIterations(50); // with the other two, half the error of the preset (docs/decisions/0006)
        search->calc(first, second, flow);
    } else {
        constexpr int levels = 5, window_px = 15, rounds = 5, polynomial_px = 7;
        constexpr double halved = 0.5, polynomial_sigma_px = 1.5;
        cv::calcOpticalFlowFarneback(first, second, flow, halved, levels, window_px, rounds, polynomial_px, polynomial_sigma_px, 0);
    }
    Flow out{Image<float>(from.width(), from.height()), Image<float>(from.width(), from.height())};
    std::transform(flow.begin<cv::Vec2f>(), flow.end<cv::Vec2f>(), out.dx_px.pixels().begin(), [](const cv::Vec2f& at) { return at[0]; });
    std::transform(flow.begin<cv::Vec2f>(), flow.end<cv::Vec2f>(), out.dy_px.pixels().begin(), [](const cv::Vec2f& at) { return at[1]; });
    return out;
}

Image<std::uint8_t> has_contrast(const Image<float>& picture, const Image<float>& step_cdm2) {
    check(picture, picture);
    const bool rounded = step_cdm2.size() != 0;
    if (rounded && (step_cdm2.width() != picture.width() || step_cdm2.height() != picture.height()))
        throw std::invalid_argument("a picture and its steps have one size");
    const cv::Mat structure = structure_of(picture);
    cv::Mat bytes;
    const double full = full_of(structure, structure);
    bytes_of(structure, full).convertTo(bytes, CV_32FC1);
    cv::Mat along_x, along_y;
    cv::Sobel(bytes, along_x, CV_32F, 1, 0, 1, 0.5, 0.0, cv::BORDER_REFLECT); // (right - left) / 2
    cv::Sobel(bytes, along_y, CV_32F, 0, 1, 1, 0.5, 0.0, cv::BORDER_REFLECT);
    const auto mean = [](const cv::Mat& product) {
        cv::Mat out;
        cv::boxFilter(product, out, CV_32F, {contrast_window_px, contrast_window_px}, {-1, -1}, true, cv::BORDER_REFLECT);
        return out;
    };
    const cv::Mat xx = mean(along_x.mul(along_x)), yy = mean(along_y.mul(along_y)), xy = mean(along_x.mul(along_y));
    cv::Mat steps(picture.height(), picture.width(), CV_32FC1, cv::Scalar(0.0)); // of the picture's own rounding, in bytes, squared
    for (int y = 0; rounded && y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const double from = static_cast<double>(picture.at(x, y)), to = from + static_cast<double>(step_cdm2.at(x, y));
            const double step = (level_of(static_cast<float>(to)) - level_of(picture.at(x, y))) * 127.0 / full;
            steps.at<float>(y, x) = static_cast<float>(step * step);
        }
    steps = mean(steps);
    Image<std::uint8_t> found(picture.width(), picture.height());
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const double explained = rounding_eigenvalue * (1.0 + static_cast<double>(steps.at<float>(y, x)));
            const double a = static_cast<double>(xx.at<float>(y, x)), b = static_cast<double>(yy.at<float>(y, x));
            const double eigenvalue = 0.5 * (a + b) - std::hypot(0.5 * (a - b), static_cast<double>(xy.at<float>(y, x)));
            found.at(x, y) = eigenvalue > 4.0 * explained ? 1 : 0;
        }
    return found;
}

Image<std::uint8_t> found_again(const Flow& there, const Flow& back, double max_px) {
    const int width = there.dx_px.width(), height = there.dx_px.height();
    if (back.dx_px.width() != width || back.dx_px.height() != height)
        throw std::invalid_argument("motion there and back is of pictures of one size");
    Image<std::uint8_t> found(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double dx = static_cast<double>(there.dx_px.at(x, y)), dy = static_cast<double>(there.dy_px.at(x, y));
            const double at_x = x + dx, at_y = y + dy;
            if (!(at_x >= 0.0 && at_y >= 0.0 && at_x <= width - 1.0 && at_y <= height - 1.0))
                continue;
            const double off = std::hypot(dx + between_pixels(back.dx_px, at_x, at_y), dy + between_pixels(back.dy_px, at_x, at_y));
            found.at(x, y) = off <= max_px ? 1 : 0;
        }
    return found;
}

FlowError flow_error(const std::vector<FlowPair>& pairs) {
    FlowError error;
    std::vector<double> off, lengths;
    std::size_t far = 0;
    for (const FlowPair& pair : pairs) {
        const std::size_t size = pair.known_at.size();
        for (const std::size_t other :
             {pair.estimated.dx_px.size(), pair.estimated.dy_px.size(), pair.kept.size(), pair.known.dx_px.size(), pair.known.dy_px.size()})
            if (other != size)
                throw std::invalid_argument("motions of pictures of one size can be held against each other");
        for (std::size_t i = 0; i < size; ++i) {
            if (pair.known_at.pixels()[i] == 0)
                continue;
            ++error.points;
            const double dx = static_cast<double>(pair.known.dx_px.pixels()[i]), dy = static_cast<double>(pair.known.dy_px.pixels()[i]);
            lengths.push_back(std::hypot(dx, dy));
            if (pair.kept.pixels()[i] == 0)
                continue;
            off.push_back(std::hypot(static_cast<double>(pair.estimated.dx_px.pixels()[i]) - dx,
                                     static_cast<double>(pair.estimated.dy_px.pixels()[i]) - dy));
            error.mean_px += off.back();
            far += off.back() > 0.5 ? 1U : 0U;
        }
    }
    if (error.points == 0)
        return error;
    error.left_out_percent = 100.0 * static_cast<double>(error.points - off.size()) / static_cast<double>(error.points);
    error.known_motion_px = middle_of(lengths);
    if (off.empty())
        return error;
    error.mean_px /= static_cast<double>(off.size());
    error.far_percent = 100.0 * static_cast<double>(far) / static_cast<double>(off.size());
    error.median_px = middle_of(off);
    return error;
}

namespace {

constexpr int taps = 16, box_px = 33;

/// Motion from one picture to a neighbour, and where it can be trusted.
struct Step {
    Flow flow;
    Image<std::uint8_t> kept;
};

std::pair<Step, Step> steps_between(const Image<float>& a, const Image<float>& b, FlowMethod method) {
    Step there{optical_flow(a, b, method), {}}, back{optical_flow(b, a, method), {}};
    there.kept = found_again(there.flow, back.flow, max_return_px);
    back.kept = found_again(back.flow, there.flow, max_return_px);
    return {std::move(there), std::move(back)};
}

double return_px(const Step& back, const Place& from, const Place& to) {
    return std::hypot(to.x + between_pixels(back.flow.dx_px, to.x, to.y) - from.x,
                      to.y + between_pixels(back.flow.dy_px, to.x, to.y) - from.y);
}

std::optional<Place> stepped(const Step& step, const Place& at) {
    const int width = step.kept.width(), height = step.kept.height();
    if (step.kept.at(static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y))) == 0)
        return std::nullopt;
    const Place to{at.x + between_pixels(step.flow.dx_px, at.x, at.y), at.y + between_pixels(step.flow.dy_px, at.x, at.y)};
    if (!(to.x >= 0.0 && to.y >= 0.0 && to.x <= width - 1.0 && to.y <= height - 1.0))
        return std::nullopt;
    return to;
}

/// Weights of the pixels floor(at) - 7 ... floor(at) + 8; their sum is 1.
std::array<double, taps> sinc_weights(double at) {
    constexpr int half = taps / 2;
    std::array<double, taps> weights{};
    double sum = 0.0;
    for (int i = 0; i < taps; ++i) {
        const double x = i - (half - 1) - (at - std::floor(at)), angle = std::numbers::pi * x, share = x / half;
        const double sinc = angle == 0.0 ? 1.0 : std::sin(angle) / angle;
        weights[static_cast<std::size_t>(i)] = sinc * (0.5 + 0.5 * std::cos(std::numbers::pi * share));
        sum += weights[static_cast<std::size_t>(i)];
    }
    for (double& weight : weights)
        weight /= sum;
    return weights;
}

double value_at(const Image<float>& picture, const Place& at) {
    if (at.x == std::floor(at.x) && at.y == std::floor(at.y)) // a pixel's own, exactly
        return static_cast<double>(picture.at(static_cast<int>(at.x), static_cast<int>(at.y)));
    const auto along_x = sinc_weights(at.x), along_y = sinc_weights(at.y);
    const int left = static_cast<int>(std::floor(at.x)) - (taps / 2 - 1), top = static_cast<int>(std::floor(at.y)) - (taps / 2 - 1);
    double sum = 0.0;
    for (int j = 0; j < taps; ++j) {
        double row = 0.0;
        for (int i = 0; i < taps; ++i)
            row += along_x[static_cast<std::size_t>(i)] *
                   static_cast<double>(picture.at(mirrored(left + i, picture.width()), mirrored(top + j, picture.height())));
        sum += along_y[static_cast<std::size_t>(j)] * row;
    }
    return sum;
}

/// The r.m.s. over the pixels around each.
cv::Mat levels_of(const Image<float>& picture) {
    cv::Mat values(picture.height(), picture.width(), CV_32FC1), squares;
    std::ranges::copy(picture.pixels(), values.begin<float>());
    cv::sqrBoxFilter(values, squares, CV_64F, {box_px, box_px}, {-1, -1}, true, cv::BORDER_REFLECT);
    return squares;
}

} // namespace

FlowPaths paths_by_flow(const std::vector<Image<float>>& pictures, std::size_t from, int stride, FlowMethod method,
                        const Image<float>& step_cdm2) {
    if (from >= pictures.size() || stride < 1)
        throw std::invalid_argument(fmt::format("picture {} of {} is not there to start from", from, pictures.size()));
    std::vector<Step> later, earlier; // from picture t to t + 1, and from t + 1 to t
    for (std::size_t t = 0; t + 1 < pictures.size(); ++t) {
        auto [there, back] = steps_between(pictures[t], pictures[t + 1], method);
        later.push_back(std::move(there));
        earlier.push_back(std::move(back));
    }
    FlowPaths found;
    const Image<std::uint8_t> contrast = has_contrast(pictures[from], step_cdm2);
    std::vector<double> motions, returns;
    for (int y = stride / 2; y < pictures[from].height(); y += stride)
        for (int x = stride / 2; x < pictures[from].width(); x += stride) {
            ++found.started;
            if (contrast.at(x, y) == 0) {
                ++found.flat;
                continue;
            }
            Path path(pictures.size(), Place{static_cast<double>(x), static_cast<double>(y)});
            std::vector<double> path_motions, path_returns;
            const auto follow = [&](const Step& there, const Step& back, std::size_t start, std::size_t end) {
                const auto to = stepped(there, path[start]);
                if (!to)
                    return false;
                path[end] = *to;
                path_motions.push_back(std::hypot(to->x - path[start].x, to->y - path[start].y));
                path_returns.push_back(return_px(back, path[start], *to));
                return true;
            };
            bool followed = true;
            for (std::size_t t = from; followed && t + 1 < pictures.size(); ++t)
                followed = follow(later[t], earlier[t], t, t + 1);
            for (std::size_t t = from; followed && t > 0; --t)
                followed = follow(earlier[t - 1], later[t - 1], t, t - 1);
            if (!followed)
                continue;
            motions.insert(motions.end(), path_motions.begin(), path_motions.end());
            returns.insert(returns.end(), path_returns.begin(), path_returns.end());
            found.paths.push_back(std::move(path));
        }
    found.median_motion_px = middle_of(std::move(motions));
    found.median_return_px = middle_of(std::move(returns));
    return found;
}

PixelTrack track_of(const Path& path, int width, int height) {
    PixelTrack track;
    for (const Place& at : path) {
        const int x = std::clamp(static_cast<int>(std::lround(at.x)), 0, width - 1);
        const int y = std::clamp(static_cast<int>(std::lround(at.y)), 0, height - 1);
        track.push_back(y * width + x);
    }
    return track;
}

std::vector<TrackSamples> samples_along(const std::vector<Path>& paths, const std::vector<Image<float>>& pictures) {
    std::vector<TrackSamples> samples(paths.size());
    for (std::size_t t = 0; t < pictures.size(); ++t) {
        const cv::Mat squares = levels_of(pictures[t]);
        for (std::size_t i = 0; i < paths.size(); ++i) {
            const Place& at = paths[i][t];
            samples[i].values.push_back(value_at(pictures[t], at));
            const double square = squares.at<double>(static_cast<int>(std::lround(at.y)), static_cast<int>(std::lround(at.x)));
            samples[i].level += std::sqrt(std::max(0.0, square)) / static_cast<double>(pictures.size());
        }
    }
    return samples;
}

} // namespace fernlicht
