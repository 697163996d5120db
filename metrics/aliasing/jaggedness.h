// Stairs along a line of equal value, as of a cut-off: how far it strays from where the reference has it.
#pragma once

#include "scenarios/values/image.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace fernlicht {

struct Jaggedness {
    double rms_px = 0.0;            ///< of the distance between both lines, across them, less its mean over 32 pixels each way
    double worst_px = 0.0;          ///< the largest of them
    std::size_t points = 0;         ///< where the tested picture's line crosses between two pixels' centres
    std::size_t without = 0;        ///< crossings left out: the reference has no line within `search_px`
    double standard_error_px = 0.0; ///< of rms_px, by its spread over pieces of 32 x 32 pixels; 0 where there is only one
};

/// The tested picture's line at `level` is where it crosses `level` between the centres of two neighbouring pixels (linear between them),
/// along x or y, whichever the picture changes faster along; the reference's the nearest crossing along the same straight line, between its
/// own samples. A step drawn without anti-aliasing along x reads |cos| / sqrt(12) for the angle between x and its normal: what is left of
/// rounding to whole pixels. `reference` is k times as fine. nullopt where fewer than 16 points have a partner: nothing to measure.
/// Only between pixels for which both `where` is not 0; an empty one takes all. Throws std::invalid_argument for sizes that do not fit or a
/// level that is not finite.
std::optional<Jaggedness> measure_jaggedness(const Image<float>& tested, const Image<float>& reference, int k, double level,
                                             double search_px = 2.0, const Image<std::uint8_t>& where = {});

} // namespace fernlicht
