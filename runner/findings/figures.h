// Figures of tables and plots as text.
#pragma once

#include "metrics/statistics/work_precision.h"

#include <string>

namespace fernlicht {

/// Numbers for people: fixed decimals with U+2212 as minus sign; a difference always carries its sign.
std::string figure(double value, int decimals);
std::string signed_figure(double value, int decimals);
/// At most four significant digits without an exponent from 0.0001 on: "0.0812", "29.35", "23990"; U+2212 as minus sign.
std::string four_digits(double value);
/// Two significant digits without an exponent from 0.001 on: "0.053", "12", "1.2e-05"; "0".
std::string two_digits(double value);
/// How far a figure of about `of` is open: two digits, without exponents; where it is less than a thousandth of the figure or so, "< 0.01".
std::string open_figure(double open, double of);
/// The same in a sentence, with a unit and what else stands behind the figure: "±0.57 m", "±0.01 m at most".
std::string open_words(double open, double of, const std::string& behind = "");
/// "0.053 %"; "< 0.02 %" for an error below the floor; "not measured".
std::string claimed_text(const WorkPrecisionRow& row, const std::string& unit);
/// Of bytes, in MiB: "1.9".
std::string mib_text(std::uint64_t bytes);
/// "12.3 ms", "0.85 s".
std::string time_text(double seconds);
/// What a time and its bar come from: "medians of 7 rounds with their 95 % intervals", "medians of 4 rounds, bars from the least to the
/// most", "of one round, so that nobody is surely faster". For `samples` > 0.
std::string timings_text(const Interval& time);
/// "95 % interval of the median", "min to max", "one timing"; "" for what was not timed repeatedly.
std::string interval_name(const Interval& time);
/// "1 moment", "3 moments".
std::string counted(std::size_t count, const std::string& what);
/// "front", "beaten by 3" (numbers from 1), "perhaps by 3" where that is not sure, "".
std::string standing_text(const Standing& standing);

/// Of shadows: two significant digits, never an exponent, and 0 for what is below what can be measured. JSON and CSV have them in full.
/// Below these a figure is rounding: of single-precision light (%), of a pixel of the ground (0.02 m2), and a hundredth of the pixels in
/// which edges are measured (edge_pixel_m).
inline constexpr double min_shadow_percent = 1e-4, min_shadow_m2 = 5e-4, min_shadow_cm = 0.01;
/// "0.053", "12", "260", without the unit; "0" below `least`, which is 1e-4 or more.
std::string shadow_figure(double value, double least);
/// Of a share, in percent.
std::string shadow_percent(double share);
std::string shadow_m2(double m2);
std::string shadow_cm(double cm);

} // namespace fernlicht
