#include "runner/write/plots/svg.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <sstream>
#include <stdexcept>

namespace fernlicht::plots {
namespace {

constexpr Colour ink{51, 51, 51}, faint{110, 110, 110}, grid_colour{222, 224, 228}, halo{255, 255, 255};

void check(const Axis& axis) {
    const bool finite = std::isfinite(axis.from) && std::isfinite(axis.to) && axis.from != axis.to;
    if (!finite || (axis.scale == Scale::logarithmic && !(axis.from > 0.0 && axis.to > 0.0)))
        throw std::invalid_argument(fmt::format("axis '{}' from {} to {} cannot be drawn", axis.label, axis.from, axis.to));
}

std::string label_of(const Axis& axis) { return axis.unit.empty() ? axis.label : axis.label + " [" + axis.unit + "]"; }

constexpr double line_px = 15.0; ///< from one line of an axis' words to the next

/// The plot area in pixels of the document.
struct Area {
    double left = 0.0, top = 0.0, width = 0.0, height = 0.0;
    std::vector<std::string> y_lines = {}; ///< what stands beside it
    double right() const { return left + width; }
    double bottom() const { return top + height; }
};

struct Legend {
    struct Entry {
        std::string name;
        Colour colour;
        std::string dash;
        bool filled = false;
        double left = 0.0;
        int row = 0;
    };
    std::vector<Entry> entries;
    int rows = 0;
};

/// In rows above the plot, where it can hide nothing.
Legend legend_of(const Figure& f) {
    Legend legend;
    for (const Series& s : f.series)
        if (!s.name.empty())
            legend.entries.push_back({s.name, s.colour, s.dash});
    for (const Band& b : f.bands)
        if (!b.name.empty())
            legend.entries.push_back({b.name, b.colour, "", true});
    double left = 0.0;
    for (Legend::Entry& e : legend.entries) {
        const double width = 34.0 + text_width(e.name, 12.0) + 18.0;
        if (left > 0.0 && left + width > f.width_px - 90.0) {
            left = 0.0;
            ++legend.rows;
        }
        e.left = left;
        e.row = legend.rows;
        left += width;
    }
    legend.rows += legend.entries.empty() ? 0 : 1;
    return legend;
}

double widest_label(const Axis& axis, int most) {
    double widest = 0.0;
    for (const Tick& t : ticks_of(axis, most))
        widest = std::max(widest, text_width(t.label, 12.0));
    return widest;
}

int ticks_along(double length_px, double each_px) { return std::max(2, static_cast<int>(length_px / each_px)); }

/// Broken between words, so that none is cut off.
std::vector<std::string> lines_of(const std::string& text, double size_px, double width_px) {
    std::vector<std::string> lines;
    std::istringstream words(text);
    for (std::string word; words >> word;)
        if (lines.empty() || text_width(lines.back() + " " + word, size_px) > width_px)
            lines.push_back(word);
        else
            lines.back() += " " + word;
    return lines;
}
std::vector<std::string> subtitle_lines(const Figure& f) { return lines_of(f.subtitle, 12.0, f.width_px - 90.0); }

Area area_of(const Figure& f, const Legend& legend) {
    Area a;
    a.top = (f.title.empty() ? 12.0 : 36.0) + 18.0 * static_cast<double>(subtitle_lines(f).size()) + 20.0 * legend.rows;
    a.height = f.height_px - a.top - 50.0;
    const double centre = a.top + 0.5 * a.height;
    a.y_lines = lines_of(label_of(f.y), 13.0, 2.0 * std::min(centre, f.height_px - centre) - 8.0);
    a.left = 38.0 + widest_label(f.y, ticks_along(a.height, 42.0)) +
             line_px * static_cast<double>(std::max<std::size_t>(a.y_lines.size(), 1) - 1);
    a.width = f.width_px - a.left - (f.colour_bar ? 84.0 + widest_label(f.colour_bar->axis, ticks_along(a.height, 42.0)) : 20.0);
    a.width = std::max(a.width, 10.0);
    a.height = std::max(a.height, 10.0);
    if (f.equal_units) {
        const double x_units = std::abs(f.x.to - f.x.from), y_units = std::abs(f.y.to - f.y.from);
        const double px_per_unit = std::min(a.width / x_units, a.height / y_units);
        a.width = px_per_unit * x_units;
        a.height = px_per_unit * y_units;
    }
    return a;
}

void draw_heading(Drawing& c, const Figure& f, const Legend& legend, const Area& a) {
    double y = f.title.empty() ? 2.0 : 24.0;
    if (!f.title.empty())
        c.text(a.left, y, f.title, // smaller where it is long: bold letters are a tenth wider
               {.size_px = std::min(16.0, (f.width_px - a.left - 8.0) / (1.1 * text_width(f.title, 1.0))), .colour = ink, .bold = true});
    for (const std::string& line : subtitle_lines(f))
        c.text(a.left, y += 18.0, line, {.size_px = 12.0, .colour = faint});
    for (const Legend::Entry& e : legend.entries) {
        const double base = a.top - 20.0 * (legend.rows - e.row) + 9.0, left = a.left + e.left;
        if (e.filled)
            c.rectangle(left, base - 9.0, 26.0, 10.0, {.fill = css(e.colour), .opacity = 0.35});
        else if (luminance(e.colour) > 0.8) // a light line needs what it lies on in the plot
            c.rectangle(left, base - 10.0, 26.0, 12.0, {.fill = css(sequential(0.25))});
        if (!e.filled)
            c.line({{left, base - 4.0}, {left + 26.0, base - 4.0}}, {.colour = e.colour, .width_px = 2.2, .dash = e.dash}, e.name);
        c.text(left + 33.0, base, e.name, {.size_px = 12.0, .colour = ink});
    }
}

void draw_axes(Drawing& c, const Figure& f, const Area& a) {
    c.rectangle(a.left, a.top, a.width, a.height, {.stroke = css(ink)});
    for (const Tick& t : ticks_of(f.x, ticks_along(a.width, 64.0))) {
        const double x = a.left + a.width * position(f.x, t.value);
        c.line({{x, a.bottom()}, {x, a.bottom() + (t.label.empty() ? 3.0 : 5.0)}}, {.colour = ink, .width_px = 1.0});
        c.text(x, a.bottom() + 18.0, t.label, {.size_px = 12.0, .colour = ink, .anchor = "middle"});
    }
    for (const Tick& t : ticks_of(f.y, ticks_along(a.height, 42.0))) {
        const double y = a.bottom() - a.height * position(f.y, t.value);
        c.line({{a.left, y}, {a.left - (t.label.empty() ? 3.0 : 5.0), y}}, {.colour = ink, .width_px = 1.0});
        c.text(a.left - 8.0, y + 4.0, t.label, {.size_px = 12.0, .colour = ink, .anchor = "end"});
    }
    c.text(a.left + 0.5 * a.width, a.bottom() + 39.0, label_of(f.x), {.size_px = 13.0, .colour = ink, .anchor = "middle"});
    double across = a.left - 14.0 - widest_label(f.y, ticks_along(a.height, 42.0));
    for (auto line = a.y_lines.rbegin(); line != a.y_lines.rend(); ++line, across -= line_px)
        c.text(across, a.top + 0.5 * a.height, *line, {.size_px = 13.0, .colour = ink, .anchor = "middle", .turn_deg = -90.0});
}

void draw_colour_bar(Drawing& c, const ColourBar& bar, const Area& a) {
    const Axis& axis = bar.axis;
    constexpr int steps = 128;
    Image<Colour> colours(1, steps);
    for (int i = 0; i < steps; ++i)
        colours.at(0, i) = bar.diverging ? diverging(1.0 - 2.0 * (i + 0.5) / steps) : sequential(1.0 - (i + 0.5) / steps);
    const double left = a.right() + 18.0, width = 14.0;
    c.picture(left, a.top, width, a.height, colours);
    c.rectangle(left, a.top, width, a.height, {.stroke = css(ink)});
    for (const Tick& t : ticks_of(axis, ticks_along(a.height, 42.0))) {
        const double y = a.bottom() - a.height * position(axis, t.value);
        c.line({{left + width, y}, {left + width + (t.label.empty() ? 2.0 : 4.0), y}}, {.colour = ink, .width_px = 1.0});
        c.text(left + width + 7.0, y + 4.0, t.label, {.size_px = 12.0, .colour = ink});
    }
    const double across = left + width + 24.0 + widest_label(axis, ticks_along(a.height, 42.0));
    c.text(across, a.top + 0.5 * a.height, label_of(axis), {.size_px = 13.0, .colour = ink, .anchor = "middle", .turn_deg = -90.0});
}

/// Drawing inside the plot area: values to pixels of the area, cut at its edges.
class Inside {
  public:
    Inside(Drawing& canvas, const Figure& figure, const Area& area) : c_(canvas), f_(figure), a_(area) {}

