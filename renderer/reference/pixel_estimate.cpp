#include "renderer/reference/pixel_estimate.h"

#include "renderer/reference/path.h"
#include "renderer/reference/solved_light.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

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

/// How the error is expected to fall with more samples (pixel_estimate.h).
double falling_power(const Shot& shot, const Drawing& drawing) {
    if (!is_direct(shot.settings))
        return 1.0;
    return drawing.mixed() != 0 || shot.settings.lamp_radius_m > 0.0 ? 1.5 : 2.0;
}

double target_of(const Shot& shot, std::size_t result, double mean) {
    return shot.settings.target_error * std::max(mean, result == 2 ? shot.settings.floor_cdm2 : shot.settings.floor_lx);
}

/// A path's light may come from a small part of all directions: 64 samples in the pilot and 128 in the mean miss 1/25 of them once in 3000.
constexpr int path_pilot_each = 4, path_min_each = 8;

/// Beside an edge: 128 samples miss what covers 1/32 of the pixel once in 60.
constexpr int edge_min_each = 8;

int min_each(const ReferenceSettings& s) {
    const int asked = static_cast<int>(std::bit_ceil((static_cast<unsigned>(s.min_samples) + 15) / 16));
    return !is_direct(s) ? std::max(asked, path_min_each) : asked;
}
int max_each(const ReferenceSettings& s) {
    if (as_solved(s))
        return min_each(s);
    return std::max(min_each(s), static_cast<int>(std::bit_floor(static_cast<unsigned>(s.max_samples) / 16)));
}

constexpr double n = static_cast<double>(replicate_count);

/// Sum of squared differences from the mean.
double squares_about(const std::array<double, replicate_count>& values, double mean) {
    double sum = 0.0;
    for (const double value : values)
        sum += (value - mean) * (value - mean);
    return sum;
}

double mean_value(const std::array<double, replicate_count>& values) { return std::accumulate(values.begin(), values.end(), 0.0) / n; }

static_assert(tile_px == packet_size, "a row of a tile is a packet of rays through pixels' centres");

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
    Drawing drawing(shot);
    PacketLight light;
    add_packet(shot, {}, row.rays, row.lanes, light, drawing);
    for (const std::size_t i : lanes_of(row.lanes)) {
        const int x = x0 + static_cast<int>(i);
        store(image, x, y, {{{drawing.sums[0][i], 0.0}, {drawing.sums[1][i], 0.0}, {drawing.sums[2][i], 0.0}}}, 0, 1);
        image.ids.at(x, y) = in_mask(light.hit, i) ? light.hits[i].mesh + 1 : 0;
    }
    return drawing.rays;
}

std::uint64_t draw_ids(const Shot& shot, const CentreRow& row, int x0, int y, ReferenceImage& image) {
    std::array<SurfaceHit, packet_size> hits;
    const LaneMask hit = shot.embree.cast(row.rays, row.lanes, shot.camera.is_map, hits);
    for (const std::size_t i : lanes_of(row.lanes))
        image.ids.at(x0 + static_cast<int>(i), y) = in_mask(hit, i) ? hits[i].mesh + 1 : 0;
    return static_cast<std::uint64_t>(std::popcount(row.lanes));
}

/// The pilots of a tile and of the pixels around it, as far as the picture goes.
class Pilots {
  public:
    Pilots(const Shot& shot, int x0, int y0)
        : left_(std::max(0, x0 - 1)), top_(std::max(0, y0 - 1)), width_(std::min(shot.view.width_px, x0 + tile_px + 1) - left_),
          height_(std::min(shot.view.height_px, y0 + tile_px + 1) - top_) {
        for (int y = top_; y < top_ + height_; ++y)
            for (int x = left_; x < left_ + width_; ++x) {
                pilots_.push_back(pilot_of(shot, x, y));
                rays_ += pilots_.back().rays;
            }
    }
    const Drawing& at(int x, int y) const { return pilots_[static_cast<std::size_t>((y - top_) * width_ + x - left_)]; }
    bool at_edge(int x, int y) const {
        bool edge = false;
        for (int j = std::max(top_, y - 1); j <= std::min(top_ + height_ - 1, y + 1); ++j)
            for (int i = std::max(left_, x - 1); i <= std::min(left_ + width_ - 1, x + 1); ++i)
                edge |= at(i, j).mixed() != 0 || differ(at(i, j), at(x, y));
        return edge;
    }
    std::uint64_t rays() const { return rays_; }

