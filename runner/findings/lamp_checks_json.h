// The check of lamp files in JSON.
#pragma once

#include "runner/files/described_json.h"
#include "runner/findings/lamp_checks.h"

namespace fernlicht {

JsonMembers lamp_file_members(CheckedLampFile& file);
JsonMembers lamp_finding_members(IntakeFinding& finding);

} // namespace fernlicht
