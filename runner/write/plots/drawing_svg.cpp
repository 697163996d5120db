#include "runner/files/clean_text.h"
#include "runner/write/plots/png.h"
#include "runner/write/plots/svg.h"

#include <cmath>
#include <fmt/format.h>

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

/// Adds mark by mark.
struct SvgText {
    std::string svg;
    int zlib;

    void operator()(const Drawing::Line& mark) {
        const Stroke& stroke = mark.stroke;
        if (mark.points.size() < 2)
            return;
        svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"", path_of(mark.points),
                           css(stroke.colour), px(stroke.width_px));
        if (!stroke.dash.empty())
            svg += " stroke-dasharray=\"" + xml_text(stroke.dash) + "\"";
        if (stroke.opacity < 1.0)
            svg += " stroke-opacity=\"" + px(stroke.opacity) + "\"";
        svg += "/>\n";
    }

    void operator()(const Drawing::Area& mark) {
        if (mark.outline.size() >= 3)
            svg += fmt::format("<path d=\"{}Z\" fill=\"{}\" stroke=\"{}\" fill-opacity=\"{}\"/>\n", path_of(mark.outline), mark.fill.fill,
                               mark.fill.stroke, px(mark.fill.opacity));
    }

    void operator()(const Drawing::Rectangle& mark) {
        svg += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\" stroke=\"{}\"", px(mark.left), px(mark.top),
                           px(mark.width), px(mark.height), mark.fill.fill, mark.fill.stroke);
        if (mark.fill.opacity < 1.0)
            svg += " fill-opacity=\"" + px(mark.fill.opacity) + "\"";
        svg += "/>\n";
    }

    void operator()(const Drawing::Dot& mark) {
        svg += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"/>\n", px(mark.centre.x), px(mark.centre.y), px(mark.radius),
                           css(mark.colour));
    }

    void operator()(const Drawing::Text& mark) {
        const Lettering& l = mark.lettering;
        if (mark.text.empty())
            return;
        std::string attributes = fmt::format("x=\"{}\" y=\"{}\" font-size=\"{}\"", px(mark.x), px(mark.y), px(l.size_px));
        if (l.bold)
            attributes += " font-weight=\"600\"";
        if (l.anchor != "start")
            attributes += " text-anchor=\"" + l.anchor + "\"";
        if (l.turn_deg != 0.0)
            attributes += fmt::format(" transform=\"rotate({} {} {})\"", px(l.turn_deg), px(mark.x), px(mark.y));
        const std::string content = xml_text(mark.text) + "</text>\n";
        if (l.halo != "none") // a text of its own, for drawers that do not know paint-order
            svg += fmt::format("<text {} fill=\"none\" stroke=\"{}\" stroke-width=\"3\" stroke-linejoin=\"round\">", attributes, l.halo) +
                   content;
        svg += fmt::format("<text {} fill=\"{}\">", attributes, css(l.colour)) + content;
    }

    void operator()(const Drawing::Picture& mark) {
        // A mirrored axis turns the picture round the edge that it begins at.
        svg += fmt::format("<image width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" transform=\"translate({} {}) scale({} {})\" "
                           "xlink:href=\"data:image/png;base64,",
                           px(std::abs(mark.width)), px(std::abs(mark.height)), px(mark.left), px(mark.top), mark.width < 0.0 ? -1 : 1,
                           mark.height < 0.0 ? -1 : 1);
        svg += base64(png_of_pixels(mark.pixels, zlib)) + "\"/>\n";
    }

    void operator()(const Drawing::Window& mark) {
        svg += fmt::format("<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"0 0 {2} {3}\" overflow=\"hidden\">\n",
                           px(mark.left), px(mark.top), px(mark.width), px(mark.height));
    }

    void operator()(const Drawing::WindowEnd&) { svg += "</svg>\n"; }
};

} // namespace

std::string svg_of(const Drawing& drawing, int zlib) {
    SvgText text{
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{0}\" height=\"{1}\" "
                    "viewBox=\"0 0 {0} {1}\" role=\"img\" "
                    "font-family=\"'DejaVu Sans','Liberation Sans',Helvetica,Arial,sans-serif\">\n",
                    px(drawing.width), px(drawing.height)),
        zlib};
    if (!drawing.title.empty())
        text.svg += "<title>" + xml_text(drawing.title) + "</title>\n";
    for (const Drawing::Mark& mark : drawing.marks)
        std::visit(text, mark);
    return text.svg + "</svg>\n";
}

} // namespace fernlicht::plots
