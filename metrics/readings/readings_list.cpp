#include "metrics/readings/readings_list.h"

#include "metrics/readings/reading_key.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

const char* better_text(Better better) { return better == Better::higher ? "higher" : better == Better::lower ? "lower" : ""; }

/// In a cell of a table `|` would end it.
std::string cell(std::string text) {
    for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2))
        text.insert(at, 1, '\\');
    return text;
}

} // namespace

std::string readings_text() {
    std::string text;
    for (const QuantityRow& row : quantities())
        text += fmt::format("{}{}\n    {}{}{}\n", text.empty() ? "" : "\n", fmt::join(forms_in_words(row), "\n"),
                            std::string(row.unit) == "1" ? "" : std::string(row.unit) + ": ", row.meaning,
                            row.better == Better::neither ? "" : fmt::format("; {} is better", better_text(row.better)));
    return text;
}

std::string readings_markdown() {
    std::string text = "| reading | unit | better | what it is | equation | source |\n|---|---|---|---|---|---|\n";
    for (const QuantityRow& row : quantities())
        text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", fmt::join(forms_in_words(row), "`, `"), row.unit,
                            better_text(row.better), row.meaning, cell(row.equation), row.source);
    return text;
}

} // namespace fernlicht
