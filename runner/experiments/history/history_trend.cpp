#include "runner/experiments/history/history_document.h"

#include "metrics/readings/reading_labels.h"
#include "metrics/statistics/statistics.h"
#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/glob.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// A reading from the first of some nights to the last, the same to the last bit.
struct TrendLevel {
    std::size_t first = 0, last = 0, nights = 0;
    Value value;
    InputChanges causes; ///< of its beginning
};

const Value* value_called(const NightCell& cell, const std::string& reading) {
    const auto found = cell.readings->find(reading);
    return found == cell.readings->end() ? nullptr : &found->second;
}

std::vector<TrendLevel> levels_of(const std::vector<Night>& nights, const std::string& cell, const std::string& reading) {
    std::vector<TrendLevel> levels;
    std::optional<std::size_t> earlier;
    for (const std::size_t night : chain_of(nights, cell, 0)) {
        const NightCell& now = *nights[night].cell(cell);
        const Value* const value = value_called(now, reading);
        if (!value)
            continue;
        if (levels.empty() || !(levels.back().value == *value)) {
            InputChanges causes;
            if (earlier)
                causes = changes_between(nights[*earlier], *nights[*earlier].cell(cell), nights[night], now);
            levels.push_back({night, night, 0, *value, std::move(causes)});
        }
        levels.back().last = night;
        ++levels.back().nights;
        earlier = night;
    }
    return levels;
}

/// "better", "worse"; "" where nobody can tell.
std::string better_words(const ReadingKey& key, const Value& before, const Value& now) {
    const Better better = row_of(key.quantity).better;
    const Value change = difference(now, before, unit_of(key));
    const bool is_more = change.low() > 0.0, is_less = change.high() < 0.0;
    return key.aspect != Aspect::value || better == Better::neither || (!is_more && !is_less) ? ""
           : is_more == (better == Better::higher)                                            ? "better"
                                                                                              : "worse";
}

Table trend_table() {
    Table table{"trend", "", columns_of("cell<|reading`|from [UTC]<|to [UTC]<|nights|value|unit<|change [%]|is<|cause<"), {}};
    table.sortable = true;
    return table;
}

void add_levels(Table& table, const std::vector<Night>& nights, const std::string& cell, const std::string& reading) {
    const std::optional<ReadingKey> key = key_of(reading);
    const std::vector<TrendLevel> levels = levels_of(nights, cell, reading);
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const TrendLevel& level = levels[i];
        const std::optional<double> share = i > 0 ? MovedReading{"", "", levels[i - 1].value, level.value}.share() : std::nullopt;
        table.rows.push_back(
            {cell, reading, when_of(nights, level.first), when_of(nights, level.last),
             Cell(fmt::format("{}", level.nights), static_cast<double>(level.nights)),
             level.value.measured() ? Cell(with_bound(level.value, fmt::format("{:.7g}", *level.value.figure())), *level.value.figure())
                                    : Cell("not measured"),
             key ? unit_label(unit_of(*key)) : "", share ? Cell(fmt::format("{:+.3g}", 100.0 * *share), 100.0 * *share) : Cell(""),
             i == 0 || !key ? "" : better_words(*key, levels[i - 1].value, level.value), i == 0 ? "" : phrase_of(level.causes)});
    }
}

/// From one change of times to the next, all of them found again.
void add_times(Table& table, const std::vector<Night>& nights, const std::string& cell) {
    const std::vector<std::size_t> timed = timed_nights(nights, cell);
    if (timed.empty())
        return;
    std::vector<double> times;
    for (const std::size_t night : timed)
        times.push_back(*nights[night].cell(cell)->frame_s);
    std::vector<std::size_t> starts{0};
    for (const SeriesChange& found : change_points({times}, HistoryTimes().rate))
        starts.push_back(found.change.first);
    starts.push_back(times.size());
    std::optional<double> before;
    for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
        const Spread level = *spread_of(
            {times.begin() + static_cast<std::ptrdiff_t>(starts[i]), times.begin() + static_cast<std::ptrdiff_t>(starts[i + 1])});
        const std::size_t first = timed[starts[i]], last = timed[starts[i + 1] - 1];
        InputChanges causes;
        if (i > 0) {
            const Night &earlier = nights[timed[starts[i] - 1]], &later = nights[first];
            causes = changed_inputs(timing_inputs(earlier, *earlier.cell(cell)), timing_inputs(later, *later.cell(cell)));
        }
        table.rows.push_back(
            {cell, timed_frame, when_of(nights, first), when_of(nights, last),
             Cell(fmt::format("{}", level.count), static_cast<double>(level.count)),
             Cell(fmt::format("{:.4g} ({:.4g} to {:.4g})", level.median, level.minimum, level.maximum), level.median), "s",
             before ? Cell(fmt::format("{:+.3g}", 100.0 * (level.median / *before - 1.0)), 100.0 * (level.median / *before - 1.0))
                    : Cell(""),
             before ? level.median < *before ? "better" : "worse" : "", i == 0 ? "" : phrase_of(causes)});
        before = level.median;
    }
}

} // namespace

