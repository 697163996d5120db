// What a run or a picture by rays found, as it would be accepted.
#pragma once

#include "runner/judge/accepted_reference.h"

namespace fernlicht {

struct RunResults {
    std::vector<AcceptedReference> references; ///< one for each lamp set of each drive
    std::string started_utc;
};

} // namespace fernlicht
