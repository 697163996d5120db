#include "renderer/reference/pixel_estimate.h"

#include "renderer/reference/path.h"
#include "renderer/reference/solved_light.h"
#include "renderer/reference/whitted.h"

#include <algorithm>
#include <bit>

namespace fernlicht::reference {

bool is_direct(const ReferenceSettings& s) { return s.integrator == Integrator::direct || s.integrator == Integrator::whitted; }

void add_packet(const Shot& shot, const std::array<SamplePoint, packet_size>& points, const std::array<Ray, packet_size>& rays,
                LaneMask lanes, PacketLight& light, Drawing& drawing) {
    light_packet(shot, points, rays, lanes, is_direct(shot.settings), light, drawing.shadows);
    switch (shot.settings.integrator) {
    case Integrator::direct:
        break;
    case Integrator::path:
        add_path_light(shot, points, rays, lanes, light);
        break;
    case Integrator::whitted:
        add_whitted_light(shot, points, light);
        break;
    case Integrator::radiosity:
    case Integrator::photon_map:
        add_solved_light(shot, points, light);
        break;
    }
    for (std::size_t i = 0; i < packet_size; ++i) {
        drawing.sums[0][i] += light.illuminance_lx[i];
        drawing.sums[1][i] += light.target_lx[i];
        drawing.sums[2][i] += light.luminance_cdm2[i];
    }
    drawing.seen.add(light, lanes);
    drawing.rays += light.rays;
}

namespace {

constexpr LaneMask all_lanes = 0xFFFF;

/// `each` points of sixteen nets; or, `of_one_net`, one point a lane, which covers the pixel evenly and says little about their mean.
Drawing draw_pixel(const Shot& shot, int x, int y, std::uint64_t round, bool of_one_net, int each) {
    Drawing drawing(shot);
    const std::uint64_t pixel =
                            static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(shot.view.width_px) + static_cast<std::uint64_t>(x),
                        key = mixed(mixed(shot.settings.seed, pixel), round);
    std::array<SamplePoint, packet_size> points;
    std::array<Ray, packet_size> rays;
    PacketLight light;
    const bool at_centre = shot.settings.footprint == Footprint::centre;
    for (int k = 0; k < each; ++k) {
        shot.leave_if_asked();
        for (std::size_t i = 0; i < packet_size; ++i) {
            points[i] = {PointNet(mixed(key, of_one_net ? 0 : i)),
                         static_cast<std::uint32_t>(of_one_net ? i : static_cast<std::size_t>(k))};
            const glm::dvec2 place = at_centre ? glm::dvec2(0.5) : points[i].pair(0);
            rays[i] = shot.ray_through(x + place.x, y + place.y);
        }
        add_packet(shot, points, rays, all_lanes, light, drawing);
    }
    return drawing;
}

/// As solved beforehand: more samples a pixel do not lessen the noise of that.
bool as_solved(const ReferenceSettings& s) {
    return (s.integrator == Integrator::radiosity || s.integrator == Integrator::photon_map) && !s.solver.final_gather;
}

/// How the error is expected to fall with more samples (replicates.h).
double falling_power(const Shot& shot, const Drawing& drawing) {
    if (!is_direct(shot.settings))
        return 1.0;
    return drawing.mixed() != 0 || shot.settings.lamp_radius_m > 0.0 ? 1.5 : 2.0;
}

double target_of(const Shot& shot, std::size_t result, double mean) {
    return shot.settings.target_error * std::max(mean, result == 2 ? shot.settings.floor_cdm2 : shot.settings.floor_lx);
}

/// A path's light may come from a small part of all directions: 64 samples in the pilot and 128 in the mean miss 1/25 of them once in 3000.
constexpr int path_pilot_each = 4, path_least_each = 8;

/// Beside an edge: 128 samples miss what covers 1/32 of the pixel once in 60.
constexpr int edge_least_each = 8;

int least_each(const ReferenceSettings& s) {
    const int asked = static_cast<int>(std::bit_ceil((static_cast<unsigned>(s.least_samples) + 15) / 16));
    return !is_direct(s) ? std::max(asked, path_least_each) : asked;
}
int most_each(const ReferenceSettings& s) {
    if (as_solved(s))
        return least_each(s);
    return std::max(least_each(s), static_cast<int>(std::bit_floor(static_cast<unsigned>(s.most_samples) / 16)));
}

} // namespace

int most_samples_used(const ReferenceSettings& s) { return most_each(s) * static_cast<int>(replicate_count); }

Drawing pilot_of(const Shot& shot, int x, int y) {
    const bool is_path = !is_direct(shot.settings);
    return draw_pixel(shot, x, y, 0, !is_path, is_path ? path_pilot_each : 1);
}

bool differ(const Drawing& a, const Drawing& b) {
    return a.seen.mesh != b.seen.mesh || a.seen.material != b.seen.material || a.shadows.seen != b.shadows.seen;
}

PixelEstimate estimate_pixel(const Shot& shot, int x, int y, const Drawing& pilot, bool at_edge) {
    const int most = most_each(shot.settings), pilot_each = is_direct(shot.settings) ? 1 : path_pilot_each;
    PixelEstimate estimate{{}, std::min(most, std::max(least_each(shot.settings), at_edge ? edge_least_each : 1)), 0, 0};
    for (std::size_t r = 0; r < 3; ++r) {
        const auto [mean, error] = mean_of(pilot.sums[r], pilot_each);
        estimate.each = std::max(estimate.each, samples_for(error, target_of(shot, r, mean), falling_power(shot, pilot), pilot_each, most));
    }
    for (std::uint64_t round = 1;; ++round) {
        const Drawing drawing = draw_pixel(shot, x, y, round, false, estimate.each);
        estimate.rays += drawing.rays;
        int wanted = estimate.each;
        for (std::size_t r = 0; r < 3; ++r) {
            estimate.result[r] = mean_of(drawing.sums[r], estimate.each);
            const auto [mean, error] = estimate.result[r];
            const double target = target_of(shot, r, mean);
            if (error > target)
                wanted = std::max(wanted, samples_for(error, target, falling_power(shot, drawing), estimate.each, most));
        }
        estimate.mixed = drawing.mixed();
        if (wanted == estimate.each)
            return estimate;
        estimate.each = wanted;
    }
}

} // namespace fernlicht::reference
