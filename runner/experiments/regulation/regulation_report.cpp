#include "runner/experiments/regulation/regulation_report.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

void add_entry(std::string& out, const char* key, const std::string& value) { out += fmt::format("{:<12} {}\n", key, value); }

const char* word(RowVerdict verdict) {
    switch (verdict) {
    case RowVerdict::pass:
        return "pass";
    case RowVerdict::fail:
        return "fail";
    case RowVerdict::not_measured:
        break;
    }
    return "not_measured";
}

const char* word(AimRule rule) {
    switch (rule) {
    case AimRule::automatic:
        return "auto";
    case AimRule::cut_off:
        return "cut-off";
    case AimRule::cut_off_by_line:
        return "cut-off-line";
    case AimRule::elbow:
        return "elbow";
    case AimRule::vol:
        return "vol";
    case AimRule::vor:
        return "vor";
    case AimRule::maximum:
        return "maximum";
    case AimRule::as_is:
        break;
    }
    return "as-is";
}

/// Candela whole, G and degrees with the digits they deserve.
std::string number(double value, const std::string& unit) {
    return unit == "cd" ? fmt::format("{:.0f}", value) : fmt::format("{:.3f}", value);
}

std::string limit_number(double value, const std::string& unit) {
    return unit == "cd" ? fmt::format("{:.0f}", value) : fmt::format("{:g}", value);
}

