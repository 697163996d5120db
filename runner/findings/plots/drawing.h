// A drawing as a plain value: marks in the order that they are drawn in. Coordinates in pixels, y downwards.
#pragma once

#include "runner/findings/plots/colour.h"
#include "runner/findings/plots/isolines.h"
#include "scenarios/values/image.h"

#include <optional>
#include <string>
#include <variant>

namespace fernlicht::plots {

struct Stroke {
    Colour colour = {};
    double width_px = 1.0;
    std::string dash = {};
    double opacity = 1.0;
};

struct Fill {
    std::string fill = "none"; ///< CSS colour
    std::string stroke = "none";
    double opacity = 1.0; ///< of the filling
};

struct Lettering {
    double size_px = 12.0;
    Colour colour = {};
    bool bold = false;
    std::string anchor = "start";
    double turn_deg = 0.0;     ///< clockwise, round the anchor
    std::string halo = "none"; ///< CSS colour of an outline behind the letters
};

struct Drawing {
    struct Line {
        Polyline points;
        Stroke stroke;
        std::string of = {}; ///< the series that it shows: a page hides it with that
    };
    struct Area {
        Polyline outline;
        Fill fill;
    };
    struct Rectangle {
        double left, top, width, height;
        Fill fill;
    };
    struct Dot {
        Point centre;
        double radius;
        Colour colour;
    };
    struct Text {
        double x, y;
        std::string text;
        Lettering lettering;
    };
    struct Picture {
        double left, top, width, height;
        Image<Colour> pixels;
    };
    struct Window {
        double left, top, width, height;
    };
    struct WindowEnd {};
    using Mark = std::variant<Line, Area, Rectangle, Dot, Text, Picture, Window, WindowEnd>;

    double width = 0.0, height = 0.0;
    std::string title = {};
    std::vector<Mark> marks = {};
    /// Where a plot's x axis lies and what it shows, by which a page moves a line across it; "" for none.
    struct Course {
        double left, top, width, height, from, to;
        std::string label;
    };
    std::optional<Course> course = {};

    void line(Polyline points, Stroke stroke, std::string of = {}) { ///< one point: nothing
        marks.emplace_back(Line{std::move(points), std::move(stroke), std::move(of)});
    }
    void area(Polyline outline, Fill fill) { marks.emplace_back(Area{std::move(outline), std::move(fill)}); } ///< two points: nothing
    void rectangle(double left, double top, double wide, double high, Fill fill) {
        marks.emplace_back(Rectangle{left, top, wide, high, std::move(fill)});
    }
    void dot(const Point& centre, double radius, Colour colour) { marks.emplace_back(Dot{centre, radius, colour}); }
    void text(double x, double y, std::string words, Lettering l) { marks.emplace_back(Text{x, y, std::move(words), std::move(l)}); }
    /// Negative width or height mirror it.
    void picture(double left, double top, double wide, double high, Image<Colour> pixels) {
        marks.emplace_back(Picture{left, top, wide, high, std::move(pixels)});
    }
    /// Marks up to its end have its origin, and are cut at its edges.
    void begin_window(double left, double top, double wide, double high) { marks.emplace_back(Window{left, top, wide, high}); }
    void end_window() { marks.emplace_back(WindowEnd{}); }
};

/// Estimated width; SVG text has no measure before it is drawn.
double text_width(const std::string& text, double size_px);

} // namespace fernlicht::plots
