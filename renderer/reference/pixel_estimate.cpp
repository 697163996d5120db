#include "renderer/reference/pixel_estimate.h"

#include "renderer/reference/path.h"
#include "renderer/reference/solved_light.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <numeric>
#include <vector>

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
    for (const std::size_t i : lanes_of(lanes)) {
        const std::array<double, 3> values{light.illuminance_lx[i], light.target_lx[i], light.luminance_cdm2[i]};
        for (std::size_t q = 0; q < 3; ++q)
            drawing.lowest[q] = std::min(drawing.lowest[q], values[q]), drawing.highest[q] = std::max(drawing.highest[q], values[q]);
    }
    drawing.seen.add(light, lanes);
    drawing.rays += light.rays;
}

namespace {

constexpr LaneMask all_of(std::size_t count) { return (1U << count) - 1U; }

/// How a round lays its points: each replicate's are a net of its own, or such a net and its image in the pixel's middle. Images cancel
/// whatever is linear in the pixel; across an edge a net of twice as many points is better.
struct Round {
    std::uint64_t number = 0;
    int each = 1; ///< points of a lane
    bool mirrored = false;
};

Drawing draw_pixel(const Shot& shot, int x, int y, const Round& round) {
    Drawing drawing(shot);
    drawing.each = round.each;
    const std::uint64_t pixel =
                            static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(shot.view.width_px) + static_cast<std::uint64_t>(x),
                        key = mixed(mixed(shot.settings.seed, pixel), round.number);
    const std::size_t replicates = replicates_of(shot.settings), lanes_each = packet_size / replicates;
    std::array<SamplePoint, packet_size> points;
    std::array<Ray, packet_size> rays;
    PacketLight light;
    const bool at_centre = shot.settings.footprint == Footprint::centre;
    for (std::size_t k = 0; k < static_cast<std::size_t>(round.each); ++k) {
        shot.leave_if_asked();
        for (std::size_t i = 0; i < packet_size; ++i) {
            const std::size_t part = i / replicates;
            points[i] = {PointNet(mixed(key, i % replicates)), static_cast<std::uint32_t>(round.mirrored ? k : k * lanes_each + part),
                         round.mirrored && part == 1};
            const glm::dvec2 place = at_centre ? glm::dvec2(0.5) : points[i].pair(0);
            rays[i] = shot.ray_through(x + place.x, y + place.y);
        }
        add_packet(shot, points, rays, all_of(packet_size), light, drawing);
    }
    return drawing;
}

/// The means of a round's replicates, and what they say.
std::array<MeanAndError, 3> result_of(const Shot& shot, const Drawing& drawing) {
    const std::size_t count = replicates_of(shot.settings), lanes_each = packet_size / count;
    std::array<MeanAndError, 3> result;
    for (std::size_t q = 0; q < 3; ++q) {
        std::array<double, packet_size> means{};
        for (std::size_t i = 0; i < packet_size; ++i)
            means[i % count] += drawing.sums[q][i] / (drawing.each * static_cast<double>(lanes_each));
        result[q] = mean_of(std::span(means).first(count));
        // Nets that an upright or level edge crosses may all count it alike. The bar is never less than what one sample more makes.
        if (is_direct(shot.settings) && drawing.mixed() != 0)
            result[q].standard_error = std::max(result[q].standard_error,
                                                (drawing.highest[q] - drawing.lowest[q]) / static_cast<double>(packet_size) / drawing.each);
    }
    return result;
}

/// How the error is expected to fall with more samples (pixel_estimate.h). Luminance has surfaces' textures in it.
double falling_power(const Shot& shot, std::uint8_t mixed, std::size_t result) {
    if (!is_direct(shot.settings))
        return 1.0;
    return mixed != 0 || result == 2 || shot.settings.lamp_radius_m > 0.0 ? 1.5 : 2.0;
}

/// As solved beforehand: more samples a pixel do not lessen the noise of that.
bool as_solved(const ReferenceSettings& s) {
    return (s.integrator == Integrator::radiosity || s.integrator == Integrator::photon_map) && !s.solver.final_gather;
}

double target_of(const Shot& shot, std::size_t result, double mean) {
    return shot.settings.target_error * std::max(mean, result == 2 ? shot.settings.floor_cdm2 : shot.settings.floor_lx);
}

/// A path's light may come from a small part of all directions: 128 samples miss 1/25 of them once in 190.
constexpr int path_min_each = 8;

/// Over a difference in units of the wanted error: as many samples as would make half of that error if one of them alone should have met
/// what differs; and at most how many a lane.
constexpr double edge_share = 2.0, edge_most_each = 64.0;

/// Neighbours' pooled error that lets a first round stay, of what is wanted: so low that the pixel's own bar, which is not independent of
/// its mean, seldom sends it on.
constexpr double first_share = 0.5;

int min_each(const ReferenceSettings& s) {
    const int asked = static_cast<int>(std::bit_ceil((static_cast<unsigned>(s.min_samples) + 15) / 16));
    return !is_direct(s) ? std::max(asked, path_min_each) : asked;
}
int max_each(const ReferenceSettings& s) {
    if (as_solved(s))
        return min_each(s);
    return std::max(min_each(s), static_cast<int>(std::bit_floor(static_cast<unsigned>(s.max_samples) / 16)));
}

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

/// The first rounds of a tile's pixels, and what is seen in the middle of those around it. What a pixel's neighbours say is independent of
/// its own samples: they are its pilot, and cost nothing.
class FirstRounds {
  public:
    FirstRounds(const Shot& shot, int x0, int y0, int size_px)
        : shot_(shot), left_(x0), top_(y0), width_(std::min(size_px, shot.view.width_px - x0)),
          height_(std::min(size_px, shot.view.height_px - y0)) {
        rounds_.reserve(static_cast<std::size_t>(width_ * height_));
        for (int y = y0; y < y0 + height_; ++y)
            for (int x = x0; x < x0 + width_; ++x) {
                rounds_.push_back(first_round(shot, x, y));
                rays_ += rounds_.back().rays;
                look_at(x, y) = {result_of(shot, rounds_.back()), true};
            }
        look_around();
    }
    const Drawing& at(int x, int y) const { return rounds_[static_cast<std::size_t>((y - top_) * width_ + x - left_)]; }
    std::uint64_t rays() const { return rays_; }

