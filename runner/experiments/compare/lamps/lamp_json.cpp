#include "runner/experiments/compare/lamps/lamp_comparison.h"
#include "runner/experiments/compare/lamps/lamp_difference_text.h"
#include "runner/experiments/regulation/regulation_result.h"
#include "runner/files/clean_text.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

std::optional<double> figure_in(const std::optional<RowResult>& row, double RowResult::*figure) {
    return row && row->verdict != RowVerdict::not_measured ? std::optional((*row).*figure) : std::nullopt;
}

JsonPart figure_part(std::optional<RowResult>& row, double RowResult::*figure) {
    return through([&row, figure] { return figure_in(row, figure); },
                   [&row, figure](const std::optional<double>& found) {
                       if (found)
                           (row ? *row : row.emplace()).*figure = *found;
                   });
}

constexpr int no_row = 3; // after the verdicts

JsonPart row_verdict_part(std::optional<RowResult>& row) {
    return through([&row] { return row ? static_cast<int>(row->verdict) : no_row; },
                   [&row](int verdict) {
                       if (verdict != no_row)
                           (row ? *row : row.emplace()).verdict = static_cast<RowVerdict>(verdict);
                   },
                   [](int& verdict) {
                       return one_of(verdict, [] { return std::vector<std::string>{"pass", "fail", "not_measured", ""}; });
                   });
}

JsonMembers compared_row_members(ComparedRow& row) {
    return {{"id", row.id},
            {"unit", row.unit},
            {"old_found", figure_part(row.before, &RowResult::found)},
            {"new_found", figure_part(row.now, &RowResult::found)},
            {"old_margin", figure_part(row.before, &RowResult::margin)},
            {"new_margin", figure_part(row.now, &RowResult::margin)},
            {"old_verdict", row_verdict_part(row.before)},
            {"new_verdict", row_verdict_part(row.now)}};
}

/// An object as a command of one lamp writes it.
JsonPart told_part(std::string& told) {
    return {[&told] { return nlohmann::ordered_json::parse(told); }, [&told](const CheckedJson& json) { told = json.dump(); },
            [] {
                return nlohmann::ordered_json{{"type", "object"}};
            }};
}

JsonMembers compared_lamp_members(ComparedLamp& lamp) {
    return {{"file", lamp.path}, {"name", lamp.file.name}, {"format", lamp.file.format}, {"cut_off", told_part(lamp.cut_off_told)}};
}

JsonMembers lamp_fact_members(LampFact& fact) {
    return {{"name", fact.name},
            {"unit", fact.unit},
            {"old_value", fact.before},
            {"new_value", fact.now},
            {"change", fact.change()},
            {"uncertainty", fact.uncertainty},
            {"not_measured", null_unless(!fact.change(), json_leaf(fact.why_not))}};
}

} // namespace

JsonMembers lamps_members(LampPairComparison& lamps) {
    const auto passed = through([&lamps] { return lamps.regulation ? std::optional(lamps.passed()) : std::nullopt; },
                                [&lamps](const std::optional<bool>& all) {
                                    if (all)
                                        lamps.now.check.emplace().verdict = *all ? RowVerdict::pass : RowVerdict::fail;
                                });
    const auto id =
        through([&lamps] { return lamps.regulation->id; }, [&lamps](const std::string& name) { lamps.regulation = &regulation(name); });
    return {
        {"schema", json_constant("fernlicht comparison")},
        {"schema_version", json_constant(2)},
        {"kind", json_constant("lamps")},
        {"reference", lamps.before.path},
        {"tested", lamps.now.path},
        {"strictness", json_constant(nullptr)},
        {"passed", passed},
        {"lamps", both(lamps.before, lamps.now, compared_lamp_members)},
        {"difference", lamps.difference, difference_part},
        {"facts", lamps.facts, lamp_fact_members},
        {"regulation", null_unless(lamps.regulation != nullptr, JsonMembers{{"id", id},
                                                                            {"edition", lamps.regulation ? lamps.regulation->edition : ""},
                                                                            {"rows", lamps.rows, compared_row_members},
                                                                            {"old", told_part(lamps.before.check_told)},
                                                                            {"new", told_part(lamps.now.check_told)}})},
        {"figures", lamps.figures, compared_figure_members}};
}

std::string lamps_csv(const LampPairComparison& lamps) {
    std::string csv = "table,name,unit,old_value,new_value,change,uncertainty,old_margin,new_margin,old_verdict,new_verdict\r\n";
    for (const LampFact& fact : lamps.facts)
        csv += csv_line("lamp", fact.name, fact.unit, csv_number(fact.before), csv_number(fact.now), csv_number(fact.change()),
                        csv_number(fact.uncertainty), "", "", "", "");
    for (const PlaceChange& found : lamps.difference.places) {
        const auto change = found.change() ? std::optional(*found.new_cd - *found.old_cd) : std::nullopt;
        const auto error = found.uncertainty ? std::optional(*found.uncertainty * *found.old_cd) : std::nullopt;
        csv += csv_line("place", csv_text(found.place.name), "cd", csv_number(found.old_cd), csv_number(found.new_cd), csv_number(change),
                        csv_number(error), "", "", "", "");
    }
    for (const ComparedRow& row : lamps.rows) {
        const auto before = figure_in(row.before, &RowResult::found), now = figure_in(row.now, &RowResult::found);
        const auto verdict = [](const std::optional<RowResult>& of) { return of ? name_of(of->verdict) : ""; };
        csv += csv_line(csv_text(lamps.regulation->id), csv_text(row.id), csv_text(row.unit), csv_number(before), csv_number(now),
                        before && now ? fmt::format("{}", *now - *before) : "", "", csv_number(figure_in(row.before, &RowResult::margin)),
                        csv_number(figure_in(row.now, &RowResult::margin)), verdict(row.before), verdict(row.now));
    }
    return csv;
}

} // namespace fernlicht
