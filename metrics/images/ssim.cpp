
#include "metrics/images/image_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <tbb/parallel_for.h>
#include <vector>

namespace fernlicht {
namespace {

constexpr int radius = 5;
constexpr double deviation_px = 1.5;

std::array<double, radius + 1> window() {
    std::array<double, radius + 1> half{};
    double sum = 0.0;
    for (int i = 0; i <= radius; ++i) {
        half[static_cast<std::size_t>(i)] = std::exp(-i * i / (2.0 * deviation_px * deviation_px));
        sum += (i == 0 ? 1.0 : 2.0) * half[static_cast<std::size_t>(i)];
    }
    for (double& weight : half)
        weight /= sum;
    return half;
}

/// Mirrored about the outermost pixels: -1 is 1, n is n - 2.
int reflected(int i, int n) {
    if (n == 1)
        return 0;
    const int period = 2 * (n - 1), inside = ((i % period) + period) % period;
    return inside < n ? inside : period - inside;
}

/// Both pictures' values, squares and product, blurred.
using Moments = std::array<double, 5>;

/// Row by row: each row's window across is taken of the eleven rows weighed down before, so nothing larger than a row is kept.
std::vector<Moments> windowed_row(const Image<float>& a, const Image<float>& b, int y) {
    static const auto half = window();
    const int w = a.width(), h = a.height();
    std::vector<Moments> down(static_cast<std::size_t>(w));
    for (int dy = -radius; dy <= radius; ++dy) {
        const double weight = half[static_cast<std::size_t>(std::abs(dy))];
        const float *ra = &a.at(0, reflected(y + dy, h)), *rb = &b.at(0, reflected(y + dy, h));
        for (int x = 0; x < w; ++x) {
            const double va = static_cast<double>(ra[x]), vb = static_cast<double>(rb[x]);
            Moments& m = down[static_cast<std::size_t>(x)];
            m[0] += weight * va;
            m[1] += weight * vb;
            m[2] += weight * (va * va);
            m[3] += weight * (vb * vb);
            m[4] += weight * (va * vb);
        }
    }
    std::vector<Moments> row(static_cast<std::size_t>(w));
    for (int x = 0; x < w; ++x)
        for (int dx = -radius; dx <= radius; ++dx) {
            const double weight = half[static_cast<std::size_t>(std::abs(dx))];
            const Moments& from = down[static_cast<std::size_t>(reflected(x + dx, w))];
            Moments& m = row[static_cast<std::size_t>(x)];
            for (std::size_t k = 0; k < m.size(); ++k)
                m[k] += weight * from[k];
        }
    return row;
}

void check(const Image<float>& tested, const Image<float>& reference, double range) {
    check_comparable(tested, reference);
    if (!(range > 0.0 && std::isfinite(range)))
        throw std::invalid_argument(fmt::format("a range of {} is not above 0", range));
    for (const auto* image : {&tested, &reference})
        for (const float v : image->pixels())
            if (!std::isfinite(v))
                throw std::invalid_argument(fmt::format("a pixel is {}", v));
}

struct Scale {
    Ssim whole;
    double contrast_structure = 1.0; ///< mean of the second factor alone
};

Scale similarity(const Image<float>& a, const Image<float>& b, double range) {
    struct Row {
        double whole = 0.0, contrast_structure = 0.0, minimum = 2.0;
        int minimum_x = 0;
    };
    const double c1 = std::pow(0.01 * range, 2.0), c2 = std::pow(0.03 * range, 2.0);
    std::vector<Row> rows(static_cast<std::size_t>(a.height()));
    tbb::parallel_for(0, a.height(), [&](int y) {
        const std::vector<Moments> blurred = windowed_row(a, b, y);
        Row& row = rows[static_cast<std::size_t>(y)];
        for (int x = 0; x < a.width(); ++x) {
            const Moments& m = blurred[static_cast<std::size_t>(x)];
            const double covariance = m[4] - m[0] * m[1], variances = (m[2] - m[0] * m[0]) + (m[3] - m[1] * m[1]);
            const double second = (2.0 * covariance + c2) / (variances + c2);
            const double whole = (2.0 * m[0] * m[1] + c1) / (m[0] * m[0] + m[1] * m[1] + c1) * second;
            row.whole += whole;
            row.contrast_structure += second;
            if (whole < row.minimum) {
                row.minimum = whole;
                row.minimum_x = x;
            }
        }
    });
    Scale scale;
    double whole = 0.0, second = 0.0;
    scale.whole.minimum = 2.0;
    for (int y = 0; y < a.height(); ++y) { // in rows' order: any number of threads gives the same sum
        const Row& row = rows[static_cast<std::size_t>(y)];
        whole += row.whole;
        second += row.contrast_structure;
        if (row.minimum < scale.whole.minimum) {
            scale.whole.minimum = row.minimum;
            scale.whole.minimum_x = row.minimum_x;
            scale.whole.minimum_y = y;
        }
    }
    scale.whole.mean = whole / static_cast<double>(a.size());
    scale.contrast_structure = second / static_cast<double>(a.size());
    return scale;
}

Image<float> halved(const Image<float>& image) {
    Image<float> half((image.width() + 1) / 2, (image.height() + 1) / 2);
    for (int y = 0; y < half.height(); ++y)
        for (int x = 0; x < half.width(); ++x) {
            const int right = std::min(2 * x + 1, image.width() - 1), below = std::min(2 * y + 1, image.height() - 1);
            half.at(x, y) = 0.25F * ((image.at(2 * x, 2 * y) + image.at(right, 2 * y)) + (image.at(2 * x, below) + image.at(right, below)));
        }
    return half;
}

} // namespace

Ssim ssim(const Image<float>& tested, const Image<float>& reference, double range) {
    check(tested, reference, range);
    return similarity(tested, reference, range).whole;
}

std::optional<double> ms_ssim(const Image<float>& tested, const Image<float>& reference, double range) {
    check(tested, reference, range);
    if (std::min(tested.width(), tested.height()) < smallest_for_ms_ssim_px)
        return std::nullopt;
    constexpr std::array<double, 5> powers{0.0448, 0.2856, 0.3001, 0.2363, 0.1333};
    Image<float> a = tested, b = reference;
    double product = 1.0;
    for (std::size_t i = 0; i < powers.size(); ++i) {
        const Scale scale = similarity(a, b, range);
        const bool coarsest = i + 1 == powers.size();
        product *= std::pow(std::max(0.0, coarsest ? scale.whole.mean : scale.contrast_structure), powers[i]);
        if (!coarsest) {
            a = halved(a);
            b = halved(b);
        }
    }
    return product;
}

} // namespace fernlicht
