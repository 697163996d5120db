#include "runner/files/json_text.h"

#include <algorithm>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t line_characters = 140;

std::string compact(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

bool is_plain_array(const Json& value) {
    return value.is_array() && std::none_of(value.begin(), value.end(), [](const Json& item) { return item.is_structured(); });
}

/// A lower bound of the compact text's length without making it: keeps the layout linear in the document.
std::size_t at_least(const Json& value) {
    if (!value.is_structured())
        return 1;
    std::size_t sum = 2;
    for (const Json& item : value)
        if (sum += at_least(item); sum > line_characters)
            break;
    return sum;
}

} // namespace

void append_json(std::string& out, const Json& value, std::size_t depth) {
    if (!value.is_structured() || value.empty() || is_plain_array(value)) {
        out += compact(value);
        return;
    }
    if (at_least(value) <= line_characters)
        if (const std::string line = compact(value); line.size() + 2 * depth <= line_characters) {
            out += line;
            return;
        }
    const std::string indent(2 * (depth + 1), ' ');
    out += value.is_array() ? "[" : "{";
    bool first = true;
    for (auto item = value.begin(); item != value.end(); ++item) {
        out += (first ? "\n" : ",\n") + indent;
        first = false;
        if (value.is_object())
            out += compact(Json(item.key())) + ": ";
        append_json(out, *item, depth + 1);
    }
    out += "\n" + std::string(2 * depth, ' ') + (value.is_array() ? "]" : "}");
}

bool takes_lines(const Json& list) { return !is_plain_array(list) && at_least(list) > line_characters; }

std::string json_quoted(const std::string& text) { return compact(Json(text)); }

std::string json_text(const Json& value) {
    std::string out;
    append_json(out, value, 0);
    return out + "\n";
}

} // namespace fernlicht
