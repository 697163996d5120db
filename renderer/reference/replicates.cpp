#include "renderer/reference/replicates.h"

#include <cmath>
#include <numeric>

namespace fernlicht::reference {
namespace {

constexpr double n = static_cast<double>(replicate_count);

/// Sum of squared differences from the mean.
double squares_about(const std::array<double, replicate_count>& values, double mean) {
    double sum = 0.0;
    for (const double value : values)
        sum += (value - mean) * (value - mean);
    return sum;
}

double mean_value(const std::array<double, replicate_count>& values) { return std::accumulate(values.begin(), values.end(), 0.0) / n; }

} // namespace

MeanAndError mean_of(const std::array<double, replicate_count>& sums, int each) {
    const double mean = mean_value(sums);
    const double error = std::sqrt(squares_about(sums, mean) / (n * (n - 1.0)) * ((n - 1.0) / (n - 3.0)));
    return {mean / each, error / each};
}

int samples_for(double error, double target, double power, int now, int most) {
    int count = now;
    for (double reached = error; count < most && reached > 0.75 * target; count *= 2)
        reached *= std::pow(2.0, -0.5 * power);
    return count;
}

} // namespace fernlicht::reference
