#include "runner/findings/context_json.h"

namespace fernlicht {

using Json = nlohmann::ordered_json;

Json versions_json(const RunContext& context) {
    Json versions = Json::object();
    for (const auto& [name, version] : context.versions)
        versions[name] = version;
    return versions;
}

Json inputs_json(const RunContext& context) {
    Json inputs = Json::array();
    for (const FileRead& file : context.inputs)
        inputs.push_back({{"path", file.path.string()}, {"bytes", file.bytes}, {"xxh128", file.xxh128}});
    return inputs;
}

Json context_json(const RunContext& context) {
    return {
        {"command", context.command},         {"started_utc", context.started_utc}, {"seed", context.seed}, {"backend", context.backend},
        {"gl_renderer", context.gl_renderer}, {"gl_version", context.gl_version},   {"cpu", context.cpu},   {"os", context.os},
        {"versions", versions_json(context)}, {"inputs", inputs_json(context)}};
}

} // namespace fernlicht
