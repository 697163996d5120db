#include "runner/experiments/compare/lamps/lamp_difference_text.h"
#include "runner/experiments/study/study_document.h"
#include "runner/findings/context_json.h"
#include "runner/findings/lamp_checks_json.h"
#include "runner/judge/verdict_json.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <memory>

namespace fernlicht {
namespace {

/// A place in a list of the study, as what is there is called; what the list lacks is added to it.
template <class List, class Name = std::identity> JsonPart place_in_study(List& list, std::size_t& place, Name name = {}) {
    using Called = std::remove_cvref_t<std::invoke_result_t<Name, typename List::value_type&>>;
    return through([&list, &place, name] { return Called(std::invoke(name, list[place])); },
                   [&list, &place, name](const Called& called) {
                       place = static_cast<std::size_t>(std::ranges::find(list, called, name) - list.begin());
                       if (place == list.size())
                           std::invoke(name, list.emplace_back()) = called;
                   });
}

/// A place in a list that was read before, as what is there is called. `known` is filled once: tens of thousands of changes name thousands
/// of cells.
using PlacesByName = std::shared_ptr<std::map<std::string, std::size_t>>;
template <class List, class Name> JsonPart place_read_before(const List& list, const PlacesByName& known, std::size_t& place, Name name) {
    const auto name_at = [&list, name](std::size_t i) { return std::invoke(name, list[i]); };
    JsonPart part = one_of(place, names_of<std::size_t>(name_at, static_cast<int>(list.size())));
    part.write = [&place, name_at] { return name_at(place); };
    part.read = [&list, &place, known, name_at, refuse = part.read](const CheckedJson& json) {
        if (known->empty())
            for (std::size_t i = 0; i < list.size(); ++i)
                known->emplace(name_at(i), i);
        if (const auto found = known->find(json.text()); found != known->end())
            place = found->second;
        else
            refuse(json);
    };
    return part;
}

JsonPart cell_by_name(const StudyResult& result, const PlacesByName& cells, std::size_t& cell) {
    return place_read_before(result.cells, cells, cell, [](const CellResult& one) { return one.cell.name; });
}

/// A number where it is one, null for the drive's own.
JsonPart axis_value_part(std::string& value) {
    using Json = nlohmann::ordered_json;
    return {[&value] {
                double number = 0.0;
                const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
                const bool is_number = error == std::errc{} && end == value.data() + value.size() && std::isfinite(number);
                return value.empty() ? Json(nullptr) : is_number ? Json(number) : Json(value);
            },
            [&value](const CheckedJson& json) {
                value = json.is_null() ? "" : json.dump().starts_with('"') ? json.text() : fmt::format("{}", json.number());
            },
            [] {
                return Json{{"type", {"number", "string", "null"}}};
            }};
}

JsonMembers axis_value_members(AxisValue& one) { return {{"axis", one.axis}, {"value", axis_value_part(one.value)}}; }

JsonMembers lamp_comparison_members(LampComparison& lamps) {
    return joined({{"new", lamps.tested},
                   {"against", lamps.against},
                   {"side", lamps.side},
                   {"says", lamp_verdict(lamps)},
                   {"file", lamps.file},
                   {"other_file", lamps.other_file},
                   {"difference", lamps.difference, difference_part}},
                  when(lamps.is_turned_later, {{"turned_later", lamps.is_turned_later}}));
}

JsonMembers study_change_members(Change& change, const StudyResult& result, const PlacesByName& cells) {
    const Value found = change.change();
    return joined({{"id", change.id},
                   {"new_cell", cell_by_name(result, cells, change.tested)},
                   {"old_cell", cell_by_name(result, cells, change.against)},
                   {"reading", change.reading},
                   {"unit", change.unit()},
                   {"old_value", change.old_value},
                   {"new_value", change.new_value},
                   {"change", found},
                   {"size", found.measured() ? std::optional(change.size()) : std::nullopt},
                   {"uncertainty", change.uncertainty},
                   {"by_tenth_degree", change.aim_effect},
                   {"by_tenth_flux", change.flux_effect},
                   {"by_10mm", change.height_effect},
                   {"by_75kg", change.load_effect},
                   {"by_noise", change.noise_effect},
                   {"kind", one_of(change.kind, names_of<ChangeKind>(change_name, 4))},
                   {"decides", change.decides}},
                  when(change.kind == ChangeKind::unknown, {{"why_not", change.reason_unknown}}));
}

JsonMembers study_figure_members(StudyFigure& figure, const StudyResult& result, const PlacesByName& cells) {
    std::string& name = figure.plot.name;
    const auto svg =
        through([&name] { return name + ".svg"; }, [&name](const std::string& file) { name = file.substr(0, file.rfind('.')); });
    const auto by_name = [&result, cells](std::size_t& cell) { return cell_by_name(result, cells, cell); };
    return {{"svg", svg}, {"png", name + ".png"}, {"title", figure.title}, {"cells", figure.cells, by_name}};
}

JsonMembers cell_reading_members(Reading& reading) {
    Value& value = reading.value;
    const auto reason =
        through([&value] { return value.reason(); }, [&value](const std::string& why) { value = Value::not_measured(why); });
    return joined({{"name", reading.key}, {"value", value}, {"unit", reading.unit()}}, when(!value.measured(), {{"not_measured", reason}}));
}

JsonMembers study_cell_members(CellResult& cell, StudyResult& result) {
    StudyCell& at = cell.cell;
    Study& study = result.study;
    StudyConditions& conditions = study.conditions;
    const auto readings = through(
        [&cell, &result] {
            Readings all;
            for (const auto& [key, reading] : all_readings(result, cell).readings)
                all.push_back(reading);
            return all;
        },
        [&cell](const Readings& all) {
            for (const Reading& reading : all)
                cell.readings.emplace(reading.key, reading);
        },
        cell_reading_members);
    JsonMembers members{{"name", at.name},
                        {"folder", "cells/" + at.name},
                        {"drive", cell.drive},
                        {"lamp", place_in_study(study.lamps, at.lamp, &StudyLamp::name)},
                        {"technique", place_in_study(study.techniques, at.technique)},
                        {"time_of_day", place_in_study(conditions.times_of_day, at.time_of_day, &Daylight::name)},
                        {"aim_percent", place_in_study(conditions.aim_percent, at.aim)},
                        {"voltage_v", place_in_study(conditions.voltage_v, at.voltage)},
                        {"mirrored", place_in_study(conditions.mirror, at.mirror)},
                        {"failed", or_null(cell.failed)},
                        {"verdicts", cell.verdicts, verdict_members},
                        {"error_share_p95", cell.error_share},
                        {"error_floor_share_p95", cell.error_floor_share},
                        {"readings", readings}};
    const auto point = through([&at] { return std::uint64_t{at.point} + 1; }, [&at](std::uint64_t number) { at.point = number - 1; });
    return joined(std::move(members), when(!cell.inputs.empty(), {{"key", cell.key}, {"inputs", cell.inputs, cell_input_members}}),
                  when(!cell.aims.empty(), {{"aims", cell.aims, lamp_aim_members}}),
                  when(!at.axes.empty(), {{"point", point}, {"axes", at.axes, axis_value_members}}));
}

JsonMembers cell_time_members(CellResult& cell) {
    return {{"cell", cell.cell.name}, {"frame_s", cell.frame_s}, {"command", cell.command}, {"reused", cell.reused}};
}

JsonMembers study_context_members(StudyResult& result) {
    JsonMembers members = context_members(result.context);
    std::erase_if(members, [](const JsonMember& member) { return member.key == "seed" || member.key == "inputs"; });
    return joined(std::move(members), JsonMembers{{"study_file", result.study.file},
                                                  {"played_by", result.played_by},
                                                  {"cells", one_for_each(result.cells, cell_time_members, "cells")}});
}

} // namespace

JsonMembers study_members(StudyResult& result) {
    const auto cells = std::make_shared<PlacesByName::element_type>(), ids = std::make_shared<PlacesByName::element_type>();
    const auto by_id = [&result, ids](std::size_t& change) { return place_read_before(result.changes, ids, change, &Change::id); };
    const auto change = [&result, cells](Change& one) { return study_change_members(one, result, cells); };
    JsonPart changes = json_part(result.changes, change);
    if (result.changes_elsewhere > 0) {
        changes.each = [&result, change](const std::function<void(nlohmann::ordered_json)>& take) {
            each_change(result, [&](Change one) { take(json_part(one, change).write()); });
        };
        changes.write = [each = changes.each] {
            nlohmann::ordered_json list = nlohmann::ordered_json::array();
            each([&](nlohmann::ordered_json one) { list.push_back(std::move(one)); });
            return list;
        };
    }
    const auto figure = [&result, cells](StudyFigure& one) { return study_figure_members(one, result, cells); };
    JsonPart lamps = json_part(result.lamps, lamp_comparison_members);
    lamps.read = [&result, read = lamps.read](const CheckedJson& json) {
        read(json);
        for (const LampComparison& one : result.lamps)
            if (one.side != "right")
                result.study.comparisons.push_back({one.tested, one.against});
    };
    return joined({{"schema", json_constant("fernlicht study")},
                   {"schema_version", json_constant(1)},
                   {"name", result.study.name},
                   {"title", result.study.title},
                   {"verdict", overall(result), verdict_kind_part},
                   {"complete", result.complete()},
                   {"interrupted", or_null(result.interrupted)},
                   {"decide", result.study.decide},
                   {"sentence", study_sentence(result)},
                   {"played_in_part", or_null(result.played_in_part)},
                   {"largest_changes", in_turn(2, json_part(result.largest, by_id))},
                   {"lamps", lamps},
                   {"verdicts", result.verdicts, verdict_members},
                   {"changes", in_turn(1, changes)},
                   {"figures", in_turn(1, json_part(result.figures, figure))},
                   {"cells", result.cells, [&result](CellResult& cell) { return study_cell_members(cell, result); }},
                   {"context", study_context_members(result)}},
                  when(!result.lamp_files.empty(), {{"lamp_files", result.lamp_files, lamp_file_members}}));
}

void study_csv(const StudyResult& result, const TakePiece& take) {
    const std::vector<AxisValue> axes = result.cells.empty() ? std::vector<AxisValue>{} : result.cells.front().cell.axes;
    std::string csv = "id,new,against,drive,technique,condition,reading,unit,old_value,new_value,change,uncertainty,by_tenth_degree,by_"
                      "tenth_flux,by_10mm,by_75kg,by_noise,kind,decides,"
                      "new_cell,old_cell,why_not,old_bound,new_bound,change_bound";
    for (const AxisValue& axis : axes)
        csv += "," + csv_text(axis.axis);
    take(csv + "\r\n");
    each_change(result, [&](const Change& c) {
        const CellResult &now = result.cells[c.tested], &before = result.cells[c.against];
        csv = csv_line(c.id, csv_text(result.study.lamps[now.cell.lamp].name), csv_text(result.study.lamps[before.cell.lamp].name),
                       csv_text(now.drive), csv_text(result.study.techniques[now.cell.technique]), csv_text(now.cell.condition),
                       csv_text(name_of(c.reading)), csv_text(c.unit()), csv_number(c.old_value.figure()), csv_number(c.new_value.figure()),
                       csv_number(c.change().figure()), csv_number(c.uncertainty), csv_number(c.aim_effect), csv_number(c.flux_effect),
                       csv_number(c.height_effect), csv_number(c.load_effect), csv_number(c.noise_effect), change_name(c.kind),
                       c.decides ? "yes" : "no", csv_text(now.cell.name), csv_text(before.cell.name), csv_text(c.reason_unknown),
                       bound_name(c.old_value), bound_name(c.new_value), bound_name(c.change()));
        csv.resize(csv.size() - 2); // before the line's end
        for (const AxisValue& axis : now.cell.axes)
            csv += "," + csv_text(axis.value);
        take(csv + "\r\n");
    });
}

} // namespace fernlicht
