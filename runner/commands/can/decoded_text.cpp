#include "runner/commands/can/decoded_text.h"

#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace fernlicht {

void append_readable(std::string& out, const CanValue& value) {
    if (std::trunc(value.physical) == value.physical) // of factors such as 0.5, too, as long as nothing is behind the point
        out += exact_text(value);
    else
        fmt::format_to(std::back_inserter(out), "{:.{}g}", value.physical, value.signal->kind == CanValueKind::float32 ? 7 : 12);
}

void append_decoded(std::string& out, const CanMessage& message, std::span<const CanValue> values, bool single_line, bool numbers) {
    out += single_line ? " :: " : " ::\n";
    out += message.name;
    out += single_line ? "(" : "(\n";
    bool first = true;
    for (const CanValue& value : values) {
        if (!first)
            out += single_line ? ", " : ",\n";
        first = false;
        out += single_line ? "" : "    ";
        out += value.signal->name;
        out += ": ";
        if (value.label != nullptr && !numbers) {
            out += *value.label;
            continue;
        }
        append_readable(out, value);
        if (!value.signal->unit.empty()) {
            out += ' ';
            out += value.signal->unit;
        }
    }
    out += single_line || first ? ")" : "\n)";
}

void append_csv_text(std::string& out, const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) {
        out += text;
        return;
    }
    out += '"';
    for (const char c : text) {
        if (c == '"')
            out += '"';
        out += c;
    }
    out += '"';
}

} // namespace fernlicht
