#include "runner/files/other_picture.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/program_module.h"

#include <algorithm>
#include <array>

namespace fernlicht {
namespace {

constexpr std::array<std::string_view, 14> extensions{".tif",  ".tiff", ".hdr", ".rgbe", ".tga", ".bmp",  ".jpg",
                                                      ".jpeg", ".dpx",  ".pfm", ".ppm",  ".pgm", ".webp", ".psd"};

}

bool is_other_picture(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return std::ranges::find(extensions, extension) != extensions.end();
}

OtherPicture read_other_picture(const std::filesystem::path& path) {
    const auto read = reinterpret_cast<ReadWithOpenImageIo*>(module_function("fernlicht-openimageio", "fernlicht_read_with_openimageio"));
    OtherPicture picture;
    try {
        read(path, std::size_t{1} << 28, picture);
    } catch (const std::exception& error) {
        throw InputError({path, 0, 0, {}}, "cannot be read: " + printable(error.what(), 200), "a picture, grey or RGB, or of numbers");
    }
    return picture;
}

} // namespace fernlicht
