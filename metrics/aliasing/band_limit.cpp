#include "metrics/aliasing/spatial_aliasing.h"

#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <oneapi/tbb/parallel_for.h>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr int half_width_px = 32;
constexpr double beta = 6.0;

/// Weights of the samples from half_width_px before a pixel's centre to as many behind; their sum is 1.
std::vector<double> low_pass(int k) {
    const int count = 2 * half_width_px * k;
    std::vector<double> weights;
    double sum = 0.0;
    for (int i = 0; i < count; ++i) {
        const double x = (i + 0.5) / k - half_width_px, at = x / half_width_px, angle = std::numbers::pi * x;
        weights.push_back(std::sin(angle) / angle * std::cyl_bessel_i(0.0, beta * std::sqrt(1.0 - at * at)));
        sum += weights.back();
    }
    for (double& weight : weights)
        weight /= sum;
    return weights;
}

/// At the centre of every k-th group of k samples along x: filtered, transposed.
Image<double> filtered_along_x(const Image<double>& fine, int k, const std::vector<double>& weights) {
    const int count = static_cast<int>(weights.size()), before = count / 2 - k / 2;
    Image<double> out(fine.height(), fine.width() / k);
    oneapi::tbb::parallel_for(0, fine.height(), [&](int y) {
        std::vector<double> row(static_cast<std::size_t>(fine.width() + 2 * before));
        for (int i = 0; i < static_cast<int>(row.size()); ++i)
            row[static_cast<std::size_t>(i)] = fine.at(mirrored(i - before, fine.width()), y);
        for (int x = 0; x < out.height(); ++x) {
            double sum = 0.0;
            for (std::size_t i = 0; i < weights.size(); ++i)
                sum += weights[i] * row[static_cast<std::size_t>(x * k) + i];
            out.at(y, x) = sum;
        }
    });
    return out;
}

} // namespace

Image<double> finite_doubles(const Image<float>& picture, const char* what) {
    Image<double> values(picture.width(), picture.height());
    for (std::size_t i = 0; i < values.size(); ++i) {
        values.pixels()[i] = static_cast<double>(picture.pixels()[i]);
        if (!std::isfinite(values.pixels()[i]))
            throw std::invalid_argument(fmt::format("{}'s value {} is {}", what, i, values.pixels()[i]));
    }
    return values;
}

BandSplit split_bands(const Image<float>& reference, int k) {
    if (k < 4 || k % 2 != 0 || reference.empty() || reference.width() % k != 0 || reference.height() % k != 0)
        throw std::invalid_argument(
            fmt::format("a reference of {}x{} is not {} times as fine as a picture", reference.width(), reference.height(), k));
    const Image<double> fine = finite_doubles(reference, "the reference");
    const std::vector<double> weights = low_pass(k);
    BandSplit split{filtered_along_x(filtered_along_x(fine, k, weights), k, weights), {}};
    split.folded = split.ideal;
    for (int y = 0; y < split.ideal.height(); ++y)
        for (int x = 0; x < split.ideal.width(); ++x) {
            const int right = x * k + k / 2, lower = y * k + k / 2;
            const double centre =
                0.25 * ((fine.at(right - 1, lower - 1) + fine.at(right, lower - 1)) + (fine.at(right - 1, lower) + fine.at(right, lower)));
            split.folded.at(x, y) = centre - split.ideal.at(x, y);
        }
    return split;
}

void fourier_transform(std::span<std::complex<double>> values) {
    const std::size_t count = values.size();
    if (!std::has_single_bit(count))
        throw std::invalid_argument("a Fourier transform takes a power of two of values");
    for (std::size_t i = 1, reversed = 0; i < count; ++i) {
        std::size_t bit = count >> 1;
        for (; (reversed & bit) != 0; bit >>= 1)
            reversed ^= bit;
        reversed ^= bit;
        if (i < reversed)
            std::swap(values[i], values[reversed]);
    }
    for (std::size_t half = 1; half < count; half *= 2)
        for (std::size_t k = 0; k < half; ++k) {
            const std::complex<double> turn = std::polar(1.0, -std::numbers::pi * static_cast<double>(k) / static_cast<double>(half));
            for (std::size_t i = k; i < count; i += 2 * half) {
                const std::complex<double> odd = turn * values[i + half];
                values[i + half] = values[i] - odd;
                values[i] += odd;
            }
        }
}

void fourier_transform(std::vector<std::complex<double>>& block, std::size_t side) {
    if (block.size() != side * side)
        throw std::invalid_argument("a Fourier transform of a block takes a square");
    std::vector<std::complex<double>> column(side);
    for (std::size_t y = 0; y < side; ++y)
        fourier_transform(std::span(block).subspan(y * side, side));
    for (std::size_t x = 0; x < side; ++x) {
        for (std::size_t y = 0; y < side; ++y)
            column[y] = block[y * side + x];
        fourier_transform(std::span(column));
        for (std::size_t y = 0; y < side; ++y)
            block[y * side + x] = column[y];
    }
}

double bin_frequency(std::size_t k, std::size_t count) {
    const double f = static_cast<double>(k) / static_cast<double>(count);
    return f < 0.5 ? f : f - 1.0;
}

} // namespace fernlicht
