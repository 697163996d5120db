// Axes of a plot: where a value falls between the edges, and which values deserve a tick.
#pragma once

#include <string>
#include <vector>

namespace fernlicht::plots {

/// signed_logarithmic: for differences, logarithmic to both sides of 0, with three decades below each end; smaller values stand at 0. The
/// axis runs from -to to `to`.
enum class Scale { linear, logarithmic, signed_logarithmic };
inline constexpr double signed_decades = 3.0;

struct Axis {
    std::string label; ///< "reach over the drive"
    std::string unit;  ///< "m"; "" for none
    double from = 0.0; ///< value at the left or bottom edge; above `to` the axis runs backwards
    double to = 1.0;
    Scale scale = Scale::linear;    ///< logarithmic: both ends above 0; signed: from == -to
    std::vector<double> ticks = {}; ///< empty: chosen
};

/// 0 at `from`, 1 at `to`, outside beyond. NaN where the value has no place (not finite; not above 0 on a logarithmic axis).
double position(const Axis& axis, double value);

struct Tick {
    double value = 0.0;
    std::string label; ///< "" for a minor tick
    bool operator==(const Tick&) const = default;
};

/// Linear: multiples of 1, 2 or 5 times a power of ten, at most `most` labelled. Logarithmic: decades, with 2 and 5 (then all
/// digits as minor ticks) where there is room. Given ticks are taken as they are.
std::vector<Tick> ticks_of(const Axis& axis, int most);

/// An axis that holds all `values` that are finite (and above 0 if logarithmic), its ends moved out to round numbers.
/// Falls back to 0..1 (0.1..1) when there are none.
Axis axis_around(std::string label, std::string unit, const std::vector<double>& values, Scale scale = Scale::linear,
                 bool include_zero = false);

/// Shortest text of a tick's value: "0.2", "150", "2e6".
std::string number(double value);

} // namespace fernlicht::plots
