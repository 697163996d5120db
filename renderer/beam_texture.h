// A candela table as the uniform float grid that the GPU looks up.
#pragma once

#include "scenarios/lamps/beam_texels.h"
#include "scenarios/lamps/candela_table.h"

#include <cstdint>
#include <optional>

namespace fernlicht {

inline constexpr std::size_t default_max_texels = std::size_t{4} << 20;

struct BeamTexture {
    int width = 0, height = 0;
    std::vector<float> cd; ///< rows from low V to high V; with less than 32 bits whole steps of scale_cd / largest_step(bits)
    int bits = 32;         ///< of a texel: 8, 16 or 32
    double scale_cd = 0.0; ///< the largest value
    double h_first_rad = 0.0, v_first_rad = 0.0, h_step_rad = 0.0, v_step_rad = 0.0;
    std::uint64_t state = 0;          ///< counts what was drawn on this grid, of lamps whose pixels dim
    double worst_error_of_peak = 0.0; ///< largest |texture - table| over peak; exact for linear_cd, for log_cd sampled
};

/// Resamples the lit part of a table (H within +-90 degrees). Steps are at most 0.05 degrees and such that the table's own samples fall on
/// texels where a common step exists: bilinear look-up then gives the table's linear rule exactly. Beyond `max_texels` the
/// steps grow, across before up, and the error says what it cost. A dark table gives a 2 x 2 texture of zeros.
BeamTexture make_beam_texture(const CandelaTable& table, std::size_t max_texels = default_max_texels);

/// The lit part of a table (H within +-90 degrees) on as many texels, from edge to edge. Throws std::invalid_argument for sizes out of
/// min_beam_texels to max_beam_texels.
BeamTexture make_beam_texture(const CandelaTable& table, const BeamTexels& texels);

/// Another state of a lamp's pixels: `table` on the texels into which `texture` was made from `full`, of the same axes, and in the same
/// steps. No intensity is above that of `full`. Returns the first row that changed and the one after the last.
std::pair<int, int> draw_state(const CandelaTable& table, const CandelaTable& full, const std::optional<BeamTexels>& texels,
                               BeamTexture& texture);

} // namespace fernlicht
