// What a run's lamp controller sent, as candump would have logged it.
#pragma once

#include "scenarios/drives/drive.h"

#include <string>

namespace fernlicht {

/// Lines of `candump -L`, stamped as the recording is that the drive was played by (0 s without one), so that both can be merged. "" for a
/// variant that sent nothing.
std::string sent_log(const Drive& drive, const Variant& variant);

} // namespace fernlicht
