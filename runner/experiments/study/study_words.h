// What a study comes to, in sentences that terminal, page, JSON and tables share.
#pragma once

#include "runner/experiments/study/study_result.h"

namespace fernlicht {

/// What the study calls the lamps of one of the result's cells.
const std::string& lamp_of(const StudyResult& result, std::size_t cell);

/// Whether anything was held against a limit, a reference or a repeat, or is missing.
bool was_judged(const StudyResult& result);

/// Why no deciding reading could be compared, as a sentence; "" where at least one could, and where nothing was to be compared.
std::string nothing_compared(const StudyResult& result);

/// How many deciding readings changed, or why that is not known.
std::string study_sentence(const StudyResult& result);

/// "9 of 660 moments of each drive were played (--frames 0:8)"; "" where all were.
std::string played_in_part(const StudyResult& result);
/// The same of one cell: "9 of 660 moments (--frames 0:8)", or "all moments".
std::string moments_text(const StudyResult& result, const CellResult& cell);

} // namespace fernlicht
