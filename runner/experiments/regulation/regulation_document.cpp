#include "metrics/regulation/fmvss108_adaptive.h"
#include "runner/experiments/regulation/regulation_result.h"
#include "runner/findings/plots/isocandela.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <map>

namespace fernlicht {
namespace {

/// What stands beside a name.
Table facts_table() { return {"facts", "", {{.head = "", .words = true}, {.head = "", .words = true}}, {}}; }

/// Candela whole, G and degrees with the digits they deserve.
std::string number(double value, const std::string& unit) {
    return unit == "cd" ? fmt::format("{:.0f}", value) : fmt::format("{:.3f}", value);
}

std::string limit_number(double value, const std::string& unit) {
    return unit == "cd" ? fmt::format("{:.0f}", value) : fmt::format("{:g}", value);
}

std::string receiver_text(const Receiver& receiver) {
    const char* shape = receiver.shape == Receiver::Shape::square ? "square" : "disc";
    return fmt::format("mean over a {} of {:.3f} degrees", shape, receiver.size_deg);
}

std::string judged_text(const Regulation& r, const std::vector<std::string>& lamps) {
    if (lamps.size() == 2)
        return fmt::format("half the sum of {} and {}", printable(lamps[0], 40), printable(lamps[1], 40));
    return r.half_sum ? "half the sum of both sides; one file given: taken for either side" : "the lamp by itself";
}

std::string turned_text(Direction turned) {
    if (turned == Direction{})
        return "not turned";
    return fmt::format("turned {:.2f} {}, {:.2f} {}", std::abs(turned.h_deg), turned.h_deg < 0.0 ? "L" : "R", std::abs(turned.v_deg),
                       turned.v_deg < 0.0 ? "D" : "U");
}

/// Bounds are rounded up: none is printed as 0.
std::string bound_text(double deg) { return fmt::format("{:.3f}", std::ceil(1000.0 * deg - 1e-9) / 1000.0); }

/// "turned 0.30 L, 0.02 D, ±0.049 and ±0.010; after 3 rounds off by 0.001 and 0.000"; "±0.010 in V" where nothing aimed sideways.
std::string aim_text(const Aim& aim) {
    std::string text = turned_text(aim.turned);
    if (aim.bound.h_deg > 0.0)
        text += fmt::format(", ±{} and ±{}", bound_text(aim.bound.h_deg), bound_text(aim.bound.v_deg));
    else if (aim.bound.v_deg > 0.0)
        text += fmt::format(", ±{} in V", bound_text(aim.bound.v_deg));
    if (aim.rounds > 1)
        text += fmt::format("; after {} rounds off by {:.3f} and {:.3f}", aim.rounds, std::abs(aim.residual.h_deg),
                            std::abs(aim.residual.v_deg));
    return text;
}

/// What a cut-off says of the lamp as it was mounted; "" within 0.1 degrees, which is what hands aim to, or where it was not aimed by one.
std::string as_found_text(const Aim& aim) {
    const bool by_cut_off = aim.rule != AimRule::as_is && aim.rule != AimRule::maximum;
    if (!by_cut_off || std::abs(aim.turned.v_deg) <= 0.1)
        return {};
    return fmt::format("as the file has it, the cut-off lies {:.2f} degrees too {}", std::abs(aim.turned.v_deg),
                       aim.turned.v_deg < 0.0 ? "high" : "low");
}

/// Of G, which has none.
std::string unit_of_row(const std::string& unit) { return unit.empty() ? "1" : unit; }

std::string remark(const RowResult& row) {
    std::string text = row.verdict == RowVerdict::not_measured ? row.reason : row.note;
    if (row.re_aimed != Direction{})
        text = turned_text(row.re_aimed) + " for this row" + (text.empty() ? "" : "; " + text);
    if (!row.lamps.empty())
        text = fmt::format("lamp {}{}", row.lamps.front() + 1, text.empty() ? "" : "; " + text);
    return text;
}

/// Rows with found value, limit and margin.
Table rows_table(const std::string& name, const std::vector<RowResult>& rows) {
    Table table{name, "", columns_of("row<|found|limit|in<|margin|at H, V|verdict<"), {}};
    for (const RowResult& row : rows) {
        const std::string text = remark(row);
        if (row.verdict == RowVerdict::not_measured)
            table.rows.push_back({row.id, "", limits_of(row), unit_of_row(row.unit), "", "", "not measured: " + text});
        else
            table.rows.push_back({row.id,
                                  {number(row.found, row.unit), row.found},
                                  limits_of(row),
                                  unit_of_row(row.unit),
                                  {fmt::format("{:+.1f}%", 100.0 * row.margin), row.margin},
                                  fmt::format("{:.2f}, {:.2f}", row.where.h_deg + 0.0, row.where.v_deg + 0.0),
                                  name_of(row.verdict) + (text.empty() ? "" : " (" + text + ")")});
    }
    return table;
}

std::size_t count_of(const RegulationCheck& check, RowVerdict verdict) {
    return static_cast<std::size_t>(
        std::count_if(check.rows.begin(), check.rows.end(), [&](const RowResult& row) { return row.verdict == verdict; }));
}

std::string verdict_text(const RegulationCheck& check) {
    const std::size_t failed = count_of(check, RowVerdict::fail), open = count_of(check, RowVerdict::not_measured);
    std::string text = check.verdict == RowVerdict::pass ? fmt::format("pass: meets all {} rows of our table", check.rows.size())
                       : check.verdict == RowVerdict::fail
                           ? fmt::format("fail: {} of {} rows of our table", failed, check.rows.size())
                           : fmt::format("not measured: {} of {} rows of our table", open, check.rows.size());
    if (check.verdict == RowVerdict::fail && open > 0)
        text += fmt::format(", {} not measured", open);
    return text;
}

std::string scan_text(const CutOffScan& s, const char* axis) {
    std::string text = s.sharpness ? fmt::format("G {:.3f}", *s.sharpness) : "G not measured";
    text += s.inflection_deg ? fmt::format(", inflection at {} {:.3f} +- {:.3f}", axis, *s.inflection_deg, s.uncertainty_deg())
                             : ", inflection not measured";
    return s.reason.empty() ? text : text + " (" + s.reason + ")";
}

/// Who read it where, and how sure that makes it: "...: one source; two prints, one reader: 75R".
std::string source_text(const Regulation& r) {
    std::string text = r.source + ": " + in_words(r.sureness);
    std::map<Sureness, std::vector<std::string>> others;
    for (const RegulationRow& row : r.rows)
        if (r.sureness_of(row) != r.sureness)
            others[row.sureness].push_back(row.id);
    for (const auto& [sureness, ids] : others)
        text += fmt::format("; {}: {}", in_words(sureness), fmt::join(ids, ", "));
    return text;
}

} // namespace

std::string limits_of(const RowResult& row) {
    const bool min = row.limits.min_cd > 0.0, max = !std::isinf(row.limits.max_cd);
    if (min && max)
        return limit_number(row.limits.min_cd, row.unit) + " to " + limit_number(row.limits.max_cd, row.unit);
    if (min)
        return ">= " + limit_number(row.limits.min_cd, row.unit);
    return max ? "<= " + limit_number(row.limits.max_cd, row.unit) : "";
}

const char* name_of(RowVerdict verdict) {
    return verdict == RowVerdict::pass ? "pass" : verdict == RowVerdict::fail ? "fail" : "not_measured";
}

const char* name_of(AimRule rule) {
    using enum AimRule;
    for (const auto& [one, name] : {std::pair(automatic, "auto"),
                                    {cut_off, "cut-off"},
                                    {cut_off_by_line, "cut-off-line"},
                                    {elbow, "elbow"},
                                    {vol, "vol"},
                                    {vor, "vor"},
                                    {maximum, "maximum"}})
        if (one == rule)
            return name;
    return "as-is";
}

std::vector<std::string> notes_of(const RegulationFound& found) {
    std::vector<std::string> notes = found.regulation.notes;
    const std::string& own_way = found.regulation.aim_note;
    if (!own_way.empty())
        notes.insert(notes.begin(), found.check.aims.front().rule == found.regulation.aim
                                        ? own_way
                                        : "aimed as asked for, not in the regulation's own way: " + own_way);
    return notes;
}

std::vector<const RowResult*> narrowest(const RegulationCheck& check, std::size_t count) {
    std::vector<const RowResult*> rows;
    for (const RowResult& row : check.rows)
        if (row.verdict != RowVerdict::not_measured)
            rows.push_back(&row);
    std::stable_sort(rows.begin(), rows.end(), [](const RowResult* a, const RowResult* b) { return a->margin < b->margin; });
    rows.resize(std::min(count, rows.size()));
    return rows;
}

Document document(const RegulationFound& found) {
    const auto& [r, lamps, check] = found;
    Table facts = facts_table(), verdict = facts_table();
    const auto tell = [&facts](const std::string& name, const std::string& text) { facts.rows.push_back({name, text}); };
    for (const std::string& lamp : lamps)
        tell("lamp", printable(lamp, 90));
    tell("regulation", r.id + ": " + r.title + (check.left_hand_traffic ? ", left-hand traffic by mirror" : ""));
    tell("edition", "per our table of " + r.edition);
    tell("source", source_text(r));
    tell("judged", judged_text(r, lamps) + "; " + receiver_text(r.receiver));
    for (std::size_t i = 0; i < check.aims.size(); ++i) {
        const Aim& aim = check.aims[i];
        tell(check.aims.size() > 1 ? fmt::format("aim, lamp {}", i + 1) : "aim",
             fmt::format("{}: {} ({})", name_of(aim.rule), aim.how, aim_text(aim)));
        if (const std::string mounted = as_found_text(aim); !mounted.empty())
            tell("mounted", mounted);
    }
    if (check.was_re_aimed)
        tell("re-aimed", turned_text(check.re_aimed) + " more, within what the edition allows a lamp that fails");
    for (const std::string& note : notes_of(found))
        tell("note", note);
    Document document{r.title, {{"", {facts}}, {"Rows", {rows_table("rows", check.rows)}}}};
    if (!check.as_filed.empty())
        document.sections.push_back({"As filed, where the aim changes the verdict", {rows_table("as-filed", check.as_filed)}});
    std::vector<std::string> names;
    for (const RowResult* row : narrowest(check, 3))
        names.push_back(fmt::format("{} {:+.1f} %", row->id, 100.0 * row->margin));
    if (!names.empty())
        verdict.rows.push_back(
            {narrowest(check, 1).front()->margin < 0.0 ? "worst" : "narrowest", fmt::format("{}", fmt::join(names, ", "))});
    if (check.verdict_as_filed.value_or(check.verdict) != check.verdict)
        verdict.rows.push_back({"as filed", name_of(*check.verdict_as_filed) + std::string(": the aim changes the verdict")});
    verdict.rows.push_back({"verdict", verdict_text(check) + "; no approval"});
    document.sections.push_back({"Verdict", {verdict}});
    return document;
}

Document document(const CutOffFound& found) {
    const auto& [lamp, options, left_hand_traffic, c, elbow] = found;
    const double sign = left_hand_traffic ? -1.0 : 1.0;
    Table facts = facts_table();
    const auto tell = [&facts](const std::string& name, const std::string& text) { facts.rows.push_back({name, text}); };
    const auto tell_scan = [&](const CutOffScan& scan) { tell(fmt::format("H {:+.1f}", sign * scan.at_deg), scan_text(scan, "V")); };
    tell("lamp", printable(lamp.name, 90));
    tell("scanned", fmt::format("in steps of 0.01 degrees, detector {:.0f} mm at 25 m, G {}{}",
                                std::tan(options.detector_deg * 3.14159265358979 / 180.0) * 25000.0,
                                options.sharpness == SharpnessRule::maximum ? "at its maximum" : "at the inflection",
                                left_hand_traffic ? "; left-hand traffic" : ""));
    for (const CutOffScan* scan : {&c.level_inner, &c.level, &c.level_outer})
        tell_scan(*scan);
    tell("linearity", c.linearity_deg ? fmt::format("{:.3f} degrees over 1.5, 2.5 and 3.5 degrees", *c.linearity_deg) : "not measured");
    for (const CutOffScan& scan : c.rise)
        tell_scan(scan);
    tell("kink", c.kink_h_deg ? fmt::format("H {:.3f} +- {}, where the line through these meets the level part", sign * *c.kink_h_deg + 0.0,
                                            bound_text(c.kink_uncertainty_deg))
                              : "not measured: " + c.kink_reason);
    tell("rise", c.rise_angle_deg ? fmt::format("{:.1f} degrees", *c.rise_angle_deg) : "not measured: " + c.kink_reason);
    tell("elbow", elbow.at ? fmt::format("H {:.3f} +- {}, V {:.3f} +- {}, by a fit over {} columns; from there {:.1f} degrees up{}",
                                         sign * elbow.at->h_deg + 0.0, bound_text(elbow.uncertainty.h_deg), elbow.at->v_deg,
                                         bound_text(elbow.uncertainty.v_deg), elbow.points.size(), elbow.rise_angle_deg,
                                         elbow.rise_to_h_deg ? fmt::format(" to H {:.2f}", sign * *elbow.rise_to_h_deg) : "")
                           : "not measured: " + elbow.reason);
    CutOffScan shoulder = c.shoulder;
    if (shoulder.inflection_deg)
        *shoulder.inflection_deg *= sign;
    tell("shoulder", scan_text(shoulder, "H") + (c.level.inflection_deg ? fmt::format(", along V {:.2f}", shoulder.at_deg) : ""));
    return {"Cut-off of " + lamp.name, {{"", {facts}}}};
}

std::vector<Regulation> listed_regulations() {
    std::vector<Regulation> all = regulations();
    all.push_back(fmvss108_adaptive_without_rows());
    return all;
}

Document regulation_list() {
    Document document{"Tables of regulations", {}};
    for (const Regulation& r : listed_regulations()) {
        if (document.sections.empty() || document.sections.back().title != r.edition)
            document.sections.push_back({r.edition, {"source: " + r.source, Listing{}}});
        std::get<Listing>(document.sections.back().blocks.back())
            .items.emplace_back(fmt::format("{:<26} {}: {}, {}, aim {}", r.id, r.title,
                                            r.rows.empty() ? "rows by where the beam is dimmed (--other or --dimmed)"
                                                           : fmt::format("{} rows in the text", r.rows.size()),
                                            in_words(r.sureness), name_of(r.aim)));
    }
    document.sections.push_back(
        {"A lamp's rows",
         {"A lamp's table has more rows where it is aimed by its cut-off (sharpness, linearity or level of the cut-off), and fewer where "
          "one file is given and rows are for two lamps."}});
    return document;
}

Document regulation_reference() {
    Document document{
        "Regulations",
        {{"",
          {"For `--regulation`; [regulations.md](../regulations.md) says how lamps are held against these tables. In brackets: rows "
           "in the text, and the rule of aim."}}}};
    std::string known;
    for (const Regulation& r : listed_regulations()) {
        if (document.sections.back().title != r.edition) {
            known = in_words(r.sureness);
            document.sections.push_back({r.edition, {fmt::format("Source: {} ({}).", r.source, known), Listing{}}});
        }
        std::get<Listing>(document.sections.back().blocks.back())
            .items.emplace_back(fmt::format("`{}` ({}{}): {}{}", r.id, r.rows.empty() ? "" : fmt::format("{}, ", r.rows.size()),
                                            name_of(r.aim), r.title,
                                            known == in_words(r.sureness) ? "" : std::string("; ") + in_words(r.sureness)));
    }
    return document;
}

plots::Figure cut_off_figure(const CutOffFound& measured) {
    const auto& [lamp, options, mirrored, c, elbow] = measured;
    const double sign = mirrored ? -1.0 : 1.0;
    const double middle = c.level.inflection_deg.value_or(-0.5);
    constexpr double beside_deg = 6.0, below_deg = 2.0, above_deg = 3.0;
    plots::Figure f = plots::isocandela_diagram(lamp.table, lamp.name,
                                                plots::AngleWindow{-beside_deg, beside_deg, middle - below_deg, middle + above_deg});
    const auto place = [](std::optional<double> value, double uncertainty, const std::string& reason) {
        return value ? fmt::format("{:.2f} ± {:.2f}°", *value, uncertainty) : "not measured (" + reason + ")";
    };
    std::optional<double> kink = c.kink_h_deg, elbow_h;
    if (kink)
        kink = sign * *kink;
    if (elbow.at)
        elbow_h = sign * elbow.at->h_deg;
    f.subtitle = fmt::format("elbow at H {}; kink by 1, 2 and 3 degrees at H {}", place(elbow_h, elbow.uncertainty.h_deg, elbow.reason),
                             place(kink, c.kink_uncertainty_deg, c.kink_reason));
    const plots::Colour edge{255, 255, 255}, fitted{240, 130, 0}, scanned{235, 235, 235}, inflection{255, 90, 170};
    constexpr double gap = std::numeric_limits<double>::quiet_NaN();
    const plots::Point apart{gap, gap}; // between dots that no line connects
    plots::Series columns{.name = "edge of each column", .colour = edge, .width_px = 1.2, .markers = true};
    for (const EdgePoint& p : elbow.points)
        if (p.used)
            columns.points.insert(columns.points.end(), {{sign * p.h_deg, p.v_deg}, apart});
    f.series.push_back(columns);
    if (elbow.at) {
        plots::Series fit{.name = "fit: level, rise, shoulder", .colour = fitted, .width_px = 2.5};
        const double from = elbow.points.front().h_deg, to = elbow.points.back().h_deg;
        for (const double h : {from, elbow.at->h_deg, elbow.rise_to_h_deg.value_or(to), to})
            fit.points.push_back({sign * h, elbow.edge_deg(h)});
        f.series.push_back(fit);
        f.notes.push_back({elbow_h.value(), elbow.at->v_deg, "elbow", {255, 255, 255}, true});
    }
    plots::Series scans{.name = "scans", .colour = scanned, .width_px = 1.0, .dash = "3 3"};
    plots::Series found{.name = "their inflections", .colour = inflection, .width_px = 2.0, .markers = true};
    for (const CutOffScan* scan : {&c.level_outer, &c.level, &c.level_inner, &c.rise[0], &c.rise[1], &c.rise[2]}) {
        const double h = sign * scan->at_deg;
        for (const double v : {middle - below_deg, middle + above_deg, gap})
            scans.points.push_back({h, v});
        if (scan->inflection_deg)
            found.points.insert(found.points.end(), {{h, *scan->inflection_deg}, apart});
    }
    if (c.level.inflection_deg) {
        scans.points.push_back({-5.0, c.shoulder.at_deg});
        scans.points.push_back({5.0, c.shoulder.at_deg});
        if (c.shoulder.inflection_deg)
            found.points.push_back({sign * *c.shoulder.inflection_deg, c.shoulder.at_deg});
    }
    f.series.push_back(scans);
    f.series.push_back(found);
    return f;
}

} // namespace fernlicht
