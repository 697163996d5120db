#include "runner/play/extent_fold.h"

#include "metrics/road/lux_near_thresholds.h"
#include "scenarios/drives/play/camera.h"
#include "scenarios/light/light.h"
#include "scenarios/packs/level.h"
#include "scenarios/values/trace.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

constexpr double margin_m = 1.0, pixel_m = 0.25;
constexpr int max_pixels = 1024;

int pixels_for(double length_m) { return std::clamp(static_cast<int>(std::ceil(length_m / pixel_m)), 2, max_pixels); }

/// Bilinear in the logarithm where all four are lit, as reach is found along the lane: beside a cut-off a target's light changes by a
/// factor of 1.8 from pixel to pixel, and a straight line between such values lies 5 % too high in the middle.
double between(double a, double b, double c, double d, double fx, double fy) {
    const auto mixed = [&](double w, double x, double y, double z) {
        return (w * (1.0 - fx) + x * fx) * (1.0 - fy) + (y * (1.0 - fx) + z * fx) * fy;
    };
    if (a > 0.0 && b > 0.0 && c > 0.0 && d > 0.0)
        return std::exp(mixed(std::log(a), std::log(b), std::log(c), std::log(d)));
    return mixed(a, b, c, d);
}

PixelPlaces places_of(const ExtentGrid& grid, const View& view, const Moment& moment) {
    const Camera camera = camera_of(moment, view);
    PixelPlaces found;
    found.places.reserve(grid.surface.size());
    for (std::size_t row = 0, i = 0; row < grid.ahead_m.size(); ++row) {
        std::pair<int, int>& between_y = found.between_y.emplace_back(view.height_px, 0);
        for (std::size_t column = 0; column < grid.offset_m.size(); ++column, ++i) {
            const glm::dvec2 at = map_pixel(camera, view, moment, grid.surface[i].position_m) - 0.5;
            const double x = std::clamp(at.x, 0.0, view.width_px - 1.0), y = std::clamp(at.y, 0.0, view.height_px - 1.0);
            const int x0 = std::min(static_cast<int>(x), view.width_px - 2), y0 = std::min(static_cast<int>(y), view.height_px - 2);
            found.places.push_back({x0, y0, x - x0, y - y0});
            between_y = {std::min(between_y.first, y0), std::max(between_y.second, y0 + 1)};
        }
    }
    return found;
}

/// What the pixels between which places lie are bounded by, some rows at a time; in a bend much of a map is beside the road.
std::vector<PixelBox> boxes_of(const PixelPlaces& pixels, int height_px) {
    constexpr int rows = 16;
    std::vector<std::pair<int, int>> between_x(static_cast<std::size_t>((height_px + rows - 1) / rows), {INT_MAX, 0});
    for (const PixelPlace& place : pixels.places)
        for (const int y : {place.y, place.y + 1}) {
            std::pair<int, int>& between = between_x[static_cast<std::size_t>(y / rows)];
            between = {std::min(between.first, place.x), std::max(between.second, place.x + 1)};
        }
    std::vector<PixelBox> boxes;
    for (std::size_t i = 0; i < between_x.size(); ++i)
        if (const auto [first, last] = between_x[i]; first <= last) {
            const int y = static_cast<int>(i) * rows;
            boxes.push_back({first, y, last - first + 1, std::min(rows, height_px - y)});
        }
    return boxes;
}

FERNLICHT_WIDEST bool all_below(const float* values, std::size_t count, float limit) {
    int reached = 0;
    for (std::size_t i = 0; i < count; ++i)
        reached |= values[i] < limit ? 0 : 1; // NaN is not below
    return reached == 0;
}

/// How many of the picture's rows before each have a pixel that is not below the limit.
std::vector<int> rows_not_below(const Image<float>& picture, float limit) {
    std::vector<int> before{0};
    for (int y = 0; y < picture.height(); ++y)
        before.push_back(before.back() + (all_below(&picture.at(0, y), static_cast<std::size_t>(picture.width()), limit) ? 0 : 1));
    return before;
}

