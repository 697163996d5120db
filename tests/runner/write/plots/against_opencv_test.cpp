#include "runner/findings/plots/colour.h"
#include "runner/findings/plots/isolines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>
#include <vector>

// What docs/decisions/0006-opencv.md decides by figures: ours where OpenCV's would be worse.
namespace fernlicht::plots {
namespace {

/// A lamp of equal intensity in all directions 25 m before a wall: E = 10 lx cos^3. Distances from the 5 lx circle, r.m.s. in metres.
struct OffTheCircle {
    double ours_m = 0.0, pixels_m = 0.0;
};
OffTheCircle off_the_circle(double step_m) {
    constexpr double distance_m = 25.0, level_lx = 5.0;
    const double radius_m = distance_m * std::sqrt(std::pow(0.5, -2.0 / 3.0) - 1.0);
    const int count = static_cast<int>(std::lround(40.0 / step_m)) + 1;
    Grid grid;
    for (int i = 0; i < count; ++i) { // off the symmetry
        grid.x.push_back(-20.0 + i * step_m + 0.013);
        grid.y.push_back(-20.0 + i * step_m - 0.021);
    }
    cv::Mat inside(count, count, CV_8UC1);
    for (int y = 0; y < count; ++y)
        for (int x = 0; x < count; ++x) {
            const auto ix = static_cast<std::size_t>(x), iy = static_cast<std::size_t>(y);
            const double cosine = distance_m / std::hypot(distance_m, grid.x[ix], grid.y[iy]);
            grid.values.push_back(10.0 * cosine * cosine * cosine);
            inside.at<std::uint8_t>(y, x) = grid.values.back() >= level_lx ? 255 : 0;
        }
    const auto rms = [&](const std::vector<Point>& points) {
        double sum = 0.0;
        for (const Point& p : points)
            sum += (std::hypot(p.x, p.y) - radius_m) * (std::hypot(p.x, p.y) - radius_m);
        return std::sqrt(sum / static_cast<double>(points.size()));
    };
    std::vector<Point> ours, pixels;
    for (const Polyline& line : isolines(grid, level_lx))
        ours.insert(ours.end(), line.begin(), line.end());
    std::vector<std::vector<cv::Point>> contours;
    cv::findContours(inside, contours, cv::RETR_LIST, cv::CHAIN_APPROX_NONE);
    for (const auto& contour : contours)
        for (const cv::Point& p : contour)
            pixels.push_back({grid.x[static_cast<std::size_t>(p.x)], grid.y[static_cast<std::size_t>(p.y)]});
    return {rms(ours), rms(pixels)};
}

TEST(AgainstOpenCv, IsoluxLinesBetweenSamplesBeatContoursOfPixels) {
    for (const double step_m : {0.5, 0.25, 0.1}) {
        const OffTheCircle off = off_the_circle(step_m);
        EXPECT_LT(off.ours_m, 0.003 * step_m); // curvature within a cell: step^2 / (8 radius)
        EXPECT_GT(off.pixels_m, 0.3 * step_m); // half a pixel inwards
    }
}

using Rgb = std::array<double, 3>; // 0..1, as encoded

double linear(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
double encoded(double c) {
    c = std::clamp(c, 0.0, 1.0);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
}

/// CIELAB under D65 (CIE 15).
Rgb lab(const Rgb& c) {
    const double r = linear(c[0]), g = linear(c[1]), b = linear(c[2]);
    const auto f = [](double t) { return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0; };
    const double x = f((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047), y = f(0.2126729 * r + 0.7151522 * g + 0.0721750 * b);
    const double z = f((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

/// As those see it who lack one kind of cone: Machado, Oliveira and Fernandes (2009), severity 1.
using Seeing = std::array<double, 9>;
constexpr Seeing all_cones{1, 0, 0, 0, 1, 0, 0, 0, 1};
constexpr Seeing protan{0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116, 1.051998};
constexpr Seeing deutan{0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940, 0.968881};
constexpr Seeing tritan{1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733, 0.691367, 0.303900};

/// The smallest difference (CIE 1976) between colours a fifteenth of the map apart, in anybody's eyes.
double smallest_step(const std::vector<Rgb>& map) {
    double smallest = 1e9;
    for (const Seeing& m : {all_cones, protan, deutan, tritan})
        for (std::size_t i = 17; i < map.size(); i += 17) {
            std::array<Rgb, 2> pair;
            for (std::size_t s = 0; s < 2; ++s) {
                const Rgb& c = map[i - 17 * s];
                const double r = linear(c[0]), g = linear(c[1]), b = linear(c[2]);
                pair[s] = lab({encoded(m[0] * r + m[1] * g + m[2] * b), encoded(m[3] * r + m[4] * g + m[5] * b),
                               encoded(m[6] * r + m[7] * g + m[8] * b)});
            }
            smallest = std::min(smallest, std::hypot(pair[0][0] - pair[1][0], pair[0][1] - pair[1][1], pair[0][2] - pair[1][2]));
        }
    return smallest;
}

std::vector<Rgb> map_of_opencv(int which) {
    cv::Mat ramp(256, 1, CV_8UC1), colours;
    for (int i = 0; i < 256; ++i)
        ramp.at<std::uint8_t>(i) = static_cast<std::uint8_t>(i);
    cv::applyColorMap(ramp, colours, which);
    std::vector<Rgb> map;
    for (int i = 0; i < 256; ++i) {
        const auto& bgr = colours.at<cv::Vec3b>(i);
        map.push_back({bgr[2] / 255.0, bgr[1] / 255.0, bgr[0] / 255.0});
    }
    return map;
}

std::vector<Rgb> ours() {
    std::vector<Rgb> map;
    for (int i = 0; i < 256; ++i) {
        const Colour c = sequential(i / 255.0);
        map.push_back({c.r / 255.0, c.g / 255.0, c.b / 255.0});
    }
    return map;
}

/// How far lightness is off a straight line, r.m.s. of CIE L*.
double uneven(const std::vector<Rgb>& map) {
    const double first = lab(map.front())[0], last = lab(map.back())[0];
    double sum = 0.0;
    for (std::size_t i = 0; i < map.size(); ++i)
        sum += std::pow(lab(map[i])[0] - (first + (last - first) * static_cast<double>(i) / 255.0), 2.0);
    return std::sqrt(sum / 256.0);
}

TEST(AgainstOpenCv, TheSequentialMapIsAsEvenAsItsBestAndKeepsItsStepsForColourBlindEyes) {
    EXPECT_GT(smallest_step(ours()), smallest_step(map_of_opencv(cv::COLORMAP_VIRIDIS)));
    EXPECT_GT(smallest_step(ours()), smallest_step(map_of_opencv(cv::COLORMAP_CIVIDIS)));
    EXPECT_LT(uneven(ours()), uneven(map_of_opencv(cv::COLORMAP_VIRIDIS)));
    EXPECT_LT(uneven(ours()), 0.1 * uneven(map_of_opencv(cv::COLORMAP_TURBO)));
    EXPECT_GT(lab(ours().back())[0] - lab(ours().front())[0],
              lab(map_of_opencv(cv::COLORMAP_CIVIDIS).back())[0] - lab(map_of_opencv(cv::COLORMAP_CIVIDIS).front())[0]);
}

} // namespace
} // namespace fernlicht::plots
