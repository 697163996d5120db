#include "metrics/statistics/work_precision.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace fernlicht {
namespace {

bool dominates(const WorkPrecisionRow& a, const WorkPrecisionRow& b) {
    const double error_a = a.claimed_error(), error_b = b.claimed_error(), time_a = a.seconds->value, time_b = b.seconds->value;
    return error_a <= error_b && time_a <= time_b && (error_a < error_b || time_a < time_b);
}

/// In each of both either better by more than both intervals or the same, and not the same in both.
bool surely_dominates(const WorkPrecisionRow& a, const WorkPrecisionRow& b) {
    const bool more_precise = std::max(a.error->high, a.floor) < b.error->low, as_precise = a.claimed_error() == b.claimed_error();
    const bool faster = a.seconds->high < b.seconds->low, as_fast = *a.seconds == *b.seconds;
    if (std::min(a.seconds->samples, b.seconds->samples) < fewest_timings)
        return false;
    return (more_precise && (faster || as_fast)) || (as_precise && faster);
}

} // namespace

std::vector<Standing> standings(const std::vector<WorkPrecisionRow>& rows) {
    std::vector<Standing> all(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        all[i].on_front = rows[i].measured();
        for (std::size_t k = 0; k < rows.size() && all[i].on_front; ++k)
            all[i].on_front = !(rows[k].measured() && dominates(rows[k], rows[i]));
    }
    const auto rank = [&](std::size_t k) { return std::tuple(rows[k].claimed_error(), rows[k].seconds->value, k); };
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!rows[i].measured() || all[i].on_front)
            continue;
        for (std::size_t k = 0; k < rows.size(); ++k)
            if (all[k].on_front && dominates(rows[k], rows[i]) && (!all[i].dominated_by || rank(k) < rank(*all[i].dominated_by)))
                all[i].dominated_by = k;
        all[i].surely = surely_dominates(rows[all[i].dominated_by.value()], rows[i]);
    }
    return all;
}

std::optional<double> logarithmic_slope(const std::vector<std::pair<double, double>>& work_and_error) {
    double count = 0.0, sum_x = 0.0, sum_y = 0.0;
    std::vector<std::pair<double, double>> logarithms;
    for (const auto& [work, error] : work_and_error)
        if (work > 0.0 && error > 0.0 && std::isfinite(work) && std::isfinite(error)) {
            logarithms.emplace_back(std::log(work), std::log(error));
            count += 1.0;
            sum_x += logarithms.back().first;
            sum_y += logarithms.back().second;
        }
    double squares = 0.0, products = 0.0;
    for (const auto& [x, y] : logarithms) {
        squares += (x - sum_x / count) * (x - sum_x / count);
        products += (x - sum_x / count) * (y - sum_y / count);
    }
    return squares > 0.0 ? std::optional(products / squares) : std::nullopt;
}

} // namespace fernlicht
