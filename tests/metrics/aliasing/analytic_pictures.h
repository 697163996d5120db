// Pictures known in closed form, drawn by their value at the centres of pixels or of the samples of a reference k times as fine.
#pragma once

#include "scenarios/values/image.h"
#include "scenarios/values/pose.h"

namespace fernlicht {

constexpr double ppd = 20.0;     ///< pixels of the display a degree
constexpr double rate_hz = 32.0; ///< of pictures
constexpr int k = 8;             ///< samples of a pixel of the display, each way

/// `value(x, y)` in pixels of the display, at the centres of samples of 1 / samples of a pixel.
template <class Value> Image<float> drawn(int width_px, int height_px, int samples, Value value) {
    Image<float> picture(width_px * samples, height_px * samples);
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            picture.at(x, y) = static_cast<float>(value((x + 0.5) / samples, (y + 0.5) / samples));
    return picture;
}

} // namespace fernlicht
