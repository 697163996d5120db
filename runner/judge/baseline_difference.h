// Results against accepted ones, one by one: readings by their spread over repeats, frames pixel by pixel.
#pragma once

#include "runner/judge/baseline.h"

namespace fernlicht {

/// Within one device class the same bytes are promised. These tolerances forgive what another patch level of a driver or a
/// library may round otherwise, and nothing that light could explain: 2 % more light exceeds them twentyfold.
struct BaselineTolerance {
    double relative = 1e-3; ///< of the accepted value
    double absolute = 1e-4; ///< lx, cd/m2 or the reading's unit: where the accepted value is next to nothing
    /// Of a reading that says how exact or how sensitive another is, on top: this part of the other. Grid error and twin difference are
    /// differences of two such figures, which Mesa 22 and 25 round by up to 3.4e-6 of them differently, however small what remains is.
    double of_other = 1e-5;
    double percent_of_pixels = 0.01; ///< may lie beyond: edges where one triangle wins over another
    /// Of readings that vary: all tests of a lamp set together call chance a difference in one run of a thousand. A list of a hundred
    /// lamp sets, judged daily, is wrong three times a month; less often would take more repeats to see the same difference.
    double false_alarm = 1e-3;
    /// A test that allows more than this many tolerances (1 % of the value) could no longer see 2 % of light with certainty:
    /// it is not measured then.
    double max_allowed = 10.0;
    /// A standard error of so small a part of the tolerance does not matter, however few repeats it is known by: of two plays one in a
    /// hundred pairs lies a hundred times closer than they spread, and then the tolerance is still as wide as the noise.
    double negligible_noise = 100.0;
};

enum class Agreement { agrees, differs, undecided };
struct ResultDifference {
    std::string what; ///< "reach_5lx_road_own_m", "10 driver"
    Agreement agreement = Agreement::agrees;
    std::string text;                       ///< figures, and what they are judged by
    double of_allowed = 0.0;                ///< how far off, 1: as far as is allowed; to find the farthest of those that agree
    std::optional<ReadingKey> reading = {}; ///< nullopt for frames
};

/// One entry for each reading that either side has. A reading that varies over the repeats of either side is judged by Student's test
/// (metrics/statistics/statistics.h) on top of the tolerance, all others by the tolerance alone.
std::vector<ResultDifference> compare_readings(const std::vector<AcceptedReading>& tested, const std::vector<AcceptedReading>& accepted,
                                               const BaselineTolerance& tolerance);

/// One entry for each channel of light of each frame that either side has: by the tolerance, or, where both sides know each pixel's
/// variance, by that (metrics/images/image_difference.h). A frame that cannot be read differs.
std::vector<ResultDifference> compare_frames(const std::vector<BaselineFrame>& tested, const std::vector<BaselineFrame>& accepted,
                                             const BaselineTolerance& tolerance);

} // namespace fernlicht