/// The picture at grid points as measure_extent needs it for these limits.
std::vector<double> sampled(const Image<float>& picture, const ExtentGrid& grid, const PixelPlaces& pixels,
                            const std::vector<double>& thresholds_lx) {
    const std::vector<PixelPlace>& places = pixels.places;
    // Rows that are dark all over, as most are ahead of what the lamps reach.
    const double dark_lx = thresholds_lx.empty() ? 0.0 : 0.99 * *std::ranges::min_element(thresholds_lx);
    const std::vector<int> not_dark = rows_not_below(picture, static_cast<float>(dark_lx));
    const std::size_t columns = grid.offset_m.size();
    const auto bounds = [&](std::size_t i) {
        const float* above = &picture.at(places[i].x, places[i].y);
        const float* below = above + picture.width();
        if (!std::isfinite(above[0] + above[1] + below[0] + below[1]))
            return LuxBounds{};
        constexpr double rounding = 1e-12; // of a logarithm of at most 89 and back again
        return LuxBounds{(1.0 - rounding) * static_cast<double>(std::min(std::min(above[0], above[1]), std::min(below[0], below[1]))),
                         (1.0 + rounding) * static_cast<double>(std::max(std::max(above[0], above[1]), std::max(below[0], below[1])))};
    };
    const auto exact = [&](std::size_t i) {
        const PixelPlace& p = places[i];
        const auto e = [&](int dx, int dy) { return static_cast<double>(picture.at(p.x + dx, p.y + dy)); };
        return between(e(0, 0), e(1, 0), e(0, 1), e(1, 1), p.fx, p.fy);
    };
    return lux_near_thresholds(
        grid, thresholds_lx,
        [&](std::size_t first, std::span<LuxBounds> of_row) {
            const auto [low_y, high_y] = pixels.between_y[first / columns];
            if (not_dark[static_cast<std::size_t>(high_y) + 1] == not_dark[static_cast<std::size_t>(low_y)]) {
                std::ranges::fill(of_row, LuxBounds{0.0, dark_lx});
                return;
            }
            for (std::size_t i = 0; i < of_row.size(); ++i)
                of_row[i] = bounds(first + i);
        },
        exact);
}

} // namespace

View map_over(const ExtentGrid& grid, const Moment& moment) {
    View view;
    view.name = "extent";
    view.projection = Projection::map;
    const Camera axes = camera_of(moment, view);
    double low_x = 0.0, high_x = 0.0, low_y = 0.0, high_y = 0.0;
    for (const Pose& pose : grid.surface) {
        const glm::dvec3 p = pose.position_m - moment.ego.position_m;
        const double ahead = glm::dot(p, axes.up), right = glm::dot(p, axes.right);
        low_x = std::min(low_x, right);
        high_x = std::max(high_x, right);
        low_y = std::min(low_y, ahead);
        high_y = std::max(high_y, ahead);
    }
    view.map_left_m = margin_m - low_x;
    view.map_right_m = high_x + margin_m;
    view.map_behind_m = margin_m - low_y;
    view.map_ahead_m = high_y + margin_m;
    view.width_px = pixels_for(view.map_left_m + view.map_right_m);
    view.height_px = pixels_for(view.map_ahead_m + view.map_behind_m);
    return view;
}

void place_pixels(ExtentDrawing& drawing) {
    drawing.pixels = places_of(drawing.grid, drawing.view, drawing.moment);
    drawing.view.looked_at = boxes_of(drawing.pixels, drawing.view.height_px);
}

ExtentDrawing ExtentFold::draw(const Moment& moment, const Draw& draw) const {
    ExtentDrawing drawing{moment, make_extent_grid(route_, moment, drive_.bumper_m, *drive_.extent), {}, {}, {}, false};
    drawing.view = map_over(drawing.grid, moment);
    place_pixels(drawing);
    if (!moment.other_lamps.empty())
        drawing.moment.other_lamps.clear(); // reach is the own lamps'
    drawing.frame = draw(drawing.moment, drawing.view, {.illuminance = true, .target = true})();
    return drawing;
}

std::vector<LaneExtent> ExtentFold::rendered(const ExtentDrawing& drawing) const {
    const auto& [moment, grid, view, pixels, frame, nudged] = drawing;
    const ExtentParameters& p = *drive_.extent;
    std::vector<LaneExtent> extents;
    for (const Surface surface : {Surface::road, Surface::target}) {
        const Image<float>& picture = surface == Surface::road ? frame.illuminance_lx : frame.target_lx;
        if (!picture.empty())
            std::ranges::copy(measure_extent(grid, sampled(picture, grid, pixels, p.thresholds_lx), surface, p.thresholds_lx, p.width_at_m),
                              std::back_inserter(extents));
    }
    return extents;
}

ExtentRow ExtentFold::measure(const ExtentDrawing& drawing) const {
    TraceSpan span("extent", "measure");
    if (span)
        span.tell("tick", drawing.moment.tick);
    const auto& [moment, grid, view, pixels, frame, nudged] = drawing;
    const ExtentParameters& p = *drive_.extent;
    ExtentRow row;
    row.tick = moment.tick;
    row.time_s = moment.time_s;
    row.distance_m = moment.distance_m;
    row.rendered = rendered(drawing);
    for (const Surface surface : {Surface::road, Surface::target}) {
        const TraceSpan twin("extent of the twin", "measure");
        const std::vector<double> truth = twin_lux_near_thresholds(grid, moment, surface, p.thresholds_lx);
        const std::vector<LaneExtent> measured = measure_extent(grid, truth, surface, p.thresholds_lx, p.width_at_m);
        std::ranges::copy(measured, std::back_inserter(row.twin));
        std::ranges::copy(grid_errors(grid, truth, surface, p.thresholds_lx, measured), std::back_inserter(row.grid_errors));
    }
    if (nudged) {
        const TraceSpan sensitivity("extent's sensitivity", "measure");
        row.nudged = nudged_extents(grid, moment, p.thresholds_lx, p.width_at_m, nudges_);
    }
    return row;
}

