// The files that a run leaves in its folder beside its pictures.
#pragma once

#include "runner/experiments/run/run_report.h"
#include "runner/write/formats.h"

namespace fernlicht {

/// The page alone; frames are read from `folder`.
std::string report_html(const Report& report, const std::filesystem::path& folder);

/// Writes report.json, junit.xml, readings.csv, times.csv, a CSV of each lamp set's moments, tables as asked for and report.html into
/// `folder` (frames are there already). Each file atomically.
void write_report(const Report& report, const std::filesystem::path& folder, const OutputFormat* tables = nullptr);

/// Results that were kept, judged anew: verdicts, warnings of them, title, command and inputs of report.json, junit.xml and report.html in
/// `folder` become those of `report`, which was read from it. Throws InputError where it was not.
void write_judgement(const Report& report, const std::filesystem::path& folder);

} // namespace fernlicht
