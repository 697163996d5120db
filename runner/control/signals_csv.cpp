#include "runner/control/signals_csv.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {

std::string signals_csv(const ControlRun& run, int first, int last) {
    std::string text = "frame";
    for (const std::string& name : run.signals)
        text += "," + name;
    text += '\n';
    for (int tick = std::max(first, 0); tick <= last && static_cast<std::size_t>(tick) < run.rows.size(); ++tick) {
        text += fmt::format("{}", tick);
        for (const double value : run.rows[static_cast<std::size_t>(tick)])
            text += std::isnan(value) ? "," : fmt::format(",{}", value);
        text += '\n';
    }
    return text;
}

} // namespace fernlicht
