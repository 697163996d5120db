#include "metrics/beam/cut_off_line.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fernlicht {
namespace {

constexpr double widest_deg = 20.0, highest_deg = 4.0, least_fall_per_deg = 1.5, least_share_of_peak = 0.02;

std::optional<double> steepest_fall(const BeamField& beam, std::size_t h, double least_cd) {
    const CandelaTable& table = beam.table();
    double steepest = -least_fall_per_deg;
    std::optional<double> at_deg;
    for (std::size_t v = 1; v + 1 < table.v_deg.size(); ++v) {
        if (std::abs(table.v_deg[v]) > highest_deg || table.at(v - 1, h) < least_cd)
            continue;
        if (const double fall = beam.gradient(v, h).second; fall < steepest) {
            steepest = fall;
            at_deg = table.v_deg[v];
        }
    }
    return at_deg;
}

} // namespace

CutOffLine::CutOffLine(const BeamField& beam, double peak_cd) : h_deg_(beam.table().h_deg) {
    for (std::size_t h = 0; h < h_deg_.size(); ++h) {
        v_deg_.push_back(std::abs(h_deg_[h]) <= widest_deg ? steepest_fall(beam, h, least_share_of_peak * peak_cd) : std::nullopt);
        if (v_deg_.back())
            ++columns_;
    }
}

std::optional<double> CutOffLine::at(double h_deg) const {
    const auto above = std::ranges::lower_bound(h_deg_, h_deg);
    auto i = static_cast<std::size_t>(std::min(above, h_deg_.end() - 1) - h_deg_.begin());
    if (i > 0 && h_deg - h_deg_[i - 1] < h_deg_[i] - h_deg)
        --i;
    return v_deg_[i];
}

double CutOffLine::lowest_deg() const {
    std::vector<double> known;
    for (const std::optional<double>& v : v_deg_)
        if (v)
            known.push_back(*v);
    std::ranges::sort(known);
    return known.empty() ? std::numeric_limits<double>::quiet_NaN() : known[known.size() / 10];
}

} // namespace fernlicht
