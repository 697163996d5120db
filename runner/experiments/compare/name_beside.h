// What a lamp is called beside another one.
#pragma once

#include "scenarios/lamps/lamp_file.h"

namespace fernlicht {

/// Its file, and in brackets its own name where that says something else: "halogen-low.ies (halogen low beam (model))". Files of one name
/// with their folders. A lamp that was read from no file has its own name alone.
std::string name_beside(const LampFile& lamp, const LampFile& other);

} // namespace fernlicht
