// A plot as a plain value: axes with units, lines, bands, heat maps, isolines, legend. How it is drawn is write's affair.
#pragma once

#include "runner/findings/plots/axes.h"
#include "runner/findings/plots/colour.h"
#include "runner/findings/plots/isolines.h"
#include "scenarios/values/image.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fernlicht::plots {

/// A line through points. A point with a coordinate that is not finite (or not above 0 on a logarithmic axis) interrupts it:
/// what was not measured is not drawn.
struct Series {
    std::string name = {}; ///< in the legend; "" for none
    Polyline points = {};
    Colour colour = {};
    double width_px = 1.8;
    std::string dash = {}; ///< SVG dash pattern, e.g. "5 3"; "" solid
    bool markers = false;  ///< a dot at each point, also at lone ones
};

/// A shaded area between two curves over the same x (an error band, a spread).
struct Band {
    std::string name = {};
    std::vector<double> x, low, high;
    Colour colour = {};
    double opacity = 0.2;
};

/// A picture stretched between axis values: its left column begins at x_left, its top row at y_top. Linear axes only.
struct Raster {
    Raster(Image<Colour> picture, double left, double right, double top, double bottom)
        : pixels(std::make_shared<const Image<Colour>>(std::move(picture))), x_left(left), x_right(right), y_top(top), y_bottom(bottom) {}
    std::shared_ptr<const Image<Colour>> pixels; ///< of all copies: a page's figures would hold them four times
    double x_left = 0.0, x_right = 1.0, y_top = 1.0, y_bottom = 0.0;
};

/// Lines of one value, with their label on the longest.
struct Isoline {
    std::string label = {}; ///< "5 lx"; "" for none
    std::vector<Polyline> lines = {};
    Colour colour{255, 255, 255};
    double width_px = 1.4;
    std::string dash = {}; ///< as of a series
};

/// A straight line across the plot at a value of one axis: a limit, the horizon.
struct Mark {
    enum class Across { at_x, at_y } across = Across::at_y;
    double value = 0.0;
    std::string label;
    Colour colour{120, 120, 120};
    std::string dash = "4 3";
};

/// A word at a point.
struct Note {
    double x = 0.0, y = 0.0;
    std::string text;
    Colour colour{40, 40, 40};
    bool cross = false; ///< a small cross at the point itself
};

/// The key to a heat map: what its colours mean, along an axis. Colours as by sequential() over the axis' positions, or by diverging() with
/// white in the axis' middle.
struct ColourBar {
    Axis axis;
    bool diverging = false;
};

struct Figure {
    std::string title;
    std::string subtitle = {}; ///< under the title, in as many lines as it takes: what, where, which conditions
    double width_px = 860.0, height_px = 480.0;
    Axis x, y;
    bool equal_units = false; ///< one unit of x is as long as one of y: the plot area shrinks to fit
    bool grid = true;
    Colour background{255, 255, 255};
    std::vector<Raster> rasters = {}; ///< drawn in the order of these members, each list first to last
    std::vector<Band> bands = {};
    std::vector<Isoline> isolines = {};
    std::vector<Series> series = {};
    std::vector<Mark> marks = {};
    std::vector<Note> notes = {};
    std::optional<ColourBar> colour_bar;
};

/// A grid of values as pixels, row 0 on top, by sequential() over the axis; a value that is not finite becomes `missing`, one that
/// has no place on a logarithmic axis the darkest colour.
Image<Colour> heat_map(const Image<float>& values, const Axis& axis, Colour missing = {200, 200, 200});

/// The same by diverging(): white in the axis' middle.
Image<Colour> difference_map(const Image<float>& values, const Axis& axis, Colour missing = {200, 200, 200});

} // namespace fernlicht::plots
