// Beyond a picture's border it goes on as in a mirror that stands on the border.
#pragma once

namespace fernlicht {

/// The pixel 0 .. count - 1 that is seen at place i: -1 is 0 again, count is count - 1. count > 0.
inline int mirrored(int i, int count) {
    const int period = 2 * count;
    const int within = ((i % period) + period) % period;
    return within < count ? within : period - 1 - within;
}

} // namespace fernlicht
