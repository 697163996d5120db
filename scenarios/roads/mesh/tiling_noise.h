// Noise on a square that repeats: for textures without seams. Whole-number hashes and the four basic operations only, so that the
// same seed gives the same bits on every machine.
#pragma once

#include <cstdint>

namespace fernlicht {

class TilingNoise {
  public:
    /// `stream` tells apart what is drawn with one seed.
    TilingNoise(std::uint64_t seed, std::uint64_t stream);

    /// Uniform in [0, 1), independent for each pair of whole numbers.
    double uniform(int x, int y) const;
    /// Gradient noise (Perlin 1985) of `cells` x `cells` cells over the square u, v in [0, 1); smooth, repeats beyond it. Its mean is near
    /// 0, it lies within -1 .. 1, and it has little at wavelengths much longer than a cell. `cells` >= 1.
    double gradient(double u, double v, int cells) const;
    /// gradient() at `cells`, 2 `cells`, 4 `cells` ..., each octave `gain` as strong as the one before.
    double octaves(double u, double v, int cells, int count, double gain) const;

  private:
    std::uint64_t key_;
};

} // namespace fernlicht
