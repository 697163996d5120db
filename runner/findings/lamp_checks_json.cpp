#include "runner/findings/lamp_checks_json.h"

namespace fernlicht {

JsonMembers lamp_finding_members(IntakeFinding& finding) {
    const auto name = [](IntakeFault fault) { return name_of(fault); };
    return {
        {"fault", one_of(finding.fault, names_of<IntakeFault>(name, 12))}, {"meaningless", finding.meaningless}, {"text", finding.text}};
}

JsonMembers lamp_file_members(CheckedLampFile& file) {
    const auto name = [](BeamFunction function) { return name_of(function); };
    return {{"file", file.file},
            {"used_as", file.used_as},
            {"function", one_of(file.function, names_of<BeamFunction>(name, 3))},
            {"function_stated", file.function_stated},
            {"filament", file.filament},
            {"measured_at_v", file.measured_at_v},
            {"findings", file.findings, lamp_finding_members}};
}

} // namespace fernlicht
