// One lamp, aimed, against the rows of one table.
// The lowest and the highest received intensity on a segment or in a polygon, and where.
#pragma once

#include "metrics/beam/received_beam.h"
#include "metrics/regulation/regulation.h"

#include <optional>
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
    Direction re_aimed;                     ///< how far the row was turned off its place to pass; 0, 0: not at all
    std::vector<int> lamps;                 ///< of rows for each lamp: which one decided, 0 or 1
    std::string reason, note;               ///< why it was not measured; what else is to say
    Sureness sureness = Sureness::as_table; ///< of the limits; as_table: of rows about the cut-off, which no table has
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

struct Extreme {
    double cd = 0.0;
    Direction where;
};

struct Extremes {
    std::optional<Extreme> lowest, highest; ///< nullopt: not looked for, or nowhere data
    bool all_covered = true;                ///< data wherever it was looked
};

struct WantedExtremes {
    bool lowest = true, highest = true;
};

/// Samples stand at most ReceivedBeam::step_deg() apart, a third of the receiver. The received beam changes over half of that by at most
/// a sixth of what it differs between the receiver's opposite edges, so nothing narrower hides between samples; the best sample is then
/// followed to its extreme (steps down to 0.001 degrees), which leaves an error of second order only.
Extremes extremes_on(const ReceivedBeam& beam, Direction from, Direction to, WantedExtremes wanted = {});

/// The polygon with its border; corners in order, not crossing itself. Blocks that by the samples around them cannot hold an extreme are
/// left out, which changes no result.
Extremes extremes_in(const ReceivedBeam& beam, const std::vector<Direction>& corners, WantedExtremes wanted = {});

} // namespace fernlicht
