// Error against run time: ways to get one result, what each costs and how far off it is, and which of them nobody beats on both.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht {

/// A figure with the interval that it was found in: low <= value <= high.
struct Interval {
    double value = 0.0, low = 0.0, high = 0.0;
    std::size_t samples = 0; ///< of a repeated measurement: how many; 0 for what was not repeated
    bool of_median = false;  ///< low to high holds the median of what the samples were drawn from with 95 %; else from min to max
    bool operator==(const Interval&) const = default;
};

/// Of a value that was measured once, without a word on how often.
inline Interval exactly(double value) { return {value, value, value}; }

/// One way, with its parameters.
struct WorkPrecisionRow {
    std::string label;
    std::vector<std::pair<std::string, std::string>> parameters; ///< name and value: {"resolution", "512x384"}
    std::optional<Interval> error;                               ///< >= 0, in the diagram's unit; nullopt: not measured
    std::optional<Interval> seconds;                             ///< > 0; nullopt: not measured
    double floor = 0.0;                                          ///< what the error was measured against is itself no better than this
    std::optional<std::uint64_t> bytes;                          ///< of memory, where it was counted
    std::string why_not;                                         ///< why the error or the time is not measured
    std::string note;                                            ///< "as the founding thesis had it"; "" for none

    bool measured() const { return error && seconds; }
    bool below_floor() const { return error && error->value < floor; }
    /// What may be claimed: the error, or the floor where it lies below.
    double claimed_error() const { return below_floor() ? floor : error->value; }
};

struct WorkPrecision {
    std::string name, title;            ///< "techniques"; "Techniques, error of illuminance on the road"
    std::string error_name, error_unit; ///< "lux error on the road, 95 % of the pixels", "%"
    std::string time_name;              ///< "time a frame"
    std::string floor_name;             ///< "noise of the reference"; "" where there is none
    std::vector<std::string> notes;     ///< what was held against what, one sentence each
    std::vector<WorkPrecisionRow> rows;
};

/// Whether somebody is at least as good as a row in claimed error and in time, and better in one of them.
struct Standing {
    bool on_front = false; ///< measured, and nobody is
    std::optional<std::size_t>
        dominated_by; ///< the row on the front that is, with the least error; of equals the fastest, of those the first
    /// And in both it is either the same or better by more than both intervals, with at least fewest_timings of either.
    bool surely = false;
};
/// Samples of times of which all of one lie below all of the other by chance in at most one of twenty cases (3! 3! / 6!). Fewer tell
/// nothing surely.
inline constexpr std::size_t fewest_timings = 3;

/// One for each row, in their order. Rows that are not measured have no standing. Equal rows do not dominate one another.
std::vector<Standing> standings(const std::vector<WorkPrecisionRow>& rows);

/// Slope of ln(error) over ln(work) by least squares: -1/2 for a mean of independent samples. Points that are not above 0 are left out;
/// nullopt for fewer than two different works.
std::optional<double> logarithmic_slope(const std::vector<std::pair<double, double>>& work_and_error);

} // namespace fernlicht