namespace {

double figure_of(const Spread& spread, Statistic statistic) {
    return statistic == Statistic::minimum ? spread.minimum : statistic == Statistic::maximum ? spread.maximum : spread.median;
}

constexpr double patch_m = 0.03; // three pixels of a centimetre, the probe in the middle one

} // namespace

View map_around(const glm::dvec3& point_m, const Moment& moment) {
    View view;
    view.name = "probe";
    view.projection = Projection::map;
    view.width_px = view.height_px = 3;
    const Camera axes = camera_of(moment, view);
    const glm::dvec3 p = point_m - moment.ego.position_m;
    const double ahead = glm::dot(p, axes.up), right = glm::dot(p, axes.right);
    view.map_ahead_m = ahead + 0.5 * patch_m;
    view.map_behind_m = 0.5 * patch_m - ahead;
    view.map_right_m = right + 0.5 * patch_m;
    view.map_left_m = 0.5 * patch_m - right;
    return view;
}

void ProbeFold::add(const Moment& moment, const Draw& draw) {
    if (found_.empty())
        return;
    const TraceSpan span("probes", "measure");
    for (std::size_t i = 0; i < found_.size(); ++i) {
        const Probe& probe = drive_.probes[i];
        const Pose pose = route_.pose(moment.distance_m + probe.ahead_m, probe.left_m);
        const glm::dvec3 point = pose.position_m + glm::dvec3(0.0, 0.0, probe.above_m);
        const bool on_surface = probe.above_m == 0.0;
        for (const LitLamp& lamp : moment.lamps)
            found_[i].near_field = found_[i].near_field || glm::length(point - lamp.pose.position_m) < lamp.photometric_distance_m;
        const CrossSection across = route_.cross_section(moment.distance_m + probe.ahead_m);
        found_[i].beside_road =
            found_[i].beside_road || (on_surface && (probe.left_m > across.paved_left_m || probe.left_m < across.paved_right_m));
        const auto twin_lx = [&](const Moment& lit) {
            return on_surface ? surface_illuminance_lx(lit, point, pose.up()) : target_illuminance_lx(lit, point);
        };
        found_[i].twin.push_back(twin_lx(moment));
        for (std::size_t kind = 0; kind < nudge_kinds; ++kind)
            if (nudges_[kind])
                found_[i].nudged[kind].push_back(twin_lx(nudged(moment, *nudges_[kind])));
        if (!on_surface)
            continue;
        const Frame frame = draw(moment, map_around(pose.position_m, moment), {.illuminance = true})();
        found_[i].not_drawn = frame.illuminance_lx.empty();
        if (!found_[i].not_drawn)
            found_[i].drawn.push_back(static_cast<double>(frame.illuminance_lx.at(1, 1)));
    }
}

Readings ProbeFold::finish() const {
    Readings readings;
    for (std::size_t i = 0; i < found_.size(); ++i) {
        const Probe& probe = drive_.probes[i];
        const std::string where = fmt::format("{} m ahead, {} m left, {} m above the road{}", probe.ahead_m, probe.left_m, probe.above_m,
                                              found_[i].near_field ? ", near-field: nearer than a lamp's photometric distance" : "");
        const auto say = [&](Statistic statistic, Aspect aspect, std::optional<double> value, const std::string& why_not) {
            const ReadingKey key{.quantity = Quantity::probe_illuminance, .subject = probe.name, .aspect = aspect, .statistic = statistic};
            readings.push_back({key, Value::of(value, why_not), where});
            for (std::size_t kind = 0; kind < nudge_kinds && value && !found_[i].beside_road; ++kind)
                if (const std::optional<Spread> as_is = spread_of(found_[i].twin), nudged = spread_of(found_[i].nudged[kind]); nudged)
                    readings.back().sensitivity.*sensitivity_rows[kind].member =
                        figure_of(*nudged, statistic) - figure_of(*as_is, statistic);
        };
        const std::optional<Spread> drawn = spread_of(found_[i].drawn), twin = spread_of(found_[i].twin);
        const std::string unseen = probe.above_m != 0.0  ? "the point is not on a rendered surface"
                                   : found_[i].not_drawn ? no_illuminance(drive_.technique)
                                                         : "no moment was played";
        say(Statistic::median, Aspect::value, drawn ? std::optional(drawn->median) : std::nullopt, unseen);
        say(Statistic::minimum, Aspect::value, drawn ? std::optional(drawn->minimum) : std::nullopt, unseen);
        say(Statistic::maximum, Aspect::value, drawn ? std::optional(drawn->maximum) : std::nullopt, unseen);
        const bool known = twin && !found_[i].beside_road;
        say(Statistic::median, Aspect::twin, known ? std::optional(twin->median) : std::nullopt,
            twin ? "the point lies beside the pavement: the twin knows the road's surface, not the verge" : "no moment was played");
    }
    return readings;
}

} // namespace fernlicht
