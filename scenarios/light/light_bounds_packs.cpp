#include "scenarios/light/light_bounds_packs.h"

#include "scenarios/packs/photometry.h"

namespace fernlicht::packs::FERNLICHT_LEVEL {
namespace {

using photometry::vec2, photometry::vec3;

constexpr float infinity = __builtin_huge_valf(), not_a_number = __builtin_nanf("");
/// Of a cosine: normals and directions of floats, and their product, are off by 7 u together, u = 6e-8.
constexpr double cosine_error = 1e-6;
/// Of what a lamp's place on the other side of the point's plane is told by: 6 u of the distance.
constexpr double side_error = 1e-6;
/// Of the some twenty operations between an intensity and an illuminance, each off by u at most. Each lamp adds one more.
constexpr float rounding = 2e-6F, half_ulp = 6e-8F;
/// Where quick_asin_half() ends to be an arcsine.
constexpr double steepest_sine = 0.5;

vec3 of_three(const float* in_each) { return {in_each[0], in_each[1], in_each[2]}; }

/// Rounded once, but for what the point is raised by: 6e-8 of that.
Floats less(double from, const double* m, const float* normal, double raised_m) {
    alignas(sizeof(FloatLanes)) float difference[lanes];
    for (std::size_t i = 0; i < lanes; ++i)
        difference[i] = static_cast<float>(from - (m[i] + raised_m * static_cast<double>(normal[i])));
    return load(difference);
}
Floats less(double from, const double* m) {
    alignas(sizeof(FloatLanes)) float difference[lanes];
    for (std::size_t i = 0; i < lanes; ++i)
        difference[i] = static_cast<float>(from - m[i]);
    return load(difference);
}

struct Bounds {
    Floats low, high;
};

/// Cell, and share of it.
struct Place {
    Ints cell;
    Floats share;
};

/// An angle from the axis's first on; what lies beside the axis is taken for its end.
Place place_on(const BeamAxis& axis, Floats angle) {
    const Floats inside = min(axis.span_rad, max(0.0, angle));
    const Ints bucket = min(to_ints(inside * axis.buckets_per_rad), Ints(axis.last_bucket));
    const Pair line = gather_pair(axis.start_and_per_rad, bucket + bucket);
    const Floats position = line.first + line.second * inside;
    const Ints cell = max(Ints(0), min(to_ints(position), Ints(axis.last_cell)));
    return {cell, position - to_floats(cell)};
}

struct Beside {
    Mask inside, border; ///< surely on the axis, or so near its end that it cannot be told
};

Beside beside(const BeamAxis& axis, Floats angle) {
    const Floats span = axis.span_rad, error = axis.error_rad;
    const Floats within = min(angle, span - angle);
    return {within > error, !(within < -error)};
}

/// Intensity towards a point that lies at `from_lamp`, 1 / inverse_d away.
Bounds intensity(const BoundedLamp& lamp, const vec3& from_lamp, Floats inverse_d) {
    const vec3 w = photometry::lamp_space(from_lamp, of_three(lamp.right), of_three(lamp.up), of_three(lamp.forward));
    const vec2 angles = photometry::quick_goniometer_angles(w, inverse_d, false);
    const Floats h = angles.x - lamp.h.first_rad, v = angles.y - lamp.v.first_rad;
    const Beside beside_h = beside(lamp.h, h), beside_v = beside(lamp.v, v);
    const Floats ahead = w.z * inverse_d;
    const Mask flat = abs(w.y * inverse_d) < steepest_sine;
    const Mask dark = ahead < -side_error || (flat && ahead > side_error && !(beside_h.border && beside_v.border));
    const Mask known = flat && ahead > side_error && beside_h.inside && beside_v.inside;
    const Floats none = 0.0;
    if (!any(known))
        return {none, select(dark, none, infinity)};
    const Place column = place_on(lamp.h, h), row = place_on(lamp.v, v);
    const Ints below = row.cell * Ints(lamp.columns) + column.cell;
    const Pair lower = gather_pair(lamp.cd, below), upper = gather_pair(lamp.cd + lamp.columns, below);
    const Floats cd = photometry::bilinear(lower.first, lower.second, upper.first, upper.second, vec2(column.share, row.share));
    const Floats error = lamp.error_cd;
    return {select(known, max(none, cd - error), none), select(known, cd + error, select(dark, none, infinity))};
}

template <bool on_surface>
void bound(const BoundedLight& light, float enough_lx, const BoundedPlaces& places, std::size_t count, FoundBounds& found) {
    const Floats none = 0.0, slack = rounding + half_ulp * static_cast<float>(light.lamp_count);
    const Floats extinction = light.extinction_per_m;
    for (std::size_t first = 0; first < count; first += lanes) {
        const auto to = [&](const BoundedLamp& lamp) {
            const double *x = places.x_m + first, *y = places.y_m + first, *z = places.z_m + first, *m = lamp.position_m;
            if constexpr (on_surface)
                return vec3(less(m[0], x), less(m[1], y), less(m[2], z));
            const double raised_m = static_cast<double>(places.raised_m);
            return vec3(less(m[0], x, places.normal_x + first, raised_m), less(m[1], y, places.normal_y + first, raised_m),
                        less(m[2], z, places.normal_z + first, raised_m));
        };
        vec3 normal;
        Bounds sum{none, none};
        if constexpr (on_surface) {
            normal = {load(places.normal_x + first), load(places.normal_y + first), load(places.normal_z + first)};
            const Floats direct = light.direct_lx, sky = light.sky_lx;
            const Floats e = photometry::sky_illuminance(sky, normal) +
                             photometry::directional_illuminance(direct, normal, of_three(light.direct_towards));
            const Floats error = cosine_error * (sky + direct);
            sum = {max(none, e - error), e + error};
            Floats most = sum.high;
            for (std::size_t i = 0; i < light.lamp_count; ++i) {
                const vec3 to_lamp = to(light.lamps[i]);
                const Floats inverse_d = inversesqrt(photometry::dot(to_lamp, to_lamp));
                const Floats cosine = max(none, photometry::dot(normal, to_lamp) * inverse_d + cosine_error);
                most += light.lamps[i].factor * light.lamps[i].peak_cd * inverse_d * inverse_d * cosine;
            }
            most = most * (1.0 + slack);
            if (!any(!(most < enough_lx))) {
                store(none, found.low_lx + first);
                store(most, found.high_lx + first);
                continue;
            }
        }
        for (std::size_t i = 0; i < light.lamp_count; ++i) {
            const vec3 to_lamp = to(light.lamps[i]);
            Floats inverse_d = inversesqrt(photometry::dot(to_lamp, to_lamp));
            if constexpr (!on_surface) // nearer than raised, where that counts; not a number: nothing is known
                inverse_d = select(inverse_d * places.raised_m < 1.0, inverse_d, not_a_number);
            const Floats by_distance = light.lamps[i].factor * inverse_d * inverse_d;
            Bounds share{by_distance, by_distance};
            if (light.extinction_per_m > 0.0F) {
                const Floats depth = extinction / inverse_d, left = photometry::exp(-depth), off = 5e-7 * (1.0 + depth);
                share = {share.low * max(none, left * (1.0 - off) - 1e-37), share.high * (left * (1.0 + off) + 1e-37)};
            }
            const Bounds cd = intensity(light.lamps[i], none - to_lamp, inverse_d);
            if constexpr (on_surface) {
                const Floats cosine = photometry::dot(normal, to_lamp) * inverse_d;
                share = {share.low * max(none, cosine - cosine_error), share.high * max(none, cosine + cosine_error)};
                sum.low += cd.low * share.low;
                sum.high += select(share.high > none, cd.high * share.high, none);
            } else {
                sum.low += cd.low * share.low;
                sum.high += select(cd.high > none, cd.high * share.high, none);
            }
        }
        store(sum.low * (1.0 - slack), found.low_lx + first);
        store(sum.high * (1.0 + slack), found.high_lx + first);
    }
}

} // namespace

void bound_surface_lx(const BoundedLight& light, float enough_lx, const BoundedPlaces& places, std::size_t count, FoundBounds& found) {
    bound<true>(light, enough_lx, places, count, found);
}

void bound_target_lx(const BoundedLight& light, const BoundedPlaces& places, std::size_t count, FoundBounds& found) {
    bound<false>(light, 0.0F, places, count, found);
}

} // namespace fernlicht::packs::FERNLICHT_LEVEL
