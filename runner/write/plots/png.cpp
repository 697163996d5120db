#include "runner/write/plots/png.h"

#include "runner/write/plots/svg_module.h"
#include "scenarios/values/png_file.h"
#include "scenarios/values/program_module.h"

#include <stdexcept>

namespace fernlicht::plots {
namespace {

void draw(const std::string& svg, double scale, Image<Colour>& pixels) {
    static const auto by_module = reinterpret_cast<DrawSvg*>(module_function("fernlicht-svg", "fernlicht_draw_svg"));
    by_module(svg, scale, pixels);
}

} // namespace

std::string png_of_pixels(const Image<Colour>& pixels, int zlib) {
    if (pixels.empty() || pixels.width() > 32767 || pixels.height() > 32767)
        throw std::runtime_error("cannot encode a PNG of an empty or a huge image");
    static_assert(sizeof(Colour) == 3);
    return encode_png({pixels.width(), pixels.height(), 8, pixels.data()}, zlib);
}

std::string png_of_svg(const std::string& svg, double scale) {
    Image<Colour> pixels;
    draw(svg, scale, pixels);
    return png_of_pixels(pixels);
}

void draw_over(Image<Colour>& picture, const std::string& svg) { draw(svg, 1.0, picture); }

std::string base64(const std::string& bytes) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text((bytes.size() + 2) / 3 * 4, '=');
    char* next = text.data();
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t triple = 0;
        for (std::size_t k = 0; k < 3; ++k)
            triple = triple << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k, ++next)
            if (i + k <= bytes.size())
                *next = digits[triple >> (18 - 6 * k) & 63u];
    }
    return text;
}

} // namespace fernlicht::plots
