// Where a film's panels, titles and scale stand. Nothing lies over a picture but its isolux lines.
#pragma once

#include "scenarios/drives/drive.h"

#include <vector>

namespace fernlicht {

/// automatic: one panel alone, two side by side, more in a grid.
enum class FilmArrangement { automatic, side_by_side, wipe, grid };

inline constexpr int most_film_panels = 9;

struct FilmPanelBoxes {
    PixelBox title;   ///< above the picture
    PixelBox picture; ///< as large as its view
    PixelBox shown;   ///< what is seen of it: all, or with `wipe` its side
    PixelBox map;     ///< below the picture: the road from above, ahead to the right; of no height where there is none
};

struct FilmLayout {
    int width_px = 0, height_px = 0;
    double letter_px = 0.0; ///< height of letters
    std::vector<FilmPanelBoxes> panels = {};
    PixelBox footer = {};
    bool wipe = false; ///< two panels share one picture's place, the first shows its left half
};

struct FilmBands {
    bool readings = false; ///< titles have a second line
    bool maps = false;     ///< each panel has a map, the footer a scale
};

/// 1 to most_film_panels panels; side by side and wipe: 2. Throws InputError naming the flag where they are more or fewer, and where they
/// have no room in the film.
FilmLayout film_layout(FilmArrangement arrangement, int panels, int width_px, int height_px, FilmBands bands);

} // namespace fernlicht
