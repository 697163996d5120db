#include "metrics/readings/readings_markdown.h"

#include "metrics/readings/reading_key.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

/// In a cell of a table `|` would end it.
std::string cell(std::string text) {
    for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2))
        text.insert(at, 1, '\\');
    return text;
}

} // namespace

std::string readings_markdown() {
    std::string text = "| reading | unit | better | what it is | equation | source |\n|---|---|---|---|---|---|\n";
    for (const QuantityRow& row : quantities())
        text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", fmt::join(forms_in_words(row), "`, `"), row.unit,
                            row.better == Better::higher  ? "higher"
                            : row.better == Better::lower ? "lower"
                                                          : "",
                            row.meaning, cell(row.equation), row.source);
    return text;
}

} // namespace fernlicht
