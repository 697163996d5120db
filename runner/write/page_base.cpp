#include "runner/write/page_base.h"

#include "report_files.h"
#include "runner/files/clean_text.h"

#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {

using kainjow::mustache::data;

data context_part(const RunContext& context) {
    data part;
    part.set("command", clean_text(context.command));
    part.set("has_out", context.command.find(" --out") != std::string::npos);
    part.set("started_utc", clean_text(context.started_utc));
    data facts{data::type::list}, inputs{data::type::list};
    const auto fact = [&](const std::string& name, const std::string& text) {
        data row;
        row.set("name", clean_text(name));
        row.set("text", text.empty() ? "not known" : clean_text(text));
        facts.push_back(row);
    };
    if (!context.started_utc.empty()) { // else nothing depends on when and where
        fact("Started", context.started_utc);
        fact("Seed", fmt::format("{}", context.seed));
        fact("Backend", context.backend);
        fact("OpenGL renderer", context.gl_renderer);
        fact("OpenGL version", context.gl_version);
        fact("CPU", context.cpu);
        fact("System", context.os);
    }
    for (const auto& [name, version] : context.versions)
        fact(name, version);
    for (const FileRead& file : context.inputs) {
        data row;
        row.set("path", clean_text(file.path.string()));
        row.set("bytes", fmt::format("{}", file.bytes));
        row.set("xxh128", clean_text(file.xxh128));
        inputs.push_back(row);
    }
    part.set("facts", facts);
    part.set("has_inputs", !context.inputs.empty());
    part.set("inputs", inputs);
    return part;
}

void page_of(const char* template_name, data page, const TakePiece& take) {
    page.set("style", std::string(report_file("report.css")) + std::string(report_file("document.css")));
    page.set("document_sections", std::string(report_file("document_sections.mustache")));
    kainjow::mustache::mustache page_template{std::string(report_file(template_name))};
    page_template.render(page, [&](const std::string& piece) { take(piece); });
    if (!page_template.is_valid())
        throw std::logic_error(std::string(template_name) + ": " + page_template.error_message());
}

std::string page_of(const char* template_name, data page) {
    std::string html;
    page_of(template_name, std::move(page), [&](std::string_view piece) { html += piece; });
    return html;
}

} // namespace fernlicht
