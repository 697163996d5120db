// Axes of a study: any key of a drive, or what a car is built with, over values; and the points that are played.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht {

class YamlEntry;
struct Study;

/// One key over its values.
struct StudyAxis {
    std::string name;                ///< what the study calls it: its key, unless it says otherwise
    std::string key;                 ///< a key path of the drive (fields/key_path.h), or one of drive_axis_names() (axes_on_drive.h)
    std::vector<std::string> values; ///< YAML, each once; empty where there is a range alone
    std::optional<std::pair<double, double>> range; ///< from and to, for samples; values of `count` or `step` have none
    std::size_t line = 0, column = 0;               ///< in the study's file
};

enum class SampleKind { grid, one_at_a_time, low_discrepancy };

struct StudySample {
    SampleKind kind = SampleKind::grid;
    std::size_t count = 0;  ///< of low_discrepancy
    std::uint64_t seed = 0; ///< of low_discrepancy: 0 is Sobol's sequence as published (sobol.h)
};

/// Of one cell.
struct AxisValue {
    std::string axis, value; ///< name; YAML, "" for the drive's own

    bool operator==(const AxisValue&) const = default;
};

/// The value of each axis, as YAML; "" leaves the drive's own.
using StudyPoint = std::vector<std::string>;

inline constexpr std::size_t max_axes = 16, max_axis_values = 10'000;

/// `axes`: a map of key paths or names, each a list of values, a range {from, to, count or step} or at length {key, values or a range}.
/// `sample`: grid, one_at_a_time, or {low_discrepancy: count, seed}. Throws InputError: for a path that no drive has (with the nearest
/// known key), an axis twice, a value twice, one out of what a named axis allows.
void read_axes(const YamlEntry& given, Study& study);
void read_sample(const YamlEntry& given, Study& study);
std::string axes_schema();   ///< JSON
std::string sample_schema(); ///< JSON

/// All points. Grid: the last axis runs fastest. One at a
/// time: the drive as it is, then each axis alone. Low discrepancy: Sobol's points over ranges, and over lists by index. Without axes one
/// point without values.
std::vector<StudyPoint> points_of(const std::vector<StudyAxis>& axes, const StudySample& sample);
/// Their number without making them; the largest std::size_t where it is larger.
std::size_t number_of_points(const std::vector<StudyAxis>& axes, const StudySample& sample);

/// "weather.wetness 0.5, mount_height_m 0.65"; "base" of a point without values; "" without axes.
std::string point_text(const std::vector<StudyAxis>& axes, const StudyPoint& point);

/// Whether the drives' daylight is theirs and the axes', and no condition's.
bool is_daylight_an_axis(const std::vector<StudyAxis>& axes);

/// What of the file can only be judged when all of it is read: axes that the study's conditions, lamps or other keys would override, a
/// sample without axes, a range that no grid can take. Throws InputError.
void check_axes(const YamlEntry& file, const Study& study);

} // namespace fernlicht
