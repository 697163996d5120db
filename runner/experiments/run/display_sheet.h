// One moment's light through every tone mapper, and through windscreen and eye, side by side.
#pragma once

#include "renderer/renderer.h"
#include "runner/findings/document.h"
#include "runner/play/stage.h"
#include "scenarios/display/tone_mapper.h"

#include <string>
#include <vector>

namespace fernlicht {

struct DisplaySheet {
    std::string drive, title, lamp_set;
    double time_s = 0.0, distance_m = 0.0;
    std::vector<PictureTile> mappers, eyes; ///< eyes: all by the drive's own tone mapper
};

/// Draws the moment's driver's view 320 pixels wide; white, s and histogram are fitted to this one picture. Empty where the technique
/// computes no luminance.
DisplaySheet display_sheet(const Stage& stage, const LampSet& lamp_set, const Moment& moment, Device& device,
                           const RendererSettings& settings);

TileSheet tiles_of(const DisplaySheet& sheet);

} // namespace fernlicht
