#include "runner/write/aligned_table.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {

std::string aligned_table(const std::string& alignment, const std::vector<std::string>& header,
                          const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::vector<std::string>> lines{header};
    lines.insert(lines.end(), rows.begin(), rows.end());
    std::string text;
    std::vector<std::size_t> widths(header.size(), 0);
    for (const auto& cells : lines)
        for (std::size_t i = 0; i < widths.size(); ++i)
            widths[i] = std::max(widths[i], cells.at(i).size());
    for (const auto& cells : lines) {
        std::string line;
        for (std::size_t i = 0; i < widths.size(); ++i)
            line += (i == 0 ? "" : "  ") +
                    (alignment.at(i) == '>' ? fmt::format("{:>{}}", cells[i], widths[i]) : fmt::format("{:<{}}", cells[i], widths[i]));
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

} // namespace fernlicht
