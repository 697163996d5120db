#include "runner/write/plots/png.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <librsvg/rsvg.h>
#include <memory>
#include <png.h>
#include <stdexcept>

namespace fernlicht::plots {
namespace {

using CairoSurface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;
using Handle = std::unique_ptr<RsvgHandle, decltype(&g_object_unref)>;

void check(cairo_status_t status, const char* doing) {
    if (status != CAIRO_STATUS_SUCCESS)
        throw std::runtime_error(fmt::format("{}: {}", doing, cairo_status_to_string(status)));
}

CairoSurface new_surface(int width, int height) {
    CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), &cairo_surface_destroy);
    check(cairo_surface_status(surface.get()), "cannot make a picture");
    return surface;
}

std::string png_of(cairo_surface_t* surface) {
    std::string bytes;
    const auto append = [](void* closure, const unsigned char* data, unsigned int length) {
        static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
        return CAIRO_STATUS_SUCCESS;
    };
    check(cairo_surface_write_to_png_stream(surface, append, &bytes), "cannot encode a PNG");
    return bytes;
}

struct PngWriter {
    png_structp png = nullptr;
    png_infop info = nullptr;
    PngWriter() {
        const auto fail = [](png_structp, png_const_charp why) { throw std::runtime_error(fmt::format("cannot encode a PNG: {}", why)); };
        png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, nullptr);
        info = png ? png_create_info_struct(png) : nullptr;
        if (!info)
            throw std::runtime_error("cannot encode a PNG: no memory");
    }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;
    ~PngWriter() { png_destroy_write_struct(&png, &info); }
};

/// Of a drawing: large areas of one colour. Without libpng's filters, which are for photographs.
std::string png_of_drawing(cairo_surface_t* surface) {
    cairo_surface_flush(surface);
    const auto width = static_cast<png_uint_32>(cairo_image_surface_get_width(surface)),
               height = static_cast<png_uint_32>(cairo_image_surface_get_height(surface));
    const PngWriter writer;
    std::string bytes;
    png_set_write_fn(
        writer.png, &bytes,
        [](png_structp of, png_bytep data, std::size_t length) {
            static_cast<std::string*>(png_get_io_ptr(of))->append(reinterpret_cast<const char*>(data), length);
        },
        nullptr);
    png_set_IHDR(writer.png, writer.info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_filter(writer.png, 0, PNG_FILTER_NONE);
    png_set_compression_level(writer.png, 4);
    png_write_info(writer.png, writer.info);
    png_set_bgr(writer.png);
    png_set_filler(writer.png, 0, PNG_FILLER_AFTER);
    for (png_uint_32 y = 0; y < height; ++y)
        png_write_row(writer.png,
                      cairo_image_surface_get_data(surface) + static_cast<std::ptrdiff_t>(y) * cairo_image_surface_get_stride(surface));
    png_write_end(writer.png, writer.info);
    return bytes;
}

std::invalid_argument invalid_svg(GError* error) {
    const std::string reason = error ? error->message : "unknown reason";
    g_clear_error(&error);
    return std::invalid_argument("not a drawable SVG: " + reason);
}

} // namespace

std::string png_of_pixels(const Image<Colour>& pixels) {
    if (pixels.empty())
        throw std::runtime_error("cannot encode a PNG of an empty image");
    const CairoSurface surface = new_surface(pixels.width(), pixels.height());
    unsigned char* data = cairo_image_surface_get_data(surface.get());
    const std::ptrdiff_t stride = cairo_image_surface_get_stride(surface.get());
    cairo_surface_flush(surface.get());
    for (int y = 0; y < pixels.height(); ++y) {
        auto* row = reinterpret_cast<std::uint32_t*>(data + y * stride); // cairo aligns rows for this
        for (int x = 0; x < pixels.width(); ++x) {
            const Colour c = pixels.at(x, y);
            row[x] = (std::uint32_t{c.r} << 16) | (std::uint32_t{c.g} << 8) | std::uint32_t{c.b};
        }
    }
    cairo_surface_mark_dirty(surface.get());
    return png_of(surface.get());
}

std::string png_of_svg(const std::string& svg, double scale) {
    GError* error = nullptr;
    const Handle handle(rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error), &g_object_unref);
    if (!handle)
        throw invalid_svg(error);
    double width = 0.0, height = 0.0;
    if (!rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width, &height))
        throw std::invalid_argument("not a drawable SVG: it has no size in pixels");
    const int columns = std::max(1, static_cast<int>(std::lround(width * scale)));
    const int rows = std::max(1, static_cast<int>(std::lround(height * scale)));
    const CairoSurface surface = new_surface(columns, rows);
    const Context context(cairo_create(surface.get()), &cairo_destroy);
    cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);
    cairo_paint(context.get());
    const RsvgRectangle viewport{0.0, 0.0, static_cast<double>(columns), static_cast<double>(rows)};
    if (!rsvg_handle_render_document(handle.get(), context.get(), &viewport, &error))
        throw invalid_svg(error);
    check(cairo_status(context.get()), "cannot draw an SVG");
    return png_of_drawing(surface.get());
}

std::string base64(const std::string& bytes) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t triple = 0;
        for (std::size_t k = 0; k < 3; ++k)
            triple = triple << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? digits[triple >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

} // namespace fernlicht::plots
