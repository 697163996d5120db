// Figures of the accuracy's tables and plots as text.
#pragma once

#include "metrics/work_precision.h"

#include <string>

namespace fernlicht {

/// Two significant digits without an exponent from 0.001 on: "0.053", "12", "1.2e-05"; "0".
std::string two_digits(double value);
/// "0.053 %"; "< 0.02 %" for an error below the floor; "not measured".
std::string claimed_text(const WorkPrecisionRow& row, const std::string& unit);
/// "12.3 ms", "0.85 s".
std::string time_text(double seconds);
/// "front", "beaten by 3" (numbers from 1), "perhaps by 3" where the bars overlap, "".
std::string standing_text(const Standing& standing);

} // namespace fernlicht
