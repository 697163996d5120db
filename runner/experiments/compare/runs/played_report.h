// The results of one drive with one lamp set, read from a run's folder.
#pragma once

#include "metrics/readings/significance.h"
#include "runner/files/csv_file.h"
#include "runner/findings/gazes.h"
#include "runner/findings/report.h"

namespace fernlicht {

/// Reach along a line of a lane over a drive; NaN where it was not measured.
struct ReachOverDrive {
    ReadingKey key; ///< of its median
    std::vector<double> distance_m, reach_m;
};

/// Illuminance in an oncoming eye, facing the lamps, or through mirrors, over the distance to it; NaN where it was not measured.
struct GlareOverDrive {
    ReadingKey eye;
    std::string over; ///< "distance to the observer"
    std::vector<double> at_m, facing_lx;
};

struct PlayedResult : ReadingsOfCell {
    std::string drive, lamp_set;         ///< names as the report has them; "" when it was not played
    std::vector<ReachOverDrive> reaches; ///< rendered
    std::vector<GlareOverDrive> glares;
    Gazes gazes;
    std::vector<StoredFrame> frames; ///< paths below what the folder is named by
    std::vector<LampAim> aims;
    std::shared_ptr<const SeriesFindings> series;         ///< as PlayedCell
    std::vector<Verdict> verdicts;                        ///< limits of the drive, baselines
    std::optional<double> error_share, error_floor_share; ///< 95 % of the road's illuminance against the reference lies within
    std::optional<double> frame_s;                        ///< a driver's view
};

/// Of one that was played: steps of the drive apart, which a report does not hold.
ReadingsOfCell whole_drive_readings(const PlayedCell& played);

/// Of one that was played; its frames' paths begin with `folder` ("" for none), its moments are those of read_moments(). Reaches are of the
/// readings that decide, by name or pattern.
PlayedResult played_result(const PlayedCell& played, const CsvFile& moments, const std::string& folder,
                           const std::vector<std::string>& decide);

} // namespace fernlicht
