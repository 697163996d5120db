// How much of a picture is wrongly lit or wrongly dark: shadows as drawn against shadows as they are.
#pragma once

#include "scenarios/values/image.h"

#include <cstdint>
#include <optional>

namespace fernlicht {

/// Illuminance of the same places, lx, all of one size. Not finite or not above the floor without shadows: the pixel does not count.
struct ShadowImages {
    Image<float> drawn_lx, true_lx;
    Image<float> unshadowed_lx;       ///< the truth without anything in the light's way
    Image<float> drawn_unshadowed_lx; ///< as drawn without shadows, so that what is wrong with the light is no shadow's error; empty:
                                      ///< unshadowed_lx
    Image<std::uint8_t> counts;       ///< 0: the pixel does not count (it shows different things in both); empty: all count
};

/// Below this illuminance without shadows a pixel's shadow does not count: on asphalt some 3e-5 cd/m2, what an eye adapted to the dark
/// hardly sees.
inline constexpr double shadow_floor_lx = 0.001;

/// 1 - E / E_unshadowed within 0..1, as drawn and as it is; nullopt where the pixel does not count.
struct ShadowDegrees {
    double drawn = 0.0, truth = 0.0;
};
std::optional<ShadowDegrees> shadow_degrees(const ShadowImages& images, int x, int y, double floor_lx = shadow_floor_lx);

/// Areas in the unit of the weights: m2, or pixels. A pixel that is half as dark as it should be counts half.
struct ShadowArea {
    double counted = 0.0, shadowed = 0.0; ///< lit without shadows; of it truly in shadow
    double wrongly_lit = 0.0, wrongly_dark = 0.0;

    double wrong() const { return wrongly_lit + wrongly_dark; }
    /// Of what is lit without shadows; 0 of nothing.
    double wrong_share() const { return counted > 0.0 ? wrong() / counted : 0.0; }
    double wrongly_lit_share() const { return counted > 0.0 ? wrongly_lit / counted : 0.0; }
    double wrongly_dark_share() const { return counted > 0.0 ? wrongly_dark / counted : 0.0; }

    ShadowArea& operator+=(const ShadowArea& other);
    bool operator==(const ShadowArea&) const = default;
};

/// `pixel_area`: of each pixel, all the same. Throws std::invalid_argument for images of different sizes and a floor or area not above 0.
ShadowArea shadow_area(const ShadowImages& images, double pixel_area = 1.0, double floor_lx = shadow_floor_lx);
/// Each pixel with an area of its own; what is not above 0 does not count.
ShadowArea shadow_area(const ShadowImages& images, const Image<float>& areas, double floor_lx = shadow_floor_lx);

/// True degree minus drawn degree: above 0 wrongly lit, below 0 wrongly dark; 0 where the pixel does not count.
Image<float> shadow_differences(const ShadowImages& images, double floor_lx = shadow_floor_lx);

/// Throws std::invalid_argument where the images are not all of one size.
void check_sizes(const ShadowImages& images);

} // namespace fernlicht
