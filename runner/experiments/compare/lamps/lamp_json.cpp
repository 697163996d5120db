#include "runner/experiments/compare/lamps/lamp_comparison.h"
#include "runner/experiments/compare/lamps/lamp_difference_text.h"
#include "runner/experiments/regulation/regulation_result.h"
#include "runner/files/clean_text.h"
#include "runner/files/json_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

std::optional<double> found_in(const std::optional<RowResult>& row) {
    return row && row->verdict != RowVerdict::not_measured ? std::optional(row->found) : std::nullopt;
}

std::optional<double> margin_in(const std::optional<RowResult>& row) {
    return row && row->verdict != RowVerdict::not_measured ? std::optional(row->margin) : std::nullopt;
}

std::string verdict_in(const std::optional<RowResult>& row) { return row ? name_of(row->verdict) : ""; }

Json lamp_json(const ComparedLamp& lamp) {
    return {{"file", lamp.path.string()},
            {"name", lamp.file.name},
            {"format", lamp.file.format},
            {"cut_off", Json::parse(cut_off_json({lamp.file, {}, false, lamp.cut_off, fit_elbow({&lamp.file.table, {}})}))}};
}

Json regulation_json(const LampPairComparison& lamps) {
    if (!lamps.regulation)
        return nullptr;
    Json rows = Json::array();
    for (const ComparedRow& row : lamps.rows)
        rows.push_back({{"id", row.id},
                        {"unit", row.any().unit},
                        {"old_found", or_null(found_in(row.before))},
                        {"new_found", or_null(found_in(row.now))},
                        {"old_margin", or_null(margin_in(row.before))},
                        {"new_margin", or_null(margin_in(row.now))},
                        {"old_verdict", verdict_in(row.before)},
                        {"new_verdict", verdict_in(row.now)}});
    return {{"id", lamps.regulation->id},
            {"edition", lamps.regulation->edition},
            {"rows", rows},
            {"old", Json::parse(fernlicht::regulation_json({*lamps.regulation, {lamps.before.file.name}, *lamps.before.check}))},
            {"new", Json::parse(fernlicht::regulation_json({*lamps.regulation, {lamps.now.file.name}, *lamps.now.check}))}};
}

} // namespace

std::string lamps_json(const LampPairComparison& lamps) {
    Json facts = Json::array();
    for (const LampFact& fact : lamps.facts) {
        const bool known = fact.before && fact.now;
        facts.push_back({{"name", fact.name},
                         {"unit", fact.unit},
                         {"old_value", or_null(fact.before)},
                         {"new_value", or_null(fact.now)},
                         {"change", known ? Json(*fact.now - *fact.before) : Json(nullptr)},
                         {"uncertainty", or_null(fact.uncertainty)},
                         {"not_measured", known ? Json(nullptr) : Json(fact.why_not)}});
    }
    return json_text({{"schema", "fernlicht comparison"},
                      {"schema_version", 2},
                      {"kind", "lamps"},
                      {"reference", lamps.before.path.string()},
                      {"tested", lamps.now.path.string()},
                      {"strictness", nullptr},
                      {"passed", lamps.regulation ? Json(lamps.passed()) : Json(nullptr)},
                      {"lamps", Json::array({lamp_json(lamps.before), lamp_json(lamps.now)})},
                      {"difference", difference_json(lamps.difference)},
                      {"facts", facts},
                      {"regulation", regulation_json(lamps)},
                      {"figures", figures_json(lamps.figures)}});
}

std::string lamps_csv(const LampPairComparison& lamps) {
    std::string csv = "table,name,unit,old_value,new_value,change,uncertainty,old_margin,new_margin,old_verdict,new_verdict\r\n";
    for (const LampFact& fact : lamps.facts)
        csv += csv_line("lamp", fact.name, fact.unit, csv_number(fact.before), csv_number(fact.now),
                        fact.before && fact.now ? fmt::format("{}", *fact.now - *fact.before) : "", csv_number(fact.uncertainty), "", "",
                        "", "");
    for (const ComparedRow& row : lamps.rows) {
        const auto before = found_in(row.before), now = found_in(row.now);
        csv += csv_line(csv_text(lamps.regulation->id), csv_text(row.id), csv_text(row.any().unit), csv_number(before), csv_number(now),
                        before && now ? fmt::format("{}", *now - *before) : "", "", csv_number(margin_in(row.before)),
                        csv_number(margin_in(row.now)), verdict_in(row.before), verdict_in(row.now));
    }
    return csv;
}

} // namespace fernlicht
