#include "scenarios/lamps/lamp_file.h"

#include "scenarios/lamps/beam_matrix.h"
#include "scenarios/lamps/beam_texture.h"
#include "scenarios/lamps/eulumdat.h"
#include "scenarios/lamps/ies.h"
#include "scenarios/lamps/lamp_text.h"

#include <stdexcept>

namespace fernlicht {

namespace {

LampFile read_as_it_is(const std::filesystem::path& path, const LampReadOptions& options) {
    FilesRead opened;
    const std::string bytes = read_file(path, opened, max_lamp_text_bytes);
    LampFile lamp;
    if (looks_like_beam_texture(bytes)) {
        lamp = read_beam_texture(path, bytes, options, std::move(opened));
        check_invariants(lamp.table);
        return lamp;
    }
    const std::string text = lamp_text(bytes, path);
    const std::string extension = uppercase(path.extension().string());
    // By content first; a file whose content says nothing is what its name says, so that its reader can tell what is wrong with it.
    if (looks_like_ies(text))
        lamp = read_ies(path, text, options, std::move(opened));
    else if (looks_like_beam_matrix(text))
        lamp = read_beam_matrix(path, text, options, std::move(opened));
    else if (looks_like_eulumdat(text))
        lamp = read_eulumdat(path, text, options, std::move(opened));
    else if (extension == ".IES")
        lamp = read_ies(path, text, options, std::move(opened));
    else if (extension == ".CSV")
        lamp = read_beam_matrix(path, text, options, std::move(opened));
    else if (extension == ".LDT")
        lamp = read_eulumdat(path, text, options, std::move(opened));
    else
        throw InputError({path, 0, 0, {}}, "is no lamp file that we know",
                         "IES LM-63, EULUMDAT, a beam matrix or a beam texture (PNG, EXR)");
    check_invariants(lamp.table);
    return lamp;
}

} // namespace

LampFile read_lamp(const std::filesystem::path& path, const LampReadOptions& options) {
    LampFile lamp = read_as_it_is(path, options);
    if (options.mirrored)
        mirror(lamp);
    return lamp;
}

void mirror(LampFile& lamp) {
    lamp.table = mirrored(lamp.table);
    if (lamp.measured)
        lamp.measured = mirrored(std::move(*lamp.measured));
}

void write_lamp(const LampFile& lamp, const std::filesystem::path& path) {
    check_invariants(lamp.table);
    const std::string extension = uppercase(path.extension().string());
    if (extension == ".IES")
        return write_file(path, ies_text(lamp));
    if (extension == ".CSV")
        return write_file(path, beam_matrix_text(lamp));
    if (extension == ".EXR")
        return write_file(path, beam_texture_bytes(lamp));
    throw InputError({path, 0, 0, {}}, "cannot be written as a lamp file", "a name that ends in .ies, .csv or .exr");
}

} // namespace fernlicht
