// How our writers keep a table's gaps: rectangles in degrees, as text, in whatever place a format has for texts.
#pragma once

#include "scenarios/lamps/lamp_file.h"
#include "scenarios/values/errors.h"

namespace fernlicht {

inline constexpr const char* gaps_key = "_GAPS_DEG";

/// "none", or "h0 h1 v0 v1; h0 h1 v0 v1; ...": the cells between these angles have no data.
std::string gaps_text(const CandelaTable& table);

/// Marks the cells between the angles that `text` names. Throws InputError when it does not read as gaps_text writes it.
void mark_written_gaps(const std::string& text, CandelaTable& table, const InputError::Where& where);

/// Takes the label `gaps_key`, if there is one, out of the labels and marks what it says. False: the file does not say.
bool take_written_gaps(std::vector<std::pair<std::string, std::string>>& labels, CandelaTable& table, const std::filesystem::path& path);

} // namespace fernlicht
