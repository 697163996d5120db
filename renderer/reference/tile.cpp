#include "renderer/reference/tile.h"

#include "renderer/reference/lanes.h"
#include "renderer/reference/path.h"
#include "renderer/reference/replicates.h"
#include "renderer/reference/solved_light.h"
#include "renderer/reference/whitted.h"

#include <algorithm>
#include <bit>

namespace fernlicht::reference {
namespace {

static_assert(tile_px == packet_size, "a row of a tile is a packet of rays through pixels' centres");
constexpr LaneMask all_lanes = 0xFFFF;

/// Illuminance, target, luminance.
using Results = std::array<Lanes, 3>;

struct Seen {
    bool several = false, anything = false;
    std::uint32_t mesh = 0, material = 0;

    void add(const PacketLight& light, LaneMask lanes) {
        for (std::size_t i = 0; i < packet_size; ++i) {
            if (!in_mask(lanes, i))
                continue;
            const bool hit = in_mask(light.hit, i);
            const std::uint32_t m = hit ? light.hits[i].mesh + 1 : 0, kind = hit ? light.hits[i].material : 0;
            several |= anything && (m != mesh || kind != material);
            anything = true, mesh = m, material = kind;
        }
    }
};

/// One pixel's drawing: its results summed over `each` points of every lane's net.
struct Drawing {
    Results sums{};
    Seen seen;
    ShadowTally shadows;
    std::uint64_t rays = 0;

