#include "scenarios/lamps/lamp_file.h"

#include "scenarios/lamps/ies.h"
#include "scenarios/lamps/lamp_text.h"

#include <stdexcept>

namespace fernlicht {

LampFile read_lamp(const std::filesystem::path& path, const LampReadOptions& options) {
    FilesRead opened;
    const std::string bytes = read_file(path, opened, max_lamp_text_bytes);
    const std::string text = to_utf8(bytes);
    const std::string extension = uppercase(path.extension().string());
    LampFile lamp;
    if (looks_like_ies(text) || extension == ".IES")
        lamp = read_ies(path, text, options, std::move(opened));
    else
        throw InputError({path, 0, 0, {}}, "is no lamp file that we know", "an IES file");
    check_invariants(lamp.table);
    return lamp;
}

void write_lamp(const LampFile& lamp, const std::filesystem::path& path) {
    check_invariants(lamp.table);
    const std::string extension = uppercase(path.extension().string());
    if (extension == ".IES")
        return write_file(path, ies_text(lamp));
    throw InputError({path, 0, 0, {}}, "cannot be written as a lamp file", "a name that ends in .ies");
}

} // namespace fernlicht
