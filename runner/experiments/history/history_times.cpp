#include "runner/experiments/history/history_findings.h"

#include <algorithm>

namespace fernlicht {

std::vector<std::size_t> timed_nights(const std::vector<Night>& nights, const std::string& cell) {
    std::vector<std::size_t> timed = chain_of(nights, cell, 0);
    const std::string cpu = machine_in(nights.back(), "CPU");
    std::erase_if(timed, [&](std::size_t night) { return !nights[night].cell(cell)->frame_s || machine_in(nights[night], "CPU") != cpu; });
    return timed;
}

HistoryTimes changes_of_times(const std::vector<Night>& nights, std::size_t base, double rate) {
    HistoryTimes times;
    times.rate = rate;
    std::vector<std::string> cells;
    std::vector<std::vector<std::size_t>> timed;
    std::vector<std::vector<double>> series;
    for (const NightCell& cell : nights.back().cells) {
        std::vector<std::size_t> at = timed_nights(nights, cell.name);
        if (at.size() < fewest_samples_of_change)
            continue;
        std::vector<double>& frames = series.emplace_back();
        for (const std::size_t night : at)
            frames.push_back(*nights[night].cell(cell.name)->frame_s);
        times.nights = std::max(times.nights, at.size());
        cells.push_back(cell.name);
        timed.push_back(std::move(at));
    }
    times.cells = cells.size();
    for (const SeriesChange& found : change_points(series, rate)) {
        const std::vector<std::size_t>& at = timed[found.series];
        const std::size_t night = at[found.change.first], earlier = at[found.change.first - 1];
        if (night <= base)
            continue;
        const std::string& cell = cells[found.series];
        times.changes.push_back({cell, night, found.change.ratio, found.change.p,
                                 changed_inputs(timing_inputs(nights[earlier], *nights[earlier].cell(cell)),
                                                timing_inputs(nights[night], *nights[night].cell(cell)))});
    }
    std::ranges::stable_sort(times.changes, {}, &HistoryTimes::Change::night);
    return times;
}

} // namespace fernlicht
