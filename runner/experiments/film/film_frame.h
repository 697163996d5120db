// One frame of a film as plain values: its pixels, and what is drawn over them.
#pragma once

#include "runner/experiments/film/film_layout.h"
#include "runner/findings/plots/drawing.h"
#include "runner/findings/report.h"

#include <string>
#include <vector>

namespace fernlicht {

struct FilmPanelMoment {
    std::string title, speed, readings; ///< "": not told
    Image<Rgb8> picture;                ///< as large as the panel's picture
    Image<float> ground_lx;             ///< of the picture where it shows ground, else NaN; empty: no isolux lines
    LuxMap map;                         ///< empty: none
};

struct FilmMoment {
    double time_s = 0.0; ///< of the drives
    std::string caption; ///< beside the time
    std::vector<FilmPanelMoment> panels;
};

/// Pictures and maps in their places, and the scale of lux.
Image<plots::Colour> film_pixels(const FilmLayout& layout, const FilmMoment& moment);

/// Titles, time, isolux lines, lanes' edges and the scale's figures, over film_pixels.
plots::Drawing film_marks(const FilmLayout& layout, const FilmMoment& moment);

/// How much of the road a map shows, ahead and behind the car's origin.
inline constexpr double film_map_ahead_m = 150.0, film_map_behind_m = 10.0;

} // namespace fernlicht
