// The outermost structure of an OpenFlight file: records with a code and a length, one after the other.
#pragma once

#include <filesystem>
#include <string>

namespace fernlicht {

/// Follows the records from the header to the file's end. Throws InputError with the byte of the record: no OpenFlight header, a revision
/// other than 1400 to 1700 (14.0 to 17.0), records that end beyond the file, levels that are opened and never closed or deeper than 1000.
void check_openflight(const std::filesystem::path& path, const std::string& bytes);

} // namespace fernlicht
