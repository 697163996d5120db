#include "runner/experiments/improve/improve_result.h"
#include "runner/findings/context_json.h"

namespace fernlicht {
namespace {

JsonMembers drive_members(ImproveDrive& drive) {
    return {{"name", drive.name}, {"title", drive.title}, {"lamp_set", drive.lamp_set}, {"moments", drive.moments}};
}

JsonMembers reading_members(ImprovedReading& line) {
    return {
        {"drive", line.drive},       {"asked", line.asked},       {"reading", line.reading}, {"unit", std::string(unit_of(line.reading))},
        {"is_gain", line.is_gain},   {"at_least", line.at_least}, {"bound", line.bound},     {"before", line.before},
        {"foretold", line.foretold}, {"stepped", line.stepped},   {"found", line.found},     {"met", line.met}};
}

JsonMembers improve_step_members(ImproveStep& step) {
    return {{"longest", step.longest}, {"size", step.size},   {"foretold", step.foretold},
            {"found", step.found},     {"taken", step.taken}, {"regulation_row", or_null(step.regulation_row)}};
}

JsonMembers binding_members(BindingLimit& limit) { return {{"of", limit.of}, {"worth", limit.worth}}; }

JsonMembers row_members(ImprovedRow& row) {
    return {{"id", row.id},
            {"limits", row.limits},
            {"unit", row.unit},
            {"before", row.before},
            {"after", row.after},
            {"before_margin", row.before_margin},
            {"after_margin", row.after_margin},
            {"before_verdict", row.before_verdict},
            {"after_verdict", row.after_verdict}};
}

JsonMembers extreme_members(ImproveExtreme& extreme) {
    return {{"h_deg", extreme.h_deg}, {"v_deg", extreme.v_deg}, {"before_cd", extreme.before_cd}, {"after_cd", extreme.after_cd}};
}

} // namespace

JsonMembers improve_members(ImproveResult& result) {
    return {{"schema", json_constant("fernlicht improve")},
            {"schema_version", json_constant(1)},
            {"context", context_members(result.context)},
            {"lamp", result.lamp},
            {"written", result.written},
            {"solver", result.solver},
            {"drives", result.drives, drive_members},
            {"readings", result.readings, reading_members},
            {"improved", improved(result)},
            {"steps", result.steps, improve_step_members},
            {"gain_missed", result.gain_missed},
            {"settled", result.settled},
            {"binding", result.binding, binding_members},
            {"variables", result.variables},
            {"floor_cd", result.floor_cd},
            {"narrowest_deg", result.narrowest_deg},
            {"samples_changed", result.samples_changed},
            {"flux_before_lm", result.flux_before_lm},
            {"flux_after_lm", result.flux_after_lm},
            {"steepest_before", result.steepest_before},
            {"steepest_after", result.steepest_after},
            {"most", result.most, extreme_members},
            {"least", result.least, extreme_members},
            {"brightest", result.brightest, extreme_members},
            {"regulation", or_null(result.regulation)},
            {"verdict_before", or_null(result.verdict_before)},
            {"verdict_after", or_null(result.verdict_after)},
            {"rows", result.rows, row_members}};
}

} // namespace fernlicht
