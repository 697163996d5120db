// A comparison of two runs as text, JSON, CSV, pictures and a page.
#pragma once

#include "runner/experiments/compare/runs/run_comparison.h"

#include <filesystem>

namespace fernlicht {

/// For the terminal; ends with a newline.
std::string runs_text(const RunComparison& runs);
/// compare.schema.json describes it.
std::string runs_json(const RunComparison& runs);
/// RFC 4180: a line a reading and a time; a line a figure of a stored frame's channel.
std::string runs_csv(const RunComparison& runs);
std::string frames_csv(const RunComparison& runs);

/// Draws figures of every drive, and below frames/ pictures of `pictured` moments of each drive and view that differ: spread evenly, and
/// the one that differs most. Fills in what was drawn.
void draw_runs(RunComparison& runs, const RunCompareOptions& options, std::size_t pictured, const std::filesystem::path& folder);

/// One self-contained page; pictures are read below `folder` and the runs' own.
std::string runs_html(const RunComparison& runs, const std::filesystem::path& folder);

/// "c0-12": a reading's row in the page, in compare.json and in compare.csv.
std::string row_id(std::size_t drive, std::size_t change);

/// What the comparison comes to, in one sentence.
std::string runs_sentence(const RunComparison& runs);

/// The value of a layer's figure by name; nullopt where it was not measured.
std::optional<double> value_in(const LayerComparison& layer, const std::string& name);

} // namespace fernlicht
