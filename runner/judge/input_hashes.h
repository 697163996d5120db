// What decides the results of one drive with one lamp set, as hashes: for the key of accepted results.
#pragma once

#include "scenarios/drives/drive.h"

#include <string>
#include <utility>
#include <vector>

namespace fernlicht {

/// "drive": what is off its defaults in the drive with this lamp set alone (drive_bits), and the moments first_tick..last_tick; "road",
/// "lamp file 1" ...: contents. Neither paths nor what changes no result counts: title, limits, comments, other lamp sets, names of keys,
/// keys at their defaults.
std::vector<std::pair<std::string, std::string>> input_hashes(const Drive& drive, const LampSet& lamp_set, const FilesRead& road,
                                                              int first_tick, int last_tick);

/// What input_hashes says of an input that was read from these.
std::string input_hash(const FilesRead& files);

/// As version 0.1 hashed "drive", which has one lamp set, over its text: less the moments, which stood below it.
std::string text_hashed_before(Drive drive);

} // namespace fernlicht
