// One lamp, aimed, against the rows of one table.
#pragma once

#include "metrics/beam/received_beam.h"
#include "metrics/regulation/regulation.h"

#include <string>
#include <vector>

namespace fernlicht {

enum class RowVerdict { pass, fail, not_measured };

struct RowResult {
    std::string id;
    RowVerdict verdict = RowVerdict::not_measured;
    double found = 0.0;      ///< what is nearest to its limit, or beyond it; 0 where not measured
    std::string unit = "cd"; ///< of `found` and `limits`; "deg" and "" of rows about the cut-off
    Direction where;         ///< of it; of a sum the first of its directions
    Limits limits;           ///< ratios worked out
    double margin = 0.0;     ///< relative to the limit, signed: found / min - 1 or 1 - found / max, the smaller of both; >= 0 passes
    bool minimum_decides = false;
    Direction re_aimed;       ///< how far the row was turned off its place to pass; 0, 0: not at all
    std::vector<int> lamps;   ///< of rows for each lamp: which one decided, 0 or 1
    std::string reason, note; ///< why it was not measured; what else is to say
};

/// `lamps`: one, or the left and the right one. Rows for two lamps are left out where there is one. A row with a minimum that reaches
/// beyond a file's angles is not_measured; one with a maximum alone is judged by what the file has, which its note tells, and not_measured
/// where that is nothing. `only`: these rows by their ids; empty: all.
std::vector<RowResult> check_rows(const Regulation& regulation, const std::vector<AimedLamp>& lamps,
                                  const std::vector<std::string>& only = {});

/// Whether a row that failed would also fail, whatever its cause, with the lamps turned anywhere within an allowance: by the brightest and
/// darkest samples that could come to where it failed. False says nothing.
bool out_of_reach(const Regulation& regulation, const std::vector<AimedLamp>& lamps, const RowResult& failed, const ReAim& allowance);

/// Passes: the margin is at least -1e-9, which is the rounding of a mean over the receiver.
inline constexpr double margin_rounding = 1e-9;

/// fail where one row fails, else not_measured where one was not, else pass.
RowVerdict verdict_of(const std::vector<RowResult>& rows);

} // namespace fernlicht
