// EULUMDAT (.ldt): one value a line, intensities in cd per 1000 lm of the lamps.
#pragma once

#include "scenarios/lamps/lamp_file.h"

#include <string_view>

namespace fernlicht {

/// The second and third line are a type 0..3 and a symmetry 0..4, the fourth and sixth are counts.
bool looks_like_eulumdat(std::string_view text);

/// `text` is the content of `path` as UTF-8. Throws InputError with the line.
/// - cd = listed value / 1000 x flux of the first lamp set x conversion factor (line 24). Further lamp sets are alternatives: noted.
/// - A negative number of lamps says absolute photometry; its values are per 1000 lm all the same.
/// - The declared flux is the luminaire's: lamp flux x light output ratio (line 23).
/// - Symmetry 3 stores its planes from C 270 through C 0 to C 90.
/// - Lamp sets stand one after the other; files that list them field by field are told apart where only that makes numbers.
LampFile read_eulumdat(const std::filesystem::path& path, std::string_view text, const LampReadOptions& options, FilesRead opened);

} // namespace fernlicht
