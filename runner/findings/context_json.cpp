#include "runner/findings/context_json.h"

namespace fernlicht {

JsonMembers file_members(FileRead& file) { return {{"path", file.path}, {"bytes", file.bytes}, {"xxh128", file.xxh128}}; }

JsonMembers moment_members(std::pair<int, double>& moment) { return {{"frame", moment.first}, {"time_s", moment.second}}; }

JsonMembers context_members(RunContext& context) {
    return {
        {"command", context.command},         {"started_utc", context.started_utc},    {"seed", context.seed}, {"backend", context.backend},
        {"gl_renderer", context.gl_renderer}, {"gl_version", context.gl_version},      {"cpu", context.cpu},   {"os", context.os},
        {"versions", context.versions},       {"inputs", context.inputs, file_members}};
}

JsonMembers spread_members(Spread& spread) {
    return {
        {"count", spread.count},     {"median", spread.median},   {"p05", spread.p05},   {"p95", spread.p95},
        {"minimum", spread.minimum}, {"maximum", spread.maximum}, {"mean", spread.mean}, {"standard_deviation", spread.standard_deviation}};
}

} // namespace fernlicht
