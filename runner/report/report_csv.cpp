#include "runner/report/clean_text.h"
#include "runner/report/report_writers.h"

#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {

std::string report_csv(const Report& report) {
    std::string out = "drive,variant,name,value,unit,where,frame,time_s,not_measured\r\n";
    for (const PlayedVariant& played : report.played)
        for (const Reading& reading : played.readings) {
            if (reading.value && !std::isfinite(*reading.value))
                throw std::logic_error("report: " + reading.name + " is not finite; a measurement that cannot be made is not_measured");
            std::string time_s;
            for (const ExtentRow& row : played.extents)
                if (row.tick == reading.tick)
                    time_s = fmt::format("{}", row.time_s);
            out += fmt::format("{},{},{},{},{},{},{},{},{}\r\n", csv_text(played.drive), csv_text(played.variant), csv_text(reading.name),
                               reading.value ? fmt::format("{}", *reading.value) : "", csv_text(reading.unit), csv_text(reading.where),
                               reading.tick < 0 ? "" : fmt::format("{}", reading.tick), time_s,
                               csv_text(reading.value ? "" : reading.why_not));
        }
    return out;
}

} // namespace fernlicht
