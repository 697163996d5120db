// The levels of a pixel lamp at one time in a few figures: how many parts shine, how much light is left, where it is dark.
#pragma once

#include "scenarios/lamps/pixel_lamp.h"

#include <memory>
#include <utility>

namespace fernlicht {

struct PixelState {
    std::size_t lit = 0;        ///< parts that shine: level above 0, and not dead
    double flux = 0.0;          ///< share of the flux at full level, base included
    std::vector<float> columns; ///< mean level of the parts in each of columns_deg(); NaN where there is none
    std::vector<AngleBox> dark; ///< where parts have level 0: of a raster rectangles of pixels, none over another; at most most_dark_boxes
    std::size_t more_dark = 0;  ///< boxes beyond these
};

class PixelStates {
  public:
    /// A raster's columns, several in one where there are more than `most_columns`; of segments H is cut where one of them ends.
    static constexpr int most_columns = 512;
    static constexpr std::size_t most_dark_boxes = 100; ///< a chequered raster has a box for every other pixel
    explicit PixelStates(std::shared_ptr<const PixelLamp> lamp);

    const std::vector<std::pair<double, double>>& columns_deg() const { return columns_deg_; } ///< H, from and to, ascending
    /// `levels`: one for each part, 0 to 1. A raster's flux is taken pixel by pixel, intensity times solid angle, without what blur and
    /// crosstalk carry over the field's border.
    PixelState of(std::span<const float> levels) const;

  private:
    std::vector<float> column_means(std::span<const float> levels) const;
    void add_dark_boxes(std::span<const float> levels, PixelState& state) const;

    std::shared_ptr<const PixelLamp> lamp_;
    std::vector<std::pair<double, double>> columns_deg_;
    std::vector<double> flux_lm_; ///< by part; 0 of those that are dead
    std::vector<bool> dead_;
    double base_lm_ = 0.0, full_lm_ = 0.0;
    std::size_t merged_ = 1; ///< columns of the raster in one
};

} // namespace fernlicht
