#include "scenarios/light/light_bounds.h"

#include "scenarios/light/fog_light.h"
#include "scenarios/light/light.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace fernlicht {
namespace {

/// quick_goniometer_angles() is within 1e-7 rad = 5.8e-6 degrees; the rest is for the rounding of both.
constexpr double angle_error_deg = 7e-6;
/// Of the some thirty operations between a table and an illuminance, each off by 1.1e-16 at most.
constexpr double rounding = 1e-12;

/// Where quick_asin_half() ends to be an arcsine.
constexpr double steepest_sine = 0.5;

/// Intensity per degree at most, by the differences between neighbouring samples.
double steepest_cd_per_deg(const CandelaTable& table) {
    double steepest = 0.0;
    for (std::size_t v = 0; v < table.v_deg.size(); ++v)
        for (std::size_t h = 0; h + 1 < table.h_deg.size(); ++h)
            steepest = std::max(steepest, std::abs(table.at(v, h + 1) - table.at(v, h)) / (table.h_deg[h + 1] - table.h_deg[h]));
    double steepest_up = 0.0;
    for (std::size_t v = 0; v + 1 < table.v_deg.size(); ++v) {
        const double per_deg = 1.0 / (table.v_deg[v + 1] - table.v_deg[v]);
        for (std::size_t h = 0; h < table.h_deg.size(); ++h)
            steepest_up = std::max(steepest_up, std::abs(table.at(v + 1, h) - table.at(v, h)) * per_deg);
    }
    return steepest + steepest_up;
}

} // namespace

LightBounds::Axis::Axis(const std::vector<double>& samples_deg) {
    for (std::size_t i = 0; i + 1 < samples_deg.size(); ++i)
        cells.push_back({samples_deg[i], samples_deg[i + 1], 1.0 / (samples_deg[i + 1] - samples_deg[i])});
    const std::size_t buckets = 4 * cells.size();
    buckets_per_deg = static_cast<double>(buckets) / (samples_deg.back() - samples_deg.front());
    std::size_t cell = 0;
    for (std::size_t bucket = 0; bucket <= buckets; ++bucket) {
        const double from_deg = samples_deg.front() + static_cast<double>(bucket) / buckets_per_deg;
        while (cell + 1 < cells.size() && cells[cell].to_deg <= from_deg)
            ++cell;
        first_cell.push_back(static_cast<std::uint32_t>(cell));
    }
}

std::pair<std::size_t, double> LightBounds::Axis::place(double deg) const {
    const auto bucket = static_cast<std::size_t>((deg - cells.front().from_deg) * buckets_per_deg);
    std::size_t cell = first_cell[std::min(bucket, first_cell.size() - 1)];
    while (cells[cell].to_deg <= deg && cell + 1 < cells.size())
        ++cell;
    return {cell, (deg - cells[cell].from_deg) * cells[cell].per_deg};
}

LightBounds::Table::Table(const CandelaTable& candela) : table(&candela), h(candela.h_deg), v(candela.v_deg) {
    peak_cd = *std::ranges::max_element(candela.cd);
    const bool continuous = candela.gaps.empty() && candela.rule == BetweenSamples::linear_cd;
    error_cd = continuous ? steepest_cd_per_deg(candela) * angle_error_deg + rounding * peak_cd : std::numeric_limits<double>::infinity();
}

double LightBounds::Table::linear_cd(double h_deg, double v_deg) const {
    const auto [column, fh] = h.place(h_deg);
    const auto [row, fv] = v.place(v_deg);
    const double* below = &table->cd[row * table->h_deg.size() + column];
    const double* above = below + table->h_deg.size();
    const double lower = below[0] + (below[1] - below[0]) * fh, upper = above[0] + (above[1] - above[0]) * fh;
    return lower + (upper - lower) * fv;
}

LightBounds::LightBounds(const Moment& moment) : daylight_(moment.daylight), weather_(moment.weather) {
    std::map<const LampFile*, std::size_t> known;
    for (const LitLamp& lamp : moment.lamps) {
        if (lamp.intensity_factor == 0.0)
            continue;
        const auto [place, is_new] = known.try_emplace(lamp.file.get(), tables_.size());
        if (is_new)
            tables_.emplace_back(lamp.file->table);
        lamps_.push_back(
            {lamp.pose.position_m, -lamp.pose.left(), lamp.pose.up(), lamp.pose.forward(), lamp.intensity_factor, place->second});
    }
}

LightBounds::Intensity LightBounds::towards(const Lamp& lamp, const glm::dvec3& from_lamp, double inverse_d) const {
    constexpr Intensity unknown{0.0, std::numeric_limits<double>::infinity()};
    const Table& table = tables_[lamp.table];
    const glm::dvec3 w = photometry::lamp_space(from_lamp, lamp.right, lamp.up, lamp.forward);
    if (w.z <= 0.0)
        return {};
    if (!(std::abs(w.y * inverse_d) < steepest_sine))
        return unknown;
    const glm::dvec2 angles = photometry::quick_goniometer_angles(w, inverse_d, false);
    const double h_deg = degrees(angles.x), v_deg = degrees(angles.y);
    const std::vector<double>& h = table.table->h_deg;
    const std::vector<double>& v = table.table->v_deg;
    const double inside_deg =
        std::min(std::min(h_deg - h.front(), h.back() - h_deg), std::min(v_deg - v.front(), v.back() - v_deg)); // negative: outside
    if (inside_deg < -angle_error_deg)
        return {};
    if (!(inside_deg > angle_error_deg))
        return unknown;
    return {lamp.factor * table.linear_cd(h_deg, v_deg), lamp.factor * table.error_cd};
}

LuxBounds LightBounds::surface_lx(const glm::dvec3& point_m, const glm::dvec3& normal, double enough_lx) const {
    const double sky_lx = daylight_illuminance_lx(daylight_, normal);
    double max_lx = sky_lx;
    for (const Lamp& lamp : lamps_) {
        const glm::dvec3 to_lamp = lamp.position_m - point_m;
        const double inverse_d2 = 1.0 / glm::dot(to_lamp, to_lamp);
        max_lx += lamp.factor * tables_[lamp.table].peak_cd * inverse_d2 * std::sqrt(inverse_d2) * std::max(glm::dot(normal, to_lamp), 0.0);
    }
    max_lx *= 1.0 + rounding;
    if (max_lx < enough_lx)
        return {0.0, max_lx};
    return sum(point_m, &normal, sky_lx);
}

LuxBounds LightBounds::target_lx(const glm::dvec3& point_m) const { return sum(point_m, nullptr, 0.0); }

LuxBounds LightBounds::sum(const glm::dvec3& point_m, const glm::dvec3* normal, double e) const {
    double error = 0.0;
    for (const Lamp& lamp : lamps_) {
        const glm::dvec3 to_lamp = lamp.position_m - point_m;
        const double inverse_d = 1.0 / std::sqrt(glm::dot(to_lamp, to_lamp));
        const double cosine = normal ? glm::dot(*normal, to_lamp) * inverse_d : 1.0;
        if (cosine <= 0.0)
            continue;
        const Intensity intensity = towards(lamp, -to_lamp, inverse_d);
        const double share =
            inverse_d * inverse_d * cosine * (weather_.extinction_per_m > 0.0 ? air_transmittance(weather_, 1.0 / inverse_d) : 1.0);
        e += intensity.cd * share;
        error += intensity.error_cd * share;
    }
    error += rounding * e;
    return {std::max(e - error, 0.0), e + error};
}

} // namespace fernlicht
