#include "scenarios/roads/mesh/tiling_noise.h"

#include <cmath>

namespace fernlicht {

namespace {

/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014).
std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
}

constexpr std::uint64_t golden = 0x9E3779B97F4A7C15ULL;

/// Perlin's fade of 2002: first and second derivative are 0 at both ends.
double fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }

} // namespace

TilingNoise::TilingNoise(std::uint64_t seed, std::uint64_t stream) : key_(mixed(mixed(seed + golden) + stream * golden)) {}

double TilingNoise::uniform(int x, int y) const {
    const std::uint64_t place = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32) | static_cast<std::uint32_t>(y);
    return static_cast<double>(mixed(key_ ^ mixed(place + golden)) >> 11) * 0x1p-53;
}

double TilingNoise::gradient(double u, double v, int cells) const {
    const double x = u * cells, y = v * cells, x0 = std::floor(x), y0 = std::floor(y);
    const double fx = x - x0, fy = y - y0;
    const auto wrapped = [cells](double i) { return ((static_cast<int>(i) % cells) + cells) % cells; };
    const auto corner = [&](int dx, int dy) {
        const int ix = wrapped(x0 + dx), iy = wrapped(y0 + dy);
        const double gx = 2.0 * uniform(2 * ix, iy) - 1.0, gy = 2.0 * uniform(2 * ix + 1, iy) - 1.0;
        return gx * (fx - dx) + gy * (fy - dy);
    };
    const double wx = fade(fx), wy = fade(fy);
    const double below = corner(0, 0) + (corner(1, 0) - corner(0, 0)) * wx, above = corner(0, 1) + (corner(1, 1) - corner(0, 1)) * wx;
    return below + (above - below) * wy;
}

double TilingNoise::octaves(double u, double v, int cells, int count, double gain) const {
    double sum = 0.0, strength = 1.0;
    for (int i = 0; i < count; ++i, cells *= 2, strength *= gain)
        sum +=
            strength * gradient(u + 0.5 / cells, v + 0.5 / cells, cells); // gradient noise is 0 on its lattice: octaves must not share one
    return sum;
}

} // namespace fernlicht