    void draw() {
        for (const Raster& r : f_.rasters)
            draw(r);
        if (f_.grid)
            draw_grid();
        for (const Band& b : f_.bands)
            draw(b);
        for (const Isoline& i : f_.isolines)
            for (const Polyline& line : i.lines)
                draw_line(line, {.colour = i.colour, .width_px = i.width_px, .dash = i.dash});
        for (const Series& s : f_.series)
            draw(s);
        for (const Mark& m : f_.marks)
            draw(m);
        draw_labels();
        for (const Note& n : f_.notes)
            draw(n);
    }

  private:
    Point place(const Point& p) const { return {a_.width * position(f_.x, p.x), a_.height * (1.0 - position(f_.y, p.y))}; }
    bool within(const Point& px, double margin) const {
        return px.x >= margin && px.y >= margin && px.x <= a_.width - margin && px.y <= a_.height - margin;
    }

    void draw_grid() {
        for (const Tick& t : ticks_of(f_.x, ticks_along(a_.width, 64.0)))
            if (const double x = a_.width * position(f_.x, t.value); !t.label.empty())
                c_.line({{x, 0.0}, {x, a_.height}}, grid_stroke());
        for (const Tick& t : ticks_of(f_.y, ticks_along(a_.height, 42.0)))
            if (const double y = a_.height * (1.0 - position(f_.y, t.value)); !t.label.empty())
                c_.line({{0.0, y}, {a_.width, y}}, grid_stroke());
    }
    /// Over a picture the grid must not hide what it helps to read.
    Stroke grid_stroke() const { return {.colour = grid_colour, .width_px = 1.0, .opacity = f_.rasters.empty() ? 1.0 : 0.22}; }

