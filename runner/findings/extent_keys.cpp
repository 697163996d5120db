#include "runner/findings/extent_keys.h"

#include <algorithm>
#include <tuple>

namespace fernlicht {

const char* surface_name(Surface surface) { return surface == Surface::road ? "road" : "target"; }

const char* verdict_name(VerdictKind kind) {
    switch (kind) {
    case VerdictKind::pass:
        return "pass";
    case VerdictKind::fail:
        return "fail";
    case VerdictKind::flaky:
        return "flaky";
    case VerdictKind::not_measured:
        break;
    }
    return "not_measured";
}

std::vector<ExtentKey> extent_keys(const PlayedCell& played) {
    std::vector<std::string> lanes;
    std::vector<ExtentKey> keys;
    const auto collect = [&](const std::vector<LaneExtent>& extents) {
        for (const LaneExtent& extent : extents) {
            if (std::find(lanes.begin(), lanes.end(), extent.lane) == lanes.end())
                lanes.push_back(extent.lane);
            const ExtentKey key{extent.surface, extent.lane, extent.threshold_lx};
            if (std::find(keys.begin(), keys.end(), key) == keys.end())
                keys.push_back(key);
        }
    };
    for (const ExtentRow& row : played.extents) {
        collect(row.rendered);
        collect(row.twin);
    }
    const auto rank = [&](const ExtentKey& key) {
        return std::tuple(key.surface, std::find(lanes.begin(), lanes.end(), key.lane) - lanes.begin(), key.threshold_lx);
    };
    std::stable_sort(keys.begin(), keys.end(), [&](const ExtentKey& a, const ExtentKey& b) { return rank(a) < rank(b); });
    return keys;
}

ReadingKey extent_reading(const ExtentKey& key, Quantity quantity, ReadingPlace place, Aspect aspect) {
    return {.quantity = quantity,
            .surface = key.surface == Surface::road ? ReadingSurface::road : ReadingSurface::target,
            .lane = key.lane,
            .threshold = {key.threshold_lx, ThresholdUnit::lx},
            .place = place,
            .aspect = aspect};
}

const LaneExtent* find_extent(const std::vector<LaneExtent>& extents, const ExtentKey& key) {
    const auto found = std::find_if(extents.begin(), extents.end(), [&](const LaneExtent& extent) {
        return extent.surface == key.surface && extent.threshold_lx == key.threshold_lx && extent.lane == key.lane;
    });
    return found == extents.end() ? nullptr : &*found;
}

} // namespace fernlicht
