#include "metrics/readings/many_moments.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// Of ascending values, infinite ones among them.
double quantile_of(std::vector<double> values, double share) {
    std::ranges::sort(values);
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const double fraction = place - static_cast<double>(below);
    if (fraction == 0.0 || values[below] == values[below + 1])
        return values[below];
    return std::isfinite(values[below])
               ? std::isfinite(values[below + 1]) ? std::lerp(values[below], values[below + 1], fraction) : values[below + 1]
               : values[below];
}

} // namespace

void ManyMoments::add(const Value& value) {
    if (!value.measured()) {
        if (left_out_++ == 0)
            why_left_out_ = value.reason();
        return;
    }
    low_.push_back(value.low());
    high_.push_back(value.high());
    at_least_ += value.kind() == Value::Kind::at_least ? 1U : 0U;
    at_most_ += value.kind() == Value::Kind::at_most ? 1U : 0U;
}

std::string ManyMoments::why_none() const { return left_out_ > 0 ? why_left_out_ + " in every moment" : why_none_; }

Value ManyMoments::quantile(double share) const {
    if (count() == 0)
        return Value::not_measured(why_none());
    const double low = quantile_of(low_, share), high = quantile_of(high_, share);
    if (low != high && at_most_ == 0)
        return Value::at_least(low);
    if (low != high && at_least_ == 0)
        return Value::at_most(high);
    return Value::between(low, high, "nothing bounds it");
}

Value ManyMoments::mean() const {
    if (count() == 0)
        return Value::not_measured(why_none());
    if (const std::size_t bounds = at_least_ + at_most_; bounds > 0)
        return Value::not_measured(fmt::format("{} of {} moments give a bound only", bounds, count()));
    return spread_of(low_)->mean;
}

Value ManyMoments::standard_deviation() const {
    const Value mean = this->mean();
    return mean.measured() ? Value(spread_of(low_)->standard_deviation) : mean;
}

std::string ManyMoments::account() const {
    std::string text = count() == 1 ? "1 moment" : fmt::format("{} moments", count());
    if (left_out_ > 0)
        text += fmt::format(", {} left out: {}", left_out_, why_left_out_);
    return text;
}

} // namespace fernlicht
