#include "scenarios/light/light_bounds.h"

#include "scenarios/light/light.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace fernlicht {
namespace {

/// Half a unit in the last place of a float.
constexpr double half_ulp = 6e-8;
/// Of quick_goniometer_angles(): 1e-7 rad, and 5e-7 in float. Of its argument: axes, points and lamp_space() in float are off by 6 u of the
/// distance, which is 6e-7 rad of an angle up to 30 degrees beside the horizon. The rest is reserve.
constexpr double direction_error_rad = 2e-6;
/// An axis is cut into buckets no wider than its finest cell, up to so many.
constexpr double most_buckets = 16384.0;

/// The largest differences between neighbouring samples along one axis.
struct Steepest {
    double cd = 0.0, cd_per_rad = 0.0;
};

void larger_differences(const double* a, const double* b, std::size_t count, double* __restrict most) {
    for (std::size_t i = 0; i < count; ++i) {
        const double difference = std::abs(b[i] - a[i]);
        most[i] = most[i] < difference ? difference : most[i];
    }
}

Steepest steepest_of(const CandelaTable& table, bool vertical) {
    const std::vector<double>& axis = vertical ? table.v_deg : table.h_deg;
    const std::size_t columns = table.h_deg.size();
    std::vector<double> most_cd(axis.size() - 1), across(columns);
    for (std::size_t v = 0; v + (vertical ? 1 : 0) < table.v_deg.size(); ++v) {
        const double *here = &table.cd[v * columns], *next = here + (vertical ? columns : 1);
        // Column by column, which compilers do several at a time.
        std::vector<double>& most = vertical ? across : most_cd;
        if (vertical)
            std::ranges::fill(across, 0.0);
        larger_differences(here, next, columns - (vertical ? 0 : 1), most.data());
        if (vertical)
            most_cd[v] = *std::ranges::max_element(across);
    }
    Steepest steepest;
    for (std::size_t cell = 0; cell < most_cd.size(); ++cell) {
        steepest.cd = std::max(steepest.cd, most_cd[cell]);
        steepest.cd_per_rad = std::max(steepest.cd_per_rad, most_cd[cell] / radians(axis[cell + 1] - axis[cell]));
    }
    return steepest;
}

/// As few buckets as let every sample lie between two of them, but for rounding; or as many as there may be.
double buckets_over(const std::vector<double>& samples) {
    const double range = samples.back() - samples.front(), finest = finest_step(samples);
    for (const double part : {1.0, 2.0, 3.0, 4.0, 5.0}) {
        const double buckets = std::round(range * part / finest);
        if (buckets > most_buckets)
            break;
        if (std::ranges::all_of(samples, [&](double sample) {
                const double place = (sample - samples.front()) / range * buckets;
                return std::abs(place - std::round(place)) < 1e-6;
            }))
            return buckets;
    }
    return std::clamp(std::ceil(range / finest), 1.0, most_buckets);
}

} // namespace

/// Within a bucket the position between samples runs straight from that of one end to that of the other. Where a sample lies inside, the
/// position belongs to another angle of the same bucket.
LightBounds::Axis::Axis(const std::vector<double>& samples_deg) {
    const double range = radians(samples_deg.back() - samples_deg.front()), buckets = buckets_over(samples_deg), width = range / buckets;
    std::size_t cell = 0;
    bool broken = false;
    double steepest = 1.0 / radians(finest_step(samples_deg)), before = 0.0;
    for (double bucket = 0.0; bucket < buckets; bucket += 1.0) {
        const double end_deg = std::min(samples_deg.front() + degrees((bucket + 1.0) * width), samples_deg.back());
        const std::size_t first_cell = cell;
        while (cell + 2 < samples_deg.size() && samples_deg[cell + 1] < end_deg - 1e-9)
            ++cell;
        const double at_end = static_cast<double>(cell) + (end_deg - samples_deg[cell]) / (samples_deg[cell + 1] - samples_deg[cell]);
        const double per = (at_end - before) / width;
        broken = broken || (cell != first_cell && before < static_cast<double>(cell) - 1e-6);
        start_and_per_rad.push_back(static_cast<float>(before - per * bucket * width));
        start_and_per_rad.push_back(static_cast<float>(per));
        steepest = std::max(steepest, per);
        before = at_end;
    }
    const double first_rad = radians(samples_deg.front());
    // The angle's difference from the first is rounded twice. The bucket's number as well, which may make it the one beside, whose line
    // then goes on too far; start, per_rad, their product and their sum are rounded once each.
    error_rad = direction_error_rad + half_ulp * (std::abs(first_rad) + 2.0 * range);
    blur_rad = error_rad + (broken ? width : 0.0);
    blur_cells = half_ulp * (2.0 * static_cast<double>(samples_deg.size()) + 5.0 * range * steepest);
    in_packs = {.first_rad = static_cast<float>(first_rad),
                .span_rad = static_cast<float>(range),
                .buckets_per_rad = static_cast<float>(1.0 / width),
                .error_rad = static_cast<float>(error_rad),
                .start_and_per_rad = nullptr,
                .last_bucket = static_cast<std::int32_t>(buckets) - 1,
                .last_cell = static_cast<std::int32_t>(samples_deg.size()) - 2};
}

