// JSON laid out for people and for diff.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace fernlicht {

/// Objects and arrays that fit into a line, and arrays of plain values of any length, stand on one line; everything else is
/// indented by two. Invalid UTF-8 becomes U+FFFD. Ends with a newline.
std::string json_text(const nlohmann::ordered_json& value);
/// The same, as it stands `depth` levels deep and without the newline, behind what is in `out`.
void append_json(std::string& out, const nlohmann::ordered_json& value, std::size_t depth);
/// Whether a list of these items, and of more like them, is on lines of its own.
bool takes_lines(const nlohmann::ordered_json& list);

/// A text as JSON has it, in quotes; invalid UTF-8 as above.
std::string json_quoted(const std::string& text);

} // namespace fernlicht
