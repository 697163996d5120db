// The five forms of a report as text. Pure functions of the report, except that the page reads the frames that it embeds.
#pragma once

#include "runner/findings/report.h"

#include <string>

namespace fernlicht {

/// docs/report.md and report.schema.json describe it. Throws std::logic_error naming the place when a number is NaN or infinite:
/// whoever measured it owed a not_measured.
std::string report_json(const Report& report);

/// One test suite per drive and variant, one test case per verdict. Carries no times, so that equal runs give equal bytes.
std::string report_junit(const Report& report);

/// RFC 4180, one line per reading.
std::string report_csv(const Report& report);

/// RFC 4180: times of passes and the run's throughput. What differs from run to run is here and not in report_csv.
std::string times_csv(const Report& report);

/// One self-contained page. Frames are read from `folder`; one that is missing or unreadable is linked and said to be missing.
std::string report_html(const Report& report, const std::filesystem::path& folder);

/// Writes report.json, junit.xml, readings.csv, times.csv and report.html into `folder` (frames are there already). Each file atomically.
void write_report(const Report& report, const std::filesystem::path& folder);

} // namespace fernlicht
