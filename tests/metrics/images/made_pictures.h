// Pictures that tests make out of whole numbers alone, so that any program makes the same.
#pragma once

#include "scenarios/drives/play/frame.h"

#include <algorithm>
#include <cstdint>

namespace fernlicht::tests {

/// Slopes, stripes and a bright disc on the dark: smooth parts, edges and texture in all channels.
inline Image<Rgb8> made_scene(int width, int height) {
    Image<Rgb8> picture(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int dx = x - width / 3, dy = y - height / 2;
            const bool disc = dx * dx + dy * dy < height * height / 16;
            const int r = disc ? 230 : 3 * x % 256, g = disc ? 210 : (x / 4 + y / 4) % 2 * 90 + y % 64, b = disc ? 140 : (x * y) % 97;
            picture.at(x, y) = {static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(b)};
        }
    return picture;
}

/// Each channel moved by -size..size, always by the same amounts (a linear congruence of Numerical Recipes).
inline Image<Rgb8> disturbed(Image<Rgb8> picture, int size, std::uint32_t seed) {
    const auto moved = [&](std::uint8_t level) {
        seed = seed * 1664525U + 1013904223U;
        const int by = static_cast<int>((seed >> 16) % static_cast<std::uint32_t>(2 * size + 1)) - size;
        return static_cast<std::uint8_t>(std::clamp(level + by, 0, 255));
    };
    for (Rgb8& p : picture.pixels())
        p = {moved(p.r), moved(p.g), moved(p.b)};
    return picture;
}

/// These values, row after row.
inline Image<float> picture(int width, const std::vector<float>& values) {
    Image<float> image(width, static_cast<int>(values.size()) / width);
    image.pixels() = values;
    return image;
}

/// One pixel to the right; the first column stays.
inline Image<Rgb8> shifted(const Image<Rgb8>& picture) {
    Image<Rgb8> out = picture;
    for (int y = 0; y < out.height(); ++y)
        for (int x = 1; x < out.width(); ++x)
            out.at(x, y) = picture.at(x - 1, y);
    return out;
}

} // namespace fernlicht::tests
