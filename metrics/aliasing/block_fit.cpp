#include "metrics/aliasing/block_fit.h"

#include "metrics/aliasing/band_limit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fernlicht {
namespace {

constexpr std::size_t block_side = static_cast<std::size_t>(block_side_px);

const Block& weights() {
    static const Block squares = [] {
        Block w = block_window();
        for (double& value : w)
            value *= value;
        return w;
    }();
    return squares;
}

double product(const Block& a, const Block& b) {
    const Block& w = weights();
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += w[i] * a[i] * b[i];
    return sum;
}

/// Solves m c = b for a symmetric positive definite m, row after row, by Cholesky's decomposition; `m` and `b` are used up.
std::vector<double> solved(std::vector<double>& m, std::vector<double>& b) {
    const std::size_t n = b.size();
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = j; i < n; ++i) {
            double sum = m[i * n + j];
            for (std::size_t k = 0; k < j; ++k)
                sum -= m[i * n + k] * m[j * n + k];
            m[i * n + j] = i == j ? std::sqrt(sum) : sum / m[j * n + j];
        }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k)
            b[i] -= m[i * n + k] * b[k];
        b[i] /= m[i * n + i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k)
            b[i] -= m[k * n + i] * b[k];
        b[i] /= m[i * n + i];
    }
    return std::move(b);
}

} // namespace

Block block_at(const Image<double>& picture, int left, int top) {
    Block block;
    block.reserve(block_side * block_side);
    for (int y = 0; y < block_side_px; ++y)
        for (int x = 0; x < block_side_px; ++x)
            block.push_back(picture.at(mirrored(left + x, picture.width()), mirrored(top + y, picture.height())));
    return block;
}

const Block& block_window() {
    static const Block window = [] {
        Block w;
        const auto along = [](int i) { return std::sin(std::numbers::pi * (i + 0.5) / block_side_px); };
        for (int y = 0; y < block_side_px; ++y)
            for (int x = 0; x < block_side_px; ++x)
                w.push_back(along(x) * along(y));
        return w;
    }();
    return window;
}

std::vector<Block> symmetric_shifts(const Image<double>& picture, int left, int top, int reach) {
    std::vector<Block> shifts;
    for (int dy = 0; dy <= reach; ++dy)
        for (int dx = dy == 0 ? 0 : -reach; dx <= reach; ++dx) {
            Block both = block_at(picture, left + dx, top + dy);
            const Block other = block_at(picture, left - dx, top - dy);
            for (std::size_t i = 0; i < both.size(); ++i)
                both[i] = 0.5 * (both[i] + other[i]);
            shifts.push_back(std::move(both));
        }
    return shifts;
}

void remove_slope(Block& block) {
    // The weights are symmetric about the block's middle: level, slope along x and slope along y are orthogonal.
    const Block& w = weights();
    const double middle = 0.5 * (block_side_px - 1);
    double weight = 0.0, square = 0.0, level = 0.0, along_x = 0.0, along_y = 0.0;
    for (std::size_t i = 0; i < block.size(); ++i) {
        const double x = static_cast<double>(i % block_side) - middle, y = static_cast<double>(i / block_side) - middle;
        weight += w[i];
        square += w[i] * x * x;
        level += w[i] * block[i];
        along_x += w[i] * x * block[i];
        along_y += w[i] * y * block[i];
    }
    for (std::size_t i = 0; i < block.size(); ++i) {
        const double x = static_cast<double>(i % block_side) - middle, y = static_cast<double>(i / block_side) - middle;
        block[i] -= level / weight + (along_x * x + along_y * y) / square;
    }
}

double energy_of(const Block& block) { return product(block, block); }

Block nearest_combination(const Block& target, const std::vector<Block>& parts, double price) {
    Block nearest(target.size(), 0.0);
    if (energy_of(target) == 0.0 || price == 0.0)
        return nearest;
    const std::size_t n = parts.size();
    std::vector<double> m(n * n), b(n);
    // Parts may all but coincide, and their rounding errors (1e-16 of the largest) must not make the matrix indefinite.
    for (const Block& part : parts)
        price = std::max(price, 1e-12 * energy_of(part));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j <= i; ++j)
            m[i * n + j] = product(parts[i], parts[j]);
        m[i * n + i] += price;
        b[i] = product(target, parts[i]);
    }
    const std::vector<double> coefficients = solved(m, b);
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < nearest.size(); ++i)
            nearest[i] += coefficients[j] * parts[j][i];
    return nearest;
}

} // namespace fernlicht
