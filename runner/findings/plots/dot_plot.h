// A ranked dot plot as a drawing: a row for each thing, a dot where it lies, a line over all that it may be. Rows stand as they are given.
#pragma once

#include "runner/findings/plots/drawing.h"

#include <optional>
#include <vector>

namespace fernlicht::plots {

struct DotRow {
    std::string name, figure;         ///< left of the row; right of it, in words: "+9.20 m"
    std::optional<double> value = {}; ///< of the axis; nullopt: no dot
    double low = 0.0, high = 0.0;     ///< all that it may be
    std::vector<double> others = {};  ///< small, behind the dot: what it is the median of
    bool sure = false;                ///< a filled dot (right of 0) or diamond (left of it), else a hollow dot
};

struct DotPlot {
    std::string title, subtitle, left, right; ///< words below both halves of the axis
    std::string unit;                         ///< of the axis, round 0
    double most = 100.0;                      ///< the axis ends here at the latest; what lies beyond stands at its end as an arrow
    double width_px = 600.0;
    std::vector<DotRow> rows = {};
};

Drawing drawing_of(const DotPlot& plot);

} // namespace fernlicht::plots
