#include "runner/write/plots/canvas.h"

#include "runner/files/clean_text.h"
#include "runner/write/plots/png.h"

#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace fernlicht::plots {
namespace {

/// Hundredths of a pixel, without trailing zeros and without "-0".
std::string px(double value) {
    const long long hundredths = std::llround(value * 100.0);
    if (hundredths % 100 == 0)
        return std::to_string(hundredths / 100);
    return fmt::format("{:.6g}", static_cast<double>(hundredths) / 100.0);
}

std::string path_of(const Polyline& points) {
    std::string d, last;
    for (const Point& p : points) {
        const std::string place = px(p.x) + "," + px(p.y);
        if (place == last)
            continue;
        d += d.empty() ? "M" : d.find('L') == std::string::npos ? "L" : " ";
        d += place;
        last = place;
    }
    return d;
}

} // namespace

double text_width(const std::string& text, double size_px) {
    double em = 0.0;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte & 0xc0u) == 0x80u)
            continue; // inside a UTF-8 sequence
        em += c == ' ' || c == '.' || c == ',' || c == 'i' || c == 'l' ? 0.33 : byte >= 'A' && byte <= 'Z' ? 0.7 : 0.6;
    }
    return em * size_px;
}

Canvas::Canvas(double width, double height, const std::string& title) {
    svg_ =
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{0}\" height=\"{1}\" "
                    "viewBox=\"0 0 {0} {1}\" role=\"img\" "
                    "font-family=\"'DejaVu Sans','Liberation Sans',Helvetica,Arial,sans-serif\">\n",
                    px(width), px(height));
    if (!title.empty())
        svg_ += "<title>" + xml_text(title) + "</title>\n";
}

void Canvas::line(const Polyline& points, const Stroke& stroke) {
    if (points.size() < 2)
        return;
    svg_ += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"", path_of(points),
                        css(stroke.colour), px(stroke.width_px));
    if (!stroke.dash.empty())
        svg_ += " stroke-dasharray=\"" + xml_text(stroke.dash) + "\"";
    if (stroke.opacity < 1.0)
        svg_ += " stroke-opacity=\"" + px(stroke.opacity) + "\"";
    svg_ += "/>\n";
}

void Canvas::area(const Polyline& outline, const Fill& fill) {
    if (outline.size() < 3)
        return;
    svg_ += fmt::format("<path d=\"{}Z\" fill=\"{}\" stroke=\"{}\" fill-opacity=\"{}\"/>\n", path_of(outline), fill.fill, fill.stroke,
                        px(fill.opacity));
}

void Canvas::rectangle(double left, double top, double width, double height, const Fill& fill) {
    svg_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\" stroke=\"{}\"", px(left), px(top), px(width),
                        px(height), fill.fill, fill.stroke);
    if (fill.opacity < 1.0)
        svg_ += " fill-opacity=\"" + px(fill.opacity) + "\"";
    svg_ += "/>\n";
}

void Canvas::dot(const Point& centre, double radius, Colour colour) {
    svg_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"/>\n", px(centre.x), px(centre.y), px(radius), css(colour));
}

void Canvas::text(double x, double y, const std::string& words, const Lettering& l) {
    if (words.empty())
        return;
    std::string attributes = fmt::format("x=\"{}\" y=\"{}\" font-size=\"{}\"", px(x), px(y), px(l.size_px));
    if (l.bold)
        attributes += " font-weight=\"600\"";
    if (l.anchor != "start")
        attributes += " text-anchor=\"" + l.anchor + "\"";
    if (l.turn_deg != 0.0)
        attributes += fmt::format(" transform=\"rotate({} {} {})\"", px(l.turn_deg), px(x), px(y));
    const std::string content = xml_text(words) + "</text>\n";
    if (l.halo != "none") // a text of its own, for drawers that do not know paint-order
        svg_ +=
            fmt::format("<text {} fill=\"none\" stroke=\"{}\" stroke-width=\"3\" stroke-linejoin=\"round\">", attributes, l.halo) + content;
    svg_ += fmt::format("<text {} fill=\"{}\">", attributes, css(l.colour)) + content;
}

void Canvas::picture(double left, double top, double width, double height, const Image<Colour>& pixels) {
    // A mirrored axis turns the picture round the edge that it begins at.
    svg_ += fmt::format("<image width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" transform=\"translate({} {}) scale({} {})\" "
                        "xlink:href=\"data:image/png;base64,",
                        px(std::abs(width)), px(std::abs(height)), px(left), px(top), width < 0.0 ? -1 : 1, height < 0.0 ? -1 : 1);
    svg_ += base64(png_of_pixels(pixels)) + "\"/>\n";
}

void Canvas::begin_window(double left, double top, double width, double height) {
    svg_ += fmt::format("<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"0 0 {2} {3}\" overflow=\"hidden\">\n", px(left),
                        px(top), px(width), px(height));
}

void Canvas::end_window() { svg_ += "</svg>\n"; }

std::string Canvas::finish() { return svg_ + "</svg>\n"; }

} // namespace fernlicht::plots
