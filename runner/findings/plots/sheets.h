// Sheets of pictures as plain values: panels with captions, lines over them and one legend; small tiles under headings.
#pragma once

#include "runner/findings/plots/axes.h"
#include "runner/findings/plots/drawing.h"
#include "scenarios/drives/play/frame.h"

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
    bool diverging = false;                            ///< colours from the bottom to the top by diverging(), else by sequential()
    std::vector<std::pair<double, std::string>> ticks; ///< 0..1 and what stands there
};

struct Sheet {
    std::string title, subtitle;
    std::vector<SheetPanel> panels; ///< all of one size
    std::optional<SheetLegend> legend = {};
    std::vector<std::pair<std::string, SheetLine>> key = {}; ///< what lines mean
};

struct PictureTile {
    std::string name, words; ///< caption, two lines
    Image<Rgb8> picture;     ///< as an sRGB display is told; of a section all of one size, tile_px wide
};

struct TileSection {
    std::string title, words; ///< heading, two lines
    std::vector<PictureTile> tiles;
};

inline constexpr int tile_px = 320;

/// Small pictures side by side under headings, each with its name: whatever is compared.
struct TileSheet {
    std::string title;
    std::vector<TileSection> sections;
};

Image<plots::Colour> pixels_of(const Image<Rgb8>& picture);

/// Square pixels, `factor` of them each way for one.
Image<plots::Colour> enlarged(const Image<plots::Colour>& picture, int factor);

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
