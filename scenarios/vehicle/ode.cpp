#include "scenarios/vehicle/ode.h"

#include <algorithm>

namespace fernlicht {

double quintic(const double* values, std::size_t stride, double place) {
    // Lagrange's form; the denominators are (k/5 - 0/5) .. without (k/5 - k/5).
    static constexpr double weight[DensePath::nodes] = {-3125.0 / 120.0, 3125.0 / 24.0,  -3125.0 / 12.0,
                                                        3125.0 / 12.0,   -3125.0 / 24.0, 3125.0 / 120.0};
    double sum = 0.0;
    for (std::size_t k = 0; k < DensePath::nodes; ++k) {
        double product = weight[k];
        for (std::size_t j = 0; j < DensePath::nodes; ++j)
            product *= j == k ? 1.0 : place - static_cast<double>(j) / 5.0;
        sum += product * values[k * stride];
    }
    return sum;
}

DensePath::DensePath(std::vector<std::size_t> kept) : kept_(std::move(kept)) {}

void DensePath::add(double start_s, double end_s, const double* values, std::size_t state_size) {
    starts_s_.push_back(start_s);
    ends_s_.push_back(end_s);
    for (std::size_t node = 0; node < nodes; ++node)
        for (const std::size_t component : kept_)
            values_.push_back(values[node * state_size + component]);
}

std::size_t DensePath::step_at(double time_s) const {
    const auto next = std::upper_bound(starts_s_.begin(), starts_s_.end(), time_s);
    return next == starts_s_.begin() ? 0 : static_cast<std::size_t>(next - starts_s_.begin()) - 1;
}

double DensePath::at(double time_s, std::size_t component) const {
    const std::size_t step = step_at(time_s);
    const double length_s = ends_s_[step] - starts_s_[step];
    const double place = std::clamp((time_s - starts_s_[step]) / length_s, 0.0, 1.0);
    return quintic(&values_[step * nodes * kept_.size() + component], kept_.size(), place);
}

} // namespace fernlicht
