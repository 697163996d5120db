#include "runner/experiments/compare/lamps/lamp_difference_text.h"
#include "runner/experiments/study/study_document.h"
#include "runner/files/json_text.h"
#include "runner/files/value_json.h"
#include "runner/findings/extent_keys.h"
#include "runner/judge/verdict_json.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json cell_json(const StudyResult& result, const CellResult& cell) {
    const StudyConditions& c = result.study.conditions;
    Json readings = Json::array();
    for (const auto& [key, reading] : cell.readings) {
        Json row{{"name", name_of(key)}, {"value", value_json(reading.value)}, {"unit", unit_of(key)}};
        if (!reading.value.measured())
            row["not_measured"] = reading.value.reason();
        readings.push_back(std::move(row));
    }
    return {{"name", cell.cell.name},
            {"folder", "cells/" + cell.cell.name},
            {"drive", cell.drive},
            {"lamp", result.study.lamps[cell.cell.lamp].name},
            {"technique", result.study.techniques[cell.cell.technique]},
            {"time_of_day", c.times_of_day[cell.cell.time_of_day].name},
            {"aim_percent", c.aim_percent[cell.cell.aim]},
            {"voltage_v", c.voltage_v[cell.cell.voltage]},
            {"mirrored", static_cast<bool>(c.mirror[cell.cell.mirror])},
            {"failed", cell.failed.empty() ? Json(nullptr) : Json(cell.failed)},
            {"verdicts", verdicts_json(cell.verdicts)},
            {"error_share_p95", or_null(cell.error_share)},
            {"error_floor_share_p95", or_null(cell.error_floor_share)},
            {"readings", readings}};
}

Json change_json(const StudyResult& result, std::size_t index) {
    const Change& change = result.changes[index];
    const Value found = change.change();
    Json row{{"id", fmt::format("c{}", index)},
             {"new_cell", result.cells[change.tested].cell.name},
             {"old_cell", result.cells[change.against].cell.name},
             {"reading", name_of(change.reading)},
             {"unit", change.unit()},
             {"old_value", value_json(change.old_value)},
             {"new_value", value_json(change.new_value)},
             {"change", value_json(found)},
             {"size", found.measured() ? Json(change.size()) : Json(nullptr)},
             {"uncertainty", or_null(change.uncertainty)},
             {"by_tenth_degree", or_null(change.aim_effect)},
             {"by_noise", or_null(change.noise_effect)},
             {"kind", change_name(change.kind)},
             {"decides", change.decides}};
    if (change.kind == ChangeKind::unknown)
        row["why_not"] = change.reason_unknown;
    return row;
}

Json lamps_json(const StudyResult& result) {
    Json out = Json::array();
    for (const LampComparison& lamps : result.lamps)
        out.push_back({{"new", lamps.tested},
                       {"against", lamps.against},
                       {"side", lamps.side},
                       {"says", lamp_verdict(lamps)},
                       {"file", lamps.file.string()},
                       {"other_file", lamps.other_file.string()},
                       {"difference", difference_json(lamps.difference)}});
    return out;
}

Json context_json(const StudyResult& result) {
    const RunContext& c = result.context;
    Json versions = Json::object(), times = Json::array();
    for (const auto& [name, version] : c.versions)
        versions[name] = version;
    for (const CellResult& cell : result.cells)
        times.push_back({{"cell", cell.cell.name}, {"frame_s", or_null(cell.frame_s)}, {"command", cell.command}, {"reused", cell.reused}});
    return {{"command", c.command},
            {"started_utc", c.started_utc},
            {"backend", c.backend},
            {"gl_renderer", c.gl_renderer},
            {"gl_version", c.gl_version},
            {"cpu", c.cpu},
            {"os", c.os},
            {"versions", versions},
            {"study_file", result.study.file.string()},
            {"cells", times}};
}

} // namespace

std::string study_json(const StudyResult& result) {
    Json cells = Json::array(), changes = Json::array(), largest = Json::array(), figures = Json::array();
    for (const CellResult& cell : result.cells)
        cells.push_back(cell_json(result, cell));
    for (std::size_t i = 0; i < result.changes.size(); ++i)
        changes.push_back(change_json(result, i));
    for (const std::size_t i : result.largest)
        largest.push_back(fmt::format("c{}", i));
    for (const StudyFigure& figure : result.figures) {
        Json names = Json::array();
        for (const std::size_t cell : figure.cells)
            names.push_back(result.cells[cell].cell.name);
        figures.push_back(
            {{"svg", figure.plot.name + ".svg"}, {"png", figure.plot.name + ".png"}, {"title", figure.title}, {"cells", names}});
    }
    const std::string part = played_in_part(result);
    return json_text({{"schema", "fernlicht study"},
                      {"schema_version", 1},
                      {"name", result.study.name},
                      {"title", result.study.title},
                      {"verdict", verdict_name(overall(result))},
                      {"complete", result.complete()},
                      {"interrupted", result.interrupted.empty() ? Json(nullptr) : Json(result.interrupted)},
                      {"sentence", study_sentence(result)},
                      {"played_in_part", part.empty() ? Json(nullptr) : Json(part)},
                      {"largest_changes", largest},
                      {"lamps", lamps_json(result)},
                      {"verdicts", verdicts_json(result.verdicts)},
                      {"changes", changes},
                      {"figures", figures},
                      {"cells", cells},
                      {"context", context_json(result)}});
}

} // namespace fernlicht
