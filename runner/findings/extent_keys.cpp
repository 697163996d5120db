#include "runner/findings/extent_keys.h"

#include <tuple>

namespace fernlicht {

std::span<const ExtentFigure> extent_figures() {
    using enum Quantity;
    static constexpr std::array spread = {Statistic::median, Statistic::minimum, Statistic::p05, Statistic::none};
    static constexpr std::array both_ends = {Statistic::median, Statistic::minimum, Statistic::p05, Statistic::p95};
    static constexpr std::array worst = {Statistic::median, Statistic::maximum, Statistic::none, Statistic::none};
    static constexpr ExtentLine centre{&LaneExtent::reach_centre_m, &LaneExtent::reach_is_cut_off};
    static constexpr ExtentLine left{&LaneExtent::reach_left_edge_m, &LaneExtent::left_edge_is_cut_off};
    static constexpr ExtentLine right{&LaneExtent::reach_right_edge_m, &LaneExtent::right_edge_is_cut_off};
    static constexpr const char *on_centre = ", centre", *of_all = ", line that reaches farthest", *by_half = ", grid of half the samples";
    static constexpr auto is_all = [](const std::string& lane) { return lane == "all"; };
    static constexpr auto is_lane = [](const std::string& lane) { return lane != "all"; };
    // clang-format off
    static constexpr ExtentFigure figures[] = {
        {.quantity = reach, .statistics = both_ends, .where = on_centre, .where_of_all = of_all, .member = centre.reach_m, .line = &centre},
        {.quantity = reach, .place = ReadingPlace::left_edge, .where = ", left edge", .where_of_all = ", leftmost line looked at",
         .member = left.reach_m, .line = &left},
        {.quantity = reach, .place = ReadingPlace::right_edge, .where = ", right edge", .where_of_all = ", rightmost line looked at",
         .member = right.reach_m, .line = &right},
        {.quantity = unlit_before_reach, .where = on_centre, .where_of_all = of_all, .member = &LaneExtent::unlit_before_reach_m,
         .line = &centre},
        {.quantity = width, .statistics = spread},
        {.quantity = area, .statistics = spread, .member = &LaneExtent::area_m2},
        {.quantity = reach, .aspect = Aspect::twin_difference, .statistics = worst, .where = ", |rendered - twin|",
         .member = centre.reach_m, .line = &centre},
        {.quantity = area, .aspect = Aspect::grid_error, .is_of = is_all, .where = by_half, .grid_error = &GridError::area,
         .error_column_of = "all"},
        {.quantity = reach, .aspect = Aspect::grid_error, .where = by_half, .grid_error = &GridError::reach, .error_column_of = "own"},
        {.quantity = reach, .place = ReadingPlace::edges, .aspect = Aspect::grid_error, .where = by_half, .grid_error = &GridError::edge},
        {.quantity = unlit_before_reach, .aspect = Aspect::grid_error, .where = by_half, .grid_error = &GridError::unlit},
        {.quantity = area, .aspect = Aspect::grid_error, .is_of = is_lane, .where = by_half, .grid_error = &GridError::area},
    };
    // clang-format on
    return figures;
}

const char* surface_name(Surface surface) { return surface == Surface::road ? "road" : "target"; }

const char* verdict_name(VerdictKind kind) {
    static constexpr const char* names[] = {"pass", "fail", "not_measured", "flaky"};
    return names[static_cast<std::size_t>(kind)];
}
const char* verdict_text(VerdictKind kind) { return kind == VerdictKind::not_measured ? "not measured" : verdict_name(kind); }

std::vector<ExtentKey> extent_keys(const PlayedCell& played) {
    std::vector<std::string> lanes;
    std::vector<ExtentKey> keys;
    const auto collect = [](auto& all, const auto& one) {
        if (std::ranges::find(all, one) == all.end())
            all.push_back(one);
    };
    for (const ExtentRow& row : played.extents)
        for (const std::vector<LaneExtent>* const extents : {&row.rendered, &row.twin})
            for (const LaneExtent& extent : *extents) {
                collect(lanes, extent.lane);
                collect(keys, ExtentKey{extent.surface, extent.lane, extent.threshold_lx});
            }
    const auto rank = [&](const ExtentKey& key) {
        return std::tuple(key.surface, std::find(lanes.begin(), lanes.end(), key.lane) - lanes.begin(), key.threshold_lx);
    };
    std::stable_sort(keys.begin(), keys.end(), [&](const ExtentKey& a, const ExtentKey& b) { return rank(a) < rank(b); });
    return keys;
}

ReadingKey extent_reading(const ExtentKey& key, Quantity quantity, ReadingPlace place, Aspect aspect,
                          const std::optional<double>& distance_m) {
    return {.quantity = quantity,
            .surface = key.surface == Surface::road ? ReadingSurface::road : ReadingSurface::target,
            .lane = key.lane,
            .threshold = {key.threshold_lx, ThresholdUnit::lx},
            .place = place,
            .distance_m = distance_m,
            .aspect = aspect};
}

const CensoredSamples& moments_of(const ExtentSummary& summary, Quantity quantity, Aspect aspect, const std::optional<double>& distance_m) {
    static const CensoredSamples none;
    const auto found = summary.moments.find(extent_reading(summary.key, quantity, ReadingPlace::none, aspect, distance_m));
    return found == summary.moments.end() ? none : found->second;
}

} // namespace fernlicht
