// Pixel lamps over the moments of a drive: which of their pixels were dark when, as values, CSV and picture.
#pragma once

#include "runner/findings/plots/figure.h"
#include "scenarios/lamps/pixel_state.h"

#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

/// Of a lamp with at most so many parts the CSV has the level of each.
inline constexpr std::size_t most_told_levels = 100;

struct PixelLevels {
    /// Where a road user stands, in the lamp's H: left and right edge; only while he is before the lamp and near its field.
    struct Other {
        std::string name;
        bool oncoming = false;
        double left_deg = 0.0, right_deg = 0.0;
    };
    struct Row {
        double time_s = 0.0;
        double level = 1.0; ///< of the lamp as a whole, beside what its pixels do
        PixelState pixels;
        std::vector<float> levels; ///< of each part; none of more than most_told_levels
        std::vector<Other> others;
    };
    std::string lamp;
    std::size_t count = 0; ///< of its parts
    std::vector<std::pair<double, double>> columns_deg;
    std::vector<Row> rows;
};

/// A line for each moment and lamp: `time_s`, `lamp`, `level` of the lamp as a whole, `lit`, `of` how many parts, `flux` (share of the full
/// one), `dark` ("H from:to/V from:to" in degrees, boxes between blanks, at last "and N more"), then the level of each part. RFC 4180.
std::string levels_csv(const std::vector<PixelLevels>& lamps);

/// The mean level of each column over H and time, which runs downwards, with the edges of other road users as lines. nullopt: no moment, or
/// parts without width.
std::optional<plots::Figure> levels_figure(const PixelLevels& lamp, const std::string& lamp_set);

} // namespace fernlicht
