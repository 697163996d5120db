// A figure that may not be there.
#pragma once

#include <optional>
#include <string>

namespace fernlicht {

/// nullopt: not_measured, with the reason in `why_not`; never NaN.
struct Measured {
    std::optional<double> value;
    std::string why_not;
};

} // namespace fernlicht