Document trend_document(const std::vector<Night>& nights, const std::string& reading, const std::vector<std::string>& patterns) {
    const std::string cells = fmt::format("{}", fmt::join(patterns, ","));
    const Night& last = nights.back();
    Table table = trend_table();
    std::set<std::string> names{timed_frame}, cell_names;
    bool any_cell = false;
    for (const NightCell& cell : last.cells) {
        cell_names.insert(cell.name);
        if (std::ranges::none_of(patterns, [&](const std::string& pattern) { return matches(pattern, cell.name); }))
            continue;
        any_cell = true;
        for (const auto& [name, value] : *cell.readings)
            names.insert(name);
        if (matches(reading, timed_frame))
            add_times(table, nights, cell.name);
        for (const auto& [name, value] : *cell.readings)
            if (matches(reading, name))
                add_levels(table, nights, cell.name, name);
    }
    if (!any_cell) {
        const std::string near = nearest_name(cells, cell_names);
        throw InputError({{}, 0, 0, "--only"}, fmt::format("found '{}', which fits no cell of {}", printable(cells), last.date()),
                         "a name or a pattern, such as " + (near.empty() ? *cell_names.begin() : near));
    }
    if (table.rows.empty() && reading == timed_frame)
        throw InputError({{}, 0, 0, "trend"},
                         fmt::format("found no time of the cells '{}': none was timed by itself in a night", printable(cells)),
                         "nights of a study with timed_cells, or of --timed");
    if (table.rows.empty()) {
        const std::string near = nearest_name(reading, names);
        throw InputError(
            {{}, 0, 0, "trend"},
            fmt::format("found '{}', which fits no reading of the cells '{}' on {}", printable(reading), printable(cells), last.date()),
            near.empty() ? "a name or a pattern as '*own_m'; `fernlicht readings` lists them" : "a name or a pattern, such as " + near);
    }
    return {fmt::format("{}: {} from {} to {}", short_text(last.study, 80), short_text(reading, 80), nights.front().date(), last.date()),
            {{"", {std::move(table)}}}};
}

void export_csv(const std::vector<Night>& nights, const std::function<void(const std::string&)>& take) {
    take(csv_line("study", "night", "played_utc", "accepted", "cell", "drive", "lamp", "technique", "condition", "backend", "renderer",
                  "driver", "cpu_class", "reading", "unit", "value", "bound", "why_not"));
    for (const Night& night : nights) {
        std::string lines;
        const std::string of_night = fmt::format("{},{},{},{}", csv_text(night.study), night.number, night.played_utc,
                                                 night.accepted ? "yes" : "no"),
                          of_machine =
                              fmt::format("{},{},{},{}", csv_text(machine_in(night, "backend")), csv_text(machine_in(night, "renderer")),
                                          csv_text(machine_in(night, "driver")), csv_text(machine_in(night, "CPU class")));
        for (const NightCell& cell : night.cells) {
            const std::string of_cell = fmt::format("{},{},{},{},{},{},{}", of_night, csv_text(cell.name), csv_text(cell.drive),
                                                    csv_text(cell.lamp), csv_text(cell.technique), csv_text(cell.condition), of_machine);
            for (const auto& [name, value] : *cell.readings) {
                const std::optional<ReadingKey> key = key_of(name);
                lines += csv_line(of_cell, csv_text(name), key ? csv_text(unit_of(*key)) : "", csv_number(value.figure()),
                                  bound_name(value), csv_text(value.reason()));
            }
            if (cell.frame_s)
                lines += csv_line(of_cell, timed_frame, "s", csv_number(cell.frame_s), "", "");
        }
        take(lines);
    }
}

} // namespace fernlicht
