// Cars of one series in JSON and as tables.
#pragma once

#include "metrics/tolerances/cars_readings.h"
#include "runner/files/described_json.h"
#include "runner/findings/document.h"

namespace fernlicht {

JsonMembers series_members(SeriesFindings& series);

/// What varies, how, and who says so: one row a kind.
Table tolerances_table(const SeriesFindings& series, const std::string& name);
/// Quantiles of the readings whose names these are (place_among), or of all, for nullptr; what told them, and what moves them most.
Table cars_table(const SeriesFindings& series, const std::string& name, const std::vector<std::string>* names);
/// Shares of cars within limits.
Table within_table(const SeriesFindings& series, const std::string& name);
/// "93.5 (89.2 … 96.2)", as within_table and a study have it; "> 93.5" where cars are open; or that it is not measured.
Cell within_cell(const CarsWithin& within);
/// "at least 50 and at most 60 m"
std::string limit_words(const Limit& limit);
/// "62.1 (55.0 … 68.2)": as designed, and what 5 % and 95 % of the cars lie below.
Cell cars_cell(const ReadingOfCars& of);

} // namespace fernlicht
