// Piecewise cubics over arc length or over t: the piece that holds, and its value.
#pragma once

#include "scenarios/roads/road_network.h"

#include <algorithm>

namespace fernlicht {

/// The last piece that begins at or before `s`; nullptr before the first: nothing is defined there, which OpenDRIVE takes as zero.
inline const Cubic* piece_at(const std::vector<Cubic>& pieces, double s) {
    if (pieces.size() == 1)
        return s >= pieces.front().s0 ? &pieces.front() : nullptr;
    const auto after = std::upper_bound(pieces.begin(), pieces.end(), s, [](double at, const Cubic& piece) { return at < piece.s0; });
    return after == pieces.begin() ? nullptr : &*(after - 1);
}

inline double value_at(const std::vector<Cubic>& pieces, double s) {
    const Cubic* piece = piece_at(pieces, s);
    return piece ? piece->at(s) : 0.0;
}

} // namespace fernlicht
