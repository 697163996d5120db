// Which extents a drive has, which figures each of them has, and where to find them among its moments.
#pragma once

#include "runner/findings/report.h"

#include <algorithm>
#include <array>
#include <span>

namespace fernlicht {

const char* surface_name(Surface surface);  ///< "road", "target"
const char* verdict_name(VerdictKind kind); ///< "pass", "fail", "not_measured"
const char* verdict_text(VerdictKind kind); ///< as people read it: "not measured"

/// Every key that occurs in any moment (rendered or twin): planes, then lanes, in the order of first sight, then limits ascending.
std::vector<ExtentKey> extent_keys(const PlayedCell& played);

/// A line along a lane, and where it ends.
struct ExtentLine {
    double LaneExtent::*reach_m;
    bool LaneExtent::*is_cut_off;
};

/// One figure of a lane's extent: its readings and its columns of moments. Its unit is the quantity's; in a mirrored drive it changes
/// places with the figure whose place is the other side's.
struct ExtentFigure {
    Quantity quantity = Quantity::reach;
    ReadingPlace place = ReadingPlace::none;
    Aspect aspect = Aspect::value;
    bool (*is_of)(const std::string& lane) = [](const std::string&) { return true; };
    std::array<Statistic, 4> statistics = {Statistic::median}; ///< over the moments; none: no more
    const char* where = "";                                    ///< for people, behind the lane
    const char* where_of_all = nullptr;                        ///< the same of "all", which has no lines of its own; nullptr: as any lane's
    // What it is in a moment, one of these two; width has none.
    double LaneExtent::*member = nullptr;
    const ExtentLine* line = nullptr; ///< whose end the member is known up to; nullptr: that of each line
    Value GridError::*grid_error = nullptr;
    const char* error_column_of = ""; ///< the lane whose grid error is a column of moments
};
/// In the order in which a lane's readings are listed.
std::span<const ExtentFigure> extent_figures();

/// The reading of an extent, over the whole drive.
ReadingKey extent_reading(const ExtentKey& key, Quantity quantity, ReadingPlace place = ReadingPlace::none, Aspect aspect = Aspect::value,
                          const std::optional<double>& distance_m = {});

/// A figure's moments; none where the summary has none.
const CensoredSamples& moments_of(const ExtentSummary& summary, Quantity quantity, Aspect aspect = Aspect::value,
                                  const std::optional<double>& distance_m = {});

/// The extent (its grid error) of that key in one moment's list; nullptr where there is none, as of a lane that ended.
template <typename Of> const Of* find_extent(const std::vector<Of>& extents, const ExtentKey& key) {
    const auto found = std::ranges::find_if(extents, [&](const Of& extent) {
        return extent.surface == key.surface && extent.threshold_lx == key.threshold_lx && extent.lane == key.lane;
    });
    return found == extents.end() ? nullptr : &*found;
}

} // namespace fernlicht