LightBounds::Table::Table(const CandelaTable& table)
    : h(table.h_deg), v(table.v_deg), cd(table.cd.begin(), table.cd.end()), peak_cd(*std::ranges::max_element(table.cd)) {
    const bool continuous = table.gaps.empty() && table.rule == BetweenSamples::linear_cd;
    constexpr double rounding = 1e-6; // bilinear() in float, and the samples
    error_cd = continuous ? rounding * peak_cd : std::numeric_limits<double>::infinity();
    for (const bool vertical : {false, true}) {
        const Steepest steepest = steepest_of(table, vertical);
        const Axis& axis = vertical ? v : h;
        error_cd += steepest.cd_per_rad * axis.blur_rad + steepest.cd * axis.blur_cells;
    }
}

LightBounds::LightBounds(const Moment& moment, packs::Level level) : level_(level) {
    std::map<const LampFile*, std::size_t> known;
    std::vector<std::size_t> table_of;
    const auto three = [](const glm::dvec3& from, auto& to) {
        for (int i = 0; i < 3; ++i)
            to[i] = static_cast<std::remove_reference_t<decltype(to[i])>>(from[i]);
    };
    for (const LitLamp& lit : moment.lamps) {
        if (lit.intensity_factor == 0.0)
            continue;
        const auto [place, is_new] = known.try_emplace(lit.file.get(), tables_.size());
        if (is_new)
            tables_.emplace_back(lit.file->table);
        table_of.push_back(place->second);
        packs::BoundedLamp& lamp = lamps_.emplace_back();
        three(lit.pose.position_m, lamp.position_m);
        three(-lit.pose.left(), lamp.right);
        three(lit.pose.up(), lamp.up);
        three(lit.pose.forward(), lamp.forward);
        lamp.factor = static_cast<float>(lit.intensity_factor);
    }
    for (std::size_t i = 0; i < lamps_.size(); ++i) {
        const Table& table = tables_[table_of[i]];
        const auto axis = [](const Axis& of) {
            packs::BeamAxis result = of.in_packs;
            result.start_and_per_rad = of.start_and_per_rad.data();
            return result;
        };
        packs::BoundedLamp& lamp = lamps_[i];
        lamp.peak_cd = static_cast<float>(table.peak_cd);
        lamp.error_cd = static_cast<float>(table.error_cd);
        lamp.cd = table.cd.data();
        lamp.columns = static_cast<std::int32_t>(table.h.in_packs.last_cell + 2);
        lamp.h = axis(table.h);
        lamp.v = axis(table.v);
    }
    const DirectLight* direct = moment.daylight.direct();
    light_.extinction_per_m = static_cast<float>(moment.weather.extinction_per_m);
    light_.sky_lx = static_cast<float>(moment.daylight.horizontal_illuminance_lx);
    light_.direct_lx = direct ? static_cast<float>(direct->illuminance_lx) : 0.0F;
    three(direct ? direct->towards() : glm::dvec3(0.0), light_.direct_towards);
}

SurfacePlaces::SurfacePlaces(std::size_t count) {
    for (std::vector<double>* each : {&x_m, &y_m, &z_m})
        each->resize(count + packs::most_lanes);
    for (std::vector<float>* each : {&normal_x, &normal_y, &normal_z})
        each->resize(count + packs::most_lanes);
}

void SurfacePlaces::put(std::size_t first, std::span<const Pose> surface) {
    for (std::size_t i = 0; i < surface.size(); ++i) {
        const glm::dvec3 &place = surface[i].position_m, &normal = surface[i].up();
        x_m[first + i] = place.x;
        y_m[first + i] = place.y;
        z_m[first + i] = place.z;
        normal_x[first + i] = static_cast<float>(normal.x);
        normal_y[first + i] = static_cast<float>(normal.y);
        normal_z[first + i] = static_cast<float>(normal.z);
    }
}

template <class Bound> void LightBounds::bound(const SurfacePlaces& places, std::size_t first, double raised_m, std::span<LuxBounds> bounds,
                                               Bound bound_places) const {
    packs::BoundedLight light = light_;
    light.lamps = lamps_.data();
    light.lamp_count = lamps_.size();
    packs::FoundBounds found;
    for (std::size_t done = 0; done < bounds.size(); done += packs::FoundBounds::count) {
        const std::size_t count = std::min(packs::FoundBounds::count, bounds.size() - done), at = first + done;
        bound_places(light,
                     packs::BoundedPlaces{&places.x_m[at], &places.y_m[at], &places.z_m[at], &places.normal_x[at], &places.normal_y[at],
                                          &places.normal_z[at], static_cast<float>(raised_m)},
                     count, found);
        for (std::size_t i = 0; i < count; ++i)
            bounds[done + i] = {static_cast<double>(found.low_lx[i]), static_cast<double>(found.high_lx[i])};
    }
}

void LightBounds::surface_lx(const SurfacePlaces& places, std::size_t first, double enough_lx, std::span<LuxBounds> bounds) const {
    bound(places, first, 0.0, bounds, [&](const auto& light, const auto& some, std::size_t count, packs::FoundBounds& found) {
        AT_LEVEL(level_, bound_surface_lx)(light, static_cast<float>(enough_lx), some, count, found);
    });
}

void LightBounds::target_lx(const SurfacePlaces& places, std::size_t first, double height_m, std::span<LuxBounds> bounds) const {
    bound(places, first, height_m, bounds, [&](const auto& light, const auto& some, std::size_t count, packs::FoundBounds& found) {
        AT_LEVEL(level_, bound_target_lx)(light, some, count, found);
    });
}

} // namespace fernlicht
