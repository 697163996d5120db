#include "metrics/images/srgb.h"

#include <cmath>
#include <cstddef>

namespace fernlicht {

double srgb_decoded(double encoded) { return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4); }

const std::array<float, 256>& srgb_table() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = static_cast<float>(srgb_decoded(static_cast<double>(i) / 255.0));
        return values;
    }();
    return table;
}

} // namespace fernlicht
