// The values of a drive at each moment: speed and car, extents of every lane, glare and light at fixed places, signals from a bus.
#pragma once

#include "runner/findings/report.h"

namespace fernlicht {

/// One figure, named as the reading that it adds up to, or "car.speed_mps", "glare_oncoming.facing_lx", "ego.speed_mps [km/h]".
struct MomentColumn {
    std::string name;
    /// A moment each: a number, a bound as "> 200", why there is none, or "" where the thing is not there. Metres of extents are rounded to
    /// a tenth of a millimetre, far below the grid's own error; what is measured otherwise has seven digits.
    std::vector<std::string> cells;
};

/// "frame" and "time_s", then the others. Throws std::logic_error naming the column for a number that is NaN or infinite: whoever measured
/// it owed a not_measured.
std::vector<MomentColumn> moment_columns(const PlayedCell& played);
/// Rows of them.
std::size_t moment_count(const PlayedCell& played);
/// Where those of each cell lie below the report's folder: "moments-DRIVE-LAMPS.csv", with "-2", "-3" ... behind the lamps where a cell
/// before it has that name.
std::vector<std::string> moments_files(const std::vector<PlayedCell>& played);

} // namespace fernlicht
