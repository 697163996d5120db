// What a measurement knows: a number, a bound beyond which nothing was measured, or the reason why there is neither.
// One figure of many moments, some of which give a bound only.
#pragma once

#include <compare>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

/// Never NaN or infinite. A figure beyond what was looked at is censored: known to be at least, or at most, so much.
class Value {
  public:
    enum class Kind { not_measured, at_most, number, at_least };

    Value() = default; ///< not measured, without a reason
    /// Throws std::invalid_argument for NaN and infinities, as at_least and at_most do.
    Value(double number) : Value(Kind::number, number) {}
    static Value at_least(double bound) { return {Kind::at_least, bound}; }
    static Value at_most(double bound) { return {Kind::at_most, bound}; }
    static Value not_measured(std::string reason);
    /// The number, else not measured for this reason.
    static Value of(const std::optional<double>& number, const std::string& reason);

    Kind kind() const { return kind_; }
    bool measured() const { return kind_ != Kind::not_measured; } ///< a number or a bound
    bool censored() const { return kind_ == Kind::at_least || kind_ == Kind::at_most; }
    std::optional<double> number() const;                 ///< nullopt for bounds, too
    std::optional<double> figure() const;                 ///< the number or the bound
    const std::string& reason() const { return reason_; } ///< why not measured; "" otherwise

    /// All that it may be: low() = high() = the number; a bound leaves the other end infinite, not measured both.
    double low() const;
    double high() const;
    /// What lies between two ends, of which one or both may be infinite. Two finite ends that differ are not measured: "between A and B".
    static Value between(double low, double high, const std::string& reason_for_none);

    bool operator==(const Value&) const = default;

  private:
    Value(Kind kind, double figure);

    Kind kind_ = Kind::not_measured;
    double figure_ = 0.0;
    std::string reason_;
};

/// a - b: at least where a is, or b at most; at most the other way round. Not measured where either is not, with its reason, or where
/// nothing bounds the difference: "both beyond 200 m".
Value difference(const Value& a, const Value& b, std::string_view unit);

/// The figure's text with what bounds it: "> 200" for a value of at least 200.
std::string with_bound(const Value& value, const std::string& figure);
const char* bound_name(const Value& value); ///< "at_least", "at_most" or ""

/// Whether the value holds a limit. nullopt: its bound, or that it is not measured, leaves it open.
std::optional<bool> holds(const Value& value, const std::optional<double>& at_least, const std::optional<double>& at_most);

/// Median of the values; not measured, for this reason, of none.
Value median_value(const std::vector<double>& values, const std::string& why_none);

/// Quantiles of type 7 (Hyndman and Fan 1996) of what the moments gave. A moment that gave a bound may be anything beyond it: a quantile
/// that this can move is a bound itself, all others are numbers.
class CensoredSamples {
  public:
    /// `why_none`: the reason when no moment adds anything.
    explicit CensoredSamples(std::string why_none) : why_none_(std::move(why_none)) {}
    CensoredSamples() : CensoredSamples("not there in any moment") {}

    /// One that is not measured says nothing of rank: it is left out, and its reason told.
    void add(const Value& value);

    std::size_t count() const { return low_.size(); }
    std::size_t left_out() const { return left_out_; }
    /// `share` from 0 to 1. Not measured, with the reason, where no moment added anything or nothing bounds it.
    Value quantile(double share) const;
    Value mean() const;               ///< not measured where a moment gave a bound
    Value standard_deviation() const; ///< of the moments (n - 1; 0 of one); as mean()
    /// "500 moments, 12 left out: cut off by the end of the road or lane", with the first reason of those.
    std::string account() const;

  private:
    std::string reason() const;

    std::string why_none_, why_left_out_;
    std::vector<double> low_, high_; ///< what each moment may be, at least and at most
    std::size_t left_out_ = 0, at_least_ = 0, at_most_ = 0;
};

} // namespace fernlicht
