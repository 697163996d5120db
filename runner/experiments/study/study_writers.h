// The forms of a study's result as text, and its pictures. Pure functions of the result, except where a folder is given.
#pragma once

#include "metrics/readings/reading_words.h"
#include "runner/experiments/study/study_result.h"

#include <filesystem>

namespace fernlicht {

/// For the terminal: verdict, what differs between the lamps, the largest changes, what failed. Ends with a newline.
std::string study_text(const StudyResult& result);

/// study.schema.json describes it. What differs from call to call stands under `context` and each cell's `times`.
std::string study_json(const StudyResult& result);
/// RFC 4180: one line a change.
std::string study_csv(const StudyResult& result);
/// Tables of the deciding readings: GitHub's Markdown, and LaTeX with booktabs.
std::string study_markdown(const StudyResult& result);
std::string study_latex(const StudyResult& result);
/// One test suite a cell, and one of the study's own limits.
std::string study_junit(const StudyResult& result);

/// Reach over each drive, lux from above and its difference, error over time, the lamps' difference. EXR files are read below `folder`.
std::vector<StudyFigure> study_figures(const StudyResult& result, const std::filesystem::path& folder);

/// One self-contained page; pictures of the driver's view are read below `folder`.
std::string study_html(const StudyResult& result, const std::filesystem::path& folder);

/// "+3.2 m" with as many digits as its uncertainty deserves.
std::string delta_text(const Change& change);

} // namespace fernlicht
