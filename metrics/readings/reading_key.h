// What a reading is of, field by field, and its name. Names are made and taken apart here and nowhere else.
#pragma once

#include "metrics/readings/quantities.h"

#include <compare>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

enum class Aspect {
    value,
    by_control, ///< what lamp control adds: against the same lamps held still
    held_still, ///< with lamps held still
    // What cars within the drive's tolerances read:
    cars_p05,
    cars_median,
    cars_p95,
    // How exact the value is:
    twin,
    twin_difference,
    grid_error,
    standard_error
};
enum class Statistic { none, median, minimum, maximum, p05, p95, spread, mean };
enum class ReadingSurface { none, road, target };
enum class ReadingPlace {
    none,
    left_edge,
    right_edge,
    edges,
    left,
    right,
    overhead,
    along,
    across,
    left_bends,
    right_bends,
    mirrors,
    own_eyes
};
enum class ThresholdUnit { none, lx, percent, de_boer };

struct Threshold {
    double value = 0.0;
    ThresholdUnit unit = ThresholdUnit::none;
    auto operator<=>(const Threshold&) const = default;
};

/// In the order in which tables list readings.
struct ReadingKey {
    Quantity quantity = Quantity::reach;
    std::string subject = {}; ///< the drive's name of a probe, sensor, eye, mirror or target; a pass; "" where there is none
    ReadingSurface surface = ReadingSurface::none;
    std::string lane = {}; ///< "own", "oncoming", "left 1", "right 2" ..., "all"
    Threshold threshold = {};
    ReadingPlace place = ReadingPlace::none;
    std::optional<double> distance_m = {};
    std::optional<double> to_m = {}; ///< far end of a range of distances, whose near end is distance_m
    Aspect aspect = Aspect::value;
    Statistic statistic = Statistic::none;
    auto operator<=>(const ReadingKey&) const = default;
};

/// "reach_5lx_road_own_m". Throws std::logic_error for a key that no reading has, such as one whose subject is not clear.
std::string name_of(const ReadingKey& key);
/// The inverse; nullopt for what is no reading's name.
std::optional<ReadingKey> key_of(std::string_view name);

/// The first of the names or patterns of names (glob.h) that fits the key; nullopt: none does.
std::optional<std::size_t> place_among(const ReadingKey& key, const std::vector<std::string>& names);

/// Whether every name with this subject leads back to it. A probe "x_min" is not clear: its median and the minimum of "x" have one name.
bool is_clear_subject(SubjectKind kind, std::string_view subject);
/// A pass's name as it stands in readings: "display: glare" is "display__glare".
std::string pass_subject(std::string_view pass);
/// The part of a glare reading's name that tells the eye, "glare_mirrors_at_15m", and the key with its fields alone.
std::string eye_name(const ReadingKey& key);
std::optional<ReadingKey> eye_of(std::string_view name);

const char* unit_of(const ReadingKey& key); ///< "m", "cd/m2", "%", "1"
bool is_extent(const ReadingKey& key);      ///< reach, unlit length, width, area
bool is_time(const ReadingKey& key);        ///< of this machine: reported, never compared
bool is_uncertainty(const ReadingKey& key); ///< of another reading: never compared itself
bool is_of_cars(const ReadingKey& key);     ///< a quantile of cars within tolerances, or a share of them

/// Every key of the sample's quantity, with its subject, lane, distance and threshold's value where names have them.
std::vector<ReadingKey> shapes_of(const ReadingKey& sample);

/// How a quantity's names are made, for people: "reach_5lx_(road/target)_LANE[_min/_p05]_m"; numbers stand for any.
std::vector<std::string> forms_in_words(const QuantityRow& row);

/// As tables have them: "grid_error", "median", "road", "left_edge", "de_boer"; "" for none.
const char* name_of(Aspect aspect);
const char* name_of(Statistic statistic);
const char* name_of(ReadingSurface surface);
const char* name_of(ReadingPlace place);
const char* name_of(ThresholdUnit unit);

} // namespace fernlicht
