#include "metrics/beam/beam_places.h"

#include "metrics/beam/cut_off_elbow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace fernlicht {
namespace {

constexpr int region_cells = 32; // across a region, either way
/// A zone larger than this is more than the points that it holds; zone IV has 9 square degrees.
constexpr double wide_deg2 = 20.0;

/// Mean intensity over directions of one lamp, and the standard deviation of its logarithm.
struct PlaceMean {
    double cd = 0.0, cubic_cd = 0.0, open = 0.0, sigma = 0.0;
};

PlaceMean place_mean(const PlaceSide& side, const std::vector<Direction>& directions, const PlaceLimits& limits) {
    const std::vector<double>& samples = side.field.table().cd;
    std::vector<double> taken(samples.size()); // of each stored sample
    PlaceMean mean;
    for (const Direction& d : directions) {
        const double cd = side.field.cd(d.h_deg, d.v_deg);
        const FieldValue cubic = side.field.at(d.h_deg, d.v_deg);
        mean.cd += cd;
        mean.cubic_cd += std::exp(cubic.log_cd);
        mean.open += cd * cubic.uncertainty;
        for (const auto& [at, weight] : side.field.weights(d.h_deg, d.v_deg))
            taken[side.source[at]] += weight * cd;
    }
    double variance = 0.0;
    for (std::size_t at = 0; at < taken.size(); ++at)
        if (taken[at] != 0.0)
            variance += std::pow(taken[at] * limits.noise_of(samples[at]), 2);
    if (mean.cd > 0.0) {
        mean.sigma = std::sqrt(variance) / mean.cd;
        mean.open /= mean.cd;
    }
    mean.cd /= static_cast<double>(directions.size());
    mean.cubic_cd /= static_cast<double>(directions.size());
    return mean;
}

double width_round(const std::vector<double>& axis, std::size_t i) {
    return (axis[std::min(i + 1, axis.size() - 1)] - axis[i == 0 ? 0 : i - 1]) / 2.0;
}

/// The samples of a grid as directions, each with the area that it stands for.
class GridAreas {
  public:
    GridAreas(const ResidualGrid& grid, const CutOffLine& line) : grid_(grid), line_(line), lowest_deg_(line.lowest_deg()) {}

    Direction direction(std::size_t at) const {
        const std::size_t columns = grid_.h_deg.size();
        return grid_.un.empty() ? Direction{grid_.h_deg[at % columns], grid_.v_deg[at / columns]}
                                : Direction{grid_.un[at].h_deg, grid_.un[at].v_deg};
    }
    double area(std::size_t at) const {
        const std::size_t columns = grid_.h_deg.size(), x = at % columns, y = at / columns;
        return width_round(grid_.h_deg, x) * width_round(grid_.v_deg, y) * std::cos(grid_.v_deg[y] * std::numbers::pi / 180.0);
    }
    bool is_above_cut_off(std::size_t at) const {
        const Direction d = direction(at);
        return line_.exists() && d.v_deg > line_.at(d.h_deg).value_or(lowest_deg_);
    }

  private:
    const ResidualGrid& grid_;
    const CutOffLine& line_;
    double lowest_deg_;
};

/// Most of all compared light, or of what is above or below the cut-off.
ZoneExtent extent_of(const GridAreas& areas, const ResidualGrid& grid, const std::vector<bool>& is_in) {
    constexpr double most = 0.8, little = 0.2;
    double all[2]{}, held[2]{};
    for (std::size_t at = 0; at < grid.r.size(); ++at)
        if (!std::isnan(grid.r[at])) {
            const std::size_t side = areas.is_above_cut_off(at) ? 1 : 0;
            all[side] += areas.area(at);
            held[side] += is_in[at] ? areas.area(at) : 0.0;
        }
    const double below = all[0] > 0.0 ? held[0] / all[0] : 0.0;
    if (all[1] == 0.0)
        return below >= most ? ZoneExtent::all : ZoneExtent::part;
    const double above = held[1] / all[1];
    return below >= most && above >= most     ? ZoneExtent::all
           : below >= most && above <= little ? ZoneExtent::below_cut_off
           : above >= most && below <= little ? ZoneExtent::above_cut_off
                                              : ZoneExtent::part;
}

double extent_deg2(const std::vector<Direction>& polygon) {
    double sum = 0.0;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
        sum += polygon[j].h_deg * polygon[i].v_deg - polygon[i].h_deg * polygon[j].v_deg;
    return std::abs(sum) / 2.0;
}

} // namespace

bool is_within(const std::vector<Direction>& polygon, Direction d) {
    bool in = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const Direction a = polygon[i], b = polygon[j];
        if ((a.v_deg > d.v_deg) != (b.v_deg > d.v_deg) &&
            d.h_deg < a.h_deg + (b.h_deg - a.h_deg) * (d.v_deg - a.v_deg) / (b.v_deg - a.v_deg))
            in = !in;
    }
    return in;
}

