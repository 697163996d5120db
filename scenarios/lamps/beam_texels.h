// How fine a texture holds a beam: its size and the depth of its texels.
#pragma once

namespace fernlicht {

struct BeamTexels {
    int width = 512, height = 128; ///< 2 to 8192 each way
    int bits = 8;                  ///< of a texel: 8 or 16 for as many steps from 0 to the largest value, 32 for a float

    bool operator==(const BeamTexels&) const = default;
};

/// What the founding thesis had.
inline constexpr BeamTexels eight_bit_texels{512, 128, 8};
inline constexpr int min_beam_texels = 2, max_beam_texels = 8192;

/// The largest step of texels of 8 or 16 bits.
inline int largest_step(int bits) { return (1 << bits) - 1; }

} // namespace fernlicht
