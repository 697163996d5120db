#include "runner/many_moments.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {

std::optional<double> ManyMoments::quantile(double share) const {
    if (count() == 0)
        return std::nullopt;
    const double place = share * static_cast<double>(count() - 1);
    const auto below = static_cast<std::size_t>(place);
    const double fraction = place - static_cast<double>(below);
    const std::size_t above = fraction > 0.0 ? below + 1 : below;
    if (above >= measured_.size())
        return std::nullopt;
    std::vector<double> ascending = measured_;
    std::ranges::sort(ascending);
    return std::lerp(ascending[below], ascending[above], fraction);
}

std::string ManyMoments::why_not() const {
    if (count() > 0)
        return fmt::format("in {} of {} moments the light goes on beyond the {} m that were looked at", beyond_, count(), looked_ahead_m_);
    return left_out_ > 0 ? "cut off by the end of the road or lane in every moment" : why_none_;
}

std::string ManyMoments::account() const {
    std::string text = count() == 1 ? "1 moment" : fmt::format("{} moments", count());
    if (left_out_ > 0)
        text += fmt::format(", {} left out: cut off by the end of the road or lane", left_out_);
    return text;
}

} // namespace fernlicht
