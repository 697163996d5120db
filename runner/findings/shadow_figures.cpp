#include "runner/findings/shadow_figures.h"

#include <cmath>
#include <fmt/format.h>

namespace fernlicht {

std::string shadow_figure(double value, double least) {
    if (std::abs(value) < least)
        return "0";
    return std::abs(value) < 99.5 ? fmt::format("{:.2g}", value) : fmt::format("{:.0f}", value);
}

std::string shadow_percent(double share) { return shadow_figure(100.0 * share, min_shadow_percent); }
std::string shadow_m2(double m2) { return shadow_figure(m2, min_shadow_m2); }
std::string shadow_cm(double cm) { return shadow_figure(cm, min_shadow_cm); }

} // namespace fernlicht
