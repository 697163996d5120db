// Text in columns for a terminal.
#pragma once

#include <string>
#include <vector>

namespace fernlicht {

/// Rows of as many cells as `header` has. Columns are as wide as their widest cell, two spaces apart; `alignment` has a character for
/// each: '<' or '>'. Nothing trails. Lines end with a newline.
std::string aligned_table(const std::string& alignment, const std::vector<std::string>& header,
                          const std::vector<std::vector<std::string>>& rows);

} // namespace fernlicht
