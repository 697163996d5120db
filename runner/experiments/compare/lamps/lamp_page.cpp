#include "report_files.h"
#include "runner/experiments/compare/lamps/lamp_comparison.h"
#include "runner/experiments/compare/name_beside.h"
#include "runner/files/clean_text.h"
#include "runner/write/page_base.h"

#include <cmath>
#include <fmt/format.h>
#include <kainjow/mustache.hpp>
#include <stdexcept>

namespace fernlicht {
namespace {

using kainjow::mustache::data;
using List = data::type;

int decimals(const std::string& unit) { return unit == "cd" ? 0 : unit == "lm" ? 1 : 3; }

data fact_part(const LampFact& fact) {
    const bool known = fact.before && fact.now;
    const int digits = decimals(fact.unit);
    const auto text = [&](const std::optional<double>& value) {
        return value ? figure(*value + 0.0, digits) : std::string("not measured");
    };
    data row;
    row.set("words", clean_text(fact.words));
    row.set("unit", fact.unit == "deg" ? "°" : fact.unit);
    row.set("old", text(fact.before));
    row.set("new", text(fact.now));
    row.set("delta", known ? signed_figure(*fact.now - *fact.before, digits) : "");
    const bool share = known && fact.unit != "deg" && *fact.before != 0.0;
    row.set("percent", share ? signed_figure(100.0 * (*fact.now / *fact.before - 1.0), 1) : "");
    row.set("uncertainty", fact.uncertainty ? figure(*fact.uncertainty, digits) : "");
    row.set("why_not", clean_text(fact.why_not));
    return row;
}

std::string limits_text(const RowResult& row) {
    const bool least = row.limits.min_cd > 0.0, most = !std::isinf(row.limits.max_cd);
    const int digits = row.unit == "cd" ? 0 : 2;
    return least && most ? figure(row.limits.min_cd, digits) + " to " + figure(row.limits.max_cd, digits)
           : least       ? "≥ " + figure(row.limits.min_cd, digits)
           : most        ? "≤ " + figure(row.limits.max_cd, digits)
                         : "";
}

data row_part(const ComparedRow& compared) {
    const RowResult& any = compared.now ? *compared.now : *compared.before;
    data row;
    row.set("id", clean_text(compared.id));
    row.set("unit", any.unit == "deg" ? "°" : any.unit);
    const std::string limits = limits_text(any), old_limits = compared.before ? limits_text(*compared.before) : limits;
    row.set("limits", limits == old_limits ? limits : "A " + old_limits + ", B " + limits); // ratios to what a lamp has elsewhere
    bool failed = false;
    const auto set = [&](const std::string& side, const RowResult* found) {
        const bool measured = found && found->verdict != RowVerdict::not_measured;
        row.set(side, measured ? figure(found->found, decimals(found->unit)) : found ? "not measured" : "");
        row.set(side + "_margin", measured ? signed_figure(100.0 * found->margin, 1) : "");
        row.set(side + "_key", measured ? fmt::format("{}", found->margin) : "");
        row.set(side + "_verdict", !found     ? ""
                                   : measured ? (found->verdict == RowVerdict::pass ? "pass" : "fail")
                                              : clean_text(found->reason));
        failed = failed || (measured && found->verdict == RowVerdict::fail);
    };
    set("old", compared.before);
    set("new", compared.now);
    const bool both = compared.before && compared.now && compared.before->verdict != RowVerdict::not_measured &&
                      compared.now->verdict != RowVerdict::not_measured;
    row.set("delta", both ? signed_figure(100.0 * (compared.now->margin - compared.before->margin), 1) : "");
    row.set("delta_key", both ? fmt::format("{}", compared.now->margin - compared.before->margin) : "");
    row.set("class", failed ? "real" : "");
    return row;
}

data zone_part(const BeamZone& zone) {
    data row;
    row.set("h_from", figure(zone.h_from_deg, 2));
    row.set("h_to", figure(zone.h_to_deg, 2));
    row.set("v_from", figure(zone.v_from_deg, 2));
    row.set("v_to", figure(zone.v_to_deg, 2));
    row.set("share", signed_figure(100.0 * zone.share, 2));
    row.set("share_key", fmt::format("{}", zone.share));
    row.set("uncertainty", figure(100.0 * zone.uncertainty, 2));
    row.set("directions", fmt::format("{}", zone.samples));
    return row;
}

/// What the comparison comes to.
data verdict_part(const LampPairComparison& lamps) {
    data part, sentences{List::list};
    const std::vector<std::string> all = sentences_of(lamps.difference);
    constexpr std::size_t most_told = 5;
    for (std::size_t i = 0; i < std::min(most_told, all.size()); ++i)
        sentences.push_back(clean_text(all[i]));
    part.set("class", lamps.passed() ? "" : "fail");
    part.set("word", lamps.difference.any() ? "The lamps differ" : "No difference beyond noise");
    part.set("sentences", sentences);
    part.set("more", all.size() > most_told ? fmt::format("And {} more, below.", all.size() - most_told) : "");
    part.set("noise",
             fmt::format("Noise of the tables: {:.2g} % of an intensity where there is more than a tenth of the peak; claimed is what lies "
                         "beyond {:.2f} of it. {} directions with at least {:.3g} cd were compared.",
                         100.0 * lamps.difference.noise_relative, lamps.difference.z_limit, lamps.difference.directions,
                         lamps.difference.floor_cd));
    const auto says = [](const ComparedLamp& lamp) {
        return lamp.check->verdict == RowVerdict::pass   ? "passes"
               : lamp.check->verdict == RowVerdict::fail ? "fails"
                                                         : "is not measured in all rows";
    };
    part.set("regulation", lamps.regulation
                               ? fmt::format("{}: A {}, B {}. No approval.", lamps.regulation->id, says(lamps.before), says(lamps.now))
                               : std::string());
    return part;
}

} // namespace

std::string lamps_html(const LampPairComparison& lamps) {
    data page, facts{List::list}, rows{List::list}, zones{List::list}, figures{List::list}, files{List::list};
    for (const LampFact& fact : lamps.facts)
        facts.push_back(fact_part(fact));
    for (const ComparedRow& row : lamps.rows)
        rows.push_back(row_part(row));
    for (const BeamZone& zone : lamps.difference.zones)
        zones.push_back(zone_part(zone));
    for (const ComparedFigure& drawn : lamps.figures) {
        data part;
        part.set("svg", drawn.svg);
        part.set("link", relative_link("figures/" + drawn.name));
        figures.push_back(part);
    }
    for (const auto& [side, lamp] : {std::pair("A, old", &lamps.before), std::pair("B, new", &lamps.now)}) {
        data part;
        part.set("side", side);
        part.set("name", clean_text(lamp->file.name));
        part.set("path", clean_text(lamp->path.string()));
        part.set("format", clean_text(lamp->file.format));
        files.push_back(part);
    }
    page.set("title", short_text(name_beside(lamps.now.file, lamps.before.file), 80) + " against " +
                          short_text(name_beside(lamps.before.file, lamps.now.file), 80));
    page.set("style",
             std::string(report_file("report.css")) + std::string(report_file("document.css")) + std::string(report_file("compare.css")));
    page.set("script", std::string(report_file("document.js")));
    page.set("verdict", verdict_part(lamps));
    page.set("facts", facts);
    page.set("rows", rows);
    page.set("has_rows", !lamps.rows.empty());
    page.set("regulation", lamps.regulation ? clean_text(lamps.regulation->id + ", per our table of " + lamps.regulation->edition) : "");
    page.set("zones", zones);
    page.set("has_zones", !lamps.difference.zones.empty());
    page.set("figures", figures);
    page.set("files", files);
    kainjow::mustache::mustache page_template{std::string(report_file("lamps.html.mustache"))};
    std::string html = page_template.render(page);
    if (!page_template.is_valid())
        throw std::logic_error("lamps.html.mustache: " + page_template.error_message());
    return html;
}

} // namespace fernlicht
