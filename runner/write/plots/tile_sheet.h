// Small pictures side by side under headings, each with its name: a contact sheet of whatever is compared.
#pragma once

#include "scenarios/drives/play/frame.h"

#include <string>
#include <vector>

namespace fernlicht {

struct PictureTile {
    std::string name, words; ///< caption, two lines
    Image<Rgb8> picture;     ///< as an sRGB display is told; of a section all of one size, tile_px wide
};

struct TileSection {
    std::string title, words; ///< heading, two lines
    std::vector<PictureTile> tiles;
};

inline constexpr int tile_px = 320;

/// Three tiles across. The same sections give the same bytes.
std::string tile_sheet_svg(const std::string& title, const std::vector<TileSection>& sections);

} // namespace fernlicht
