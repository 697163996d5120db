// Beam texture: a picture whose pixels are illuminances over a rectangle of goniometer angles (PNG or float EXR).
#pragma once

#include "scenarios/lamps/lamp_file.h"

#include <string>

namespace fernlicht {

/// Begins as a PNG or an OpenEXR file does.
bool looks_like_beam_texture(const std::string& bytes);

/// E[lx] = pixel value x scale at the distance, the sensor facing the lamp; I = E d^2. Integer pixels count from 0 to 1 and are taken as
/// linear, whatever gamma the file claims. Colour pictures: 0.2126 R + 0.7152 G + 0.0722 B. Columns are evenly spaced in H, rows in V.
/// The extent runs between the picture's outer edges; the samples are the pixels' centres, half a pixel inside, and there is no
/// light beyond the outermost centres. What the options leave out comes from the picture's metadata (text chunks of a PNG, string
/// attributes of an EXR): fernlicht:scale_lx, fernlicht:distance_m, fernlicht:h_extent_deg "left right", fernlicht:v_extent_deg "bottom
/// top".
LampFile read_beam_texture(const std::filesystem::path& path, const std::string& bytes, const LampReadOptions& options, FilesRead opened);

/// The bytes of an EXR with one float channel "illuminance.lx" at 25 m and the metadata above. Exact to float where the table's angles lie
/// on an even lattice of at most 4096 by 4096 and four million pixels; else sampled by the table's rule, twice as finely as its finest step
/// as far as those limits go.
std::string beam_texture_bytes(const LampFile& lamp);

} // namespace fernlicht
