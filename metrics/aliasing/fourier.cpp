#include "metrics/aliasing/fourier.h"

#include <bit>
#include <numbers>
#include <stdexcept>

namespace fernlicht {

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
