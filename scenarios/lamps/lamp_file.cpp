#include "scenarios/lamps/lamp_file.h"

#include "scenarios/lamps/beam_files.h"
#include "scenarios/lamps/eulumdat.h"
#include "scenarios/lamps/ies.h"
#include "scenarios/lamps/lamp_text.h"

#include <algorithm>

namespace fernlicht {
namespace {

LampFile read_as_it_is(const std::filesystem::path& path, const LampReadOptions& options) {
    struct Format {
        bool (*looks_so)(std::string_view);
        const char* extension;
        LampFile (*read)(const std::filesystem::path&, std::string_view, const LampReadOptions&, FilesRead);
    };
    static constexpr Format formats[]{{looks_like_ies, ".IES", read_ies},
                                      {looks_like_beam_matrix, ".CSV", read_beam_matrix},
                                      {looks_like_eulumdat, ".LDT", read_eulumdat}};
    FilesRead opened;
    const std::string bytes = read_file(path, opened, max_lamp_text_bytes);
    if (looks_like_beam_texture(bytes))
        return read_beam_texture(path, bytes, options, std::move(opened));
    const std::string text = lamp_text(bytes, path);
    // By content first; a file whose content says nothing is what its name says, so that its reader can tell what is wrong with it.
    const auto* format = std::ranges::find_if(formats, [&](const Format& f) { return f.looks_so(text); });
    if (format == std::end(formats))
        format = std::ranges::find(formats, uppercase(path.extension().string()), &Format::extension);
    if (format == std::end(formats))
        throw InputError({path, 0, 0, {}}, "is no lamp file that we know",
                         "IES LM-63, EULUMDAT, a beam matrix or a beam texture (PNG, EXR)");
    return format->read(path, text, options, std::move(opened));
}

} // namespace

LampFile read_lamp(const std::filesystem::path& path, const LampReadOptions& options) {
    LampFile lamp = read_as_it_is(path, options);
    check_invariants(lamp.table);
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
