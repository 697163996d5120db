// One figure of many moments, some of which give a bound only.
#pragma once

#include "metrics/readings/value.h"

#include <cstddef>
#include <vector>

namespace fernlicht {

/// Quantiles of type 7 (Hyndman and Fan 1996) of what the moments gave. A moment that gave a bound may be anything beyond it: a quantile
/// that this can move is a bound itself, all others are numbers.
class ManyMoments {
  public:
    /// `why_none`: the reason when no moment adds anything.
    explicit ManyMoments(std::string why_none) : why_none_(std::move(why_none)) {}
    ManyMoments() : ManyMoments("not there in any moment") {}

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
    std::string why_none() const;

    std::string why_none_, why_left_out_;
    std::vector<double> low_, high_; ///< what each moment may be, at least and at most
    std::size_t left_out_ = 0, at_least_ = 0, at_most_ = 0;
};

} // namespace fernlicht
