#include "scenarios/values/version.h"

namespace fernlicht {

const char* const program_version = FERNLICHT_VERSION;

} // namespace fernlicht
