#include "runner/experiments/regulation/regulation_result.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

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

Json figures_json(const CutOffFigures& c, double sign) {
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
    Json j{{"id", row.id}, {"verdict", name_of(row.verdict)}, {"unit", row.unit}};
    if (row.sureness != Sureness::as_table)
        j["known_by"] = in_words(row.sureness);
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

} // namespace

std::string regulation_json(const RegulationFound& found) {
    const auto& [r, lamps, check] = found;
    Json aims = Json::array();
    for (const Aim& aim : check.aims) {
        Json one{{"rule", name_of(aim.rule)},
                 {"how", aim.how},
                 {"found", aim.found},
                 {"turned_deg", {aim.turned.h_deg, aim.turned.v_deg}},
                 {"bound_deg", {aim.bound.h_deg, aim.bound.v_deg}},
                 {"residual_deg", {aim.residual.h_deg, aim.residual.v_deg}},
                 {"rounds", aim.rounds}};
        if (aim.cut_off)
            one["cut_off"] = figures_json(*aim.cut_off, check.left_hand_traffic ? -1.0 : 1.0);
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
           {"notes", notes_of(found)},
           {"rows", rows},
           {"narrowest", nearest}};
    if (check.verdict_as_filed)
        j["as_filed"] = {{"verdict", name_of(*check.verdict_as_filed)}, {"rows_changed", as_filed}};
    j["verdict"] = name_of(check.verdict);
    if (check.was_re_aimed)
        j["re_aimed_deg"] = {check.re_aimed.h_deg, check.re_aimed.v_deg};
    return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string cut_off_json(const CutOffFound& found) {
    const auto& [lamp, options, left_hand_traffic, c, elbow] = found;
    Json j{{"lamp", lamp.name},
           {"left_hand_traffic", left_hand_traffic},
           {"detector_deg", options.detector_deg},
           {"sharpness_rule", options.sharpness == SharpnessRule::maximum ? "maximum" : "at-inflection"}};
    const double sign = left_hand_traffic ? -1.0 : 1.0;
    j.update(figures_json(c, sign));
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

std::string regulation_list_json() {
    Json list = Json::array();
    for (const Regulation& r : listed_regulations()) {
        Json rows = Json::array();
        for (const RegulationRow& row : r.rows) {
            Json places = Json::array();
            for (const Direction d : row.places)
                places.push_back({d.h_deg, d.v_deg});
            static constexpr const char* kinds[]{"point", "segment", "zone", "sum", "brightest"};
            Json one{{"id", row.id},
                     {"kind", kinds[static_cast<int>(row.kind)]},
                     {"places_deg", places},
                     {"known_by", in_words(r.sureness_of(row))}};
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
                            {"aim", name_of(r.aim)},
                            {"half_sum", r.half_sum},
                            {"rows", rows}});
    }
    return list.dump(2) + "\n";
}

} // namespace fernlicht
