// Pictures beside each other with captions, lines over them and one legend: a sheet, drawn as SVG or PNG.
#pragma once

#include "runner/findings/plots/axes.h"
#include "runner/write/plots/canvas.h"
#include "scenarios/values/image.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht {

struct SheetLine {
    plots::Polyline points; ///< in pixels of the panel, 0, 0 its top left corner
    plots::Colour colour;
    std::string dash = {};  ///< "" solid
    std::string label = {}; ///< at its middle; "" for none
};

struct SheetPanel {
    std::string caption;
    Image<plots::Colour> pixels;
    std::vector<SheetLine> lines = {};
};

/// What colours mean, beside the panels.
struct SheetLegend {
    std::string label;                                 ///< with its unit
    std::function<plots::Colour(double)> colour;       ///< 0 at the bottom to 1 at the top
    std::vector<std::pair<double, std::string>> ticks; ///< 0..1 and what stands there
};

struct Sheet {
    std::string title, subtitle;
    std::vector<SheetPanel> panels; ///< all of one size
    std::optional<SheetLegend> legend = {};
    std::vector<std::pair<std::string, SheetLine>> key = {}; ///< what lines mean
};

/// Small pictures are magnified by whole numbers without smoothing, large ones shrunk to 1024 pixels across.
std::string svg_of_sheet(const Sheet& sheet);
std::string png_of_sheet(const Sheet& sheet);

/// The least of 1, 2, 5 times a power of ten that is at least `value`; 1 for 0.
double rounded_up(double value);

/// A sequential legend over an axis.
SheetLegend legend_of(const plots::Axis& axis);

/// Signed differences on a log scale to both sides of 0: three decades below `top` have no colour of their own.
struct SignedScale {
    double top = 1.0;
    double position(double difference) const; ///< -1..1
    plots::Colour colour(double difference) const;
    SheetLegend legend(const std::string& label, const std::string& unit) const;
};

} // namespace fernlicht
