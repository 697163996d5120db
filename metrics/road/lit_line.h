// The lit part of a line of samples: along a lane for its reach, across the road for its width.
// How illuminance runs between two neighbouring samples, and where it meets a limit there.
// A figure followed while a car comes nearer to a place: what it is at a distance, how far away it passes a limit, for how long.
// The own lane ahead of a car as the driver sees it: places on it at even distances, what its ground hides, where a line of sight meets it.
// Along its centre and across in the tangent plane there: banked roads are followed, their edges and what stands beside them are not.
#pragma once

#include "metrics/readings/value.h"
#include "scenarios/roads/route.h"

#include <cmath>
#include <utility>
#include <vector>

namespace fernlicht {

struct LineSample {
    double at_m = 0.0;        ///< ascending along a line
    std::optional<double> lx; ///< nullopt: not looked at here; no line runs through such a place
};

struct LitLine {
    bool lit = false;                   ///< anywhere
    double first_m = 0.0, last_m = 0.0; ///< nearest and farthest place with E >= limit; 0 where unlit
    double lit_m = 0.0;                 ///< length at or above the limit
    double unlit_before_last_m = 0.0;   ///< length below the limit from the line's start to `last_m`
    bool lit_at_end = false;            ///< at the last place that was looked at
};

/// threshold_lx > 0.
LitLine lit_line(const std::vector<LineSample>& line, double threshold_lx);

/// Away from the lamps light falls off by powers of distance and beams by factors per degree: straight in the logarithm. Where
/// either sample is dark there is no logarithm, and the value runs straight.
inline double between_samples(double a, double b, double share) {
    return a > 0.0 && b > 0.0 ? a * std::pow(b / a, share) : a + (b - a) * share;
}

/// Share of the way from `a` to `b` at which `limit` is met; one of the two lies below it, the other does not. limit > 0.
template <class Number> Number crossing_share(const Number& a, const Number& b, double limit) {
    using std::log;
    return a > 0.0 && b > 0.0 ? log(a / limit) / log(a / b) : (a - limit) / (a - b);
}

/// How a figure answers to one of the values that it follows from.
struct ValueShare {
    std::size_t index = 0;
    double by_value = 0.0; ///< d figure / d value
};
using ValueShares = std::vector<ValueShare>;

/// d between_samples() / d a and / d b.
std::pair<double, double> between_samples_shares(double a, double b, double share);
/// Of LitLine::last_m and of LitLine::lit_m by the samples of the line, m per lx: where E passes the threshold in s, ds / dE = -1 / (dE /
/// ds), with the slope that E has between the samples on both sides. Empty for an end that no sample moves, as where the line ends lit.
struct LitLineShares {
    ValueShares last, lit;
};
LitLineShares lit_line_shares(const std::vector<LineSample>& line, double threshold_lx);

struct ApproachSample {
    double time_s = 0.0;
    double distance_m = 0.0;     ///< still to go, which falls or stays; or gone, which rises or stays
    std::optional<double> value; ///< >= 0; nullopt: not measured
};
using Approach = std::vector<ApproachSample>;

/// With distances to go: the value where so many metres are left. Not measured where the drive comes from nearer or ends farther away.
Value value_at(const Approach& approach, double distance_m);

/// How far value_at() may be off between two samples: the most that either half of the samples alone would move it by; with samples at
/// equal steps no less than the error of what bends evenly. 0 at a sample; nullopt where neither half tells it.
std::optional<double> unknown_at(const Approach& approach, double distance_m);

/// An approach that comes so near is finished though the place is not passed: a lamp is hardly a point of light from there on.
inline constexpr double near_enough_m = 10.0;

/// Of that value by the approach's; empty where it is not measured.
ValueShares value_at_shares(const Approach& approach, double distance_m);

/// With distances to go, of a drive that did not pass the place: "the drive comes from 246.2 m to 210.4 m before it"; "" where it passed,
/// came within near_enough_m, or no moment was before the place.
std::string cut_short(const Approach& approach, bool passed);

/// With distances to go: farthest at which the value reaches the limit; 0: nowhere. At least the first moment's distance where it does so
/// from there on; at most the last one's where it does so nowhere and the approach was cut short.
Value reached_from_m(const Approach& approach, double limit, bool passed);

/// Of that distance by the approach's values, which are all measured.
ValueShares reached_from_shares(const Approach& approach, double limit);

/// Seconds and metres of the drive at or above the limit.
struct Stretch {
    double time_s = 0.0, length_m = 0.0;
};
Stretch at_or_above(const Approach& approach, double limit);
Stretch below(const Approach& approach, double limit);

/// Largest and smallest of the measured values.
std::optional<double> largest(const Approach& approach);
std::optional<double> smallest(const Approach& approach);

class LaneAhead {
  public:
    /// Places every `step_m` from `from_m` along the route, to `length_m` farther or the route's end.
    LaneAhead(const Route& route, double from_m, double length_m, double step_m);

    const std::vector<Pose>& surface() const { return surface_; }

    /// A point from which lines start; and of each place, from there, the distance along the lane and the height over it.
    struct Origin {
        glm::dvec3 at_m{0.0};
        std::vector<double> ahead_m, above_m;
    };
    Origin origin(const glm::dvec3& at_m) const;

    /// True where the lane rises above the line between two points: of no use for points below it.
    bool hides(const Origin& from, const glm::dvec3& to) const;
    bool hides(const glm::dvec3& from, const glm::dvec3& to) const { return hides(origin(from), to); }
    /// Where the line from `eye` through `point` meets the lane beyond `point`: the place's pose, the point on its surface. nullopt: it
    /// does not meet what is known of the lane.
    std::optional<Pose> behind(const Origin& eye, const glm::dvec3& point) const;
    std::optional<Pose> behind(const glm::dvec3& eye, const glm::dvec3& point) const { return behind(origin(eye), point); }

  private:
    std::vector<Pose> surface_;
    std::vector<double> in_blocks_; ///< its axes, many places at a time
};

} // namespace fernlicht
