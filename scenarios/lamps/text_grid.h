// Luminous intensities in a text that a recipe describes: a goniometer's own export.
#pragma once

#include "scenarios/lamps/grid_recipe.h"
#include "scenarios/lamps/lamp_file.h"

#include <string_view>

namespace fernlicht {

/// `text` is the content of `path` as UTF-8. Throws InputError with the line where it is not laid out as the recipe says: another number of
/// cells or lines, a cell that is no number with the recipe's decimal sign, a direction twice with different values or missing, a word of
/// the header that is another.
///
/// Angles are brought to degrees and given the recipe's signs, values to candela (a planar screen stands square to the file's 0, 0), then
/// the file's 0, 0 is moved to where it lies, and other systems are brought onto H and V as those of other formats are.
LampFile read_text_grid(const std::filesystem::path& path, std::string_view text, const GridRecipe& recipe, const LampReadOptions& options,
                        FilesRead opened);

} // namespace fernlicht
