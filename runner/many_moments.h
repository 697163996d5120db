// One figure of many moments, some of which only give a lower bound.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

/// Samples of a reach. Light that goes on beyond the ground that was looked at gives "at least so much": such a moment ranks above
/// every other one, which leaves quantiles exact as long as they fall among the measured ones.
class ManyMoments {
  public:
    /// `why_none`: the reason when no moment adds anything.
    explicit ManyMoments(double looked_ahead_m = 0.0, std::string why_none = "not there in any moment")
        : looked_ahead_m_(looked_ahead_m), why_none_(std::move(why_none)) {}

    void add(double value) { measured_.push_back(value); }
    void add_beyond() { ++beyond_; }  ///< lit as far as the grid goes
    void leave_out() { ++left_out_; } ///< cut off nearer by the end of route or lane: says nothing of rank

    std::size_t count() const { return measured_.size() + beyond_; }
    /// Quantile of type 7 as in spread_of; nullopt where it would rest on a lower bound, or on nothing.
    std::optional<double> quantile(double share) const;
    /// Why quantile() gave nothing.
    std::string why_not() const;
    /// "500 moments, 12 left out: cut off by the end of the road or lane".
    std::string account() const;

  private:
    double looked_ahead_m_ = 0.0;
    std::string why_none_;
    std::vector<double> measured_;
    std::size_t beyond_ = 0, left_out_ = 0;
};

} // namespace fernlicht
