#include "runner/files/clean_text.h"
#include "runner/write/plots/png.h"
#include "runner/write/plots/svg.h"

#include <algorithm>
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

/// Whether b lies on the straight way from a to c, as far as anybody can see.
bool is_between(const Point& a, const Point& b, const Point& c) {
    constexpr double seen_px = 0.04;
    const double x = c.x - a.x, y = c.y - a.y, length = std::hypot(x, y), along = x * (b.x - a.x) + y * (b.y - a.y);
    return length > 0.0 && along >= 0.0 && along <= length * length && std::abs(x * (b.y - a.y) - y * (b.x - a.x)) <= seen_px * length;
}

/// Without points that lie on the way between others.
Polyline without_idle(const Polyline& points) {
    constexpr std::size_t most_at_once = 64;
    Polyline kept;
    for (std::size_t at = 0; at < points.size();) {
        kept.push_back(points[at]);
        std::size_t next = at + 1;
        while (next + 1 < points.size() && next - at < most_at_once &&
               std::all_of(points.begin() + static_cast<std::ptrdiff_t>(at) + 1, points.begin() + static_cast<std::ptrdiff_t>(next) + 1,
                           [&](const Point& p) { return is_between(points[at], p, points[next + 1]); }))
            ++next;
        at = next;
    }
    return kept;
}

std::string path_of(const Polyline& all) {
    const Polyline points = without_idle(all);
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

std::string course_of(const Drawing& drawing) {
    if (!drawing.course)
        return "";
    const Drawing::Course& c = *drawing.course;
    return fmt::format("data-course=\"{} {} {} {} {} {}\" data-along=\"{}\" ", px(c.left), px(c.top), px(c.width), px(c.height), c.from,
                       c.to, xml_text(c.label));
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
        if (!mark.of.empty())
            svg += " data-of=\"" + xml_text(mark.of) + "\"";
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
                    "viewBox=\"0 0 {0} {1}\" role=\"img\" {2}"
                    "font-family=\"'DejaVu Sans','Liberation Sans',Helvetica,Arial,sans-serif\">\n",
                    px(drawing.width), px(drawing.height), course_of(drawing)),
        zlib};
    if (!drawing.title.empty())
        text.svg += "<title>" + xml_text(drawing.title) + "</title>\n";
    for (const Drawing::Mark& mark : drawing.marks)
        std::visit(text, mark);
    return text.svg + "</svg>\n";
}

} // namespace fernlicht::plots