    Advice advice(int x, int y) const { return {more(x, y), least_each(x, y)}; }

  private:
    struct Look {
        std::array<MeanAndError, 3> result;
        bool has_error = false;
    };
    static constexpr double no_look = std::numeric_limits<double>::infinity();

    std::size_t place(int x, int y) const { return static_cast<std::size_t>((y - top_ + 1) * (tile_px + 2) + x - left_ + 1); }
    Look& look_at(int x, int y) { return looks_[place(x, y)]; }
    const Look& look_at(int x, int y) const { return looks_[place(x, y)]; }

    /// Whether the neighbours' errors are together above what is wanted.
    bool more(int x, int y) const {
        int count = 0;
        std::array<double, 3> squares{}, means{};
        for (int j = y - 1; j <= y + 1; ++j)
            for (int i = x - 1; i <= x + 1; ++i)
                if (const Look& look = look_at(i, j); look.has_error && (i != x || j != y)) {
                    ++count;
                    for (std::size_t q = 0; q < 3; ++q)
                        squares[q] += look.result[q].standard_error * look.result[q].standard_error, means[q] += look.result[q].mean;
                }
        bool above = false;
        for (std::size_t q = 0; q < 3 && count > 0; ++q)
            above |= std::sqrt(squares[q] / count) > first_share * target_of(shot_, q, means[q] / count);
        return above;
    }

    /// Of a lane, by how far the neighbours are from a plane: what one of them has and the others have not may reach into the pixel.
    int least_each(int x, int y) const {
        if (shot_.settings.footprint == Footprint::centre || x == 0 || y == 0 || x + 1 == shot_.view.width_px ||
            y + 1 == shot_.view.height_px)
            return 1;
        double samples = 0.0;
        for (std::size_t q = 0; q < 3; ++q) {
            const auto value = [&](int k) { return look_at(x + k % 3 - 1, y + k / 3 - 1).result[q].mean; };
            double mean = 0.0, across = 0.0, down = 0.0, least = no_look, low = no_look, high = -no_look;
            for (const int k : around) {
                const int x_of = k % 3 - 1, y_of = k / 3 - 1;
                mean += value(k) / 8.0, across += value(k) * x_of / 6.0, down += value(k) * y_of / 6.0;
            }
            for (const int k : around) {
                const int x_of = k % 3 - 1, y_of = k / 3 - 1;
                const double beside = value(k) - mean - across * x_of - down * y_of;
                low = std::min(low, beside), high = std::max(high, beside), least = std::min(least, value(k));
            }
            samples = std::max(samples, (high - low) / target_of(shot_, q, least));
        }
        const double each = edge_share * samples / static_cast<double>(packet_size);
        return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::clamp(each, 1.0, edge_most_each))));
    }

    void look_around() {
        std::vector<glm::ivec2> places;
        for (int y = std::max(0, top_ - 1); y < std::min(top_ + height_ + 1, shot_.view.height_px); ++y)
            for (int x = std::max(0, left_ - 1); x < std::min(left_ + width_ + 1, shot_.view.width_px); ++x)
                if (x < left_ || x == left_ + width_ || y < top_ || y == top_ + height_)
                    places.emplace_back(x, y);
        std::array<Ray, packet_size> rays;
        PacketLight light;
        for (std::size_t first = 0; first < places.size(); first += packet_size) {
            const std::span<const glm::ivec2> some = std::span(places).subspan(first, std::min(packet_size, places.size() - first));
            for (std::size_t i = 0; i < some.size(); ++i)
                rays[i] = shot_.ray_through(some[i].x + 0.5, some[i].y + 0.5);
            Drawing drawing(shot_);
            add_packet(shot_, {}, rays, all_of(some.size()), light, drawing);
            for (std::size_t i = 0; i < some.size(); ++i)
                for (std::size_t q = 0; q < 3; ++q)
                    look_at(some[i].x, some[i].y).result[q].mean = drawing.sums[q][i];
            rays_ += drawing.rays;
        }
    }

    static constexpr std::array<int, 8> around{0, 1, 2, 3, 5, 6, 7, 8};

    const Shot& shot_;
    int left_, top_, width_, height_;
    std::vector<Drawing> rounds_;
    std::array<Look, static_cast<std::size_t>((tile_px + 2) * (tile_px + 2))> looks_{};
    std::uint64_t rays_ = 0;
};

