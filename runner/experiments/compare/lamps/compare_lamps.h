// `fernlicht compare` of two lamps' files.
#pragma once

#include <filesystem>
#include <string>

namespace fernlicht {

struct CompareLampsRequest {
    std::filesystem::path before, now, out; ///< `out` empty: no pictures, no page
    std::string regulation;                 ///< id; "" for none
    double noise_relative = 0.0;
    bool json = false;
};

/// Prints the comparison; 1 where a regulation was asked for and B does not pass it, else 0. Throws InputError, DeviceError.
int compare_two_lamps(const CompareLampsRequest& request);

} // namespace fernlicht
