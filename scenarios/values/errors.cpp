#include "scenarios/values/errors.h"

#include "scenarios/values/files.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace fernlicht {
namespace {

std::string sentence(const InputError::Where& where, const std::string& found, const std::string& expected) {
    std::string text = where.file == "-" ? "standard input" : printable(where.file.string(), 400);
    if (where.line > 0) {
        text += ":" + std::to_string(where.line);
        if (where.column > 0)
            text += ":" + std::to_string(where.column);
    }
    if (!text.empty())
        text += ": ";
    if (!where.key.empty())
        text += printable(where.key, 120) + ": ";
    text += found;
    if (!expected.empty())
        text += ", expected " + expected;
    return text;
}

} // namespace

InputError::InputError(Where where, const std::string& found, const std::string& expected)
    : std::runtime_error(sentence(where, found, expected)), where_(std::move(where)) {}

std::string printable(const std::string& text, std::size_t max_chars) {
    static constexpr char hex[] = "0123456789abcdef";
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        if (out.size() >= max_chars)
            return out + "...";
        const auto byte = static_cast<unsigned char>(text[i]);
        const std::size_t length = utf8_length(reinterpret_cast<const unsigned char*>(text.data()) + i, text.size() - i);
        if (length > 0 && byte >= 0x20 && byte != 0x7f)
            out.append(text, i, length);
        else
            out += {'\\', 'x', hex[byte >> 4], hex[byte & 15]};
        i += std::max<std::size_t>(length, 1);
    }
    return out;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
            diagonal = above;
        }
    }
    return row[b.size()];
}

} // namespace fernlicht
