// Former names of flags and commands.
#pragma once

#include <string>
#include <vector>

namespace fernlicht {

/// Of a command line that cannot be parsed: "found '--variant' of version 0.1, expected --lamp-set ..." for the first word that has another
/// name today; "" where none has.
std::string old_word_in(const std::vector<std::string>& command_line);

} // namespace fernlicht
