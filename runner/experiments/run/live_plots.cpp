#include "runner/experiments/run/run_plots.h"
#include "runner/play/live/live_figures.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double shortest_s = 1e-6; ///< what is less late is drawn as this
constexpr int bins_a_decade = 10;
constexpr plots::Colour ink{0, 114, 178}, outage_ink{213, 94, 0};

/// Stairs, each bin as wide as it is on the axis.
std::string histogram_svg(const LiveFigures& live) {
    const double longest_s = std::max(2.0 * shortest_s, LiveFigures::quantile(live.late_s, 1.0));
    const int bins = static_cast<int>(std::ceil(bins_a_decade * std::log10(longest_s / shortest_s))) + 1;
    std::vector<double> counts(static_cast<std::size_t>(bins), 0.0);
    for (const double late_s : live.late_s)
        ++counts[static_cast<std::size_t>(
            std::clamp(static_cast<int>(bins_a_decade * std::log10(std::max(late_s, shortest_s) / shortest_s)), 0, bins - 1))];
    plots::Figure figure;
    figure.title = "How late ticks began";
    figure.subtitle = fmt::format("{} ticks every {:g} ms", live.late_s.size(), 1e3 * live.period_s);
    figure.height_px = 360.0;
    plots::Band band;
    band.colour = ink;
    band.opacity = 0.45;
    plots::Series line{.colour = ink, .width_px = 1.2};
    constexpr double none = 0.5; // below one tick, on a logarithmic axis
    for (int bin = 0; bin < bins; ++bin)
        for (const int end : {bin, bin + 1}) {
            const double ms = 1e3 * shortest_s * std::pow(10.0, static_cast<double>(end) / bins_a_decade);
            const double count = std::max(none, counts[static_cast<std::size_t>(bin)]);
            band.x.push_back(ms);
            band.low.push_back(none);
            band.high.push_back(count);
            line.points.push_back({ms, count});
        }
    figure.x = {"late", "ms", band.x.front(), band.x.back(), plots::Scale::logarithmic};
    figure.y = {"ticks", "", none, 2.0 * std::max(1.0, *std::ranges::max_element(counts)), plots::Scale::logarithmic};
    figure.bands.push_back(std::move(band));
    figure.series.push_back(std::move(line));
    for (const auto& [share, name] : {std::pair(0.5, "p50"), std::pair(0.99, "p99")})
        figure.marks.push_back({.across = plots::Mark::Across::at_x,
                                .value = 1e3 * std::max(shortest_s, LiveFigures::quantile(live.late_s, share)),
                                .label = name});
    if (1e3 * live.period_s < figure.x.to)
        figure.marks.push_back({.across = plots::Mark::Across::at_x, .value = 1e3 * live.period_s, .label = "a whole period"});
    return plots::svg_of(figure);
}

/// The worst of each part of the drive; a point for each of 24000 ticks would say no more.
std::string over_drive_svg(const LiveFigures& live) {
    constexpr std::size_t most_points = 400;
    const std::size_t ticks = live.late_s.size(), step = (ticks + most_points - 1) / most_points;
    plots::Series line{.name = "worst of each part", .colour = ink, .width_px = 1.2};
    for (std::size_t from = 0; from < ticks; from += step) {
        const auto part = std::ranges::subrange(live.late_s.begin() + static_cast<std::ptrdiff_t>(from),
                                                live.late_s.begin() + static_cast<std::ptrdiff_t>(std::min(from + step, ticks)));
        line.points.push_back({static_cast<double>(from) * live.period_s, 1e3 * std::max(shortest_s, *std::ranges::max_element(part))});
    }
    std::vector<double> late_ms;
    for (const plots::Point& point : line.points)
        late_ms.push_back(point.y);
    plots::Figure figure;
    figure.title = "Lateness over the drive";
    figure.height_px = 300.0;
    figure.x = {"time", "s", 0.0, std::max(live.period_s, static_cast<double>(ticks) * live.period_s)};
    figure.y = plots::axis_around("late", "ms", late_ms, plots::Scale::logarithmic);
    figure.series.push_back(std::move(line));
    for (const CanOutage& outage : live.socket.outages)
        if (outage.from_ns >= 0)
            figure.marks.push_back({.across = plots::Mark::Across::at_x,
                                    .value = 1e-9 * static_cast<double>(outage.from_ns),
                                    .label = outage.kind == CanOutage::Kind::bus_off ? "bus-off" : "interface away",
                                    .colour = outage_ink});
    return plots::svg_of(figure);
}

} // namespace

std::vector<std::string> live_svgs(const LiveFigures& live) {
    if (live.late_s.empty() || !live.waited)
        return {};
    return {histogram_svg(live), over_drive_svg(live)};
}

} // namespace fernlicht
