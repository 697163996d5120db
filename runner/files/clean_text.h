// Text from users and their files on its way into a report: names, paths and labels may hold anything.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace fernlicht {

/// Valid UTF-8 that every reader can take: bad bytes and code points that must not be seen (C1 controls, U+FFFE, U+FFFF, marks that turn
/// the direction of writing) become U+FFFD; C0 controls and DEL become their pictures (U+2400 ff.), so that a newline in a file name shows.
std::string clean_text(std::string_view bytes);

/// With a capital first, where that is a letter from a to z.
std::string capitalised(std::string text);

/// clean_text, its middle replaced by an ellipsis when longer than `max_characters` (code points; at least 3).
std::string short_text(std::string_view bytes, std::size_t max_characters);

/// clean_text with & < > " ' as entities: good for XML text and attributes.
std::string xml_text(std::string_view bytes);

/// A field of RFC 4180: quoted where it must be. A text, other than a number, that a spreadsheet would take for a formula gets a leading
/// apostrophe.
std::string csv_text(std::string_view bytes);
/// With all its digits; "" for none.
std::string csv_number(const std::optional<double>& value);
/// Such fields between commas, and the end of the line.
std::string csv_line(const auto&... fields) {
    std::string line;
    ((line += fields, line += ','), ...);
    return line.replace(line.size() - 1, 1, "\r\n");
}

/// A relative path as the reference of a link: everything but unreserved characters and / percent-encoded, "./" before it so that no scheme
/// can be meant.
std::string relative_link(std::string_view path);

} // namespace fernlicht
