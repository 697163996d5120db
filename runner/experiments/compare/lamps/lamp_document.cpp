#include "runner/experiments/compare/lamps/lamp_comparison.h"
#include "runner/experiments/compare/lamps/lamp_difference_text.h"
#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"

#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

Cell figure_cell(const std::optional<double>& value) { return value ? Cell(four_digits(*value), *value) : Cell("not measured"); }

Cell percent(double share) { return {signed_figure(100.0 * share, 1), 100.0 * share}; }

std::string unit_words(const std::string& unit) { return unit == "deg" ? "°" : unit; }

Table facts_table(const LampPairComparison& lamps) {
    Table table{"figures", "± is how well the difference of two places is known", columns_of("figure<|A|B|B − A|%|±|unit<|why not<"), {}};
    for (const LampFact& fact : lamps.facts) {
        const bool known = fact.before && fact.now;
        const double change = known ? *fact.now - *fact.before + 0.0 : 0.0;
        table.rows.push_back({fact.words, figure_cell(fact.before), figure_cell(fact.now),
                              known ? Cell((change > 0.0 ? "+" : "") + four_digits(change), change) : Cell(""),
                              known && fact.unit != "deg" && *fact.before != 0.0 ? percent(*fact.now / *fact.before - 1.0) : Cell(""),
                              fact.uncertainty ? Cell(two_digits(*fact.uncertainty), *fact.uncertainty) : Cell(""), unit_words(fact.unit),
                              fact.why_not});
    }
    return table;
}

Table zones_table(const LampDifference& difference) {
    Table table{"zones",
                "Clearest first",
                columns_of("where<|B over A, less 1 [%]|± [%]|H from [°]|H to [°]|V from [°]|V to [°]|directions"),
                {},
                false,
                false,
                true};
    const auto degrees_cell = [](double deg) { return Cell(figure(deg, 1), deg); };
    for (const BeamZone& zone : difference.zones)
        table.rows.push_back({zone_where(zone),
                              {signed_figure(100.0 * zone.share, 1), 100.0 * zone.share},
                              {two_digits(100.0 * zone.uncertainty), 100.0 * zone.uncertainty},
                              degrees_cell(zone.h_from_deg),
                              degrees_cell(zone.h_to_deg),
                              degrees_cell(zone.v_from_deg),
                              degrees_cell(zone.v_to_deg),
                              {fmt::format("{}", zone.samples), static_cast<double>(zone.samples)}});
    return table;
}

std::string limits_text(const RowResult& row) {
    const bool least = row.limits.min_cd > 0.0, most = !std::isinf(row.limits.max_cd);
    const int digits = row.unit == "cd" ? 0 : 2;
    return least && most ? figure(row.limits.min_cd, digits) + " to " + figure(row.limits.max_cd, digits)
           : least       ? "≥ " + figure(row.limits.min_cd, digits)
           : most        ? "≤ " + figure(row.limits.max_cd, digits)
                         : "";
}

/// Ratios to what a lamp has elsewhere differ.
std::string limits_of(const ComparedRow& row) {
    const std::string limits = limits_text(row.now ? *row.now : *row.before), old_limits = row.before ? limits_text(*row.before) : limits;
    return limits == old_limits ? limits : "A " + old_limits + ", B " + limits;
}

Table rows_table(const LampPairComparison& lamps) {
    Table table{"regulation",
                "Margins to the nearer limit, each lamp aimed as the procedure says; below 0 fails",
                columns_of("row<|limit<|unit<|A|B|margin: A [%]|margin: B [%]|margin: change [%]|A<|B<"),
                {}};
    const auto is_measured = [](const std::optional<RowResult>& found) { return found && found->verdict != RowVerdict::not_measured; };
    for (const ComparedRow& row : lamps.rows) {
        std::vector<Cell>& cells = table.rows.emplace_back(std::vector<Cell>{row.id, limits_of(row), unit_words(row.unit)});
        for (const auto* found : {&row.before, &row.now})
            cells.push_back(is_measured(*found) ? figure_cell((*found)->found) : *found ? Cell("not measured") : Cell(""));
        for (const auto* found : {&row.before, &row.now})
            cells.push_back(is_measured(*found) ? percent((*found)->margin) : Cell(""));
        cells.push_back(is_measured(row.before) && is_measured(row.now) ? percent(row.now->margin - row.before->margin) : Cell(""));
        for (const auto* found : {&row.before, &row.now})
            cells.emplace_back(!*found               ? ""
                               : is_measured(*found) ? ((*found)->verdict == RowVerdict::pass ? "pass" : "fail")
                                                     : (*found)->reason);
    }
    return table;
}

} // namespace

Document document(const LampPairComparison& lamps) {
    const LampFile &a = lamps.before.file, &b = lamps.now.file;
    Document document{short_text(distinct_label(b, a), 80) + " against " + short_text(distinct_label(a, b), 80), {}};
    Table told{"difference", "", columns_of("<|B against A<"), {}};
    for (const auto& [what, text] : difference_lines(b, a, lamps.difference))
        told.rows.push_back({what.empty() ? " " : what, text});
    document.sections.push_back(
        {lamps.difference.any() ? "The lamps differ" : "No difference beyond noise", {told}, 2, false, lamps.passed() ? "none" : "fail"});
    document.sections.push_back({"Named places", {named_places_table(lamps.difference)}});
    if (lamps.regulation) {
        const auto verdict = [](const ComparedLamp& lamp) {
            return lamp.check->verdict == RowVerdict::pass ? "pass" : lamp.check->verdict == RowVerdict::fail ? "fail" : "not measured";
        };
        document.sections.push_back(
            {fmt::format("{}, per our table of {}", lamps.regulation->id, lamps.regulation->edition),
             {rows_table(lamps), fmt::format("verdict  A {}, B {}; no approval", verdict(lamps.before), verdict(lamps.now))}});
    }
    document.sections.push_back({"Figures of both", {facts_table(lamps)}});
    Section& beams = document.sections.emplace_back(Section{"The beams", {}, 2, true});
    for (const ComparedFigure& drawn : lamps.figures)
        beams.blocks.emplace_back(drawn.plot());
    if (!lamps.difference.zones.empty())
        document.sections.push_back({"Zones that differ", {zones_table(lamps.difference)}, 2, true});
    Table files{"files", "", columns_of("<|name<|format<|file<"), {}};
    for (const auto& [side, lamp] : {std::pair("A, old", &lamps.before), std::pair("B, new", &lamps.now)})
        files.rows.push_back({side, lamp->file.name, lamp->file.format, lamp->path.string()});
    document.sections.push_back({"The files", {files}, 2, true});
    return document;
}

} // namespace fernlicht
