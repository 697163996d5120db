#include "renderer/reference/lanes.h"

#include "scenarios/values/pose.h"

#include <cmath>

namespace fernlicht::reference {

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
__attribute__((target_clones("avx512f", "avx2", "default"))) // chosen when the program starts; sanitizers cannot instrument that
#endif
void angles(const Lanes& y, const Lanes& x, Lanes& angle_rad) {
    for (std::size_t i = 0; i < packet_size; ++i) {
        const double ay = std::abs(y[i]), ax = std::abs(x[i]), small = ay < ax ? ay : ax, large = ay < ax ? ax : ay;
        // tan(a - pi/4) = (tan a - 1) / (tan a + 1) brings the upper half of the octant down.
        const bool upper = small > 0.66 * large;
        const double above = upper ? small - large : small, below = upper ? small + large : large;
        const double t = above / (below > 0.0 ? below : 1.0), z = t * t;
        const double p = (((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z - 7.500855792314704667340e1) * z -
                          1.228866684490136173410e2) *
                             z -
                         6.485021904942025371773e1;
        const double q = ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z + 4.328810604912902668951e2) * z +
                          4.853903996359136964868e2) *
                             z +
                         1.945506571482613964425e2;
        double a = t + t * (z * p / q);
        a = upper ? a + 0.25 * pi : a;
        a = ay > ax ? 0.5 * pi - a : a;
        a = x[i] < 0.0 ? pi - a : a;
        angle_rad[i] = y[i] < 0.0 ? -a : a;
    }
}

} // namespace fernlicht::reference
