#include "runner/experiments/study/study_result.h"

#include "runner/experiments/run/run_report.h"
#include "scenarios/values/files.h"

#include <algorithm>
#include <fmt/format.h>
#include <tuple>

namespace fernlicht {

std::string hash_of_readings(const CellResult& cell) {
    if (!cell.has_all_readings)
        return cell.hash_of_readings;
    std::string text;
    for (const auto& [key, reading] : cell.readings)
        if (!is_time(key))
            text += fmt::format("{} {} {}\n", name_of(key), static_cast<int>(reading.value.kind()), reading.value.figure().value_or(0.0));
    return content_hash(text.data(), text.size());
}

ReadingsOfCell all_readings(const StudyResult& result, const CellResult& cell) {
    if (cell.has_all_readings || !result.tells_all)
        return cell;
    ReadingsOfCell all = whole_drive_readings(read_report(result.folder / "cells" / cell.cell.name).played.front());
    static_cast<Steps&>(all) = cell;
    return all;
}

void keep_told_readings(StudyResult& result, CellResult& cell) {
    for (const auto& [key, reading] : cell.readings)
        result.keys.insert(key);
    cell.hash_of_readings = hash_of_readings(cell);
    const auto is_told = [&](const ReadingKey& key) {
        return place_among(key, result.study.decide) ||
               std::ranges::any_of(result.study.limits, [&](const StudyLimit& limit) { return limit.reading == name_of(key); });
    };
    const auto what_of = [](const ReadingKey& key) { return std::tuple(key.quantity, key.subject, key.surface, key.lane, key.threshold); };
    std::set<decltype(what_of(ReadingKey()))> told;
    for (const auto& [key, reading] : cell.readings)
        if (!result.tells_all && is_told(key)) // else changes are computed out of the reports
            told.insert(what_of(key));
    cell.has_all_readings = std::erase_if(cell.readings, [&](const auto& reading) {
                                return !is_told(reading.first) && !(is_uncertainty(reading.first) && told.contains(what_of(reading.first)));
                            }) == 0;
}

} // namespace fernlicht
