#include "metrics/readings/reading_labels.h"
#include "runner/experiments/study/study_document.h"
#include "runner/findings/series.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>

namespace fernlicht {
namespace {

const SeriesFindings* series_in(const CellResult& cell) {
    return cell.series && !cell.series->readings.empty() ? cell.series.get() : nullptr;
}

bool has_conditions(const StudyResult& result) {
    return std::ranges::any_of(result.cells,
                               [&](const CellResult& cell) { return cell.cell.condition != result.cells.front().cell.condition; });
}

/// One row a place, a column a lamp: `find` gives what a cell has of the row, nullopt for nothing.
void add_place_rows(const StudyResult& result, Table& table, const std::vector<Cell>& heads,
                    const std::function<std::optional<Cell>(const SeriesFindings&)>& find) {
    for (std::size_t i = 0; i < result.cells.size(); ++i) {
        const StudyCell& place = result.cells[i].cell;
        if (std::ranges::any_of(result.cells.begin(), result.cells.begin() + static_cast<std::ptrdiff_t>(i),
                                [&](const CellResult& earlier) { return is_same_place(earlier.cell, place); }))
            continue;
        std::vector<Cell> row = heads;
        row.emplace_back(result.cells[i].drive);
        if (has_conditions(result))
            row.emplace_back(place.condition);
        bool found = false;
        for (std::size_t lamp = 0; lamp < result.study.lamps.size(); ++lamp) {
            const auto cell = std::ranges::find_if(
                result.cells, [&](const CellResult& one) { return one.cell.lamp == lamp && is_same_place(one.cell, place); });
            const SeriesFindings* const series = cell == result.cells.end() ? nullptr : series_in(*cell);
            const std::optional<Cell> there = series ? find(*series) : std::nullopt;
            found = found || there;
            row.push_back(there.value_or(Cell("")));
        }
        if (found)
            table.rows.push_back(std::move(row));
    }
}

Table table_by_lamp(const StudyResult& result, const std::string& name, const std::string& caption, const std::string& heads) {
    Table table{name, caption, columns_of(heads + (has_conditions(result) ? "|drive<|condition<" : "|drive<")), {}};
    for (std::size_t i = 0; i < result.study.lamps.size(); ++i)
        table.columns.push_back({.head = result.study.lamps[i].name, .series = i});
    table.sortable = true;
    return table;
}

Cell limited_cell(const Limit& limit) {
    const auto key = key_of(limit.reading);
    return key ? Cell(reading_label(*key)).hinted(limit.reading) : Cell("every limit");
}

/// Drives may have limits of their own: each once.
Table car_shares_table(const StudyResult& result) {
    Table table =
        table_by_lamp(result, "cars-within",
                      "Share of cars within each limit, %, with what chance among the cars counted leaves open (95 %)", "reading<|limit<");
    std::vector<Limit> limits;
    for (const CellResult& cell : result.cells)
        if (const SeriesFindings* const series = series_in(cell))
            for (const CarsWithin& within : series->within)
                if (std::ranges::find(limits, within.limit) == limits.end())
                    limits.push_back(within.limit);
    for (const Limit& limit : limits)
        add_place_rows(result, table, {limited_cell(limit), limit_words(limit)}, [&](const SeriesFindings& series) {
            const auto found = std::ranges::find(series.within, limit, &CarsWithin::limit);
            return found == series.within.end() ? std::nullopt : std::optional(within_cell(*found));
        });
    return table;
}

std::string texts_of(const Table& table) {
    std::string all;
    for (const std::vector<Cell>& row : table.rows)
        for (const Cell& one : row)
            all += one.text + "|";
    return all;
}

/// One for all drives that have the same.
void add_tolerances(const StudyResult& result, Section& section) {
    std::vector<std::pair<Table, std::string>> known; // a table, and the drives that have it
    for (const CellResult& cell : result.cells) {
        const SeriesFindings* const series = series_in(cell);
        if (!series)
            continue;
        Table table = tolerances_table(*series, "tolerances-" + std::to_string(known.size()));
        const auto same = std::ranges::find_if(known, [&](const auto& one) { return texts_of(one.first) == texts_of(table); });
        if (same == known.end())
            known.emplace_back(std::move(table), cell.drive);
        else if (same->second.find(cell.drive) == std::string::npos)
            same->second += ", " + cell.drive;
    }
    for (auto& [table, drives] : known) {
        if (known.size() > 1)
            table.caption += ": " + drives;
        section.blocks.emplace_back(std::move(table));
    }
}

Table car_quantiles_table(const StudyResult& result) {
    Table table = table_by_lamp(result, "cars", "Deciding readings of the car as designed, and what 5 % and 95 % of the cars lie below",
                                "reading<|unit<");
    std::vector<ReadingKey> keys;
    for (const CellResult& cell : result.cells)
        if (const SeriesFindings* const series = series_in(cell))
            for (const ReadingOfCars& of : series->readings)
                if (place_among(of.key, result.study.decide) && std::ranges::find(keys, of.key) == keys.end())
                    keys.push_back(of.key);
    std::ranges::stable_sort(keys, {}, [&](const ReadingKey& key) { return place_among(key, result.study.decide); });
    for (const ReadingKey& key : keys)
        add_place_rows(
            result, table, {Cell(reading_label(key)).hinted(name_of(key)), unit_label(unit_of(key))}, [&](const SeriesFindings& series) {
                const auto found = std::ranges::find(series.readings, key, &ReadingOfCars::key);
                return found == series.readings.end() || !found->as_designed.measured() ? std::nullopt : std::optional(cars_cell(*found));
            });
    return table;
}

} // namespace

Section cars_section(const StudyResult& result) {
    Section section{"Cars of a series", {}};
    if (std::ranges::none_of(result.cells, [](const CellResult& cell) { return series_in(cell) != nullptr; }))
        return section;
    const SeriesFindings& first =
        *series_in(*std::ranges::find_if(result.cells, [](const CellResult& cell) { return series_in(cell) != nullptr; }));
    section.blocks.emplace_back(
        fmt::format("Readings of cars whose lamps, height and load differ by the tolerances, each counted from the car "
                    "as designed: {} drawn, {} of them in full. The reports of the cells say what told each reading "
                    "and what moves it most.",
                    first.draws, first.cars));
    add_tolerances(result, section);
    if (Table shares = car_shares_table(result); !shares.rows.empty())
        section.blocks.emplace_back(std::move(shares));
    section.blocks.emplace_back(car_quantiles_table(result));
    return section;
}

} // namespace fernlicht
