#include "runner/experiments/compare/lamps/lamp_comparison.h"

#include "runner/experiments/compare/lamps/lamp_difference_text.h"
#include "runner/experiments/regulation/regulation_result.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

/// As `fernlicht lamp FILE --cut-off`: a detector of 30 mm at 25 m.
CutOffOptions default_cut_off() { return {SharpnessRule::maximum, degrees(std::atan(30.0 / 25000.0))}; }

ComparedLamp read_compared(const std::filesystem::path& path, const std::filesystem::path& recipe) {
    ComparedLamp lamp;
    lamp.path = path;
    lamp.file = read_lamp(path, {.recipe = recipe});
    lamp.description = describe(lamp.file);
    lamp.cut_off = measure_cut_off({&lamp.file.table, {}}, default_cut_off());
    lamp.cut_off_told = cut_off_json({lamp.file, {}, false, lamp.cut_off, fit_elbow({&lamp.file.table, {}})});
    return lamp;
}

void add(LampPairComparison& lamps, const char* name, const char* words, const char* unit, const std::optional<double>& before,
         const std::optional<double>& now, const std::string& why_before = {}, const std::string& why_now = {}) {
    lamps.facts.push_back({name, unit, words, before, now, std::nullopt, before && now ? "" : before ? why_now : why_before});
}

void add_place(LampPairComparison& lamps, const char* name, const char* words, const CutOffScan& before, const CutOffScan& now) {
    add(lamps, name, words, "deg", before.inflection_deg, now.inflection_deg, before.reason, now.reason);
    if (before.inflection_deg && now.inflection_deg)
        lamps.facts.back().uncertainty = std::hypot(before.uncertainty_deg(), now.uncertainty_deg());
}

void add_facts(LampPairComparison& lamps) {
    const LampDescription &a = lamps.before.description, &b = lamps.now.description;
    add(lamps, "peak_cd", "peak", "cd", a.peak.cd, b.peak.cd);
    add(lamps, "peak_h_deg", "peak, H", "deg", a.peak.h_deg, b.peak.h_deg);
    add(lamps, "peak_v_deg", "peak, V", "deg", a.peak.v_deg, b.peak.v_deg);
    add(lamps, "hv_cd", "straight ahead (HV)", "cd", a.hv_cd, b.hv_cd);
    add(lamps, "flux_lm", "flux within the table", "lm", a.flux_lm, b.flux_lm);
    const CutOffFigures &c = lamps.before.cut_off, &d = lamps.now.cut_off;
    add_place(lamps, "cut_off_v_deg", "cut-off at 2.5 degrees left, V", c.level, d.level);
    add(lamps, "cut_off_sharpness_g", "its sharpness G", "", c.level.sharpness, d.level.sharpness, c.level.reason, d.level.reason);
    add(lamps, "cut_off_linearity_deg", "its linearity", "deg", c.linearity_deg, d.linearity_deg,
        "the level part was not found at three places", "the level part was not found at three places");
    add(lamps, "kink_h_deg", "kink, H", "deg", c.kink_h_deg, d.kink_h_deg, c.kink_reason, d.kink_reason);
    add(lamps, "rise_angle_deg", "angle of the rise", "deg", c.rise_angle_deg, d.rise_angle_deg, c.kink_reason, d.kink_reason);
    add_place(lamps, "shoulder_h_deg", "shoulder of the rise, H", c.shoulder, d.shoulder);
}

void check(LampPairComparison& lamps, const std::string& id) {
    lamps.regulation = &regulation(id);
    for (ComparedLamp* lamp : {&lamps.before, &lamps.now}) {
        lamp->check = check_regulation(*lamps.regulation, {lamp->file.table});
        lamp->check_told = regulation_json({*lamps.regulation, {lamp->file.name}, *lamp->check});
    }
    for (const RowResult& row : lamps.before.check->rows)
        lamps.rows.push_back({row.id, row.unit, row, {}});
    for (const RowResult& row : lamps.now.check->rows) {
        const auto found = std::ranges::find(lamps.rows, row.id, &ComparedRow::id);
        if (found == lamps.rows.end())
            lamps.rows.push_back({row.id, row.unit, {}, row});
        else
            found->now = row, found->unit = row.unit;
    }
}

} // namespace

bool LampPairComparison::passed() const { return !now.check || now.check->verdict == RowVerdict::pass; }

LampPairComparison compare_lamp_files(const std::filesystem::path& before, const std::filesystem::path& now,
                                      const LampCompareOptions& options) {
    LampPairComparison lamps;
    if (!options.regulation.empty())
        regulation(options.regulation); // its name first: reading and comparing take longer
    lamps.before = read_compared(before, options.recipe);
    lamps.now = read_compared(now, options.recipe);
    lamps.difference = difference_of(lamps.now.file, lamps.before.file, options.noise_relative);
    add_facts(lamps);
    if (!options.regulation.empty())
        check(lamps, options.regulation);
    return lamps;
}

} // namespace fernlicht
