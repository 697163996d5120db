#include "metrics/road/lux_near_thresholds.h"

#include "metrics/road/lit_road.h"
#include "scenarios/packs/level.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

/// So many bounds are told in one go.
constexpr std::size_t at_a_time = 64;

/// Counts the limits that a light reaches.
FERNLICHT_WIDEST void count_limits(const double* __restrict lx, const double* limits, std::size_t limit_count,
                                   long long* __restrict reached) {
    for (std::size_t i = 0; i < at_a_time; ++i)
        reached[i] = 0;
    for (std::size_t k = 0; k < limit_count; ++k)
        for (std::size_t i = 0; i < at_a_time; ++i)
            reached[i] += lx[i] >= limits[k] ? 1 : 0;
}

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
void mark_lines(const std::vector<LaneStrip>& strips, const std::vector<double>& offset_m, const std::vector<LimitSide>& sides,
                std::vector<unsigned char>& decides) {
    const std::size_t columns = offset_m.size();
    const auto mark_line = [&](const LaneSpans& spans, auto offset_in) {
        std::optional<std::size_t> before; // the sample left of the line
        std::size_t column = 0;
        for (std::size_t row = 0; row < spans.size(); ++row) {
            std::optional<std::size_t> here;
            if (spans[row])
                here = row * columns + (column = column_left_of(offset_m, offset_in(*spans[row]), column));
            if (here && before) {
                const std::size_t samples[]{*before - 1, *before, *here - 1, *here};
                if (std::ranges::any_of(samples, [&](std::size_t sample) { return sides[sample] != sides[*here]; }))
                    for (const std::size_t sample : samples)
                        decides[sample] = 1;
            }
            before = here;
        }
    };
    for (const LaneStrip& strip : strips) {
        mark_line(strip.spans, [](const LaneSpan& span) { return span.left_m; });
        mark_line(strip.spans, [](const LaneSpan& span) { return 0.5 * (span.left_m + span.right_m); });
        mark_line(strip.spans, [](const LaneSpan& span) { return span.right_m; });
    }
}

std::vector<unsigned char> deciding(const std::vector<LaneStrip>& strips, const std::vector<double>& offset_m,
                                    const std::vector<LimitSide>& sides) {
    const std::size_t columns = offset_m.size();
    const auto fewest = spread_both_ways(sides, columns, [](LimitSide a, LimitSide b) { return std::min(a, b); });
    const auto most = spread_both_ways(sides, columns, [](LimitSide a, LimitSide b) { return std::max(a, b); });
    std::vector<unsigned char> decides(sides.size());
    for (std::size_t i = 0; i < sides.size(); ++i)
        decides[i] = fewest[i] != most[i] || most[i] == undecided_side ? 1 : 0;
    if (columns > 1)
        mark_lines(strips, offset_m, sides, decides);
    return decides;
}

} // namespace

void limit_sides(std::span<const LuxBounds> bounds, const std::vector<double>& thresholds_lx, LimitSide* sides, double* lx) {
    constexpr double hair = 1e-9; // what lies between two points is interpolated, and rounded
    double low_lx[at_a_time]{}, high_lx[at_a_time]{};
    long long low[at_a_time], high[at_a_time];
    for (std::size_t first = 0; first < bounds.size(); first += at_a_time) {
        const std::size_t count = std::min(at_a_time, bounds.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            lx[first + i] = bounds[first + i].low_lx;
            low_lx[i] = bounds[first + i].low_lx * (1.0 - hair);
            high_lx[i] = bounds[first + i].high_lx * (1.0 + hair);
        }
        count_limits(low_lx, thresholds_lx.data(), thresholds_lx.size(), low);
        count_limits(high_lx, thresholds_lx.data(), thresholds_lx.size(), high);
        for (std::size_t i = 0; i < count; ++i) {
            const bool known = std::isfinite(low_lx[i]) && std::isfinite(high_lx[i]) && thresholds_lx.size() < undecided_side;
            sides[first + i] = known && low[i] == high[i] ? static_cast<LimitSide>(low[i]) : undecided_side;
        }
    }
}

std::vector<unsigned char> deciding_points(const ExtentGrid& grid, const std::vector<LimitSide>& sides) {
    if (sides.empty())
        return {};
    const bool known = !grid.strips.empty();
    const std::vector<LaneStrip> own = known ? std::vector<LaneStrip>{} : lane_strips(grid),
                                 own_coarse = known ? std::vector<LaneStrip>{} : lane_strips(grid, 2);
    std::vector<unsigned char> decides = deciding(known ? grid.strips : own, grid.offset_m, sides);
    std::vector<double> coarse_offset_m; // as grid_errors has it
    std::vector<LimitSide> coarse_sides;
    const std::size_t columns = grid.offset_m.size();
    for (std::size_t column = 0; column < columns; column += 2)
        coarse_offset_m.push_back(grid.offset_m[column]);
    for (std::size_t row = 0; row < grid.sections.size(); row += 2)
        for (std::size_t column = 0; column < columns; column += 2)
            coarse_sides.push_back(sides[row * columns + column]);
    const std::vector<unsigned char> coarse_decides = deciding(known ? grid.coarse_strips : own_coarse, coarse_offset_m, coarse_sides);
    auto at_coarse = coarse_decides.begin();
    for (std::size_t row = 0; row < grid.sections.size(); row += 2)
        for (std::size_t column = 0; column < columns; column += 2)
            decides[row * columns + column] |= *at_coarse++;
    return decides;
}

} // namespace fernlicht