  private:
    int left_, top_, width_, height_;
    std::vector<Drawing> pilots_;
    std::uint64_t rays_ = 0;
};

std::uint64_t draw_pixels(const Shot& shot, int x0, int y0, ReferenceImage& image) {
    std::uint64_t rays = 0;
    const int width = std::min(tile_px, image.samples.width() - x0), bottom = std::min(y0 + tile_px, image.samples.height());
    if (is_certain(shot.settings)) {
        for (int y = y0; y < bottom; ++y)
            rays += draw_certain_row(shot, centre_row(shot, x0, y, width), x0, y, image);
        return rays;
    }
    const Pilots pilots(shot, x0, y0);
    rays += pilots.rays();
    for (int y = y0; y < bottom; ++y) {
        rays += draw_ids(shot, centre_row(shot, x0, y, width), x0, y, image);
        for (int x = x0; x < x0 + width; ++x) {
            const PixelEstimate estimate = estimate_pixel(shot, x, y, pilots.at(x, y), pilots.at_edge(x, y));
            store(image, x, y, estimate.result, estimate.mixed, estimate.each * static_cast<int>(replicate_count));
            rays += estimate.rays;
        }
    }
    return rays;
}

} // namespace

int max_samples_used(const ReferenceSettings& s) { return max_each(s) * static_cast<int>(replicate_count); }

Drawing pilot_of(const Shot& shot, int x, int y) {
    const bool is_path = !is_direct(shot.settings);
    return draw_pixel(shot, x, y, 0, !is_path, is_path ? path_pilot_each : 1);
}

bool differ(const Drawing& a, const Drawing& b) {
    return a.seen.mesh != b.seen.mesh || a.seen.material != b.seen.material || a.shadows.seen != b.shadows.seen;
}

PixelEstimate estimate_pixel(const Shot& shot, int x, int y, const Drawing& pilot, bool at_edge) {
    const int most = max_each(shot.settings), pilot_each = is_direct(shot.settings) ? 1 : path_pilot_each;
    PixelEstimate estimate{{}, std::min(most, std::max(min_each(shot.settings), at_edge ? edge_min_each : 1)), 0, 0};
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

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
__attribute__((target_clones("avx512f", "avx2", "default"))) // chosen when the program starts; sanitizers cannot instrument that
#endif
void angles(const Lanes& y, const Lanes& x, Lanes& angle_rad) {
    for (std::size_t i = 0; i < packet_size; ++i) {
        const double ay = std::abs(y[i]), ax = std::abs(x[i]), small = ay < ax ? ay : ax, large = ay < ax ? ax : ay;
        // tan(a - pi/4) = (tan a - 1) / (tan a + 1) brings the upper half of the octant down.
        const bool upper = small > 0.66 * large;
        const double above = upper ? small - large : small, below = upper ? small + large : large;
        const double t = above / (below > 0.0 ? below : 1.0), z = t * t;
        const double p = (((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z - 7.500855792314704667340e1) * z -
                          1.228866684490136173410e2) *
                             z -
                         6.485021904942025371773e1;
        const double q = ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z + 4.328810604912902668951e2) * z +
                          4.853903996359136964868e2) *
                             z +
                         1.945506571482613964425e2;
        double a = t + t * (z * p / q);
        a = upper ? a + 0.25 * pi : a;
        a = ay > ax ? 0.5 * pi - a : a;
        a = x[i] < 0.0 ? pi - a : a;
        angle_rad[i] = y[i] < 0.0 ? -a : a;
    }
}

MeanAndError mean_of(const std::array<double, replicate_count>& sums, int each) {
    const double mean = mean_value(sums);
    const double error = std::sqrt(squares_about(sums, mean) / (n * (n - 1.0)) * ((n - 1.0) / (n - 3.0)));
    return {mean / each, error / each};
}

int samples_for(double error, double target, double power, int now, int most) {
    int count = now;
    for (double reached = error; count < most && reached > 0.75 * target; count *= 2)
        reached *= std::pow(2.0, -0.5 * power);
    return count;
}

std::uint64_t draw_tile(const Shot& shot, int x0, int y0, ReferenceImage& image) {
    try {
        return draw_pixels(shot, x0, y0, image);
    } catch (const Stopped&) {
        for (int y = y0; y < std::min(y0 + tile_px, image.samples.height()); ++y)
            for (int x = x0; x < std::min(x0 + tile_px, image.samples.width()); ++x) {
                store(image, x, y, {}, 0, 0);
                image.ids.at(x, y) = 0;
            }
        return 0;
    }
}

} // namespace fernlicht::reference
