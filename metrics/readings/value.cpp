#include "metrics/readings/value.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>
#include <utility>

namespace fernlicht {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

} // namespace

Value::Value(Kind kind, double figure) : kind_(kind), figure_(figure) {
    if (!std::isfinite(figure))
        throw std::invalid_argument(fmt::format("a measured value is {}; one that cannot be had is not measured", figure));
}

Value Value::not_measured(std::string reason) {
    Value value;
    value.reason_ = std::move(reason);
    return value;
}

Value Value::of(const std::optional<double>& number, const std::string& reason) { return number ? Value(*number) : not_measured(reason); }

std::optional<double> Value::number() const { return kind_ == Kind::number ? std::optional(figure_) : std::nullopt; }

std::optional<double> Value::figure() const { return measured() ? std::optional(figure_) : std::nullopt; }

double Value::low() const { return kind_ == Kind::number || kind_ == Kind::at_least ? figure_ : -endless; }

double Value::high() const { return kind_ == Kind::number || kind_ == Kind::at_most ? figure_ : endless; }

Value Value::between(double low, double high, const std::string& reason_for_none) {
    if (low == high)
        return low;
    if (std::isfinite(low) && std::isfinite(high))
        return not_measured(fmt::format("between {:.6g} and {:.6g}", low, high));
    if (std::isfinite(low))
        return at_least(low);
    return std::isfinite(high) ? at_most(high) : not_measured(reason_for_none);
}

Value difference(const Value& a, const Value& b, std::string_view unit) {
    if (!a.measured() || !b.measured())
        return Value::not_measured(a.measured() ? b.reason() : a.reason());
    const auto end = [](double x, double y) { return std::isfinite(x) && std::isfinite(y) ? x - y : std::isfinite(x) ? -y : x; };
    const bool up = a.kind() == Value::Kind::at_least;
    return Value::between(end(a.low(), b.high()), end(a.high(), b.low()),
                          *a.figure() == *b.figure() ? fmt::format("both are {} {:.4g} {}", up ? "over" : "below", *a.figure(), unit)
                                                     : fmt::format("one is {0} {1:.4g} {3}, the other {0} {2:.4g} {3}",
                                                                   up ? "over" : "below", *a.figure(), *b.figure(), unit));
}

std::string with_bound(const Value& value, const std::string& figure) {
    return value.censored() ? fmt::format("{} {}", value.kind() == Value::Kind::at_least ? ">" : "<", figure) : figure;
}

const char* bound_name(const Value& value) {
    return value.kind() == Value::Kind::at_least ? "at_least" : value.kind() == Value::Kind::at_most ? "at_most" : "";
}

std::optional<bool> holds(const Value& value, const std::optional<double>& at_least, const std::optional<double>& at_most) {
    if (!value.measured())
        return std::nullopt;
    if ((at_least && value.high() < *at_least) || (at_most && value.low() > *at_most))
        return false;
    const bool surely = (!at_least || value.low() >= *at_least) && (!at_most || value.high() <= *at_most);
    return surely ? std::optional(true) : std::nullopt;
}

Value median_value(const std::vector<double>& values, const std::string& why_none) {
    const std::optional<Spread> spread = spread_of(values);
    return spread ? Value(spread->median) : Value::not_measured(why_none);
}

namespace {

/// Of values, infinite ones among them.
double quantile_with_bounds(std::vector<double> values, double share) {
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

void CensoredSamples::add(const Value& value) {
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

std::string CensoredSamples::reason() const { return left_out_ > 0 ? why_left_out_ + " in every moment" : why_none_; }

Value CensoredSamples::quantile(double share) const {
    if (count() == 0)
        return Value::not_measured(reason());
    const double low = quantile_with_bounds(low_, share), high = quantile_with_bounds(high_, share);
    if (low != high && at_most_ == 0)
        return Value::at_least(low);
    if (low != high && at_least_ == 0)
        return Value::at_most(high);
    return Value::between(low, high, "nothing bounds it");
}

Value CensoredSamples::mean() const {
    if (count() == 0)
        return Value::not_measured(reason());
    if (const std::size_t bounds = at_least_ + at_most_; bounds > 0)
        return Value::not_measured(fmt::format("{} of {} moments give a bound only", bounds, count()));
    return spread_of(low_)->mean;
}

Value CensoredSamples::standard_deviation() const {
    const Value mean = this->mean();
    return mean.measured() ? Value(spread_of(low_)->standard_deviation) : mean;
}

std::string CensoredSamples::account() const {
    std::string text = count() == 1 ? "1 moment" : fmt::format("{} moments", count());
    if (left_out_ > 0)
        text += fmt::format(", {} left out: {}", left_out_, why_left_out_);
    return text;
}

} // namespace fernlicht
