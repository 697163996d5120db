#include "runner/write/formats.h"

#include "runner/write/document.h"

namespace fernlicht {

std::span<const OutputFormat> output_formats() {
    static constexpr OutputFormat formats[] = {
        {"csv", ".csv", "comma-separated values for spreadsheets", table_csv, nullptr},
        {"markdown", ".md", "Markdown", table_markdown, document_markdown, true},
        {"tex", ".tex", "LaTeX with booktabs", table_latex, document_latex, true},
        {"text", ".txt", "text for a terminal", table_text, document_text},
        {"html", ".html", "a page for a browser", nullptr, [](const Document& document) { return document_html(document, {}); }}};
    return formats;
}

} // namespace fernlicht
