// Which part of the beam decides one reading of a drive.
#pragma once

#include "runner/experiments/importance/importance_result.h"
#include "runner/play/play.h"
#include "scenarios/ratings/rating.h"

#include <optional>

namespace fernlicht {

struct ImportanceRequest : ExperimentRequest<ImportanceResult> {
    Drive drive;
    std::string lamp_set; ///< "": the first
    std::string reading;  ///< as typed; "": the row's
    TickRange ticks;
    /// In place of a drive and its reading: a row of a rating, all of its photometers or one, by the lamps of this file.
    struct Row {
        Rating rating;
        std::string name, photometer;
        std::filesystem::path lamps;
    };
    std::optional<Row> row;
    int check = 20; ///< random changes that are tried; 0: none
    std::uint64_t seed = 1;
};

/// Needs no device. Throws InputError for a reading that it cannot tell of, or that the drive does not measure.
ImportanceResult run_importance(const ImportanceRequest& request);

} // namespace fernlicht
