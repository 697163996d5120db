// Parts of a resolved drive that are not described key by key yet: what follows their key, "" for what is not written. Where such a part
// holds described structs, its bits are theirs (fields/field_bits.h), and its text for the rest.
#pragma once

#include "scenarios/drives/drive.h"

namespace fernlicht {

/// What hashes of a drive are taken over: ids and bits of what is off its defaults, for parts that are not described yet their text.
std::string drive_bits(const Drive& drive);

std::string storyboard_text(const Drive& drive);
std::string storyboard_bits(const Drive& drive);
std::string street_lamps_text(const Drive& drive);
std::string variants_text(const Drive& drive);
std::string variants_bits(const Drive& drive);
std::string can_text(const Drive& drive);
std::string traffic_text(const Drive& drive);

} // namespace fernlicht
