// Whether pictures share a scale, by what they say of themselves.
#pragma once

#include <filesystem>
#include <string>

namespace fernlicht {

/// A PNG, and what sentences call it.
struct NamedPicture {
    std::filesystem::path file;
    std::string name; ///< "A", "frame_0001.png"
};

/// PNGs shown in different ways have no common scale, and what is made for sRGB's codes takes those of another display for others. Throws
/// InputError naming `tested` where both tell how they were shown and differ, and naming either where it has a display's ICC profile;
/// `as` says what the first is: "the reference". Of pictures of others, and of such that passed through other programs, nothing is known:
/// where one alone tells, a sentence that says so; else "".
std::string check_shown_alike(const NamedPicture& reference, const NamedPicture& tested, const std::string& as);

} // namespace fernlicht
