// What the module fernlicht-zip does: it alone is linked with libzip.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace fernlicht {

struct ZipReader {
    std::function<bool(const std::string& name, std::uint64_t bytes)>
        wants;                                        ///< asked of each entry, folders included, before it is unpacked
    std::function<void(std::string_view piece)> take; ///< of the entry that was wanted last, in order; none of an empty one
};

/// In the archive's order; what `reader` throws goes through. Throws std::invalid_argument with libzip's reason for a file that is no zip,
/// an entry that is damaged, encrypted, or longer than it says.
extern "C" using ReadZip = void(const std::string& file, const ZipReader& reader);

} // namespace fernlicht
