// The marks that a plot is made of, as SVG text. Coordinates in pixels, y downwards.
#pragma once

#include "runner/findings/plots/colour.h"
#include "runner/findings/plots/isolines.h"
#include "scenarios/values/image.h"

#include <string>

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

/// Estimated width; SVG text has no measure before it is drawn.
double text_width(const std::string& text, double size_px);

/// For XML text and attributes: & < > " ' escaped, control characters that XML forbids replaced by spaces.
std::string escaped(const std::string& text);

class Canvas {
  public:
    Canvas(double width, double height, const std::string& title);
    void line(const Polyline& points, const Stroke& stroke); ///< fewer than two points: nothing
    void area(const Polyline& outline, const Fill& fill);    ///< fewer than three points: nothing
    void rectangle(double left, double top, double width, double height, const Fill& fill);
    void dot(const Point& centre, double radius, Colour colour);
    void text(double x, double y, const std::string& text, const Lettering& lettering);              ///< empty text: nothing
    void picture(double left, double top, double width, double height, const Image<Colour>& pixels); ///< negative width or height mirror it
    void begin_window(double left, double top, double width, double height);                         ///< its own origin; cuts at its edges
    void end_window();
    std::string finish();

  private:
    std::string svg_;
};

} // namespace fernlicht::plots
