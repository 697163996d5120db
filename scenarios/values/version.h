// The program's own version. Only its source is compiled anew with a new one.
#pragma once

namespace fernlicht {

extern const char* const program_version; ///< "0.2.0"

} // namespace fernlicht
