#include "metrics/display/night_vision.h"

#include "metrics/seeing/visibility.h"
#include "scenarios/display/display_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <tbb/parallel_for.h>
#include <vector>

namespace fernlicht {
namespace {

constexpr double adapts_deg = 1.0;
constexpr double min_fitted_cdm2 = 1.0e-3, tenth_deg_cycles = 0.34155; // sqrt(ln(10) / 2) / pi
constexpr double min_sigma_px = 0.2, sigma_ratio = 1.4142135623730951;
constexpr double min_mesopic_cdm2 = 1.0e-4, max_mesopic_cdm2 = 10.0;
constexpr int shares_a_decade = 100;

/// The share of cones by decades: computed once, as its iteration takes longer than a pixel may.
const std::array<float, 5 * shares_a_decade + 1>& cone_shares() {
    static const auto shares = [] {
        std::array<float, 5 * shares_a_decade + 1> table{};
        for (std::size_t i = 0; i < table.size(); ++i)
            table[i] =
                static_cast<float>(mesopic_luminance(min_mesopic_cdm2 * std::pow(10.0, static_cast<double>(i) / shares_a_decade), 1.0).m);
        return table;
    }();
    return shares;
}

cv::Mat matrix_of(const Image<glm::vec3>& picture) {
    // Only read.
    return {picture.height(), picture.width(), CV_32FC3, const_cast<glm::vec3*>(picture.data())};
}

/// Gaussians of 0.2 pixels and each sqrt(2) more, up to the widest that is needed; [0] is the picture itself.
std::vector<Image<glm::vec3>> blurred(const Image<glm::vec3>& light, double widest_px) {
    std::vector<Image<glm::vec3>> all{light};
    for (double sigma = min_sigma_px * sigma_ratio; all.back().width() > 0 && sigma < widest_px * sigma_ratio; sigma *= sigma_ratio) {
        Image<glm::vec3> next(light.width(), light.height());
        cv::Mat into = matrix_of(next);
        const int reach = 2 * static_cast<int>(std::ceil(4.0 * sigma)) + 1;
        cv::GaussianBlur(matrix_of(light), into, {reach, reach}, sigma, sigma, cv::BORDER_REPLICATE);
        all.push_back(std::move(next));
    }
    return all;
}

} // namespace

double acuity_cycles_per_deg(double adaptation_cdm2) {
    return 17.25 * std::atan(1.4 * std::log10(std::max(adaptation_cdm2, min_fitted_cdm2)) + 0.35) + 25.72;
}

double cone_share(double adaptation_cdm2) {
    if (!(adaptation_cdm2 > min_mesopic_cdm2))
        return 0.0;
    if (adaptation_cdm2 >= max_mesopic_cdm2)
        return 1.0;
    const double at = shares_a_decade * std::log10(adaptation_cdm2 / min_mesopic_cdm2);
    const auto i = std::min(static_cast<std::size_t>(at), cone_shares().size() - 2);
    return std::lerp(static_cast<double>(cone_shares()[i]), static_cast<double>(cone_shares()[i + 1]), at - static_cast<double>(i));
}

double rod_luminance_cdm2(const glm::dvec3& light) {
    static const glm::dmat3 to_xyz = xyz_from_light();
    static const double of_white = [] {
        const glm::dvec3 white = to_xyz * glm::dvec3(1.0);
        return 1.33 * (1.0 + (white.y + white.z) / white.x) - 1.68;
    }();
    const glm::dvec3 xyz = to_xyz * light;
    return xyz.x > 0.0 ? std::max(xyz.y * (1.33 * (1.0 + (xyz.y + xyz.z) / xyz.x) - 1.68) / of_white, 0.0) : 0.0;
}

Image<float> adaptation_cdm2(const Image<glm::vec3>& light, double pixel_deg) {
    const int half = static_cast<int>(std::lround(0.5 * adapts_deg / pixel_deg));
    const int width = light.width(), height = light.height();
    // Sums from the top left corner; in double, since a bright source must not take the digits of the dark beside it.
    std::vector<double> sums(static_cast<std::size_t>(width + 1) * static_cast<std::size_t>(height + 1), 0.0);
    const auto at = [&](int x, int y) -> double& {
        return sums[static_cast<std::size_t>(y) * static_cast<std::size_t>(width + 1) + static_cast<std::size_t>(x)];
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const glm::vec3& rgb = light.at(x, y);
            const double l =
                0.2126 * static_cast<double>(rgb.x) + 0.7152 * static_cast<double>(rgb.y) + 0.0722 * static_cast<double>(rgb.z);
            at(x + 1, y + 1) = l + at(x, y + 1) + at(x + 1, y) - at(x, y);
        }
    Image<float> mean(width, height);
    tbb::parallel_for(0, height, [&](int y) {
        const int top = std::max(y - half, 0), bottom = std::min(y + half + 1, height);
        for (int x = 0; x < width; ++x) {
            const int left = std::max(x - half, 0), right = std::min(x + half + 1, width);
            const double sum = at(right, bottom) - at(left, bottom) - at(right, top) + at(left, top);
            mean.at(x, y) = static_cast<float>(std::max(sum, 0.0) / ((right - left) * (bottom - top)));
        }
    });
    return mean;
}

Image<glm::vec3> colours_at_night(const Image<glm::vec3>& light, double pixel_deg, const glm::dvec3& grey) {
    const Image<float> adapted = adaptation_cdm2(light, pixel_deg);
    Image<glm::vec3> seen = light;
    tbb::parallel_for(0, light.height(), [&](int y) {
        for (int x = 0; x < light.width(); ++x)
            if (const double m = cone_share(static_cast<double>(adapted.at(x, y))); m < 1.0) {
                const glm::dvec3 rgb(light.at(x, y));
                seen.at(x, y) = glm::vec3(m * rgb + (1.0 - m) * rod_luminance_cdm2(rgb) * grey);
            }
    });
    return seen;
}

Image<glm::vec3> sharpness_at_night(const Image<glm::vec3>& light, double pixel_deg) {
    if (light.empty())
        return light;
    const Image<float> adapted = adaptation_cdm2(light, pixel_deg);
    const auto sigma_px = [&](int x, int y) {
        return tenth_deg_cycles / acuity_cycles_per_deg(static_cast<double>(adapted.at(x, y))) / pixel_deg;
    };
    double widest = 0.0;
    for (int y = 0; y < light.height(); ++y)
        for (int x = 0; x < light.width(); ++x)
            widest = std::max(widest, sigma_px(x, y));
    const std::vector<Image<glm::vec3>> levels = blurred(light, widest);
    Image<glm::vec3> seen = light;
    tbb::parallel_for(0, light.height(), [&](int y) {
        for (int x = 0; x < light.width(); ++x) {
            const double level = std::log(sigma_px(x, y) / min_sigma_px) / std::log(sigma_ratio);
            if (!(level > 0.0))
                continue;
            const auto below = std::min(static_cast<std::size_t>(level), levels.size() - 2);
            const auto between = static_cast<float>(std::min(level - static_cast<double>(below), 1.0));
            seen.at(x, y) = (1.0F - between) * levels[below].at(x, y) + between * levels[below + 1].at(x, y);
        }
    });
    return seen;
}

} // namespace fernlicht
