#include "runner/findings/plots/colour.h"

#include "scenarios/photometry.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht::plots {
namespace {

std::uint8_t encoded(double linear) {
    return static_cast<std::uint8_t>(std::lround(255.0 * photometry::srgb_encoded(std::clamp(linear, 0.0, 1.0))));
}

double decoded(std::uint8_t byte) {
    const double c = byte / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// B. Ottosson, "A perceptual color space for image processing" (2020): OKLab to linear sRGB.
Colour from_oklab(double lightness, double a, double b) {
    const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3.0);
    const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3.0);
    const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3.0);
    return {encoded(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
            encoded(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
            encoded(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

Colour from_oklch(double lightness, double chroma, double hue_deg) {
    return from_oklab(lightness, chroma * std::cos(radians(hue_deg)), chroma * std::sin(radians(hue_deg)));
}

double between(double a, double b, double t) { return a + (b - a) * t; }

} // namespace

std::string css(Colour c) { return fmt::format("#{:02x}{:02x}{:02x}", c.r, c.g, c.b); }

Colour series_colour(std::size_t n) {
    static constexpr std::array<Colour, 7> colours{
        {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {86, 180, 233}, {230, 159, 0}, {60, 60, 60}}};
    return colours[n % colours.size()];
}

Colour lamp_colour(std::size_t n) {
    static constexpr std::array<Colour, 6> colours{
        {{194, 78, 0}, {0, 104, 168}, {0, 121, 90}, {168, 64, 127}, {138, 106, 0}, {74, 74, 74}}};
    return colours[n % colours.size()];
}

namespace {

constexpr double steps = 4096.0; // 16 times as fine as a level of 8 bits

/// Of each step from 0 to 1: maps ask for each of their pixels, and a colour takes several powers.
std::vector<Colour> stepwise(Colour (*colour)(double)) {
    std::vector<Colour> all;
    for (int i = 0; i <= static_cast<int>(steps); ++i)
        all.push_back(colour(i / steps));
    return all;
}

std::size_t step_of(double t) {
    return static_cast<std::size_t>(std::floor(std::max(0.0, std::min(1.0, t)) * steps + 0.5));
} // no number: 1

Colour sequential_at(double t) {
    // Within what sRGB can show at each hue (least, 0.092, in the blue-greens): a clipped component would draw an edge that the data
    // do not have.
    const double warm = std::clamp((t - 0.4) / 0.6, 0.0, 1.0);
    const double chroma = 0.091 + 0.07 * warm * warm * (3.0 - 2.0 * warm);
    return from_oklch(between(0.20, 0.94, t), chroma, between(300.0, 105.0, t));
}

Colour diverging_at(double place) {
    const double t = 2.0 * place - 1.0;
    const double strength = std::abs(t);
    return from_oklch(between(0.96, 0.45, strength), 0.13 * std::min(1.0, 1.4 * strength), t < 0.0 ? 250.0 : 50.0);
}

} // namespace

Colour sequential(double t) {
    static const std::vector<Colour> all = stepwise(sequential_at);
    return all[step_of(t)];
}

Colour diverging(double t) {
    static const std::vector<Colour> all = stepwise(diverging_at);
    return all[step_of(0.5 * t + 0.5)];
}

double luminance(Colour c) { return 0.2126 * decoded(c.r) + 0.7152 * decoded(c.g) + 0.0722 * decoded(c.b); }

} // namespace fernlicht::plots
