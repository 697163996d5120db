// What a run leaves: report.json, the page, and the files that are made of its verdicts and readings.
#pragma once

#include "runner/findings/report.h"
#include "runner/write/document.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace fernlicht {

/// docs/report.md and report.schema.json describe it. Throws std::logic_error naming the place when a number is NaN or infinite:
/// whoever measured it owed a not_measured.
std::string report_json(const Report& report);
std::string report_json_schema();
/// An entry of the report's `drives`: all results of one drive with one lamp set, no readings, moments and times.
nlohmann::ordered_json played_json(const PlayedVariant& played);

/// A complete run as it was written, without lux maps, summaries and what moments were like; readings come from readings.csv. Throws
/// InputError for what is no such run.
Report read_report(const std::filesystem::path& folder);

/// All of the page but what a document cannot hold: figures at a glance, the chooser of moments with its pictures and maps.
Document document(const Report& report);

/// One self-contained page. Frames are read from `folder`; one that is missing or unreadable is linked and said to be missing.
std::string report_html(const Report& report, const std::filesystem::path& folder);

/// Writes report.json, junit.xml, readings.csv, times.csv, tables as asked for and report.html into `folder` (frames are there already).
/// Each file atomically.
void write_report(const Report& report, const std::filesystem::path& folder, TableFormat tables = TableFormat::none);

} // namespace fernlicht
