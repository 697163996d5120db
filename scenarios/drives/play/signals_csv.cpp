#include "scenarios/drives/play/signals_csv.h"

#include "scenarios/drives/play/bus_play.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {

std::string signals_csv(const Drive& drive, const ControlRun& run, int first, int last) {
    std::string text = "frame";
    const std::vector<BusInput> no_inputs;
    const std::vector<BusInput>& inputs = drive.bus ? drive.can->inputs : no_inputs;
    for (const std::string& name : run.signals)
        text += "," + name;
    for (const BusInput& input : inputs)
        text += fmt::format(",{0}.state,{0}.age_s", input.name);
    text += '\n';
    for (int tick = std::max(first, 0); tick <= last && static_cast<std::size_t>(tick) < run.rows.size(); ++tick) {
        text += fmt::format("{}", tick);
        for (const double value : run.rows[static_cast<std::size_t>(tick)])
            text += std::isnan(value) ? "," : fmt::format(",{}", value);
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            const BusValue& value = drive.bus->at(tick * drive.step_s)[i];
            text += fmt::format(",{},{}", name_of(value.state), value.age_s);
        }
        text += '\n';
    }
    return text;
}

} // namespace fernlicht
