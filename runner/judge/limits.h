// A drive's limits against its readings.
#pragma once

#include "runner/findings/report.h"

namespace fernlicht {

/// One verdict for each limit of the drive. A limit on the whole drive's reading judges that; where a name has readings of single
/// moments only, the worst of them decides. A reading that is not measured, or that is not there at all, makes the verdict
/// not_measured: never green. `rerun` is left to the caller, here as in all of judge/.
std::vector<Verdict> judge_limits(const Drive& drive, const Readings& readings);

} // namespace fernlicht
