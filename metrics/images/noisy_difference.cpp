#include "metrics/images/noisy_difference.h"

#include "metrics/statistics/spread_test.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <stdexcept>
#include <vector>

namespace fernlicht {
namespace {

void check(const NoisyPicture& a, const NoisyPicture& b) {
    for (const Image<float>* const image : {a.mean, a.variance, b.mean, b.variance, a.mixed, b.mixed}) {
        if (!image)
            continue;
        if (image->empty() || image->width() != a.mean->width() || image->height() != a.mean->height())
            throw std::invalid_argument("compare_noisy: pictures are empty or of different sizes");
        if (!std::ranges::all_of(image->pixels(), [](float value) { return std::isfinite(value); }))
            throw std::invalid_argument("compare_noisy: a value is not finite");
    }
    for (const Image<float>* const image : {a.variance, b.variance})
        if (std::ranges::any_of(image->pixels(), [](float value) { return value < 0.0F; }))
            throw std::invalid_argument("compare_noisy: a variance is below 0");
}

bool same(const Image<float>& a, const Image<float>& b) { return std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0; }

bool is_mixed(const NoisyPicture& picture, int x, int y) { return picture.mixed && picture.mixed->at(x, y) != 0.0F; }

/// The pixel's variance, at least the mean of those around it.
double raised(const Image<float>& variance, int x, int y) {
    double sum = 0.0;
    int count = 0;
    for (int j = std::max(0, y - 1); j <= std::min(variance.height() - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(variance.width() - 1, x + 1); ++i, ++count)
            sum += static_cast<double>(variance.at(i, j));
    return std::max(static_cast<double>(variance.at(x, y)), sum / count);
}

/// What is known of a block, or of all of them.
struct Sums {
    double difference = 0.0, variance = 0.0;
    double estimated = 0.0, squares = 0.0; ///< of the variances as they were estimated
    std::size_t pixels = 0;

    double z() const { return variance > 0.0 ? difference / std::sqrt(variance) : 0.0; }
    int freedom(int of_a_pixel) const {
        return squares > 0.0 ? std::max(of_a_pixel, static_cast<int>(of_a_pixel * estimated * estimated / squares)) : of_a_pixel;
    }
    void add(const Sums& other) {
        difference += other.difference;
        variance += other.variance;
        pixels += other.pixels;
    }
};

class NoisyComparison {
  public:
    NoisyComparison(const NoisyPicture& a, const NoisyPicture& b, double absolute, double relative)
        : a_(a), b_(b), absolute_(absolute), relative_(relative) {}

    NoisyDifference run(double false_alarm) {
        std::vector<Sums> blocks;
        std::vector<std::pair<int, int>> places;
        for (int y = 0; y < a_.mean->height(); y += noise_block_px)
            for (int x = 0; x < a_.mean->width(); x += noise_block_px)
                if (const Sums block = sums_of(x, y); block.pixels > 0) {
                    blocks.push_back(block);
                    places.emplace_back(x, y);
                }
        out_.blocks = blocks.size();
        out_.sum_ratio = sum_b_ == 0.0 ? 1.0 : sum_a_ / sum_b_;
        if (!blocks.empty())
            judge(blocks, places, false_alarm);
        return out_;
    }

  private:
    Sums sums_of(int x0, int y0) {
        Sums block;
        for (int y = y0; y < std::min(y0 + noise_block_px, a_.mean->height()); ++y)
            for (int x = x0; x < std::min(x0 + noise_block_px, a_.mean->width()); ++x)
                add_pixel(block, x, y);
        return block;
    }

    void add_pixel(Sums& block, int x, int y) {
        const double mean_a = a_.mean->at(x, y), mean_b = b_.mean->at(x, y), difference = mean_a - mean_b;
        const double variance = raised(*a_.variance, x, y) + raised(*b_.variance, x, y);
        if (!(variance > 0.0)) {
            out_.exact_over += std::abs(difference) > absolute_ + relative_ * std::abs(mean_b) ? 1U : 0U;
            return;
        }
        if (is_mixed(a_, x, y) || is_mixed(b_, x, y)) {
            ++out_.left_out;
            return;
        }
        ++out_.compared;
        ++block.pixels;
        sum_a_ += mean_a;
        sum_b_ += mean_b;
        block.difference += difference;
        block.variance += variance;
        for (const Image<float>* const image : {a_.variance, b_.variance}) {
            const double estimated = image->at(x, y);
            block.estimated += estimated;
            block.squares += estimated * estimated;
        }
    }

    void judge(const std::vector<Sums>& blocks, const std::vector<std::pair<int, int>>& places, double false_alarm) {
        const int of_a_pixel = std::min(a_.freedom, b_.freedom);
        std::map<int, double> bounds; // many blocks have as many degrees of freedom as others
        Sums all;
        double worst = -1.0;
        for (std::size_t i = 0; i < blocks.size(); ++i) {
            all.add(blocks[i]);
            const auto [at, is_new] = bounds.try_emplace(blocks[i].freedom(of_a_pixel), 0.0);
            if (is_new)
                at->second = student_bound(at->first, 0.5 * false_alarm, blocks.size());
            const double z = std::abs(blocks[i].z());
            out_.blocks_over += z > at->second ? 1U : 0U;
            if (z / at->second > worst) {
                worst = z / at->second;
                out_.worst_z = z;
                out_.worst_bound = at->second;
                out_.worst_x = places[i].first;
                out_.worst_y = places[i].second;
            }
        }
        out_.sum_z = all.z();
        out_.sum_bound = normal_bound(0.5 * false_alarm, 1);
    }

    const NoisyPicture &a_, &b_;
    double absolute_, relative_, sum_a_ = 0.0, sum_b_ = 0.0;
    NoisyDifference out_;
};

} // namespace

NoisyDifference compare_noisy(const NoisyPicture& a, const NoisyPicture& b, double threshold_absolute, double threshold_relative,
                              double false_alarm) {
    check(a, b);
    NoisyDifference out = NoisyComparison(a, b, threshold_absolute, threshold_relative).run(false_alarm);
    out.identical = same(*a.mean, *b.mean) && same(*a.variance, *b.variance);
    return out;
}

} // namespace fernlicht
