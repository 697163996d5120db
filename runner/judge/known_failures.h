// The list of known failures and flakes: what is red today, why, and until when that is accepted.
#pragma once

#include "runner/findings/report.h"

namespace fernlicht {

struct KnownFailure {
    std::string id;                       ///< of verdicts: DRIVE/LAMP SET/TECHNIQUE/NAME; `*` stands for any text, `?` for one character
    VerdictKind kind = VerdictKind::fail; ///< fail or flaky: how it is red
    std::string reason;
    std::string expires; ///< 2026-12-31: the last day that it holds, UTC
    std::size_t line = 0;
};

struct KnownFailures {
    std::filesystem::path file;
    std::vector<KnownFailure> entries;
    FilesRead opened;
};

/// Reads `known:`, a list of {id, kind: fails | flaky, reason, expires}; all four are required. Throws InputError with line and column:
/// unknown keys, an id without a drive, a kind that is none, an empty reason, what is no date, an id given twice.
KnownFailures read_known_failures(const std::filesystem::path& file);

/// A date as 2026-12-31 that the calendar has.
bool is_date(const std::string& text);

/// "straight/halogen/photometric/reach_5lx_road_own_m".
std::string verdict_id(const PlayedCell& played, const Verdict& verdict);

/// Marks verdicts by the first entry that names them: red in the way that is listed: known; green though listed as failing: an unexpected
/// pass, which is red. An entry past its day covers nothing and is red itself, as is one that names a drive of this run and none of its
/// verdicts; one that names no drive of this run is a warning. `today`: 2026-12-31.
void apply_known_failures(Report& report, const KnownFailures& known, const std::string& today);

} // namespace fernlicht
