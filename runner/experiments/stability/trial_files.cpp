#include "runner/experiments/stability/trial_files.h"

#include "scenarios/values/errors.h"

#include <fmt/format.h>
#include <iterator>

namespace fernlicht::stability {

std::string matrix_text(const CandelaTable& table) {
    fmt::memory_buffer out;
    const auto put = std::back_inserter(out);
    fmt::format_to(put, "# unit: cd\n# angles: goniometer\nV\\H");
    for (const double h : table.h_deg)
        fmt::format_to(put, ",{}", h);
    for (std::size_t v = 0; v < table.v_deg.size(); ++v) {
        fmt::format_to(put, "\n{}", table.v_deg[v]);
        for (std::size_t h = 0; h < table.h_deg.size(); ++h)
            fmt::format_to(put, ",{}", table.at(v, h));
    }
    fmt::format_to(put, "\n");
    return fmt::to_string(out);
}

std::string lane_text(int id, double width_m, const std::string& more) {
    return fmt::format(R"(<lane id="{}" type="driving"><width sOffset="0" a="{}" b="0" c="0" d="0"/>{}</lane>)", id, width_m, more);
}

std::string road_text(double length_m, const std::string& plan, const std::string& lanes, const std::string& profiles) {
    return fmt::format(R"(<?xml version="1.0"?>
<OpenDRIVE><header revMajor="1" revMinor="7"/>
<road name="trial" length="{}" id="1" junction="-1">
<planView>{}</planView>{}
<lanes><laneSection s="0"><center><lane id="0"/></center><right>{}</right></laneSection></lanes></road></OpenDRIVE>
)",
                       length_m, plan, profiles, lanes);
}

std::filesystem::path write_drive_file(StabilityBench& bench, const std::string& name, const std::string& more, const std::string& time) {
    bench.write("straight.xodr", road_text(600.0, line_of_600_m, lane_text(-1, 3.5)));
    const CandelaTable table{{-40.0, 40.0}, {-20.0, 20.0}, {5000.0, 5000.0, 5000.0, 5000.0}, {}, BetweenSamples::linear_cd};
    bench.write("even.csv", matrix_text(table));
    return bench.write(name, fmt::format("fernlicht: 1\nname: trial\nroad: straight.xodr\n{}\ncar:\n  lamps:\n    right: {{file: even.csv, "
                                         "position_m: [3.5, -0.6, 0.65]}}\n{}\n",
                                         time.empty() ? "speed_kmh: 60\nstep_s: 0.1\nduration_s: 8" : time, more));
}

std::string refusal(const std::function<void()>& read) {
    try {
        read();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace fernlicht::stability
