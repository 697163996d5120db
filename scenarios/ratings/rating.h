// A rating of headlamps as its file says it: what is driven, where light is judged, by which limits, for how many points.
#pragma once

#include "scenarios/drives/seeing_parameters.h"
#include "scenarios/values/files.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht {

/// Whether a source states it, or it was assumed for want of one.
enum class Known { stated, assumed };
inline constexpr const char* known_words[] = {"stated", "assumed"};

/// lamps: sum of I / d^2. Else the cosine to where it faces counts: as the road user that carries it; beside the road, as the own car.
enum class PhotometerFacing { lamps, forward, backward };

struct Photometer {
    std::string name;
    std::string on;             ///< road user of the drive that carries it; "": beside the road
    glm::dvec3 position_m{0.0}; ///< in that one's frame: x forward from the rear axle, y left, z up from the road
    std::optional<double> at_m; ///< beside the road: along the route from its start
    Across across = Across::own_centre;
    double above_m = 0.0; ///< the road
    PhotometerFacing faces = PhotometerFacing::lamps;
    Known is = Known::assumed;
    std::string why; ///< source or reason, for people
};

/// From `from_m` to below the next one's; the last one's end is its own.
struct LimitRange {
    double from_m = 0.0, to_m = 0.0;
    std::optional<double> at_most_lx;     ///< > 0; nullopt: light is told alone
    std::optional<double> at_most_lx_far; ///< where the limit runs to, linearly, at to_m; nullopt: it stays

    /// lx; of a range with a limit.
    double limit_lx(double distance_m) const {
        const double share = (distance_m - from_m) / (to_m - from_m);
        return *at_most_lx + share * (at_most_lx_far.value_or(*at_most_lx) - *at_most_lx);
    }
};

struct LimitCurve {
    std::string name;
    std::vector<LimitRange> ranges; ///< by distance, none over another
    Known is = Known::assumed;
    std::string why;
};

struct RatingRow {
    std::string name, title;
    std::filesystem::path drive;
    std::string lamp_set; ///< of the lamps under test; "": the one that is rated
    // Either a reading of the drive,
    std::string reading;
    std::optional<double> at_least, at_most; ///< neither: told alone
    // or light on photometers while the car comes nearer.
    std::vector<std::string> photometers;
    std::string limits;
    double from_m = 0.0, to_m = 2000.0; ///< where it is measured
    std::vector<double> speed_kmh;      ///< least and greatest that the drive may have there; empty: any
    std::vector<double> radius_m;       ///< of the path there, left positive; empty: any
    Known is = Known::stated;           ///< the row as such
    std::string why;
    double points = 0.0;                              ///< if it is within its limits; or the most of points_by
    std::vector<std::pair<double, double>> points_by; ///< reading and points, linear between, level beyond
    double weight = 1.0;                              ///< on its points
    std::optional<double> cap;                        ///< the most that the whole may have if the row exceeds a limit
    std::size_t line = 0;                             ///< in the file
    bool of_reading() const { return !reading.empty(); }
};

/// Light above a limit that does not count: up to `percent` above it, for at most `for_s` or `for_m`.
struct MomentaryExcess {
    bool allowed = false;
    double percent = 25.0, for_s = 0.1, for_m = 1.0;
    Known is = Known::assumed;
    std::string why;
};

/// From where on the own car to where distance runs.
enum class DistanceFrom { lamps, bumper };
enum class DistanceTo { photometer, road_user };

struct JudgingRules {
    DistanceFrom from = DistanceFrom::lamps;
    DistanceTo to = DistanceTo::photometer;
    Known distance_is = Known::assumed;
    std::optional<double> pitch_off_mean_deg; ///< moments whose pitch is farther off the mean are left out; nullopt: none
    std::optional<double> round_lx;           ///< light and limits are rounded to multiples of it; nullopt: not at all
    MomentaryExcess excess;
};

struct Grade {
    std::string name;
    double from_points = 0.0;
};

struct Rating {
    std::filesystem::path file;
    std::string name, title;
    std::string modelled_on; ///< the regulation or test that it follows; "": one of its own
    std::string edition, source;
    std::vector<std::string> unsettled; ///< what its sources do not settle, one sentence each; told in every result
    JudgingRules rules;
    std::vector<Photometer> photometers;
    std::vector<LimitCurve> limits;
    std::vector<RatingRow> rows;
    std::vector<Grade> grades; ///< from the lowest; none: points alone
    FilesRead opened;
};

template <class Struct> struct Fields;
const Fields<Rating>& rating_fields(); ///< the keys of its file

/// Reads and checks a rating, version 1 (scenarios/rating.example.yaml explains every key): what rows name is there, drives exist. Throws
/// InputError with file, line, column and key.
Rating read_rating(const std::filesystem::path& file);

/// nullptr: there is none of that name.
const Photometer* photometer_named(const Rating& rating, const std::string& name);
const LimitCurve* limits_named(const Rating& rating, const std::string& name);

} // namespace fernlicht
