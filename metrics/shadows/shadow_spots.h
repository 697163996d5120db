// Spots that are wrong where there is no doubt: shadow acne and light leaks.
#pragma once

#include "metrics/shadows/shadow_area.h"

namespace fernlicht {

struct ShadowSpots {
    std::size_t acne = 0, acne_px = 0;   ///< connected spots drawn dark in the light, and their pixels
    std::size_t leaks = 0, leaks_px = 0; ///< drawn lit in the shadow
    std::size_t sure_px = 0;             ///< pixels beyond doubt

    ShadowSpots& operator+=(const ShadowSpots& other);
    bool operator==(const ShadowSpots&) const = default;
};

/// Beyond doubt is a pixel that counts, truly lit or shadowed by at least 90 %, whose neighbours within `doubt_px` (Chebyshev's distance: a
/// square) all count and are so by the same; it is wrong where it is drawn on the other side of 50 %. Connected are wrong pixels of one
/// kind that touch by edge or corner. Throws std::invalid_argument for images of different sizes and doubt_px < 0.
ShadowSpots shadow_spots(const ShadowImages& images, int doubt_px, double floor_lx = shadow_floor_lx);

} // namespace fernlicht
