// fernlicht-svg.so: drawings to pixels and for print.
#include "runner/write/plots/svg_module.h"

#include <algorithm>
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <librsvg/rsvg.h>
#include <memory>
#include <stdexcept>

namespace fernlicht::plots {
namespace {

using CairoSurface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;
using Handle = std::unique_ptr<RsvgHandle, decltype(&g_object_unref)>;

void check(cairo_status_t status, const char* doing) {
    if (status != CAIRO_STATUS_SUCCESS)
        throw std::runtime_error(std::string(doing) + ": " + cairo_status_to_string(status));
}

/// A picture of the surface's size, before anything is drawn.
void put_below(const Image<Colour>& picture, cairo_surface_t* surface) {
    if (picture.width() != cairo_image_surface_get_width(surface) || picture.height() != cairo_image_surface_get_height(surface))
        throw std::invalid_argument("a drawing over a picture of another size");
    cairo_surface_flush(surface);
    unsigned char* const rows = cairo_image_surface_get_data(surface);
    const std::ptrdiff_t stride = cairo_image_surface_get_stride(surface);
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const Colour& c = picture.at(x, y);
            const std::uint32_t rgb = std::uint32_t{c.r} << 16 | std::uint32_t{c.g} << 8 | c.b;
            std::memcpy(rows + y * stride + std::ptrdiff_t{4} * x, &rgb, sizeof rgb);
        }
    cairo_surface_mark_dirty(surface);
}

std::invalid_argument invalid_svg(GError* error) {
    const std::string reason = error ? error->message : "unknown reason";
    g_clear_error(&error);
    return std::invalid_argument("not a drawable SVG: " + reason);
}

Handle read_svg(const std::string& svg, double& width, double& height) {
    GError* error = nullptr;
    Handle handle(rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error), &g_object_unref);
    if (!handle)
        throw invalid_svg(error);
    if (!rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width, &height))
        throw std::invalid_argument("not a drawable SVG: it has no size in pixels");
    return handle;
}

cairo_status_t append(void* to, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

} // namespace

extern "C" __attribute__((visibility("default"))) void fernlicht_draw_svg(const std::string& svg, double scale, Image<Colour>& pixels) {
    GError* error = nullptr;
    double width = 0.0, height = 0.0;
    const Handle handle = read_svg(svg, width, height);
    const int columns = std::max(1, static_cast<int>(std::lround(width * scale)));
    const int rows = std::max(1, static_cast<int>(std::lround(height * scale)));
    const CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, columns, rows), &cairo_surface_destroy);
    check(cairo_surface_status(surface.get()), "cannot make a picture");
    const Context context(cairo_create(surface.get()), &cairo_destroy);
    cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);
    cairo_paint(context.get());
    if (!pixels.empty())
        put_below(pixels, surface.get());
    const RsvgRectangle viewport{0.0, 0.0, static_cast<double>(columns), static_cast<double>(rows)};
    if (!rsvg_handle_render_document(handle.get(), context.get(), &viewport, &error))
        throw invalid_svg(error);
    check(cairo_status(context.get()), "cannot draw an SVG");
    cairo_surface_flush(surface.get());
    pixels = Image<Colour>(columns, rows);
    const unsigned char* const drawn = cairo_image_surface_get_data(surface.get());
    const std::ptrdiff_t stride = cairo_image_surface_get_stride(surface.get());
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            std::uint32_t rgb = 0;
            std::memcpy(&rgb, drawn + y * stride + std::ptrdiff_t{4} * x, sizeof rgb);
            pixels.at(x, y) = {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8), static_cast<std::uint8_t>(rgb)};
        }
}

extern "C" __attribute__((visibility("default"))) void fernlicht_print_svg(const std::string& svg, double width_pt, bool as_pdf,
                                                                           std::string& printed) {
    double width = 0.0, height = 0.0;
    const Handle handle = read_svg(svg, width, height);
    const double height_pt = width_pt * height / width;
    printed.clear();
    const CairoSurface surface(as_pdf ? cairo_pdf_surface_create_for_stream(append, &printed, width_pt, height_pt)
                                      : cairo_svg_surface_create_for_stream(append, &printed, width_pt, height_pt),
                               &cairo_surface_destroy);
    check(cairo_surface_status(surface.get()), "cannot make a page");
    if (as_pdf) // else the time of day
        cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
    const Context context(cairo_create(surface.get()), &cairo_destroy);
    const RsvgRectangle viewport{0.0, 0.0, width_pt, height_pt};
    GError* error = nullptr;
    if (!rsvg_handle_render_document(handle.get(), context.get(), &viewport, &error))
        throw invalid_svg(error);
    check(cairo_status(context.get()), "cannot draw an SVG");
    cairo_surface_finish(surface.get());
    check(cairo_surface_status(surface.get()), "cannot print an SVG");
}

} // namespace fernlicht::plots
