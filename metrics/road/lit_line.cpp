#include "metrics/road/lit_line.h"

#include "scenarios/packs/level.h"

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

std::pair<double, double> between_samples_shares(double a, double b, double share) {
    if (!(a > 0.0 && b > 0.0))
        return {1.0 - share, share};
    const double value = between_samples(a, b, share);
    return {value * (1.0 - share) / a, value * share / b};
}

LitLineShares lit_line_shares(const std::vector<LineSample>& line, double threshold_lx) {
    LitLineShares shares;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const bool begins = i == 0 || !line[i - 1].lx;
        if (begins && line[i].lx && *line[i].lx >= threshold_lx)
            shares.last.clear();
        if (begins || !line[i].lx)
            continue;
        const double a = *line[i - 1].lx, b = *line[i].lx, length_m = line[i].at_m - line[i - 1].at_m;
        if (a < threshold_lx && b < threshold_lx)
            continue;
        shares.last.clear(); // lit farther on
        if (a >= threshold_lx && b >= threshold_lx)
            continue;
        const double share = crossing_share(a, b, threshold_lx);
        const bool logarithmic = a > 0.0 && b > 0.0;
        const double by_a = (1.0 - share) / (logarithmic ? a * std::log(a / b) : a - b);
        const double by_b = share / (logarithmic ? b * std::log(a / b) : a - b);
        const double sign = a > b ? 1.0 : -1.0; // of the lit length: it begins where light rises
        for (const auto& [index, by] : {std::pair(i - 1, by_a), std::pair(i, by_b)}) {
            if (a > b)
                shares.last.push_back({index, length_m * by});
            shares.lit.push_back({index, sign * length_m * by});
        }
    }
    return shares;
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

std::optional<double> unknown_at(const Approach& approach, double distance_m) {
    const std::optional<double> all = value_at(approach, distance_m).number();
    if (!all)
        return std::nullopt;
    if (std::ranges::count(approach, distance_m, &ApproachSample::distance_m) > 0)
        return 0.0;
    std::optional<double> most;
    for (const std::size_t first : {0U, 1U}) {
        Approach half;
        for (std::size_t i = first; i < approach.size(); i += 2)
            half.push_back(approach[i]);
        if (const auto by_half = value_at(half, distance_m).number())
            most = std::max(most.value_or(0.0), std::abs(*by_half - *all));
    }
    return most;
}

