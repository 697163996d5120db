// Stairs along a line of equal value, such as a cut-off: how far it strays from the reference's line.
// Stairs along edges that have a name: the line of the cut-off on the road, and the borders of road marks. Silhouettes and shadows, which
// are no lines of a lamp, are left out.
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

/// What a sample of the reference shows.
enum class Ground : std::uint8_t { other, road, mark };

/// The reference, all pictures k times as fine as what is tested; an empty one is not known.
struct EdgeReference {
    int k = 0;
    Image<float> luminance_cdm2, illuminance_lx;
    Image<float> unshadowed_lx; ///< illuminance as if nothing stood in the way
    Image<Ground> ground;
};

struct EdgeJaggedness {
    Jaggedness found;
    double floor_px = 0.0; ///< what the reference itself reads, averaged over each pixel's area: what this measure takes for stairs though
                           ///< they are none. Nothing near it is told apart from 0
};

/// The line of `level_lx` where all within 2 pixels is road or mark and no shadow changes the light there by more than 2 %. nullopt for
/// fewer than 16 points. Throws std::invalid_argument for sizes that do not fit.
std::optional<EdgeJaggedness> cut_off_jaggedness(const Image<float>& tested_lx, const EdgeReference& reference, double level_lx);

/// Of straight borders (a Gaussian of 2 pixels is half mark, within 0.2), the line half way from road to mark where both fill a pixel
/// within 2 pixels, nothing else does, and the mark is at least twice as bright as the road. Brightness of road and of mark are the
/// reference's own, means under a Gaussian of 4 pixels; the line that should be there is where a mark covers half of a pixel's area.
/// nullopt and throws as above.
std::optional<EdgeJaggedness> mark_jaggedness(const Image<float>& tested_cdm2, const EdgeReference& reference);

} // namespace fernlicht
