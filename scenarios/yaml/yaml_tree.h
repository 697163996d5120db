// A YAML document as plain values that know where they stand in the file. The only place that knows the YAML library.
// Pieces of the YAML that resolved drives are written in.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

struct YamlMember;

/// One value of the document. Aliases are already replaced by what they name.
struct YamlValue {
    enum class Kind { null, scalar, list, map };
    Kind kind = Kind::null;
    std::string text;                ///< scalar only
    bool quoted = false;             ///< scalar only: '...', "...", | or >; such text is never a number
    std::vector<YamlValue> items;    ///< list only
    std::vector<YamlMember> members; ///< map only, in the order of the file, each key once
    std::size_t line = 1, column = 1;
};

struct YamlMember {
    std::string key;
    std::size_t line = 1, column = 1; ///< of the key
    YamlValue value;
};

/// The one document in `content`; `file` only for messages. Throws InputError with line and column for what is not YAML, more than
/// one document, a key that is given twice or is not plain text, nesting deeper than 32, and more than 100 000 values
/// (aliases counted as what they stand for, so that a small file cannot grow into a large tree).
YamlValue parse_yaml(const std::string& content, const std::filesystem::path& file);

/// Text in double quotes, as YAML and JSON both read it.
std::string quoted(const std::string& text);

/// `key`_deg where some number of degrees gives exactly these radians, else `key`_rad.
std::string angle_entry(std::string_view key, double angle_rad);

} // namespace fernlicht
