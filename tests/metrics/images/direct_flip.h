// FLIP as the paper writes it, pixel by pixel with two-dimensional filters in double precision: slow, and independent of what it checks.
#pragma once

#include "scenarios/drives/play/frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

namespace fernlicht::tests {

class DirectFlip {
    using Colour = std::array<double, 3>;
    using Plane = std::vector<Colour>; ///< rows of width_
    static constexpr double pi_ = 3.14159265358979323846;
    static constexpr Colour white_{10135552.0 / 24577794 + 8788810.0 / 24577794 + 4435075.0 / 24577794, 1.0,
                                   1425312.0 / 73733382 + 8788810.0 / 73733382 + 70074185.0 / 73733382};

  public:
    DirectFlip(int width, int height, double pixels_per_degree) : width_(width), height_(height), ppd_(pixels_per_degree) {}

    /// Of linear colours 0..1.
    std::vector<double> errors(const Plane& tested, const Plane& reference) const {
        const Seen a = see(tested), b = see(reference);
        const double largest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), 0.7);
        std::vector<double> out;
        for (std::size_t i = 0; i < a.colour.size(); ++i) {
            const double power = std::pow(hyab(a.colour[i], b.colour[i]), 0.7), knee = 0.4 * largest;
            const double colour = power < knee ? 0.95 / knee * power : 0.95 + (power - knee) / (largest - knee) * 0.05;
            const double feature = std::sqrt(std::max(std::abs(a.edge[i] - b.edge[i]), std::abs(a.point[i] - b.point[i])) / std::sqrt(2.0));
            out.push_back(std::pow(colour, 1.0 - feature));
        }
        return out;
    }
    std::vector<double> errors(const Image<Rgb8>& tested, const Image<Rgb8>& reference) const {
        return errors(linear(tested), linear(reference));
    }

    /// The error of two even pictures: no filter changes them, no feature is in them.
    static double of_even(const Colour& tested, const Colour& reference) {
        return DirectFlip(1, 1, 67.0).errors(Plane{tested}, Plane{reference})[0];
    }

    static Plane linear(const Image<Rgb8>& picture) {
        const auto decoded = [](int level) {
            const double c = level / 255.0;
            return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
        };
        Plane out;
        for (const Rgb8& p : picture.pixels())
            out.push_back({decoded(p.r), decoded(p.g), decoded(p.b)});
        return out;
    }

  private:
    struct Seen {
        Plane colour; ///< L*, a*, b* after Hunt
        std::vector<double> edge, point;
    };
    using Kernel = std::function<double(double x, double y)>;

    static Colour xyz(const Colour& c) {
        return {(10135552 * c[0] + 8788810 * c[1] + 4435075 * c[2]) / 24577794,
                (2613072 * c[0] + 8788810 * c[1] + 887015 * c[2]) / 12288897,
                (1425312 * c[0] + 8788810 * c[1] + 70074185 * c[2]) / 73733382};
    }
    static Colour opponent(const Colour& c) {
        const Colour v = xyz(c);
        const double x = v[0] / white_[0], y = v[1], z = v[2] / white_[2];
        return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
    }
    /// Cramer's rule on the matrix above, so that no second table of digits can be wrong.
    static Colour rgb_of_opponent(const Colour& o) {
        const double y = (o[0] + 16) / 116;
        const Colour v{(y + o[1] / 500) * white_[0], y, (y - o[2] / 200) * white_[2]};
        const Colour r = xyz({1, 0, 0}), g = xyz({0, 1, 0}), b = xyz({0, 0, 1});
        const auto det = [](const Colour& p, const Colour& q, const Colour& s) {
            return p[0] * (q[1] * s[2] - q[2] * s[1]) - q[0] * (p[1] * s[2] - p[2] * s[1]) + s[0] * (p[1] * q[2] - p[2] * q[1]);
        };
        const double all = det(r, g, b);
        const auto unit = [](double c) { return std::clamp(c, 0.0, 1.0); };
        return {unit(det(v, g, b) / all), unit(det(r, v, b) / all), unit(det(r, g, v) / all)};
    }
    static Colour hunt_lab(const Colour& rgb) {
        const Colour v = xyz(rgb);
        const auto f = [](double t) { return t > std::pow(6.0 / 29, 3) ? std::cbrt(t) : t / (3 * std::pow(6.0 / 29, 2)) + 4.0 / 29; };
        const double x = f(v[0] / white_[0]), y = f(v[1]), z = f(v[2] / white_[2]), l = 116 * y - 16;
        return {l, 0.01 * l * 500 * (x - y), 0.01 * l * 200 * (y - z)};
    }
    static double hyab(const Colour& p, const Colour& q) { return std::abs(p[0] - q[0]) + std::hypot(p[1] - q[1], p[2] - q[2]); }

    /// Sum of kernel times value around each pixel; positive weights divided by their sum, negative ones by theirs.
    std::vector<double> filtered(const Plane& in, std::size_t channel, int radius, const Kernel& kernel) const {
        double positive = 0, negative = 0;
        std::vector<double> weights;
        for (int y = -radius; y <= radius; ++y)
            for (int x = -radius; x <= radius; ++x) {
                weights.push_back(kernel(x, y));
                (weights.back() > 0 ? positive : negative) += std::abs(weights.back());
            }
        for (double& weight : weights)
            weight = weight == 0 ? 0 : weight / (weight > 0 ? positive : negative);
        std::vector<double> out;
        for (int py = 0; py < height_; ++py)
            for (int px = 0; px < width_; ++px) {
                double sum = 0;
                const double* weight = weights.data();
                for (int y = -radius; y <= radius; ++y)
                    for (int x = -radius; x <= radius; ++x, ++weight) {
                        const int ix = std::clamp(px + x, 0, width_ - 1), iy = std::clamp(py + y, 0, height_ - 1);
                        sum += *weight * in[static_cast<std::size_t>(iy * width_ + ix)][channel];
                    }
                out.push_back(sum);
            }
        return out;
    }

    Seen see(const Plane& rgb) const {
        Plane opponents;
        for (const Colour& c : rgb)
            opponents.push_back(opponent(c));
        const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi_ * pi_)) * ppd_));
        const auto sensitivity = [&](double a1, double b1, double a2, double b2) {
            return [=, ppd = ppd_](double x, double y) {
                const double d2 = (x * x + y * y) / (ppd * ppd);
                return a1 * std::sqrt(pi_ / b1) * std::exp(-pi_ * pi_ * d2 / b1) +
                       a2 * std::sqrt(pi_ / b2) * std::exp(-pi_ * pi_ * d2 / b2);
            };
        };
        const auto y = filtered(opponents, 0, radius, sensitivity(1, 0.0047, 0, 1e-5));
        const auto cx = filtered(opponents, 1, radius, sensitivity(1, 0.0053, 0, 1e-5));
        const auto cz = filtered(opponents, 2, radius, sensitivity(34.1, 0.04, 13.5, 0.025));
        Seen seen;
        for (std::size_t i = 0; i < y.size(); ++i)
            seen.colour.push_back(hunt_lab(rgb_of_opponent({y[i], cx[i], cz[i]})));
        Plane light = opponents;
        for (Colour& c : light)
            c[0] = (c[0] + 16) / 116;
        const double sd = 0.5 * 0.082 * ppd_;
        const int reach = static_cast<int>(std::ceil(3 * sd));
        const auto bell = [sd](double px, double py) { return std::exp(-(px * px + py * py) / (2 * sd * sd)); };
        const auto size_of = [&](const Kernel& along_x) {
            const auto gx = filtered(light, 0, reach, along_x);
            const auto gy = filtered(light, 0, reach, [&](double px, double py) { return along_x(py, px); });
            std::vector<double> size;
            for (std::size_t i = 0; i < gx.size(); ++i)
                size.push_back(std::hypot(gx[i], gy[i]));
            return size;
        };
        seen.edge = size_of([&](double px, double py) { return -px * bell(px, py); });
        seen.point = size_of([&](double px, double py) { return (px * px / (sd * sd) - 1) * bell(px, py); });
        return seen;
    }

    int width_, height_;
    double ppd_;
};

} // namespace fernlicht::tests