    std::uint8_t mixed() const {
        return static_cast<std::uint8_t>((seen.several ? several_surfaces : 0) | (shadows.edge() ? shadow_edge : 0));
    }
};

ShadowTally empty_tally(const Shot& shot) { return {std::vector<std::uint8_t>(2 * shot.moment.lamps.size(), 0)}; }

/// One ray a sample and feelers; the sky is a share.
bool is_direct(const ReferenceSettings& s) { return s.integrator == Integrator::direct || s.integrator == Integrator::whitted; }
/// As solved beforehand: more samples a pixel do not lessen the noise of that.
bool as_solved(const ReferenceSettings& s) {
    return (s.integrator == Integrator::radiosity || s.integrator == Integrator::photon_map) && !s.solver.final_gather;
}

void add_packet(const Shot& shot, const std::array<SamplePoint, packet_size>& points, const std::array<Ray, packet_size>& rays,
                LaneMask lanes, PacketLight& light, Drawing& drawing) {
    light_packet(shot, points, rays, lanes, is_direct(shot.settings), light, drawing.shadows);
    switch (shot.settings.integrator) {
    case Integrator::direct:
        break;
    case Integrator::path:
        add_path_light(shot, points, light);
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

/// `each` points of sixteen nets; or, `of_one_net`, one point a lane, which covers the pixel evenly and says little about their mean.
Drawing draw_pixel(const Shot& shot, int x, int y, std::uint64_t round, bool of_one_net, int each) {
    Drawing drawing;
    drawing.shadows = empty_tally(shot);
    const std::uint64_t pixel =
                            static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(shot.view.width_px) + static_cast<std::uint64_t>(x),
                        key = mixed(mixed(shot.settings.seed, pixel), round);
    std::array<SamplePoint, packet_size> points;
    std::array<Ray, packet_size> rays;
    PacketLight light;
    const bool at_centre = shot.settings.footprint == Footprint::centre;
    for (int k = 0; k < each; ++k) {
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

int least_each(const ReferenceSettings& s) {
    const int asked = static_cast<int>(std::bit_ceil((static_cast<unsigned>(s.least_samples) + 15) / 16));
    return !is_direct(s) ? std::max(asked, path_least_each) : asked;
}
int most_each(const ReferenceSettings& s) {
    if (as_solved(s))
        return least_each(s);
    return std::max(least_each(s), static_cast<int>(std::bit_floor(static_cast<unsigned>(s.most_samples) / 16)));
}

struct PixelEstimate {
    std::array<MeanAndError, 3> result;
    int each = 0;
    std::uint8_t mixed = 0;
    std::uint64_t rays = 0;
};

PixelEstimate estimate_pixel(const Shot& shot, int x, int y) {
    const int most = most_each(shot.settings);
    const bool is_path = !is_direct(shot.settings);
    const int pilot_each = is_path ? path_pilot_each : 1;
    Drawing drawing = draw_pixel(shot, x, y, 0, !is_path, pilot_each);
    PixelEstimate estimate{{}, least_each(shot.settings), 0, drawing.rays};
    for (std::size_t r = 0; r < 3; ++r) {
        const auto [mean, error] = mean_of(drawing.sums[r], pilot_each);
        estimate.each =
            std::max(estimate.each, samples_for(error, target_of(shot, r, mean), falling_power(shot, drawing), pilot_each, most));
    }
    for (std::uint64_t round = 1;; ++round) {
        drawing = draw_pixel(shot, x, y, round, false, estimate.each);
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

/// What every pixel has, its samples' number last: a pixel counts as drawn by it.
void store(ReferenceImage& image, int x, int y, const std::array<MeanAndError, 3>& result, std::uint8_t mixed, int samples) {
    const std::array<Estimate*, 3> estimates{&image.illuminance_lx, &image.target_lx, &image.luminance_cdm2};
    for (std::size_t r = 0; r < 3; ++r)
        if (!estimates[r]->mean.empty()) {
            estimates[r]->mean.at(x, y) = static_cast<float>(result[r].mean);
            estimates[r]->standard_error.at(x, y) = static_cast<float>(result[r].standard_error);
        }
    image.mixed.at(x, y) = mixed;
    image.samples.at(x, y) = static_cast<std::uint32_t>(samples);
}

/// Rays through the centres of a row of pixels.
struct CentreRow {
    std::array<Ray, packet_size> rays;
    LaneMask lanes = 0;
};
CentreRow centre_row(const Shot& shot, int x0, int y, int width) {
    CentreRow row;
    for (int i = 0; i < width; ++i) {
        row.rays[static_cast<std::size_t>(i)] = shot.ray_through(x0 + i + 0.5, y + 0.5);
        row.lanes |= 1U << i;
    }
    return row;
}

/// Nothing is left to chance: one ray a pixel, no noise.
bool is_certain(const ReferenceSettings& settings) {
    return settings.footprint == Footprint::centre && is_direct(settings) && settings.lamp_radius_m <= 0.0;
}

std::uint64_t draw_certain_row(const Shot& shot, const CentreRow& row, int x0, int y, ReferenceImage& image) {
    Drawing drawing;
    drawing.shadows = empty_tally(shot);
    PacketLight light;
    add_packet(shot, {}, row.rays, row.lanes, light, drawing);
    for (std::size_t i = 0; i < packet_size && in_mask(row.lanes, i); ++i) {
        const int x = x0 + static_cast<int>(i);
        store(image, x, y, {{{drawing.sums[0][i], 0.0}, {drawing.sums[1][i], 0.0}, {drawing.sums[2][i], 0.0}}}, 0, 1);
        image.ids.at(x, y) = in_mask(light.hit, i) ? light.hits[i].mesh + 1 : 0;
    }
    return drawing.rays;
}

std::uint64_t draw_ids(const Shot& shot, const CentreRow& row, int x0, int y, ReferenceImage& image) {
    std::array<SurfaceHit, packet_size> hits;
    const LaneMask hit = shot.embree.cast(row.rays, row.lanes, shot.camera.is_map, hits);
    for (std::size_t i = 0; i < packet_size && in_mask(row.lanes, i); ++i)
        image.ids.at(x0 + static_cast<int>(i), y) = in_mask(hit, i) ? hits[i].mesh + 1 : 0;
    return static_cast<std::uint64_t>(std::popcount(row.lanes));
}

} // namespace

std::uint64_t draw_tile(const Shot& shot, int x0, int y0, ReferenceImage& image) {
    std::uint64_t rays = 0;
    const int width = std::min(tile_px, image.samples.width() - x0);
    for (int y = y0; y < std::min(y0 + tile_px, image.samples.height()); ++y) {
        const CentreRow row = centre_row(shot, x0, y, width);
        if (is_certain(shot.settings)) {
            rays += draw_certain_row(shot, row, x0, y, image);
            continue;
        }
        rays += draw_ids(shot, row, x0, y, image);
        for (int x = x0; x < x0 + width; ++x) {
            const PixelEstimate estimate = estimate_pixel(shot, x, y);
            store(image, x, y, estimate.result, estimate.mixed, estimate.each * static_cast<int>(replicate_count));
            rays += estimate.rays;
        }
    }
    return rays;
}

} // namespace fernlicht::reference
