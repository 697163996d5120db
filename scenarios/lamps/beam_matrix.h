// Beam matrix: a goniometer's or a screen's measurement as comma-separated values.
#pragma once

#include "scenarios/lamps/lamp_file.h"

#include <string_view>

namespace fernlicht {

/// A line `# unit:` stands before the numbers.
bool looks_like_beam_matrix(std::string_view text);

/// `text` is the content of `path` as UTF-8. Throws InputError with the line.
///
///     # unit: lx                 lx or cd; must be given
///     # distance_m: 25           of the sensor or screen, for lx; 25 when not given
///     # angles: goniometer       or screen: atan(x / distance), atan(y / distance) as read off a flat wall; goniometer when not given
///     # screen: spherical        or planar: the sensor lies in the wall. Spherical, the sensor facing the lamp, when not given
///     V\H, -10, 0, 10            first cell free, then the horizontal angles in degrees
///     -1, 3.5, 20, 4             vertical angle, then one cell per horizontal angle
///
/// Also `# name:`, `# flux_lm:` (declared), `# gaps_deg:` (as our writer puts it) and `# label KEY: text`. Lines that begin with # and are
/// none of these are comments; `# word:` with an unknown word is refused. Cells are parted by ; (then 1,5 is a number), tab, comma or
/// blanks.
///
/// Facing the lamp, I = E d^2. On a wall square to the axis at distance d, theta off it, I = E (d / cos theta)^2 / cos theta.
LampFile read_beam_matrix(const std::filesystem::path& path, std::string_view text, const LampReadOptions& options, FilesRead opened);

/// In cd over goniometer angles, numbers in full: reading it back gives the same table.
std::string beam_matrix_text(const LampFile& lamp);

} // namespace fernlicht
