
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

/// One row of both pictures' values, squares and product, blurred; each for itself, as processors take them. What is added, and in which
/// order, decides the last bits.
class WindowedRow {
  public:
    WindowedRow(const Image<float>& a, const Image<float>& b, int y)
        : width_(static_cast<std::size_t>(a.width())), down_(width_ + 2 * margin), across_(5 * width_) {
        std::array<std::vector<double>, 5> moments;
        moments.fill(std::vector<double>(width_));
        for (int dy = -radius; dy <= radius; ++dy)
            add_down(moments, &a.at(0, reflected(y + dy, a.height())), &b.at(0, reflected(y + dy, a.height())), weight(dy));
        for (std::size_t k = 0; k < moments.size(); ++k)
            blur_across(moments[k], across_.data() + k * width_);
    }
    const double* operator[](std::size_t moment) const { return across_.data() + moment * width_; }

  private:
    static constexpr std::size_t margin = radius;

    static double weight(int offset) {
        static const auto half = window();
        return half[static_cast<std::size_t>(std::abs(offset))];
    }

    void add_down(std::array<std::vector<double>, 5>& moments, const float* a, const float* b, double weight) const {
        double *__restrict m0 = moments[0].data(), *__restrict m1 = moments[1].data(), *__restrict m2 = moments[2].data(),
                           *__restrict m3 = moments[3].data(), *__restrict m4 = moments[4].data();
        for (std::size_t x = 0; x < width_; ++x) {
            const double va = static_cast<double>(a[x]), vb = static_cast<double>(b[x]);
            m0[x] += weight * va;
            m1[x] += weight * vb;
            m2[x] += weight * (va * va);
            m3[x] += weight * (vb * vb);
            m4[x] += weight * (va * vb);
        }
    }

    void blur_across(const std::vector<double>& from, double* to) {
        for (std::size_t i = 0; i < down_.size(); ++i)
            down_[i] = from[static_cast<std::size_t>(reflected(static_cast<int>(i) - radius, static_cast<int>(width_)))];
        for (int dx = -radius; dx <= radius; ++dx) {
            const double w = weight(dx);
            const double* __restrict at = down_.data() + (dx + radius);
            double* __restrict sum = to;
            for (std::size_t x = 0; x < width_; ++x)
                sum[x] += w * at[x];
        }
    }

    std::size_t width_;
    std::vector<double> down_, across_;
};

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
        const WindowedRow m(a, b, y);
        const auto width = static_cast<std::size_t>(a.width());
        std::vector<double> wholes(width), seconds(width);
        for (std::size_t x = 0; x < width; ++x) {
            const double m0 = m[0][x], m1 = m[1][x];
            const double covariance = m[4][x] - m0 * m1, variances = (m[2][x] - m0 * m0) + (m[3][x] - m1 * m1);
            seconds[x] = (2.0 * covariance + c2) / (variances + c2);
            wholes[x] = (2.0 * m0 * m1 + c1) / (m0 * m0 + m1 * m1 + c1) * seconds[x];
        }
        Row& row = rows[static_cast<std::size_t>(y)];
        for (std::size_t x = 0; x < width; ++x) {
            row.whole += wholes[x];
            row.contrast_structure += seconds[x];
            if (wholes[x] < row.minimum) {
                row.minimum = wholes[x];
                row.minimum_x = static_cast<int>(x);
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

SsimScales ssim_scales(const Image<float>& tested, const Image<float>& reference, double range) {
    check(tested, reference, range);
    constexpr std::array<double, 5> powers{0.0448, 0.2856, 0.3001, 0.2363, 0.1333};
    SsimScales found;
    Image<float> halved_a, halved_b;
    const Image<float>*a = &tested, *b = &reference;
    double product = 1.0;
    for (std::size_t i = 0; i < powers.size(); ++i) {
        const Scale scale = similarity(*a, *b, range);
        if (i == 0)
            found.finest = scale.whole;
        if (std::min(tested.width(), tested.height()) < smallest_for_ms_ssim_px)
            return found;
        const bool coarsest = i + 1 == powers.size();
        product *= std::pow(std::max(0.0, coarsest ? scale.whole.mean : scale.contrast_structure), powers[i]);
        if (!coarsest) {
            halved_a = halved(*a);
            halved_b = halved(*b);
            a = &halved_a;
            b = &halved_b;
        }
    }
    found.all = product;
    return found;
}

} // namespace fernlicht