std::vector<Direction> directions_of(const BeamPlace& place) {
    if (place.is_point())
        return place.corners;
    const auto [left, right] = std::ranges::minmax(place.corners, {}, &Direction::h_deg);
    const auto [bottom, top] = std::ranges::minmax(place.corners, {}, &Direction::v_deg);
    std::vector<Direction> directions;
    for (int y = 0; y < region_cells; ++y)
        for (int x = 0; x < region_cells; ++x) {
            const Direction d{left.h_deg + (right.h_deg - left.h_deg) * (x + 0.5) / region_cells,
                              bottom.v_deg + (top.v_deg - bottom.v_deg) * (y + 0.5) / region_cells};
            if (is_within(place.corners, d))
                directions.push_back(d);
        }
    return directions;
}

PlaceChange change_at(const BeamPlace& place, const PlaceSide& before, const PlaceSide& now, const PlaceLimits& limits) {
    PlaceChange found;
    found.place = place;
    std::vector<Direction> directions = directions_of(place);
    const std::size_t all = directions.size();
    std::erase_if(directions, [&](const Direction& d) { return !before.field.has(d.h_deg, d.v_deg) || !now.field.has(d.h_deg, d.v_deg); });
    if (2 * directions.size() < all || directions.empty()) {
        found.not_measured = "outside a table";
        return found;
    }
    const PlaceMean old_mean = place_mean(before, directions, limits), new_mean = place_mean(now, directions, limits);
    found.old_cd = old_mean.cd;
    found.new_cd = new_mean.cd;
    if (std::max(old_mean.cd, new_mean.cd) < limits.floor_cd) {
        found.not_measured = "too faint to compare";
        return found;
    }
    const auto log_of = [&](double cd) { return std::log(std::max(cd, limits.darkest_cd)); };
    const double r = log_of(new_mean.cd) - log_of(old_mean.cd);
    const double by_cubic = log_of(new_mean.cubic_cd) - log_of(old_mean.cubic_cd);
    const double open = limits.is_same_grid ? std::abs(r - by_cubic) : new_mean.open + old_mean.open;
    const double sigma = std::hypot(old_mean.sigma, new_mean.sigma);
    found.is_beyond_noise = std::abs(r) - open > limits.z_limit * sigma;
    if (old_mean.cd < limits.darkest_cd)
        found.not_measured = "dark in the old lamp";
    else
        found.uncertainty = new_mean.cd / old_mean.cd * (sigma + open);
    return found;
}

void name_zones(std::vector<BeamZone>& zones, const ResidualGrid& grid, const BeamField& tested, const CutOffLine& line,
                const std::vector<BeamPlace>& places) {
    const GridAreas areas(grid, line);
    std::vector<std::vector<std::size_t>> samples; // nearest to each direction of each place
    for (const BeamPlace& place : places) {
        std::vector<std::size_t>& nearest = samples.emplace_back();
        for (const Direction& d : directions_of(place))
            nearest.push_back(tested.has(d.h_deg, d.v_deg) ? tested.nearest(d.h_deg, d.v_deg) : grid.r.size());
    }
    for (BeamZone& zone : zones) {
        std::vector<bool> is_in(grid.r.size() + 1); // the last one stands for what lies outside the table
        for (const std::size_t at : zone.members)
            is_in[at] = true;
        zone.extent = extent_of(areas, grid, is_in);
        if (zone.extent != ZoneExtent::part)
            continue;
        bool holds_region = false;
        double smallest = std::numeric_limits<double>::infinity(), area = 0.0;
        for (const std::size_t at : zone.members)
            area += areas.area(at);
        for (std::size_t i = 0; i < places.size(); ++i) {
            const auto held = std::ranges::count_if(samples[i], [&](std::size_t at) { return is_in[at]; });
            if (2 * static_cast<std::size_t>(held) >= samples[i].size()) {
                zone.holds.push_back(places[i].name);
                holds_region = holds_region || !places[i].is_point();
            }
            if (places[i].is_point() || extent_deg2(places[i].corners) >= smallest)
                continue;
            double common = 0.0;
            for (const std::size_t at : zone.members)
                common += is_within(places[i].corners, areas.direction(at)) ? areas.area(at) : 0.0;
            if (2.0 * common >= area) {
                smallest = extent_deg2(places[i].corners);
                zone.part_of = places[i].name;
            }
        }
        if (!zone.holds.empty())
            zone.part_of.clear();
        if (!zone.holds.empty() && !holds_region && area > wide_deg2)
            zone.extent = ZoneExtent::wide;
    }
}

const char* traffic_side_name(TrafficSide side) {
    static constexpr const char* names[]{"unknown", "right", "left"};
    return names[static_cast<int>(side)];
}

TrafficSide traffic_side_of(const CandelaTable& table) {
    const CandelaTable image = mirrored(table);
    const bool right = fit_elbow({&table, {}}).at.has_value(), left = fit_elbow({&image, {}}).at.has_value();
    return right == left ? TrafficSide::unknown : right ? TrafficSide::right : TrafficSide::left;
}

} // namespace fernlicht
