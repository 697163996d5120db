#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"

#include <fmt/format.h>

namespace fernlicht {

std::string accuracy_csv(const AccuracyResult& result) {
    std::string out = "diagram,row,parameters,error,error_low,error_high,error_unit,floor,seconds,seconds_low,seconds_high,timings,seconds_"
                      "interval,bytes,on_front,"
                      "beaten_by,beaten_surely,not_measured\r\n";
    const auto interval = [](const std::optional<Interval>& i) { return i ? fmt::format("{},{},{}", i->value, i->low, i->high) : ",,"; };
    for (const WorkPrecision& diagram : result.diagrams) {
        const std::vector<Standing> standing = standings(diagram.rows);
        for (std::size_t i = 0; i < diagram.rows.size(); ++i) {
            const WorkPrecisionRow& row = diagram.rows[i];
            std::string parameters;
            for (const auto& [name, value] : row.parameters)
                parameters += (parameters.empty() ? "" : "; ") + name + " " + value;
            const auto by = standing[i].dominated_by;
            out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", csv_text(diagram.name), csv_text(row.label),
                               csv_text(parameters), interval(row.error), csv_text(diagram.error_unit), row.floor, interval(row.seconds),
                               row.seconds ? fmt::format("{}", row.seconds->samples) : "", row.seconds ? interval_name(*row.seconds) : "",
                               row.bytes ? fmt::format("{}", *row.bytes) : "", standing[i].on_front ? "true" : "false",
                               by ? csv_text(diagram.rows[*by].label) : "", standing[i].surely ? "true" : "false", csv_text(row.why_not));
        }
    }
    return out;
}

} // namespace fernlicht
