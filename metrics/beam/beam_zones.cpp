#include "metrics/beam/beam_zones.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>

namespace fernlicht {
namespace {

constexpr std::size_t max_zones = 64;
constexpr std::array<std::size_t, 3> block_halves{0, 1, 2}; // 1, 3 x 3, 5 x 5 samples

struct ZoneMean {
    double mean = 0.0, sigma = 0.0, open = 0.0;
    /// How sure the mean is not 0, in standard deviations, when interpolation is given all it may want.
    double z() const { return std::max(0.0, std::abs(mean) - open) / sigma; }
};

/// Adds up what each source of noise does to a sum of residuals.
class NoiseSum {
  public:
    void add(const ResidualGrid& grid, std::size_t at, double weight) {
        tested_.emplace_back(grid.source[at], weight * grid.noise[at]);
        for (std::size_t k = grid.first[at]; k < grid.first[at + 1]; ++k)
            against_.emplace_back(grid.shared[k].first, weight * grid.noise[at] * grid.shared[k].second);
    }
    double variance() { return of(tested_) + of(against_); }
    void clear() {
        tested_.clear();
        against_.clear();
    }

  private:
    using Terms = std::vector<std::pair<std::size_t, double>>;
    static double of(Terms& terms) {
        std::ranges::sort(terms);
        double variance = 0.0;
        for (std::size_t i = 0; i < terms.size();) {
            double sum = 0.0;
            const std::size_t from = terms[i].first;
            for (; i < terms.size() && terms[i].first == from; ++i)
                sum += terms[i].second;
            variance += sum * sum;
        }
        return variance;
    }
    Terms tested_, against_;
};

/// What samples together say, each weighed by its noise.
struct Weighed {
    double weights = 0.0, sum = 0.0, open = 0.0;
    void add(const ResidualGrid& grid, std::size_t at, NoiseSum& noise) {
        const double weight = 1.0 / (grid.noise[at] * grid.noise[at]);
        weights += weight;
        sum += weight * grid.r[at];
        open += weight * grid.open[at];
        noise.add(grid, at, weight);
    }
};

/// Calls `visit` with each sample no farther than `steps` from `at` along either axis.
void each_near(const ResidualGrid& grid, std::size_t at, std::size_t steps, const auto& visit) {
    const std::size_t columns = grid.h_deg.size(), rows = grid.v_deg.size(), x = at % columns, y = at / columns;
    for (std::size_t j = std::max(y, steps) - steps; j <= std::min(rows - 1, y + steps); ++j)
        for (std::size_t i = std::max(x, steps) - steps; i <= std::min(columns - 1, x + steps); ++i)
            visit(j * columns + i);
}

/// Weighted mean over the compared samples within `half` of `at`; nullopt where `at` is not compared.
std::optional<ZoneMean> block_at(const ResidualGrid& grid, std::size_t at, std::size_t half, NoiseSum& noise) {
    if (std::isnan(grid.r[at]))
        return std::nullopt;
    noise.clear();
    Weighed all;
    each_near(grid, at, half, [&](std::size_t near) {
        if (!std::isnan(grid.r[near]))
            all.add(grid, near, noise);
    });
    return ZoneMean{all.sum / all.weights, std::sqrt(noise.variance()) / all.weights, all.open / all.weights};
}

struct Smoothed {
    std::vector<double> mean; ///< over 3 x 3, less what is open; NaN where not compared
    std::vector<double> best_z;
};

/// Makes the smoothed values of one sample those of the grid.
void smooth(const ResidualGrid& grid, std::size_t at, NoiseSum& noise, Smoothed& out) {
    double z = 0.0, mean = std::numeric_limits<double>::quiet_NaN();
    for (const std::size_t half : block_halves)
        if (const std::optional<ZoneMean> block = block_at(grid, at, half, noise)) {
            z = std::max(z, block->z());
            if (half == 1)
                mean = std::copysign(std::max(0.0, std::abs(block->mean) - block->open), block->mean);
        }
    out.mean[at] = mean;
    out.best_z[at] = z;
}

/// All samples that `belongs` and that touch one another and `start`; they are taken out of `free`.
std::vector<std::size_t> connected(std::size_t start, std::size_t columns, std::vector<bool>& free, const auto& belongs) {
    std::vector<std::size_t> found{start};
    free[start] = false;
    for (std::size_t next = 0; next < found.size(); ++next) {
        const std::size_t at = found[next], x = at % columns;
        const auto visit = [&](bool inside, std::size_t neighbour) {
            if (inside && free[neighbour] && belongs(neighbour)) {
                free[neighbour] = false;
                found.push_back(neighbour);
            }
        };
        visit(x > 0, at - 1);
        visit(x + 1 < columns, at + 1);
        visit(at >= columns, at - columns);
        visit(at + columns < free.size(), at + columns);
    }
    return found;
}

/// The smallest stretch of an axis outside which on either side lies at most 1 % of the zone: single samples that noise put beside it do
/// not move its borders. Out to halfway to the next sample.
std::pair<double, double> stretch(const std::vector<double>& axis, std::vector<std::size_t> indices) {
    std::ranges::sort(indices);
    const std::size_t beside = indices.size() / 100, first = indices[beside], last = indices[indices.size() - 1 - beside];
    return {first == 0 ? axis.front() : (axis[first - 1] + axis[first]) / 2.0,
            last + 1 == axis.size() ? axis.back() : (axis[last] + axis[last + 1]) / 2.0};
}

/// The same where the axes are other angles: over the directions themselves.
std::pair<double, double> stretch_of(const ResidualGrid& grid, const std::vector<std::size_t>& members, double TwoAngles::*angle) {
    std::vector<double> angles;
    for (const std::size_t at : members)
        angles.push_back(grid.un[at].*angle);
    std::ranges::sort(angles);
    const std::size_t beside = angles.size() / 100;
    return {angles[beside], angles[angles.size() - 1 - beside]};
}

/// Of its shares.
void set_scatter(const ResidualGrid& grid, BeamZone& zone) {
    constexpr double notable = 0.02, beyond_noise = 3.0;
    std::vector<double> logs;
    double noise = 0.0;
    for (const std::size_t at : zone.members) {
        logs.push_back(grid.r[at]);
        noise += std::numbers::sqrt2 * grid.noise[at] / static_cast<double>(zone.members.size());
    }
    std::ranges::sort(logs);
    const std::size_t beside = logs.size() / 20;
    const double low = logs[beside], high = logs[logs.size() - 1 - beside];
    const bool scatters = high - low > std::max(notable, 2.0 * beyond_noise * noise);
    zone.share_low = scatters ? std::expm1(low) : zone.share;
    zone.share_high = scatters ? std::expm1(high) : zone.share;
}

BeamZone zone_of(const ResidualGrid& grid, const Smoothed& smoothed, const std::vector<std::size_t>& members) {
    const std::size_t columns = grid.h_deg.size();
    BeamZone zone;
    NoiseSum noise;
    Weighed all;
    std::vector<std::size_t> xs, ys;
    for (const std::size_t at : members) {
        all.add(grid, at, noise);
        zone.z = std::max(zone.z, smoothed.best_z[at]);
        xs.push_back(at % columns);
        ys.push_back(at / columns);
        const TwoAngles d = grid.un.empty() ? TwoAngles{grid.h_deg[xs.back()], grid.v_deg[ys.back()]} : grid.un[at];
        zone.h_deg += d.h_deg / static_cast<double>(members.size());
        zone.v_deg += d.v_deg / static_cast<double>(members.size());
    }
    zone.samples = members.size();
    zone.members = members;
    zone.share = std::expm1(all.sum / all.weights);
    zone.uncertainty = (1.0 + zone.share) * (std::sqrt(noise.variance()) + all.open) / all.weights;
    set_scatter(grid, zone);
    if (grid.un.empty()) {
        std::tie(zone.h_from_deg, zone.h_to_deg) = stretch(grid.h_deg, std::move(xs));
        std::tie(zone.v_from_deg, zone.v_to_deg) = stretch(grid.v_deg, std::move(ys));
    } else {
        std::tie(zone.h_from_deg, zone.h_to_deg) = stretch_of(grid, members, &TwoAngles::h_deg);
        std::tie(zone.v_from_deg, zone.v_to_deg) = stretch_of(grid, members, &TwoAngles::v_deg);
    }
    return zone;
}

/// How strong the zone round these seeds is: the upper quartile of their smoothed sizes, for blocks at its border are half outside.
double strength(const Smoothed& smoothed, const std::vector<std::size_t>& seeds) {
    std::vector<double> sizes;
    for (const std::size_t at : seeds)
        sizes.push_back(std::abs(smoothed.mean[at]));
    return middle_of(std::move(sizes), 0.75);
}

/// The largest set of connected seeds, grown or cut to what is at least half as strong as they are; empty without seeds.
std::vector<std::size_t> largest_zone(const ResidualGrid& grid, const Smoothed& smoothed, double z_limit) {
    const std::size_t columns = grid.h_deg.size();
    std::vector<std::size_t> largest;
    double sign = 0.0;
    for (const double tried : {-1.0, 1.0}) {
        const auto is_seed = [&](std::size_t at) { return smoothed.best_z[at] > z_limit && tried * smoothed.mean[at] > 0.0; };
        std::vector<bool> free(grid.r.size(), true);
        for (std::size_t at = 0; at < grid.r.size(); ++at)
            if (free[at] && is_seed(at))
                if (std::vector<std::size_t> cluster = connected(at, columns, free, is_seed); cluster.size() > largest.size()) {
                    largest = std::move(cluster);
                    sign = tried;
                }
    }
    if (largest.empty())
        return {};
    const double half = strength(smoothed, largest) / 2.0;
    const auto belongs = [&](std::size_t at) { return sign * smoothed.mean[at] >= half; };
    std::vector<bool> free(grid.r.size(), true);
    std::vector<std::size_t> members;
    for (const std::size_t seed : largest)
        if (free[seed] && belongs(seed))
            std::ranges::copy(connected(seed, columns, free, belongs), std::back_inserter(members));
    return members;
}

/// The zone and the samples round it; those whose blocks reached into it are smoothed anew.
void take_out(ResidualGrid& grid, const std::vector<std::size_t>& members, NoiseSum& noise, Smoothed& smoothed) {
    std::vector<bool> stale(grid.r.size());
    for (const std::size_t at : members) {
        each_near(grid, at, 1, [&](std::size_t near) { grid.r[near] = std::numeric_limits<double>::quiet_NaN(); });
        each_near(grid, at, 1 + block_halves.back(), [&](std::size_t near) { stale[near] = true; });
    }
    for (std::size_t at = 0; at < stale.size(); ++at)
        if (stale[at])
            smooth(grid, at, noise, smoothed);
}

} // namespace

double z_limit(double chance, std::size_t tests) {
    const double each = chance / static_cast<double>(std::max<std::size_t>(tests, 1));
    double low = 0.0, high = 40.0; // erfc(z / sqrt 2) is the chance beyond z on either side
    for (int i = 0; i < 100; ++i) {
        const double middle = (low + high) / 2.0;
        (std::erfc(middle / std::numbers::sqrt2) > each ? low : high) = middle;
    }
    return high;
}

double neighbour_noise(const ResidualGrid& grid, const std::vector<bool>& chosen) {
    const std::size_t columns = grid.h_deg.size();
    std::vector<double> sizes;
    ResidualGrid unit; // noise of 1 through the same weights
    unit.source = grid.source;
    unit.first = grid.first;
    unit.shared = grid.shared;
    unit.noise.assign(grid.r.size(), 1.0);
    NoiseSum noise;
    for (std::size_t at = 0; at < grid.r.size(); ++at) {
        if (!chosen.empty() && !chosen[at])
            continue;
        const auto add = [&](bool inside, std::size_t step) {
            if (!inside)
                return;
            const double d = grid.r[at] - (grid.r[at - step] + grid.r[at + step]) / 2.0;
            if (std::isnan(d))
                return;
            noise.clear();
            noise.add(unit, at, 1.0);
            noise.add(unit, at - step, -0.5);
            noise.add(unit, at + step, -0.5);
            if (const double variance = noise.variance(); variance > 0.1) // else copies of one sample
                sizes.push_back(std::abs(d) / std::sqrt(variance));
        };
        add(at % columns > 0 && at % columns + 1 < columns, 1);
        add(at >= columns && at + columns < grid.r.size(), columns);
    }
    if (sizes.size() < 30)
        return 0.0;
    // The median of n sizes is off by 1.2 / sqrt(n) of itself, and a noise taken too small claims what is none.
    return 1.4826 * middle_of(sizes) * (1.0 + 1.2 / std::sqrt(static_cast<double>(sizes.size())));
}

std::vector<BeamZone> find_zones(const ResidualGrid& grid, double z_limit) {
    std::vector<BeamZone> zones;
    ResidualGrid rest = grid;
    NoiseSum noise;
    Smoothed smoothed{std::vector<double>(grid.r.size()), std::vector<double>(grid.r.size())};
    for (std::size_t at = 0; at < grid.r.size(); ++at)
        smooth(rest, at, noise, smoothed);
    // One zone after the other, each taken out with the samples round it: blocks that reach into it would begin another beside it.
    while (zones.size() < max_zones) {
        const std::vector<std::size_t> members = largest_zone(rest, smoothed, z_limit);
        if (members.empty())
            break;
        zones.push_back(zone_of(rest, smoothed, members));
        take_out(rest, members, noise, smoothed);
    }
    std::ranges::stable_sort(zones, std::greater{}, &BeamZone::z);
    return zones;
}

} // namespace fernlicht
