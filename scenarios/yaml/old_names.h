// Names that keys and words in users' files had in version 0.1: the one table by which `fernlicht migrate` converts files, and from which
// the refusal of an unknown key takes today's word.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

/// Today's name of a key of drives and studies, if the map knows it by that; else "".
std::string_view name_of_today(std::string_view key, std::span<const std::string_view> known_keys);

enum class Naming { today, before };

/// A piece of a text to be replaced.
struct TextEdit {
    std::size_t line = 1, column = 1; ///< from 1; where the old piece begins, a quote before it not counted
    std::string old, now;
};
/// The text with each piece replaced, all else as it was. `unmatched` gets "LINE: ..." for a piece that does not stand where it should.
std::string edited(const std::string& text, std::vector<TextEdit> edits, std::vector<std::string>& unmatched);

/// A drive or study with its keys in the other naming; comments and layout stay. `unmatched` gets "LINE: ..." for a key whose other name
/// stands beside it. Throws InputError for what is no YAML.
std::string renamed_keys(const std::string& text, const std::filesystem::path& file, Naming naming, std::vector<std::string>& unmatched);

/// The id of a known failure with the words that verdicts have today.
std::string verdict_id_of_today(const std::string& id);

/// Whether a baselines' index has the schema of version 0.1.
bool is_old_index(std::string_view schema);
/// Index or results of baselines with today's keys and schemas.
std::string baseline_text_of_today(std::string text);

} // namespace fernlicht