    void draw(const Raster& r) {
        const Point top_left = place({r.x_left, r.y_top}), bottom_right = place({r.x_right, r.y_bottom});
        c_.picture(top_left.x, top_left.y, bottom_right.x - top_left.x, bottom_right.y - top_left.y, *r.pixels);
    }

    /// Where a limit is missing the band is interrupted like a line.
    void draw(const Band& b) {
        Polyline high, low;
        const auto finish_part = [&] {
            high.insert(high.end(), low.rbegin(), low.rend());
            c_.area(high, {.fill = css(b.colour), .opacity = b.opacity});
            high.clear();
            low.clear();
        };
        for (std::size_t i = 0; i < b.x.size(); ++i) {
            const Point above = place({b.x[i], b.high.at(i)}), below = place({b.x[i], b.low.at(i)});
            if (std::isfinite(above.x) && std::isfinite(above.y) && std::isfinite(below.y)) {
                high.push_back(above);
                low.push_back(below);
            } else {
                finish_part();
            }
        }
        finish_part();
    }

    void draw_line(const Polyline& points, const Stroke& stroke, const std::string& of = {}) {
        Polyline part;
        for (const Point& p : points) {
            const Point px = place(p);
            if (std::isfinite(px.x) && std::isfinite(px.y)) {
                part.push_back(px);
            } else {
                c_.line(part, stroke, of);
                part.clear();
            }
        }
        c_.line(part, stroke, of);
    }

    void draw(const Series& s) {
        draw_line(s.points, {.colour = s.colour, .width_px = s.width_px, .dash = s.dash}, s.name);
        if (!s.markers)
            return;
        for (const Point& p : s.points)
            if (const Point px = place(p); std::isfinite(px.x) && std::isfinite(px.y))
                c_.dot(px, 1.6 * s.width_px, s.colour);
    }

    void draw(const Mark& m) {
        const bool at_x = m.across == Mark::Across::at_x;
        const double at = position(at_x ? f_.x : f_.y, m.value);
        if (!std::isfinite(at))
            return;
        const Point from = at_x ? Point{a_.width * at, 0.0} : Point{0.0, a_.height * (1.0 - at)};
        const Point to = at_x ? Point{from.x, a_.height} : Point{a_.width, from.y};
        c_.line({from, to}, {.colour = m.colour, .width_px = 1.2, .dash = m.dash});
        const Point beside = at_x ? Point{from.x + 5.0, 14.0} : Point{a_.width - 6.0, from.y - 5.0};
        c_.text(beside.x, beside.y, m.label,
                {.size_px = 11.0, .colour = m.colour, .anchor = at_x ? "start" : "end", .halo = halo_colour()});
    }