std::uint64_t draw_pixels(const Shot& shot, int x0, int y0, int size_px, ReferenceImage& image) {
    std::uint64_t rays = 0;
    const int width = std::min(size_px, image.samples.width() - x0), bottom = std::min(y0 + size_px, image.samples.height());
    if (is_certain(shot.settings)) {
        for (int y = y0; y < bottom; ++y)
            rays += draw_certain_row(shot, centre_row(shot, x0, y, width), x0, y, image);
        return rays;
    }
    const FirstRounds first(shot, x0, y0, size_px);
    rays += first.rays();
    for (int y = y0; y < bottom; ++y) {
        rays += draw_ids(shot, centre_row(shot, x0, y, width), x0, y, image);
        for (int x = x0; x < x0 + width; ++x) {
            const PixelEstimate estimate = estimate_pixel(shot, x, y, first.at(x, y), first.advice(x, y));
            store(image, x, y, estimate.result, estimate.mixed, estimate.each * static_cast<int>(packet_size));
            rays += estimate.rays;
        }
    }
    return rays;
}

} // namespace

std::size_t replicates_of(const ReferenceSettings& settings) { return is_direct(settings) ? packet_size / 2 : replicate_count; }

int max_samples_used(const ReferenceSettings& s) { return max_each(s) * static_cast<int>(packet_size); }

Drawing first_round(const Shot& shot, int x, int y) {
    return draw_pixel(shot, x, y, {0, min_each(shot.settings), is_direct(shot.settings)});
}

PixelEstimate estimate_pixel(const Shot& shot, int x, int y, const Drawing& first, const Advice& advice) {
    const int most = max_each(shot.settings);
    PixelEstimate estimate{result_of(shot, first), first.each, first.mixed(), 0};
    for (std::uint64_t round = 1; estimate.each < most; ++round) {
        int wanted = estimate.each;
        if (round == 1)
            wanted = std::max(advice.more ? 2 * wanted : wanted, advice.least_each);
        for (std::size_t q = 0; q < 3; ++q) {
            const auto [mean, error] = estimate.result[q];
            const double target = target_of(shot, q, mean);
            if (error > target || wanted > estimate.each)
                wanted = std::max(wanted, samples_for(error, target, falling_power(shot, estimate.mixed, q), estimate.each, most));
        }
        if (wanted == estimate.each)
            break;
        const Drawing drawing = draw_pixel(shot, x, y, {round, std::min(wanted, most), is_direct(shot.settings) && estimate.mixed == 0});
        estimate = {result_of(shot, drawing), drawing.each, static_cast<std::uint8_t>(estimate.mixed | drawing.mixed()),
                    estimate.rays + drawing.rays};
    }
    return estimate;
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

MeanAndError mean_of(std::span<const double> means) {
    const auto n = static_cast<double>(means.size());
    const double mean = std::accumulate(means.begin(), means.end(), 0.0) / n;
    double squares = 0.0;
    for (const double value : means)
        squares += (value - mean) * (value - mean);
    return {mean, std::sqrt(squares / (n * (n - 1.0)) * ((n - 1.0) / (n - 3.0)))};
}

int samples_for(double error, double target, double power, int now, int most) {
    int count = now;
    for (double reached = error; count < most && reached > 0.75 * target; count *= 2)
        reached *= std::pow(2.0, -0.5 * power);
    return count;
}

std::uint64_t draw_tile(const Shot& shot, int x0, int y0, int size_px, ReferenceImage& image) {
    try {
        return draw_pixels(shot, x0, y0, size_px, image);
    } catch (const Stopped&) {
        for (int y = y0; y < std::min(y0 + size_px, image.samples.height()); ++y)
            for (int x = x0; x < std::min(x0 + size_px, image.samples.width()); ++x) {
                store(image, x, y, {}, 0, 0);
                image.ids.at(x, y) = 0;
            }
        return 0;
    }
}

} // namespace fernlicht::reference
