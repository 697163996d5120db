// What a run tells: report.json, its document and page.
#pragma once

#include "runner/files/csv_file.h"
#include "runner/findings/run_page.h"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace fernlicht {

/// docs/report.md and report.schema.json describe it. Throws std::logic_error naming the place when a number is NaN or infinite:
/// whoever measured it owed a not_measured.
std::string report_json(const Report& report);
std::string report_json_schema();
/// The text of a report.json with the verdicts, and the command and inputs, of `report`, which was read from it.
std::string rejudged_json(const std::string& kept, const Report& report);
/// An entry of the report's `drives`: all results of one drive with one lamp set, no readings, moments and times.
nlohmann::ordered_json played_json(const PlayedCell& played);

/// A complete run as it was written, without lux maps, summaries and what moments were like; readings come from readings.csv. Throws
/// InputError for what is no such run, and where readings.csv has more or fewer than it says.
Report read_report(const std::filesystem::path& folder);
/// What the moments of one of its cells were like. Throws InputError where there are more or fewer than it says.
CsvFile read_moments(const std::filesystem::path& folder, const Report& report, std::size_t cell);

/// All of the page but what a document cannot hold: figures at a glance, the chooser of moments with its pictures and maps.
Document document(const Report& report);
RunPage run_page(const Report& report);
RunPage verdict_page(const Report& report); ///< without what was found

} // namespace fernlicht