std::string limits_text(const RowResult& row) {
    const bool min = row.limits.min_cd > 0.0, max = !std::isinf(row.limits.max_cd);
    if (min && max)
        return limit_number(row.limits.min_cd, row.unit) + " to " + limit_number(row.limits.max_cd, row.unit);
    if (min)
        return ">= " + limit_number(row.limits.min_cd, row.unit);
    return max ? "<= " + limit_number(row.limits.max_cd, row.unit) : "";
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

/// "turned 0.30 L, 0.02 D, known to 0.049 and 0.010; 3 rounds left 0.001 and 0.000"; "known to 0.010 in V" where nothing aimed sideways.
std::string aim_text(const Aim& aim) {
    std::string text = turned_text(aim.turned);
    if (aim.bound.h_deg > 0.0)
        text += fmt::format(", known to {} and {}", bound_text(aim.bound.h_deg), bound_text(aim.bound.v_deg));
    else if (aim.bound.v_deg > 0.0)
        text += fmt::format(", known to {} in V", bound_text(aim.bound.v_deg));
    if (aim.rounds > 1)
        text += fmt::format("; {} rounds left {:.3f} and {:.3f}", aim.rounds, std::abs(aim.residual.h_deg), std::abs(aim.residual.v_deg));
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
std::string unit_text(const std::string& unit) { return unit.empty() ? "1" : unit; }

std::string remark(const RowResult& row) {
    std::string text = row.verdict == RowVerdict::not_measured ? row.reason : row.note;
    if (row.re_aimed != Direction{})
        text = turned_text(row.re_aimed) + " for this row" + (text.empty() ? "" : "; " + text);
    if (!row.lamps.empty())
        text = fmt::format("lamp {}{}", row.lamps.front() + 1, text.empty() ? "" : "; " + text);
    return text;
}

std::string row_line(const RowResult& row, std::size_t width) {
    if (row.verdict == RowVerdict::not_measured)
        return fmt::format("{:<{}} {:>9} {:>17} {:<3} {:>8} {:>15}  not_measured: {}\n", row.id, width, "-", limits_text(row),
                           unit_text(row.unit), "-", "", remark(row));
    const std::string where = fmt::format("{:.2f}, {:.2f}", row.where.h_deg + 0.0, row.where.v_deg + 0.0);
    std::string line = fmt::format("{:<{}} {:>9} {:>17} {:<3} {:>+7.1f}% {:>15}  {}", row.id, width, number(row.found, row.unit),
                                   limits_text(row), unit_text(row.unit), 100.0 * row.margin, where, word(row.verdict));
    if (const std::string text = remark(row); !text.empty())
        line += " (" + text + ")";
    return line + "\n";
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

std::size_t count_of(const RegulationCheck& check, RowVerdict verdict) {
    return static_cast<std::size_t>(
        std::count_if(check.rows.begin(), check.rows.end(), [&](const RowResult& row) { return row.verdict == verdict; }));
}

std::string verdict_text(const RegulationCheck& check) {
    const std::size_t failed = count_of(check, RowVerdict::fail), open = count_of(check, RowVerdict::not_measured);
    std::string text = check.verdict == RowVerdict::pass ? fmt::format("pass: meets all {} rows of our table", check.rows.size())
                       : check.verdict == RowVerdict::fail
                           ? fmt::format("fail: {} of {} rows of our table", failed, check.rows.size())
                           : fmt::format("not_measured: {} of {} rows of our table", open, check.rows.size());
    if (check.verdict == RowVerdict::fail && open > 0)
        text += fmt::format(", {} not measured", open);
    return text;
}

Json number_or_reason(const std::optional<double>& value, const std::string& reason) {
    if (value)
        return *value;
    return Json{{"not_measured", reason}};
}

Json scan_json(const CutOffScan& s, double sign, bool vertical) {
    const auto along = [&](std::optional<double> value) -> std::optional<double> {
        if (!value || vertical)
            return value;
        return sign * *value + 0.0;
    };
    return {{vertical ? "h_deg" : "v_deg", (vertical ? sign : 1.0) * s.at_deg + 0.0},
            {"sharpness_g", number_or_reason(s.sharpness, s.reason)},
            {vertical ? "inflection_v_deg" : "inflection_h_deg", number_or_reason(along(s.inflection_deg), s.reason)},
            {"uncertainty_deg", s.uncertainty_deg()},
            {"file_step_deg", s.table_step_deg}};
}

Json cut_off_json(const CutOffFigures& c, double sign) {
    Json rise = Json::array();
    for (const CutOffScan& scan : c.rise)
        rise.push_back(scan_json(scan, sign, true));
    std::optional<double> kink = c.kink_h_deg;
    if (kink)
        *kink = sign * *kink + 0.0;
    const std::string open = c.level.reason.empty() ? c.level_inner.reason + c.level_outer.reason : c.level.reason;
    return {{"level",
             Json::array({scan_json(c.level_inner, sign, true), scan_json(c.level, sign, true), scan_json(c.level_outer, sign, true)})},
            {"linearity_deg", number_or_reason(c.linearity_deg, open)},
            {"kink_h_deg", number_or_reason(kink, c.kink_reason)},
            {"kink_uncertainty_deg", c.kink_uncertainty_deg},
            {"rise_angle_deg", number_or_reason(c.rise_angle_deg, c.kink_reason)},
            {"rise", rise},
            {"shoulder", scan_json(c.shoulder, sign, false)}};
}

Json row_json(const RowResult& row) {
    Json j{{"id", row.id}, {"verdict", word(row.verdict)}, {"unit", row.unit}};
    if (row.verdict == RowVerdict::not_measured)
        j["reason"] = row.reason;
    else {
        j["found"] = row.found;
        j["h_deg"] = row.where.h_deg;
        j["v_deg"] = row.where.v_deg;
        j["margin"] = row.margin;
    }
    if (row.limits.min_cd > 0.0)
        j["min"] = row.limits.min_cd;
    if (!std::isinf(row.limits.max_cd))
        j["max"] = row.limits.max_cd;
    if (row.re_aimed != Direction{})
        j["re_aimed_deg"] = {row.re_aimed.h_deg, row.re_aimed.v_deg};
    if (!row.lamps.empty())
        j["lamp"] = row.lamps.front() + 1;
    if (!row.note.empty())
        j["note"] = row.note;
    return j;
}

std::string scan_text(const CutOffScan& s, const char* axis) {
    std::string text = s.sharpness ? fmt::format("G {:.3f}", *s.sharpness) : "G not_measured";
    text += s.inflection_deg ? fmt::format(", inflection at {} {:.3f} +- {:.3f}", axis, *s.inflection_deg, s.uncertainty_deg())
                             : ", inflection not_measured";
    return s.reason.empty() ? text : text + " (" + s.reason + ")";
}

} // namespace

std::string text_of(const Regulation& r, const RegulationCheck& check, const std::vector<std::string>& lamps) {
    std::string out;
    for (const std::string& lamp : lamps)
        add_entry(out, "lamp", printable(lamp, 90));
    add_entry(out, "regulation", r.id + ": " + r.title + (check.left_hand_traffic ? ", left-hand traffic by mirror" : ""));
    add_entry(out, "edition", "per our table of " + r.edition);
    add_entry(out, "source", r.source);
    add_entry(out, "judged", judged_text(r, lamps) + "; " + receiver_text(r.receiver));
    for (std::size_t i = 0; i < check.aims.size(); ++i) {
        add_entry(out, check.aims.size() > 1 ? (i == 0 ? "aim, lamp 1" : "aim, lamp 2") : "aim",
                  fmt::format("{}: {} ({})", word(check.aims[i].rule), check.aims[i].how, aim_text(check.aims[i])));
        if (const std::string found = as_found_text(check.aims[i]); !found.empty())
            add_entry(out, "mounted", found);
    }
    if (check.was_re_aimed)
        add_entry(out, "re-aimed", turned_text(check.re_aimed) + " more, within what the edition allows a lamp that fails");
    for (const std::string& note : r.notes)
        add_entry(out, "note", note);
    std::size_t width = 3;
    for (const RowResult& row : check.rows)
        width = std::max(width, row.id.size());
    out += fmt::format("\n{:<{}} {:>9} {:>17} {:<3} {:>8} {:>15}  \n", "row", width, "found", "limit", "in", "margin", "at H, V");
    for (const RowResult& row : check.rows)
        out += row_line(row, width);
    if (!check.as_filed.empty()) {
        out += "\nas filed, where the aim changes the verdict\n";
        for (const RowResult& row : check.as_filed)
            out += row_line(row, width);
    }
    out += "\n";
    std::vector<std::string> names;
    for (const RowResult* row : narrowest(check, 3))
        names.push_back(fmt::format("{} {:+.1f} %", row->id, 100.0 * row->margin));
    if (!names.empty())
        add_entry(out, "narrowest", fmt::format("{}", fmt::join(names, ", ")));
    if (check.verdict_as_filed != check.verdict)
        add_entry(out, "as filed", std::string(word(check.verdict_as_filed)) + ": the aim changes the verdict");
    add_entry(out, "verdict", verdict_text(check) + "; no approval");
    return out;
}

std::string json_of(const Regulation& r, const RegulationCheck& check, const std::vector<std::string>& lamps) {
    Json aims = Json::array();
    for (const Aim& aim : check.aims) {
        Json one{{"rule", word(aim.rule)},
                 {"how", aim.how},
                 {"found", aim.found},
                 {"turned_deg", {aim.turned.h_deg, aim.turned.v_deg}},
                 {"bound_deg", {aim.bound.h_deg, aim.bound.v_deg}},
                 {"residual_deg", {aim.residual.h_deg, aim.residual.v_deg}},
                 {"rounds", aim.rounds}};
        if (aim.cut_off)
            one["cut_off"] = cut_off_json(*aim.cut_off, check.left_hand_traffic ? -1.0 : 1.0);
        aims.push_back(one);
    }
    Json rows = Json::array(), nearest = Json::array(), as_filed = Json::array();
    for (const RowResult& row : check.as_filed)
        as_filed.push_back(row_json(row));
    for (const RowResult& row : check.rows)
        rows.push_back(row_json(row));
    for (const RowResult* row : narrowest(check, 3))
        nearest.push_back(row->id);
    Json j{{"lamps", lamps},
           {"regulation", r.id},
           {"title", r.title},
           {"edition", r.edition},
           {"source", r.source},
           {"left_hand_traffic", check.left_hand_traffic},
           {"half_sum", r.half_sum || lamps.size() == 2},
           {"receiver", {{"shape", r.receiver.shape == Receiver::Shape::square ? "square" : "disc"}, {"size_deg", r.receiver.size_deg}}},
           {"aim", aims},
           {"notes", r.notes},
           {"rows", rows},
           {"narrowest", nearest},
           {"as_filed", {{"verdict", word(check.verdict_as_filed)}, {"rows_changed", as_filed}}},
           {"verdict", word(check.verdict)}};
    if (check.was_re_aimed)
        j["re_aimed_deg"] = {check.re_aimed.h_deg, check.re_aimed.v_deg};
    return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string text_of(const CutOffFigures& c, const CutOffElbow& elbow, const std::string& lamp, const CutOffOptions& options,
                    bool left_hand_traffic) {
    const double sign = left_hand_traffic ? -1.0 : 1.0;
    const auto at = [&](double h) { return fmt::format("H {:+.1f}", sign * h); };
    std::string out;
    add_entry(out, "lamp", printable(lamp, 90));
    add_entry(out, "scanned",
              fmt::format("in steps of 0.01 degrees, detector {:.0f} mm at 25 m, G {}{}",
                          std::tan(options.detector_deg * 3.14159265358979 / 180.0) * 25000.0,
                          options.sharpness == SharpnessRule::maximum ? "at its maximum" : "at the inflection",
                          left_hand_traffic ? "; left-hand traffic" : ""));
    for (const CutOffScan* scan : {&c.level_inner, &c.level, &c.level_outer})
        add_entry(out, at(scan->at_deg).c_str(), scan_text(*scan, "V"));
    add_entry(out, "linearity",
              c.linearity_deg ? fmt::format("{:.3f} degrees over 1.5, 2.5 and 3.5 degrees", *c.linearity_deg) : "not_measured");
    for (const CutOffScan& scan : c.rise)
        add_entry(out, at(scan.at_deg).c_str(), scan_text(scan, "V"));
    add_entry(out, "kink",
              c.kink_h_deg ? fmt::format("H {:.3f} +- {}, where the line through these meets the level part", sign * *c.kink_h_deg + 0.0,
                                         bound_text(c.kink_uncertainty_deg))
                           : "not_measured: " + c.kink_reason);
    add_entry(out, "rise", c.rise_angle_deg ? fmt::format("{:.1f} degrees", *c.rise_angle_deg) : "not_measured: " + c.kink_reason);
    add_entry(out, "elbow",
              elbow.at ? fmt::format("H {:.3f} +- {}, V {:.3f} +- {}, by a fit over {} columns; from there {:.1f} degrees up{}",
                                     sign * elbow.at->h_deg + 0.0, bound_text(elbow.uncertainty.h_deg), elbow.at->v_deg,
                                     bound_text(elbow.uncertainty.v_deg), elbow.points.size(), elbow.rise_angle_deg,
                                     elbow.rise_to_h_deg ? fmt::format(" to H {:.2f}", sign * *elbow.rise_to_h_deg) : "")
                       : "not_measured: " + elbow.reason);
    CutOffScan shoulder = c.shoulder;
    if (shoulder.inflection_deg)
        *shoulder.inflection_deg *= sign;
    add_entry(out, "shoulder", scan_text(shoulder, "H") + (c.level.inflection_deg ? fmt::format(", along V {:.2f}", shoulder.at_deg) : ""));
    return out;
}

std::string json_of(const CutOffFigures& c, const CutOffElbow& elbow, const std::string& lamp, const CutOffOptions& options,
                    bool left_hand_traffic) {
    Json j{{"lamp", lamp},
           {"left_hand_traffic", left_hand_traffic},
           {"detector_deg", options.detector_deg},
           {"sharpness_rule", options.sharpness == SharpnessRule::maximum ? "maximum" : "at-inflection"}};
    const double sign = left_hand_traffic ? -1.0 : 1.0;
    j.update(cut_off_json(c, sign));
    if (!elbow.at)
        j["elbow"] = {{"not_measured", elbow.reason}};
    else {
        j["elbow"] = {{"h_deg", sign * elbow.at->h_deg + 0.0},
                      {"v_deg", elbow.at->v_deg},
                      {"uncertainty_deg", {elbow.uncertainty.h_deg, elbow.uncertainty.v_deg}},
                      {"rise_angle_deg", elbow.rise_angle_deg}};
        if (elbow.rise_to_h_deg)
            j["elbow"]["rise_to_h_deg"] = sign * *elbow.rise_to_h_deg + 0.0;
    }
    return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string regulation_list_text() {
    std::string out;
    std::string edition;
    for (const Regulation& r : regulations()) {
        if (r.edition != edition)
            out += fmt::format("{}{}\n  source: {}\n", edition.empty() ? "" : "\n", r.edition, r.source);
        edition = r.edition;
        out += fmt::format("  {:<26} {}: {} rows in the text, aim {}\n", r.id, r.title, r.rows.size(), word(r.aim));
    }
    out += "\nA lamp's table has more rows where it is aimed by its cut-off (sharpness, linearity or level of the cut-off), and fewer "
           "where one\n"
           "file is given and rows are for two lamps.\n";
    return out;
}

std::string regulation_list_json() {
    Json list = Json::array();
    for (const Regulation& r : regulations()) {
        Json rows = Json::array();
        for (const RegulationRow& row : r.rows) {
            Json places = Json::array();
            for (const Direction d : row.places)
                places.push_back({d.h_deg, d.v_deg});
            static constexpr const char* kinds[]{"point", "segment", "zone", "sum", "brightest"};
            Json one{{"id", row.id}, {"kind", kinds[static_cast<int>(row.kind)]}, {"places_deg", places}};
            if (row.limits.min_cd > 0.0)
                one["min_cd"] = row.limits.min_cd;
            if (!std::isinf(row.limits.max_cd))
                one["max_cd"] = row.limits.max_cd;
            if (!row.ratio_of.empty())
                one[row.ratio_is_minimum ? "min_of" : "max_of"] = Json{{"row", row.ratio_of}, {"times", row.ratio}};
            if (!row.note.empty())
                one["note"] = row.note;
            rows.push_back(one);
        }
        list.push_back(Json{{"id", r.id},
                            {"title", r.title},
                            {"edition", r.edition},
                            {"source", r.source},
                            {"aim", word(r.aim)},
                            {"half_sum", r.half_sum},
                            {"rows", rows}});
    }
    return list.dump(2) + "\n";
}

} // namespace fernlicht
