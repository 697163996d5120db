// Old value, new value and change of a reading as cells of tables.
#pragma once

#include "runner/experiments/study/study_result.h"

namespace fernlicht {

/// Two; more where the change, or else the value, would show less than two digits (glare of 0.0312 and 0.0298 lx is two values), but none
/// finer than the numerical uncertainty.
int decimals_of(const Change& change);
Cell cell_of(const Value& value, const std::string& rounded); ///< "> 200", "not measured"
Cell value_cell(const Value& value, int decimals);
Cell change_cell(const Change& change);                                   ///< "" where the change is not measured
Cell open_cell(const Change& change, const std::optional<double>& value); ///< open_figure; "" without a value
/// Of a change in a sentence: "±0.57 m", "±0.01 m at most".
std::string open_words(const Change& change, double value, const std::string& behind = "");
/// "+14.2 m (+21 %)"; "from not measured to 12.0 m" where there is no change to tell.
std::string change_words(const Change& change);

} // namespace fernlicht