ValueShares value_at_shares(const Approach& approach, double distance_m) {
    for (std::size_t i = 0; i < approach.size(); ++i) {
        if (approach[i].distance_m == distance_m && approach[i].value)
            return {{i, 1.0}};
        if (i == 0 || !(approach[i - 1].distance_m > distance_m && approach[i].distance_m < distance_m))
            continue;
        const ApproachSample &before = approach[i - 1], &here = approach[i];
        if (!before.value || !here.value)
            return {};
        const auto [by_before, by_here] =
            between_samples_shares(*before.value, *here.value, (before.distance_m - distance_m) / (before.distance_m - here.distance_m));
        return {{i - 1, by_before}, {i, by_here}};
    }
    return {};
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

ValueShares reached_from_shares(const Approach& approach, double limit) {
    const std::vector<LineSample> line = by_distance(approach);
    ValueShares shares = lit_line_shares(line, limit).last;
    if (!line.empty() && line.front().at_m != approach.front().distance_m) // by_distance() turned it round
        for (ValueShare& one : shares)
            one.index = approach.size() - 1 - one.index;
    return shares;
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

namespace {

/// So many places of a lane are asked together: forward and up, the same number of all next to one another.
constexpr std::size_t block = 16;
constexpr std::size_t numbers = 6;
/// What rounding may do to a height in metres, at coordinates of millions of metres, and to a share of a way.
constexpr double height_hair_m = 1e-6, share_hair = 1e-12;

/// Of one place: how far along a line it is passed, and how high over its tangent plane. NaN where the line runs along its cross-section.
struct Passing {
    double share = 0.0, height_m = 0.0;
};
Passing passing(const Pose& place, const glm::dvec3& from, const glm::dvec3& direction) {
    const double along = glm::dot(direction, place.forward());
    const double share =
        along > 0.0 ? glm::dot(place.position_m - from, place.forward()) / along : std::numeric_limits<double>::quiet_NaN();
    return {share, glm::dot(from + share * direction - place.position_m, place.up())};
}

// Whether a line may decide in a block, by the same products without their quotient: most blocks it passes high above. What is near the
// border may; passing() tells then.

/// Passes a place before its end and below the lane, or a place at or beyond its end.
FERNLICHT_WIDEST bool may_hide(const double* p, const double* ahead_m, const double* above_m, double x, double y, double z) {
    long long found = 0;
    for (std::size_t i = 0; i < block; ++i) {
        const double along = x * p[i] + y * p[block + i] + z * p[2 * block + i];
        const double rise = x * p[3 * block + i] + y * p[4 * block + i] + z * p[5 * block + i];
        const long long ends = ahead_m[i] >= along * (1.0 - share_hair) ? 1 : 0, before = ahead_m[i] > 0.0 ? 1 : 0;
        const long long low = above_m[i] * along + ahead_m[i] * rise < height_hair_m * along ? 1 : 0, passes = along > 0.0 ? 1 : 0;
        found |= passes & (ends | (before & low));
    }
    return found != 0;
}

/// Passes a place beyond its end and not above the lane.
FERNLICHT_WIDEST bool may_meet(const double* p, const double* ahead_m, const double* above_m, double x, double y, double z) {
    long long found = 0;
    for (std::size_t i = 0; i < block; ++i) {
        const double along = x * p[i] + y * p[block + i] + z * p[2 * block + i];
        const double rise = x * p[3 * block + i] + y * p[4 * block + i] + z * p[5 * block + i];
        const long long beyond = ahead_m[i] >= along * (1.0 - share_hair) ? 1 : 0, passes = along > 0.0 ? 1 : 0;
        const long long low = above_m[i] * along + ahead_m[i] * rise < height_hair_m * along ? 1 : 0;
        found |= passes & beyond & low;
    }
    return found != 0;
}

} // namespace

LaneAhead::LaneAhead(const Route& route, double from_m, double length_m, double step_m) {
    const double room_m = std::min(length_m, route.length_m() - from_m);
    for (int k = 0; k * step_m <= room_m; ++k)
        surface_.push_back(route.pose(from_m + k * step_m));
    in_blocks_.resize((surface_.size() + block - 1) / block * block * numbers); // no line passes those that are no places
    for (std::size_t place = 0; place < surface_.size(); ++place) {
        double* to = &in_blocks_[place / block * block * numbers + place % block];
        for (const glm::dvec3* const three : {&surface_[place].forward(), &surface_[place].up()})
            for (int axis = 0; axis < 3; ++axis, to += block)
                *to = (*three)[axis];
    }
}

LaneAhead::Origin LaneAhead::origin(const glm::dvec3& at_m) const {
    Origin origin{at_m, std::vector<double>(in_blocks_.size() / numbers), {}};
    origin.above_m = origin.ahead_m;
    for (std::size_t place = 0; place < surface_.size(); ++place) {
        const glm::dvec3 to = surface_[place].position_m - at_m;
        origin.ahead_m[place] = glm::dot(to, surface_[place].forward());
        origin.above_m[place] = -glm::dot(to, surface_[place].up());
    }
    return origin;
}

bool LaneAhead::hides(const Origin& from, const glm::dvec3& to) const {
    const glm::dvec3 direction = to - from.at_m;
    for (std::size_t first = 0; first < surface_.size(); first += block)
        if (may_hide(&in_blocks_[first * numbers], &from.ahead_m[first], &from.above_m[first], direction.x, direction.y, direction.z))
            for (std::size_t place = first; place < std::min(first + block, surface_.size()); ++place) {
                const auto [share, height_m] = passing(surface_[place], from.at_m, direction);
                if (share > 0.0 && share < 1.0 && height_m < 0.0)
                    return true;
                if (share >= 1.0)
                    return false; // the next ones are farther still
            }
    return false;
}

std::optional<Pose> LaneAhead::behind(const Origin& eye, const glm::dvec3& point) const {
    const glm::dvec3 direction = point - eye.at_m;
    for (std::size_t first = 0; first < surface_.size(); first += block) {
        if (!may_meet(&in_blocks_[first * numbers], &eye.ahead_m[first], &eye.above_m[first], direction.x, direction.y, direction.z))
            continue;
        for (std::size_t place = first; place < std::min(first + block, surface_.size()); ++place) {
            const Passing here = passing(surface_[place], eye.at_m, direction);
            if (!(here.share > 1.0 && here.height_m <= 0.0))
                continue;
            double met = here.share;
            for (std::size_t nearer = place; nearer-- > 0;)
                if (const Passing before = passing(surface_[nearer], eye.at_m, direction); before.share > 1.0) {
                    // The ground between two places is straight: where the line's height over it passes 0.
                    met = before.share + before.height_m / (before.height_m - here.height_m) * (here.share - before.share);
                    break;
                }
            Pose pose = surface_[place];
            pose.position_m = eye.at_m + met * direction;
            return pose;
        }
    }
    return std::nullopt;
}

} // namespace fernlicht
