// One lamp set rated by a rating's drives.
#pragma once

#include "runner/experiments/rating/rating_result.h"

namespace fernlicht {

struct RatingRequest : ExperimentRequest<RatingFound> {
    Rating rating;
    std::filesystem::path lamps; ///< file of lamp sets, or a drive
    std::string lamp_set;        ///< of it; "": its first
};

/// By the twin: needs no device, and nothing hides a lamp. Throws InputError for what the drives lack.
RatingFound run_rating(const RatingRequest& request);

} // namespace fernlicht
