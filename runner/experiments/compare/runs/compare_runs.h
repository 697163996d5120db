// `fernlicht compare` of two runs' folders.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace fernlicht {

struct CompareRunsRequest {
    std::filesystem::path before, now, out; ///< `out` empty: no pictures, no page
    std::string strictness;                 ///< class or file; "" for none
    std::optional<double> pixels_per_degree;
    std::size_t pictured = 3; ///< moments of each drive and view
    bool json = false;
};

/// Prints the comparison; 1 where a class of strictness was asked for and not kept, else 0. Throws InputError, DeviceError.
int compare_two_runs(const CompareRunsRequest& request);

} // namespace fernlicht
