#include "metrics/road/lux_near_thresholds.h"

#include "metrics/road/lit_road.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

constexpr std::size_t around = 2;

/// Each of `count` values by `pick` of its own and those up to `around` times `stride` away on either side.
template <class Pick>
void spread(const LimitSide* __restrict values, LimitSide* __restrict result, std::size_t count, std::size_t stride, Pick pick) {
    for (std::size_t away = stride; away <= around * stride && away < count; away += stride) {
        for (std::size_t i = away; i < count; ++i)
            result[i] = pick(result[i], values[i - away]);
        for (std::size_t i = 0; i < count - away; ++i)
            result[i] = pick(result[i], values[i + away]);
    }
}

template <class Pick> std::vector<LimitSide> spread_both_ways(const std::vector<LimitSide>& sides, std::size_t columns, Pick pick) {
    std::vector<LimitSide> along = sides;
    spread(sides.data(), along.data(), sides.size(), columns, pick);
    std::vector<LimitSide> both = along;
    for (std::size_t row = 0; row < sides.size(); row += columns)
        spread(&along[row], &both[row], columns, 1, pick);
    return both;
}

/// Marks the samples of lanes' lines where these go on farther than to a neighbouring column: what decides there lies between points that
/// are no neighbours.
void mark_jumps(const ExtentGrid& grid, std::vector<unsigned char>& decides) {
    const std::vector<double>& offsets = grid.offset_m;
    double narrowest_m = offsets.back() - offsets.front();
    for (std::size_t column = 0; column + 1 < offsets.size(); ++column)
        narrowest_m = std::min(narrowest_m, offsets[column + 1] - offsets[column]);
    const auto mark = [&](std::size_t row, double offset_m) {
        const std::size_t left = column_left_of(offsets, offset_m);
        decides[row * offsets.size() + left - 1] = decides[row * offsets.size() + left] = 1;
    };
    for (const LaneStrip& strip : lane_strips(grid))
        for (std::size_t row = 0; row + 1 < strip.spans.size(); ++row) {
            const std::optional<LaneSpan>&near = strip.spans[row], &far = strip.spans[row + 1];
            if (!near || !far ||
                (std::abs(far->left_m - near->left_m) <= narrowest_m && std::abs(far->right_m - near->right_m) <= narrowest_m))
                continue;
            for (const auto& [at, span] : {std::pair(row, *near), std::pair(row + 1, *far)})
                for (const double offset_m : {span.left_m, 0.5 * (span.left_m + span.right_m), span.right_m})
                    mark(at, offset_m);
        }
}

} // namespace

std::vector<unsigned char> deciding_points(const ExtentGrid& grid, const std::vector<LimitSide>& sides) {
    const std::size_t columns = grid.offset_m.size();
    if (sides.empty())
        return {};
    const auto fewest = spread_both_ways(sides, columns, [](LimitSide a, LimitSide b) { return std::min(a, b); });
    const auto most = spread_both_ways(sides, columns, [](LimitSide a, LimitSide b) { return std::max(a, b); });
    std::vector<unsigned char> decides(sides.size());
    for (std::size_t i = 0; i < sides.size(); ++i)
        decides[i] = fewest[i] != most[i] || most[i] == undecided_side ? 1 : 0;
    if (columns > 1)
        mark_jumps(grid, decides);
    return decides;
}

} // namespace fernlicht
