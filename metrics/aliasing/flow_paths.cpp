#include "metrics/aliasing/flow_paths.h"

#include "metrics/aliasing/mirrored.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr int taps = 16, box_px = 33;

/// Motion from one picture to a neighbour, and where it can be trusted.
struct Step {
    Flow flow;
    Image<std::uint8_t> kept;
};

std::pair<Step, Step> steps_between(const Image<float>& a, const Image<float>& b, FlowMethod method) {
    Step there{optical_flow(a, b, method), {}}, back{optical_flow(b, a, method), {}};
    there.kept = found_again(there.flow, back.flow, most_return_px);
    back.kept = found_again(back.flow, there.flow, most_return_px);
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

double middle_of(std::vector<double> values) {
    if (values.empty())
        return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

/// Weights of the pixels floor(at) - 7 ... floor(at) + 8; their sum is 1.
std::array<double, taps> sinc_weights(double at) {
    std::array<double, taps> weights{};
    double sum = 0.0;
    for (int i = 0; i < taps; ++i) {
        const double x = i - (taps / 2 - 1) - (at - std::floor(at)), angle = std::numbers::pi * x, share = x / (taps / 2);
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
