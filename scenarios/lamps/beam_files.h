// Beams as measured on a goniometer or a screen: a matrix of comma-separated values, or a texture, a picture (PNG or float EXR) whose
// pixels are illuminances over a rectangle of goniometer angles.
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
/// none of these are comments; `# word:` with an unknown word is refused. Cells are separated by ; (then 1,5 is a number), tab, comma or
/// blanks.
///
/// Facing the lamp, I = E d^2. On a wall square to the axis at distance d, theta off it, I = E (d / cos theta)^2 / cos theta.
LampFile read_beam_matrix(const std::filesystem::path& path, std::string_view text, const LampReadOptions& options, FilesRead opened);

/// In cd over goniometer angles, numbers in full: reading it back gives the same table.
std::string beam_matrix_text(const LampFile& lamp);

/// Begins as a PNG or an OpenEXR file does.
bool looks_like_beam_texture(std::string_view bytes);

/// E[lx] = pixel value x scale at the distance, the sensor facing the lamp; I = E d^2. Integer pixels count from 0 to 1 and are taken as
/// linear, whatever gamma the file claims. Colour pictures: 0.2126 R + 0.7152 G + 0.0722 B. Columns are evenly spaced in H, rows in V.
/// The extent runs between the picture's outer edges; the samples are the pixels' centres, half a pixel inside, and there is no
/// light beyond the outermost centres. What the options leave out comes from the picture's metadata (text chunks of a PNG, string
/// attributes of an EXR): fernlicht:scale_lx, fernlicht:distance_m, fernlicht:h_extent_deg "left right", fernlicht:v_extent_deg "bottom
/// top".
LampFile read_beam_texture(const std::filesystem::path& path, std::string_view bytes, const LampReadOptions& options, FilesRead opened);

/// The bytes of an EXR with one float channel "illuminance.lx" at 25 m and the metadata above. Exact to float where the table's angles lie
/// on an even lattice of at most 4096 by 4096 and four million pixels; else sampled by the table's rule, twice as finely as its finest step
/// as far as those limits go.
std::string beam_texture_bytes(const LampFile& lamp);

} // namespace fernlicht
