// Patterns by which users name several things at a time: cells, readings, verdicts.
#pragma once

#include <string_view>

namespace fernlicht {

/// Whether the whole text fits: `*` stands for any characters, none too, `?` for one, all others for themselves.
bool matches(std::string_view pattern, std::string_view text);

} // namespace fernlicht
