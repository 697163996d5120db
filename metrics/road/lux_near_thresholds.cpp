#include "metrics/road/lux_near_thresholds.h"

#include "metrics/road/lit_road.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

/// Each of `count` values by `pick` of its own and those `stride` away on either side.
template <class Pick>
void spread(const LimitSide* __restrict values, LimitSide* __restrict result, std::size_t count, std::size_t stride, Pick pick) {
    for (std::size_t i = stride; i < count; ++i)
        result[i] = pick(result[i], values[i - stride]);
    for (std::size_t i = 0; i + stride < count; ++i)
        result[i] = pick(result[i], values[i + stride]);
}

template <class Pick> std::vector<LimitSide> spread_both_ways(const std::vector<LimitSide>& sides, std::size_t columns, Pick pick) {
    std::vector<LimitSide> along = sides;
    spread(sides.data(), along.data(), sides.size(), columns, pick);
    std::vector<LimitSide> both = along;
    for (std::size_t row = 0; row < sides.size(); row += columns)
        spread(&along[row], &both[row], columns, 1, pick);
    return both;
}

/// Marks the samples between which a lane's line crosses a limit from one row to the next: where it runs across columns they are no
/// neighbours.
void mark_lines(const ExtentGrid& grid, const std::vector<LimitSide>& sides, std::vector<unsigned char>& decides) {
    const std::size_t columns = grid.offset_m.size();
    const auto mark_line = [&](const LaneSpans& spans, auto offset_in) {
        std::optional<std::size_t> before; // the sample left of the line
        for (std::size_t row = 0; row < spans.size(); ++row) {
            std::optional<std::size_t> here;
            if (spans[row])
                here = row * columns + column_left_of(grid.offset_m, offset_in(*spans[row]));
            if (here && before) {
                const std::size_t samples[]{*before - 1, *before, *here - 1, *here};
                if (std::ranges::any_of(samples, [&](std::size_t sample) { return sides[sample] != sides[*here]; }))
                    for (const std::size_t sample : samples)
                        decides[sample] = 1;
            }
            before = here;
        }
    };
    for (const LaneStrip& strip : lane_strips(grid)) {
        mark_line(strip.spans, [](const LaneSpan& span) { return span.left_m; });
        mark_line(strip.spans, [](const LaneSpan& span) { return 0.5 * (span.left_m + span.right_m); });
        mark_line(strip.spans, [](const LaneSpan& span) { return span.right_m; });
    }
}

std::vector<unsigned char> deciding(const ExtentGrid& grid, const std::vector<LimitSide>& sides) {
    const std::size_t columns = grid.offset_m.size();
    const auto fewest = spread_both_ways(sides, columns, [](LimitSide a, LimitSide b) { return std::min(a, b); });
    const auto most = spread_both_ways(sides, columns, [](LimitSide a, LimitSide b) { return std::max(a, b); });
    std::vector<unsigned char> decides(sides.size());
    for (std::size_t i = 0; i < sides.size(); ++i)
        decides[i] = fewest[i] != most[i] || most[i] == undecided_side ? 1 : 0;
    if (columns > 1)
        mark_lines(grid, sides, decides);
    return decides;
}

} // namespace

std::vector<unsigned char> deciding_points(const ExtentGrid& grid, const std::vector<LimitSide>& sides) {
    if (sides.empty())
        return {};
    std::vector<unsigned char> decides = deciding(grid, sides);
    ExtentGrid coarse; // as grid_errors has it
    std::vector<LimitSide> coarse_sides;
    const std::size_t columns = grid.offset_m.size();
    for (std::size_t column = 0; column < columns; column += 2)
        coarse.offset_m.push_back(grid.offset_m[column]);
    for (std::size_t row = 0; row < grid.sections.size(); row += 2) {
        coarse.sections.push_back(grid.sections[row]);
        for (std::size_t column = 0; column < columns; column += 2)
            coarse_sides.push_back(sides[row * columns + column]);
    }
    const std::vector<unsigned char> coarse_decides = deciding(coarse, coarse_sides);
    auto at_coarse = coarse_decides.begin();
    for (std::size_t row = 0; row < grid.sections.size(); row += 2)
        for (std::size_t column = 0; column < columns; column += 2)
            decides[row * columns + column] |= *at_coarse++;
    return decides;
}

} // namespace fernlicht
