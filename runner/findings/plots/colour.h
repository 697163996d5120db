// Colours of the plots: chosen so that they stay apart for colour-blind eyes and in grey print.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace fernlicht::plots {

struct Colour {
    std::uint8_t r = 0, g = 0, b = 0;
    bool operator==(const Colour&) const = default;
};

std::string css(Colour colour); ///< "#rrggbb"

/// Colour of the n-th series: the eight colours of Okabe and Ito (2008) without yellow, round again after the last.
Colour series_colour(std::size_t n);

/// Sequential map 0..1 (clamped), dark violet over blue and green to light yellow. Lightness rises evenly and monotonically
/// (straight in OKLab's L), so that it reads as "more" in colour, in grey and for every kind of colour vision.
Colour sequential(double t);

/// Diverging map -1..1 (clamped): blue, near white at 0, orange. Both arms equally dark at equal distance.
Colour diverging(double t);

/// Relative luminance 0..1 of the colour as shown (IEC 61966-2-1, BT.709 weights).
double luminance(Colour colour);

} // namespace fernlicht::plots
