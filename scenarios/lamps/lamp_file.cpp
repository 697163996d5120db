#include "scenarios/lamps/lamp_file.h"

#include "scenarios/lamps/beam_files.h"
#include "scenarios/lamps/eulumdat.h"
#include "scenarios/lamps/ies.h"
#include "scenarios/lamps/lamp_text.h"
#include "scenarios/lamps/pixel_lamp.h"
#include "scenarios/lamps/pixel_lamp_file.h"
#include "scenarios/lamps/text_grid.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// Whether a text that a format claims may be one that a recipe describes: `# unit:` is no rare comment, and a few numbers begin EULUMDAT.
bool may_be_grid(const LampFormat& format, const std::filesystem::path& path) {
    return format.read == read_beam_matrix || (format.read == read_eulumdat && uppercase(path.extension().string()) != ".LDT");
}

LampFile read_as_it_is(const std::filesystem::path& path, const LampReadOptions& options) {
    FilesRead opened;
    std::string content = read_file(path, opened, max_lamp_text_bytes);
    const std::optional<GridRecipe> recipe =
        options.recipe.empty() ? std::nullopt : std::optional(read_grid_recipe(options.recipe, opened));
    const auto all = lamp_formats();
    auto format = std::ranges::find_if(all, [&](const LampFormat& f) { return f.picture && f.looks_so(content); });
    if (format == all.end()) {
        content = lamp_text(content, path);
        format = std::ranges::find_if(all, [&](const LampFormat& f) { return !f.picture && f.looks_so(content); });
    }
    if (recipe && (format == all.end() || may_be_grid(*format, path)))
        return read_text_grid(path, content, *recipe, options, std::move(opened));
    // A text whose content says nothing is what its name says, so that its reader can tell what is wrong with it.
    if (format == all.end())
        format = std::ranges::find_if(
            all, [&](const LampFormat& f) { return !f.picture && uppercase(f.extensions) == uppercase(path.extension().string()); });
    if (format == all.end())
        throw InputError({path, 0, 0, {}}, "is no lamp file that we know",
                         lamp_format_list() + "; other text grids need a recipe that says how they are laid out (docs/lamps.md)");
    return format->read(path, content, options, std::move(opened));
}

} // namespace

std::span<const LampFormat> lamp_formats() {
    static constexpr LampFormat formats[]{{"pixel lamp", ".yaml", looks_like_pixel_lamp, read_pixel_lamp},
                                          {"IES LM-63", ".ies", looks_like_ies, read_ies},
                                          {"beam matrix", ".csv", looks_like_beam_matrix, read_beam_matrix},
                                          {"EULUMDAT", ".ldt", looks_like_eulumdat, read_eulumdat},
                                          {"beam texture", ".png, .exr", looks_like_beam_texture, read_beam_texture, true}};
    return formats;
}

std::string lamp_format_list() {
    std::vector<std::string> names;
    for (const LampFormat& f : lamp_formats())
        names.push_back(fmt::format("{} ({})", f.name, f.extensions));
    return fmt::format("{} or {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

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
    if (lamp.pixels)
        lamp.pixels = std::make_shared<const PixelLamp>(lamp.pixels->mirrored());
}

void write_lamp(const LampFile& lamp, const std::filesystem::path& path) {
    check_invariants(lamp.table);
    const std::string extension = uppercase(path.extension().string());
    if (extension == ".IES" || path == "-")
        return write_file(path, ies_text(lamp));
    if (extension == ".CSV")
        return write_file(path, beam_matrix_text(lamp));
    if (extension == ".EXR")
        return write_file(path, beam_texture_bytes(lamp));
    throw InputError({path, 0, 0, {}}, "cannot be written as a lamp file", "a name that ends in .ies, .csv or .exr");
}

} // namespace fernlicht