    void draw(const Note& n) {
        const Point p = place({n.x, n.y});
        if (!within(p, 0.0))
            return;
        if (n.cross) {
            c_.line({{p.x - 5.0, p.y}, {p.x + 5.0, p.y}}, {.colour = n.colour, .width_px = 1.4});
            c_.line({{p.x, p.y - 5.0}, {p.x, p.y + 5.0}}, {.colour = n.colour, .width_px = 1.4});
        }
        const bool near_right_edge = p.x > 0.7 * a_.width;
        c_.text(p.x + (near_right_edge ? -8.0 : 8.0), p.y - 6.0, n.text,
                {.size_px = 11.0, .colour = n.colour, .anchor = near_right_edge ? "end" : "start"});
    }

    /// About 200 points of a line set, in pixels: enough to judge where there is room.
    Polyline sparse(const Isoline& i) const {
        Polyline all, some;
        for (const Polyline& line : i.lines)
            for (const Point& p : line)
                all.push_back(place(p));
        for (std::size_t k = 0; k < all.size(); k += 1 + all.size() / 200)
            some.push_back(all[k]);
        return some;
    }

    /// Each label stands on its line where the labels before it and the lines of other values are farthest.
    void draw_labels() {
        std::vector<Polyline> places;
        for (const Isoline& i : f_.isolines)
            places.push_back(sparse(i));
        Polyline labels;
        for (std::size_t i = 0; i < places.size(); ++i) {
            const Isoline& isoline = f_.isolines[i];
            const double margin = 0.5 * text_width(isoline.label, 11.0) + 4.0;
            const Point* best = nullptr;
            double best_room = 9.0; // crowded lines stay without a label: two on one another say less than none
            for (const Point& p : places[i]) {
                const double room = isoline.label.empty() || !within(p, margin) ? 0.0 : room_at(p, i, places, labels);
                if (room > best_room) {
                    best = &p;
                    best_room = room;
                }
            }
            if (!best)
                continue;
            labels.push_back(*best);
            c_.text(best->x, best->y + 4.0, isoline.label,
                    {.size_px = 11.0, .colour = isoline.colour, .bold = true, .anchor = "middle", .halo = halo_for(isoline.colour)});
        }
    }

    static double room_at(const Point& p, std::size_t own, const std::vector<Polyline>& places, const Polyline& labels) {
        double room = 60.0; // pixels; more is of no use
        for (const Point& taken : labels)
            room = std::min(room, 0.5 * std::hypot(p.x - taken.x, 2.0 * (p.y - taken.y))); // words are wider than high
        for (std::size_t k = 0; k < places.size(); ++k)
            if (k != own)
                for (const Point& other : places[k])
                    room = std::min(room, std::hypot(p.x - other.x, p.y - other.y));
        return room;
    }

    /// What makes a word readable on anything: an outline as dark as it is light.
    static std::string halo_for(Colour c) { return luminance(c) > 0.4 ? "#202028" : css(halo); }
    std::string halo_colour() const { return f_.rasters.empty() ? css(f_.background) : "none"; }

    Drawing& c_;
    const Figure& f_;
    const Area& a_;
};

} // namespace

std::string svg_of(const Figure& f, int zlib) {
    check(f.x);
    check(f.y);
    if (f.colour_bar)
        check(f.colour_bar->axis);
    const Legend legend = legend_of(f);
    const Area area = area_of(f, legend);
    Drawing canvas{f.width_px, f.height_px, f.title.empty() ? f.subtitle : f.title};
    if (f.x.scale == Scale::linear && f.rasters.empty() && !f.equal_units)
        canvas.course = Drawing::Course{area.left, area.top, area.width, area.height, f.x.from, f.x.to, f.x.label};
    canvas.rectangle(0.0, 0.0, f.width_px, f.height_px, {.fill = css(f.background)});
    canvas.begin_window(area.left, area.top, area.width, area.height);
    Inside(canvas, f, area).draw();
    canvas.end_window();
    draw_axes(canvas, f, area);
    draw_heading(canvas, f, legend, area);
    if (f.colour_bar)
        draw_colour_bar(canvas, *f.colour_bar, area);
    return svg_of(canvas, zlib);
}

std::string svg_of(const FiguresBeside& figures, int zlib) {
    const auto& [left, right] = figures;
    const auto placed = [](std::string svg, double x) {
        return svg.replace(svg.find("<svg "), 5, fmt::format("<svg x=\"{}\" y=\"0\" ", x));
    };
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n<rect width=\"{0}\" "
        "height=\"{1}\" fill=\"#ffffff\"/>\n{2}{3}</svg>\n",
        left.width_px + right.width_px, std::max(left.height_px, right.height_px), placed(svg_of(left, zlib), 0.0),
        placed(svg_of(right, zlib), left.width_px));
}

} // namespace fernlicht::plots
