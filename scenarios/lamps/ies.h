// IES LM-63, editions 1986, 1991, 1995, 2002 and 2019, types A, B and C.
#pragma once

#include "scenarios/lamps/lamp_file.h"

#include <string_view>

namespace fernlicht {

/// The first line names LM-63, or a line begins with TILT= (1986 has no header).
bool looks_like_ies(std::string_view text);

/// `text` is the content of `path` as UTF-8. Throws InputError with the line.
/// - cd = listed value x multiplier x ballast factor, and x ballast-lamp factor in the 1986 and 1991 editions only: from 1995 on that
///   field is reserved, in 2019 it is the file's generation type.
/// - Type 1 with vertical angles below 0 cannot be type C and is read as A; type 3 with angles above 90 cannot be A and is read as C
///   (the codes of 1986 files were understood both ways).
/// - Types A and B whose horizontal angles begin at 0 are laterally symmetric and are mirrored.
/// - TILT factors belong to tilted luminaires; the one at angle 0 is applied.
LampFile read_ies(const std::filesystem::path& path, std::string_view text, const LampReadOptions& options, FilesRead opened);

/// LM-63-2002, type A, absolute photometry (or the declared flux). Numbers in full: reading it back gives the same table.
/// A table whose H axis begins at 0 gets a dark column at -0.001 degrees, because LM-63 would have it mirrored.
std::string ies_text(const LampFile& lamp);

} // namespace fernlicht
