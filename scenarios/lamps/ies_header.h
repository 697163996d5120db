// What stands before the numbers of an LM-63 file.
#pragma once

#include "scenarios/lamps/lamp_text.h"
#include "scenarios/lamps/measured_grid.h"

#include <utility>

namespace fernlicht {

struct IesHeader {
    int edition = 1986; ///< 1986, 1991, 1995, 2002 or 2019
    std::string tilt;   ///< "NONE", "INCLUDE" or a file name
    std::size_t tilt_line = 0;
    std::vector<std::pair<std::string, std::string>> labels;
};

/// The edition that a header line names ("IESNA91", "IESNA: LM-63-1995", "IES:LM-63-2019"); nullopt: not a header line.
/// An LM-63 line without a year that we know counts as the last edition not after it, with a note.
std::optional<int> ies_edition(std::string_view line, Notes& notes);

/// Is this `TILT = ...`? Then what follows the equals sign.
std::optional<std::string_view> tilt_of(std::string_view line);

/// Reads up to and including the TILT line. Throws InputError when there is none.
IesHeader read_ies_header(LineReader& lines, const std::filesystem::path& path, Notes& notes);

} // namespace fernlicht
