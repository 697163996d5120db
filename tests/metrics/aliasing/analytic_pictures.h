// Pictures known in closed form, drawn by their value at the centres of pixels or of the samples of a reference k times as fine.
#pragma once

#include "scenarios/values/image.h"

namespace fernlicht {

/// `value(x, y)` in pixels of the display, at the centres of samples of 1 / k pixel.
template <class Value> Image<float> drawn(int width_px, int height_px, int k, Value value) {
    Image<float> picture(width_px * k, height_px * k);
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            picture.at(x, y) = static_cast<float>(value((x + 0.5) / k, (y + 0.5) / k));
    return picture;
}

} // namespace fernlicht
