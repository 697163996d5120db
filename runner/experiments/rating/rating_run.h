// One lamp set rated by a rating's drives.
#pragma once

#include "metrics/importance/reading_of_light.h"
#include "runner/experiments/rating/rating_result.h"
#include "runner/play/stage.h"

namespace fernlicht {

struct RatingRequest : ExperimentRequest<RatingFound> {
    Rating rating;
    std::filesystem::path lamps; ///< file of lamp sets, or a drive
    std::string lamp_set;        ///< of it; "": its first
};

/// By the twin: needs no device, and nothing hides a lamp. Throws InputError for what the drives lack.
RatingFound run_rating(const RatingRequest& request);

/// What one row judges, played: light on its photometers where it counts, with the limits that it has there, or a reading.
struct RatedRow {
    std::unique_ptr<Stage> stage;
    std::string lamp_set;
    std::vector<Moment> moments;
    std::vector<LimitedLight> lights; ///< unrounded; none of a reading
    std::optional<ReadingKey> key;
};
/// `photometer`: of a row of light the only one that counts; "": all. Throws InputError naming --row or --photometer for what the rating
/// lacks, for a row that is told alone or not measured, and where light above a limit may pass for a moment.
RatedRow rated_row(const Rating& rating, const std::string& row, const std::string& photometer, const std::filesystem::path& lamps,
                   const std::string& lamp_set);

} // namespace fernlicht
