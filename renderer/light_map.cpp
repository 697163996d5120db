#include "renderer/light_map.h"

#include "renderer/projected_beam.h"
#include "scenarios/light/light.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <oneapi/tbb/parallel_for.h>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr double nearest_m = 0.5;
constexpr double lit_lx = 1.0;
constexpr std::size_t max_texels_of_all = std::size_t{1} << 28;

double facing_lx(const Moment& local, const glm::dvec3& point_m) {
    double e = 0.0;
    for (const LitLamp& lamp : local.lamps) {
        const glm::dvec3 to_lamp = lamp.pose.position_m - point_m;
        e += intensity_towards_cd(lamp, point_m) / std::max(glm::dot(to_lamp, to_lamp), nearest_m * nearest_m);
    }
    return e;
}

std::size_t cells(const LightMapAxis& axis) { return static_cast<std::size_t>(axis.cells); }

std::size_t checked_cells(std::initializer_list<LightMapAxis> axes) {
    std::size_t texels = 1;
    for (const LightMapAxis& axis : axes) {
        if (axis.cells < 1 || !(axis.to_m > axis.from_m) || !std::isfinite(axis.to_m - axis.from_m) || !(axis.growth >= 1.0) ||
            !std::isfinite(axis.growth))
            throw std::invalid_argument(
                fmt::format("light map: {} cells from {} to {} m growing by {}, expected at least 1, ascending, 1 or more", axis.cells,
                            axis.from_m, axis.to_m, axis.growth));
        texels *= cells(axis);
        if (texels > max_texels_of_all)
            throw std::invalid_argument(fmt::format("light map: more than {} texels", max_texels_of_all));
    }
    return texels;
}

double texel_m(const LightMapAxis& axis, std::size_t index) {
    return position_m(axis, (static_cast<double>(index) + 0.5) / static_cast<double>(axis.cells));
}
double border_m(const LightMapAxis& axis, std::size_t index) {
    return position_m(axis, static_cast<double>(index + 1) / static_cast<double>(axis.cells));
}

struct Place {
    std::size_t lower = 0, upper = 0;
    double share = 0.0; ///< of the upper one
};

/// nullopt: outside the axis.
std::optional<Place> place_on(const LightMapAxis& axis, double at_m) {
    const double u = texture_coordinate(axis, at_m);
    if (!(u >= 0.0 && u <= 1.0))
        return std::nullopt;
    const double texel = std::clamp(u * axis.cells - 0.5, 0.0, axis.cells - 1.0);
    const auto lower = static_cast<std::size_t>(texel);
    return Place{lower, std::min(lower + 1, cells(axis) - 1), texel - static_cast<double>(lower)};
}

/// Linear along `ahead` within the row that starts at `first`.
double in_row(const std::vector<float>& lx, std::size_t first, const Place& ahead) {
    return static_cast<double>(lx[first + ahead.lower]) * (1.0 - ahead.share) + static_cast<double>(lx[first + ahead.upper]) * ahead.share;
}

/// One row's samples of (truth, looked up).
struct ErrorSamples {
    double worst_lx = 0.0;
    std::vector<double> relative;

    void add(double truth, double found) {
        worst_lx = std::max(worst_lx, std::abs(found - truth));
        if (truth >= lit_lx)
            relative.push_back(std::abs(found - truth) / truth);
    }
};

LightMapError summary(std::vector<ErrorSamples>& rows) {
    LightMapError error;
    std::vector<double> relative;
    for (const ErrorSamples& row : rows) {
        error.worst_lx = std::max(error.worst_lx, row.worst_lx);
        relative.insert(relative.end(), row.relative.begin(), row.relative.end());
    }
    if (relative.empty())
        return error;
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.95 * static_cast<double>(relative.size()))) - 1;
    std::nth_element(relative.begin(), relative.begin() + rank, relative.end());
    error.p95_relative = relative[static_cast<std::size_t>(rank)];
    return error;
}

/// `light_lx`: at a point in the car's frame.
template <class Light> LightMap baked(LightMap map, const Light& light_lx) {
    map.lx.resize(checked_cells({map.ahead, map.left, map.up}));
    oneapi::tbb::parallel_for(std::size_t{0}, cells(map.up) * cells(map.left), [&](std::size_t row) {
        const double left = texel_m(map.left, row % cells(map.left)), up = texel_m(map.up, row / cells(map.left));
        for (std::size_t i = 0; i < cells(map.ahead); ++i)
            map.lx[row * cells(map.ahead) + i] = static_cast<float>(light_lx({texel_m(map.ahead, i), left, up}));
    });
    const bool flat = map.up.cells == 1;
    const std::size_t rows_a_layer = cells(map.left) - 1;
    std::vector<ErrorSamples> rows((flat ? 1 : cells(map.up) - 1) * rows_a_layer);
    oneapi::tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t row) {
        const double left = border_m(map.left, row % rows_a_layer), up = flat ? texel_m(map.up, 0) : border_m(map.up, row / rows_a_layer);
        for (std::size_t i = 0; i + 1 < cells(map.ahead); ++i) {
            const glm::dvec3 point{border_m(map.ahead, i), left, up};
            rows[row].add(light_lx(point), mapped_lx(map, point));
        }
    });
    map.error = summary(rows);
    return map;
}

} // namespace

double position_m(const LightMapAxis& axis, double u) {
    const double log_growth = std::log(axis.growth);
    const double share = log_growth < 1e-9 ? u : std::expm1(log_growth * u) / std::expm1(log_growth);
    return axis.from_m + (axis.to_m - axis.from_m) * share;
}

double texture_coordinate(const LightMapAxis& axis, double at_m) {
    const double share = (at_m - axis.from_m) / (axis.to_m - axis.from_m), log_growth = std::log(axis.growth);
    return log_growth < 1e-9 ? share : std::log1p(share * std::expm1(log_growth)) / log_growth;
}

LightMap bake_ground(const Moment& moment, const GroundMapExtent& extent) {
    Moment local;
    local.lamps = shining_in(moment.ego, moment.lamps);
    return baked({extent.ahead, extent.left, {-0.5, 0.5, 1, 1.0}, {}, {}}, [&](const glm::dvec3& point_m) {
        return surface_illuminance_lx(local, point_m, {0.0, 0.0, 1.0});
    });
}

LightMap bake_volume(const Moment& moment, const VolumeMapExtent& extent) {
    Moment local;
    local.lamps = shining_in(moment.ego, moment.lamps);
    return baked({extent.ahead, extent.left, extent.up, {}, {}}, [&](const glm::dvec3& point_m) { return facing_lx(local, point_m); });
}

double mapped_lx(const LightMap& map, const glm::dvec3& point_m) {
    const std::optional<Place> ahead = place_on(map.ahead, point_m.x), left = place_on(map.left, point_m.y),
                               up = place_on(map.up, point_m.z);
    if (!ahead || !left || !up)
        return 0.0;
    const auto in_layer = [&](std::size_t layer) {
        const std::size_t first = layer * cells(map.left);
        return in_row(map.lx, (first + left->lower) * cells(map.ahead), *ahead) * (1.0 - left->share) +
               in_row(map.lx, (first + left->upper) * cells(map.ahead), *ahead) * left->share;
    };
    return in_layer(up->lower) * (1.0 - up->share) + in_layer(up->upper) * up->share;
}

} // namespace fernlicht
