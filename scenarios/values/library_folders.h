// Where the program's own files lie: lamps, roads, drives and what else is in scenarios/library.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fernlicht {

/// Folders laid out as scenarios/library, in the order in which they are asked for a file: $FERNLICHT_DATA; ../share/fernlicht from the
/// program, where it is installed; scenarios/library above the program, then above the working folder; fernlicht/ of $XDG_DATA_HOME and of
/// each of $XDG_DATA_DIRS. Not all need exist. Throws InputError where FERNLICHT_DATA names no folder.
std::vector<std::filesystem::path> library_folders();

/// A file or folder of theirs ("lamps/halogen-low.ies"): the first there is, or empty.
std::filesystem::path shipped_path(const std::filesystem::path& name);

/// The same, but throws InputError where there is none; `flag` would name another file.
std::filesystem::path shipped_file(const std::filesystem::path& name, const std::string& flag);

/// The name of a shipped file of the same folder that is nearest to `name`; "" where none is near.
std::string nearest_shipped(const std::filesystem::path& name);

/// Where shipped_path() looks, for a sentence: "/usr/share/fernlicht, ...".
std::string library_places();

} // namespace fernlicht
