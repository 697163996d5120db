// Which extents a drive has, and where to find them among its moments.
#pragma once

#include "runner/findings/report.h"

namespace fernlicht {

const char* surface_name(Surface surface);  ///< "road", "target"
const char* verdict_name(VerdictKind kind); ///< "pass", "fail", "not_measured"

/// Every key that occurs in any moment (rendered or twin): planes, then lanes, in the order of first sight, then limits ascending.
std::vector<ExtentKey> extent_keys(const PlayedCell& played);

/// The reading of an extent, over the whole drive.
ReadingKey extent_reading(const ExtentKey& key, Quantity quantity, ReadingPlace place = ReadingPlace::none, Aspect aspect = Aspect::value);

/// The extent of that key in one moment's list; nullptr where there is none (a lane that ended).
const LaneExtent* find_extent(const std::vector<LaneExtent>& extents, const ExtentKey& key);

} // namespace fernlicht
