#include "metrics/road/lit_line.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <limits>

namespace fernlicht {
namespace {

/// Extends the lit part by what is lit between `from` and `to`; `unlit_m` is the unlit length so far.
void add_stretch(LitLine& result, double& unlit_m, double from_m, double to_m) {
    if (!result.lit)
        result.first_m = from_m;
    result.lit = true;
    result.lit_m += to_m - from_m;
    result.last_m = to_m;
    result.unlit_before_last_m = unlit_m;
}

void add_segment(LitLine& result, double& unlit_m, const LineSample& a, const LineSample& b, double threshold_lx) {
    const bool a_lit = *a.lx >= threshold_lx;
    const bool b_lit = *b.lx >= threshold_lx;
    const double length_m = b.at_m - a.at_m;
    if (a_lit == b_lit) {
        a_lit ? add_stretch(result, unlit_m, a.at_m, b.at_m) : void(unlit_m += length_m);
        return;
    }
    const double crossing_m = a.at_m + length_m * crossing_share(*a.lx, *b.lx, threshold_lx);
    if (a_lit) {
        add_stretch(result, unlit_m, a.at_m, crossing_m);
        unlit_m += b.at_m - crossing_m;
    } else {
        unlit_m += crossing_m - a.at_m;
        add_stretch(result, unlit_m, crossing_m, b.at_m);
    }
}

} // namespace

LitLine lit_line(const std::vector<LineSample>& line, double threshold_lx) {
    LitLine result;
    double unlit_m = 0.0;
    const LineSample* before = nullptr;
    for (const LineSample& sample : line) {
        if (before != nullptr && before->lx && sample.lx)
            add_segment(result, unlit_m, *before, sample, threshold_lx);
        else if (sample.lx && *sample.lx >= threshold_lx)
            add_stretch(result, unlit_m, sample.at_m, sample.at_m);
        if (sample.lx)
            result.lit_at_end = *sample.lx >= threshold_lx;
        before = &sample;
    }
    return result;
}

namespace {

const char* const nothing = "no moment of the drive before this place was measured";

std::vector<LineSample> by_distance(const Approach& approach) {
    std::vector<LineSample> line;
    for (const ApproachSample& sample : approach)
        line.push_back({sample.distance_m, sample.value});
    if (!line.empty() && line.front().at_m > line.back().at_m)
        std::ranges::reverse(line);
    return line;
}

double measured_length(const std::vector<LineSample>& line) {
    double length = 0.0;
    for (std::size_t i = 1; i < line.size(); ++i)
        if (line[i - 1].lx && line[i].lx)
            length += line[i].at_m - line[i - 1].at_m;
    return length;
}

std::vector<LineSample> by_time(const Approach& approach) {
    std::vector<LineSample> line;
    for (const ApproachSample& sample : approach)
        line.push_back({sample.time_s, sample.value});
    return line;
}

template <class Order> std::optional<double> outermost(const Approach& approach, Order before) {
    std::optional<double> found;
    for (const ApproachSample& sample : approach)
        if (sample.value && (!found || before(*sample.value, *found)))
            found = sample.value;
    return found;
}

} // namespace

Value value_at(const Approach& approach, double distance_m) {
    if (approach.empty())
        return Value::not_measured(nothing);
    for (std::size_t i = 0; i < approach.size(); ++i) {
        const ApproachSample& here = approach[i];
        if (here.distance_m == distance_m && here.value)
            return *here.value;
        if (i == 0 || !(approach[i - 1].distance_m > distance_m && here.distance_m < distance_m))
            continue;
        const ApproachSample& before = approach[i - 1];
        if (!before.value || !here.value)
            return Value::not_measured("not measured in the moments around it");
        return between_samples(*before.value, *here.value, (before.distance_m - distance_m) / (before.distance_m - here.distance_m));
    }
    return Value::not_measured(
        fmt::format("the drive comes from {:.1f} m away to {:.1f} m", approach.front().distance_m, approach.back().distance_m));
}

std::string cut_short(const Approach& approach, bool passed) {
    if (passed || approach.empty() || approach.back().distance_m <= near_enough_m)
        return {};
    return fmt::format("the drive comes from {:.1f} m to {:.1f} m before it", approach.front().distance_m, approach.back().distance_m);
}

Value reached_from_m(const Approach& approach, double limit, bool passed) {
    const LitLine line = lit_line(by_distance(approach), limit);
    const std::optional<double> most = largest(approach);
    if (!most)
        return Value::not_measured(nothing);
    if (*most < limit && !cut_short(approach, passed).empty())
        return Value::at_most(approach.back().distance_m);
    if (line.lit_at_end)
        return Value::at_least(approach.front().distance_m);
    return line.last_m;
}

Stretch at_or_above(const Approach& approach, double limit) {
    return {lit_line(by_time(approach), limit).lit_m, lit_line(by_distance(approach), limit).lit_m};
}

Stretch below(const Approach& approach, double limit) {
    const Stretch above = at_or_above(approach, limit);
    return {measured_length(by_time(approach)) - above.time_s, measured_length(by_distance(approach)) - above.length_m};
}

std::optional<double> largest(const Approach& approach) {
    return outermost(approach, [](double a, double b) { return a > b; });
}

std::optional<double> smallest(const Approach& approach) {
    return outermost(approach, [](double a, double b) { return a < b; });
}

LaneAhead::LaneAhead(const Route& route, double from_m, double length_m, double step_m) {
    const double room_m = std::min(length_m, route.length_m() - from_m);
    for (int k = 0; k * step_m <= room_m; ++k)
        surface_.push_back(route.pose(from_m + k * step_m));
}

/// Height over the lane's tangent plane where the line passes the cross-section of a place, and how far along `direction` that is. NaN
/// where it runs along the cross-section.
double LaneAhead::height_m(std::size_t place, const glm::dvec3& from, const glm::dvec3& direction, double& share) const {
    const Pose& pose = surface_[place];
    const double along = glm::dot(direction, pose.forward());
    share = along > 0.0 ? glm::dot(pose.position_m - from, pose.forward()) / along : std::numeric_limits<double>::quiet_NaN();
    return glm::dot(from + share * direction - pose.position_m, pose.up());
}

bool LaneAhead::hides(const glm::dvec3& from, const glm::dvec3& to) const {
    for (std::size_t place = 0; place < surface_.size(); ++place) {
        double share = 0.0;
        const double height = height_m(place, from, to - from, share);
        if (share > 0.0 && share < 1.0 && height < 0.0)
            return true;
        if (share >= 1.0)
            return false; // the next ones are farther still
    }
    return false;
}

std::optional<Pose> LaneAhead::behind(const glm::dvec3& eye, const glm::dvec3& point) const {
    const glm::dvec3 direction = point - eye;
    double before = -1.0, share_before = 0.0;
    for (std::size_t place = 0; place < surface_.size(); ++place) {
        double share = 0.0;
        const double height = height_m(place, eye, direction, share);
        if (!(share > 1.0))
            continue;
        if (height <= 0.0) {
            // The ground between two places is straight: where the line's height over it passes 0.
            const double part = before > 0.0 ? before / (before - height) : 1.0;
            const double met = before > 0.0 ? share_before + part * (share - share_before) : share;
            Pose pose = surface_[place];
            pose.position_m = eye + met * direction;
            return pose;
        }
        before = height;
        share_before = share;
    }
    return std::nullopt;
}

} // namespace fernlicht
