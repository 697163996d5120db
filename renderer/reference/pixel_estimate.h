// One pixel: what its samples saw, how many of them it needs, and what they say.
#pragma once

#include "renderer/reference/lanes.h"
#include "renderer/reference/replicates.h"
#include "renderer/reference/shot.h"

namespace fernlicht::reference {

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

    explicit Drawing(const Shot& shot) : shadows{std::vector<std::uint8_t>(2 * shot.moment.lamps.size(), 0)} {}
    std::uint8_t mixed() const {
        return static_cast<std::uint8_t>((seen.several ? several_surfaces : 0) | (shadows.edge() ? shadow_edge : 0));
    }
};

/// What ReferenceSettings::most_samples comes to: a power of two, no less than the least that the integrator takes; and that least where
/// more samples would not lessen the noise of what was solved.
int most_samples_used(const ReferenceSettings& settings);

/// One ray a sample and feelers; the sky is a share.
bool is_direct(const ReferenceSettings& settings);

/// Draws a packet and adds it up.
void add_packet(const Shot& shot, const std::array<SamplePoint, packet_size>& points, const std::array<Ray, packet_size>& rays,
                LaneMask lanes, PacketLight& light, Drawing& drawing);

/// A first look at a pixel, which decides how many samples it gets and is thrown away.
Drawing pilot_of(const Shot& shot, int x, int y);

/// Whether what two pixels saw differs: by surface, or by lamps that light one and not the other.
bool differ(const Drawing& a, const Drawing& b);

struct PixelEstimate {
    std::array<MeanAndError, 3> result;
    int each = 0; ///< points of each of the sixteen nets
    std::uint8_t mixed = 0;
    std::uint64_t rays = 0;
};

/// `at_edge`: a neighbour saw something else, so that some of it may reach into this pixel and be missed by few samples.
PixelEstimate estimate_pixel(const Shot& shot, int x, int y, const Drawing& pilot, bool at_edge);

} // namespace fernlicht::reference
