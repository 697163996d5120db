// One pixel: what its samples saw, how many of them it needs, and what they say.
// Angles of a packet at a time: a function that is called a dozen times for every ray, in a form that compilers turn into SIMD.
// Independent means and what they say: mean, standard error, and how many more samples an error asks for.
// A square of pixels, drawn by one thread. What it gives depends on the shot and its place alone.
#pragma once

#include "renderer/reference/embree_scene.h"
#include "renderer/reference/shot.h"

#include <array>
#include <limits>
#include <span>

namespace fernlicht::reference {

using Lanes = std::array<double, packet_size>;

/// atan2(y, x) in every lane, radians, within 6e-16; (0, 0) gives 0. Cephes' rational function (Moshier 1989) on octants. The four basic
/// operations alone: the same bits with any width of SIMD. Lanes that hold no number give no number.
void angles(const Lanes& y, const Lanes& x, Lanes& angle_rad);

/// Of solved light, and of pixels whose light comes over other surfaces: one a lane.
inline constexpr std::size_t replicate_count = packet_size;

/// A pixel's independent estimates. Direct light: lanes i and i + 8 belong together, as a point and its image or as two points of one net.
/// What the integrand's nets save grows with their size, so that there are no more of them than an error bar needs.
std::size_t replicates_of(const ReferenceSettings& settings);

struct MeanAndError {
    double mean = 0.0, standard_error = 0.0;
};

/// Of four and more independent means with one expectation. The error is such that (mean - truth) / error has variance 1 where the means
/// are normal: s / sqrt(n) times sqrt((n - 1) / (n - 3)), the spread of Student's t with n - 1 degrees of freedom.
MeanAndError mean_of(std::span<const double> means);

/// How the error of stratified samples falls: error^2 goes with the number of samples to the power -power. 1: as for independent samples
/// (many dimensions); 1.5: an edge in two dimensions; 2: smooth in two dimensions (nets reach 3, which is not counted on).
/// The least power of two times `now` that brings `error` below 3/4 of `target`, at most `most`. now >= 1.
int samples_for(double error, double target, double power, int now, int most);

struct Seen {
    bool several = false, anything = false;
    std::uint32_t mesh = 0, material = 0;

    void add(const PacketLight& light, LaneMask lanes) {
        for (const std::size_t i : lanes_of(lanes)) {
            const bool hit = in_mask(light.hit, i);
            const std::uint32_t m = hit ? light.hits[i].mesh + 1 : 0, kind = hit ? light.hits[i].material : 0;
            several |= anything && (m != mesh || kind != material);
            anything = true, mesh = m, material = kind;
        }
    }
};

/// A round of a pixel's samples: its results summed over `each` of every lane.
struct Drawing {
    std::array<Lanes, 3> sums{};             ///< illuminance, target, luminance
    std::array<double, 3> lowest, highest{}; ///< of all samples
    int each = 0;
    Seen seen;
    ShadowTally shadows;
    std::uint64_t rays = 0;

    explicit Drawing(const Shot& shot) : shadows{std::vector<std::uint8_t>(2 * shot.moment.lamps.size(), 0)} {
        lowest.fill(std::numeric_limits<double>::infinity());
    }
    std::uint8_t mixed() const {
        return static_cast<std::uint8_t>((seen.several ? several_surfaces : 0) | (shadows.edge() ? shadow_edge : 0));
    }
};

/// What ReferenceSettings::max_samples comes to: a power of two, no less than the least that the integrator takes; and that least where
/// more samples would not lessen the noise of what was solved.
int max_samples_used(const ReferenceSettings& settings);

/// One ray a sample and feelers; the sky is a share.
bool is_direct(const ReferenceSettings& settings);

/// Draws a packet and adds it up.
void add_packet(const Shot& shot, const std::array<SamplePoint, packet_size>& points, const std::array<Ray, packet_size>& rays,
                LaneMask lanes, PacketLight& light, Drawing& drawing);

/// The first round of a pixel, which is often enough.
Drawing first_round(const Shot& shot, int x, int y);

/// What a pixel's neighbours say of how many samples it needs.
struct Advice {
    bool more = false;  ///< than the first round
    int least_each = 1; ///< of a lane
};

struct PixelEstimate {
    std::array<MeanAndError, 3> result;
    int each = 0; ///< points of a lane
    std::uint8_t mixed = 0;
    std::uint64_t rays = 0; ///< without those of the first round
};

PixelEstimate estimate_pixel(const Shot& shot, int x, int y, const Drawing& first, const Advice& advice);

inline constexpr int tile_px = 16; ///< at most

/// Draws the tile of `size_px` pixels each way whose first pixel is (x0, y0) into `image`. Returns the rays cast; none for a tile that was
/// left because a stop was asked for, whose pixels are as if never drawn.
std::uint64_t draw_tile(const Shot& shot, int x0, int y0, int size_px, ReferenceImage& image);

} // namespace fernlicht::reference
