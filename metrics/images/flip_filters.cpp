#include "metrics/images/flip_tile.h"

#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>

namespace fernlicht::flip {
namespace {

/// a sqrt(pi / b) exp(-(pi d)^2 / b), d in degrees: the contrast sensitivity as a filter in space.
struct Sensitivity {
    double a, b;
};
constexpr Sensitivity lightness{1.0, 0.0047}, red_green{1.0, 0.0053}, blue_yellow_wide{34.1, 0.04}, blue_yellow_narrow{13.5, 0.025};

constexpr double unseen = 0x1p-26;      // of a filter's sum; half a float's last digit is 2^-25
constexpr double feature_width = 0.082; // degrees, of the receptive fields for edges (section 4.2)

std::vector<double> gaussian(double b, double pixels_per_degree, int radius) {
    std::vector<double> half;
    for (int i = 0; i <= radius; ++i)
        half.push_back(std::exp(-std::pow(pi * i / pixels_per_degree, 2.0) / b));
    return half;
}

double both_sides(const std::vector<double>& half) {
    double sum = 0.0;
    for (std::size_t i = half.size(); i-- > 1;)
        sum += 2.0 * half[i];
    return sum + half[0];
}

/// Scaled to the sum `share`, without the tails that nobody sees.
HalfFilter scaled(std::vector<double> half, double share) {
    const double sum = both_sides(half);
    double tail = 0.0;
    while (half.size() > 1 && (tail += 2.0 * half.back()) < unseen * sum)
        half.pop_back();
    const double kept = both_sides(half);
    HalfFilter filter;
    for (const double weight : half)
        filter.weights.push_back(static_cast<float>(share * weight / kept));
    return filter;
}

/// Divided by what its positive and its negative weights sum to, each.
HalfFilter balanced(const std::vector<double>& half, bool odd) {
    double positive = half[0] > 0.0 ? half[0] : 0.0, negative = half[0] < 0.0 ? -half[0] : 0.0;
    for (std::size_t i = 1; i < half.size(); ++i) {
        const double size = std::abs(half[i]);
        positive += odd ? size : half[i] > 0.0 ? 2.0 * size : 0.0;
        negative += odd ? size : half[i] < 0.0 ? 2.0 * size : 0.0;
    }
    HalfFilter filter;
    for (const double weight : half)
        filter.weights.push_back(static_cast<float>(weight > 0.0 ? weight / positive : weight < 0.0 ? weight / negative : 0.0));
    return filter;
}

void add_features(Filters& filters, double pixels_per_degree) {
    const double deviation = 0.5 * feature_width * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3.0 * deviation));
    std::vector<double> smooth, first, second;
    for (int i = 0; i <= radius; ++i) {
        const double g = std::exp(-i * i / (2.0 * deviation * deviation));
        smooth.push_back(g);
        first.push_back(-i * g);
        second.push_back((i * i / (deviation * deviation) - 1.0) * g);
    }
    const double sum = both_sides(smooth);
    for (const double g : smooth)
        filters.gaussian.weights.push_back(static_cast<float>(g / sum));
    filters.edge = balanced(first, true);
    filters.point = balanced(second, false);
}

} // namespace

Filters filters_for(double pixels_per_degree) {
    Filters filters;
    const double widest = std::max({lightness.b, red_green.b, blue_yellow_wide.b, blue_yellow_narrow.b});
    const int radius = static_cast<int>(std::ceil(3.0 * std::sqrt(widest / (2.0 * pi * pi)) * pixels_per_degree));
    const auto along = [&](const Sensitivity& s) { return gaussian(s.b, pixels_per_degree, radius); };
    filters.y = scaled(along(lightness), 1.0);
    filters.cx = scaled(along(red_green), 1.0);
    const auto weight = [&](const Sensitivity& s) { return s.a * std::sqrt(pi / s.b) * std::pow(both_sides(along(s)), 2.0); };
    const double wide = weight(blue_yellow_wide) / (weight(blue_yellow_wide) + weight(blue_yellow_narrow));
    filters.cz_wide_across = scaled(along(blue_yellow_wide), wide);
    filters.cz_wide_down = scaled(along(blue_yellow_wide), 1.0);
    filters.cz_narrow_across = scaled(along(blue_yellow_narrow), 1.0 - wide);
    filters.cz_narrow_down = scaled(along(blue_yellow_narrow), 1.0);
    add_features(filters, pixels_per_degree);
    filters.radius = std::max(radius, filters.gaussian.radius());
    return filters;
}

} // namespace fernlicht::flip
