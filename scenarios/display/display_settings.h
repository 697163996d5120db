// The way from a drive's light to its pictures: windscreen, eye, display. All of it is off unless a drive asks for it.
#pragma once

#include "scenarios/display/display_profile.h"

#include <optional>

namespace fernlicht {

struct Windscreen {
    double transmittance = 0.75; ///< of light, 0 to 1; UN R43 asks for 0.70 at least
    double haze = 0.01;          ///< share turned by more than 2.5 degrees, 0 to 0.3; new about 0.003, worn 0.01 to 0.03
    bool operator==(const Windscreen&) const = default;
};

struct EyeVeil {
    double age_years = 25.0;
    double pigmentation = 0.5; ///< 0 black, 0.5 brown, 1.0 blue-green, 1.2 very light
    bool operator==(const EyeVeil&) const = default;
};

/// White follows what the eye is adapted to: d ln A / dt = (ln L - ln A) / tau with L the picture's log-mean luminance. Pictures of
/// different moments then have different exposures.
struct ExposureAdaptation {
    double brighter_s = 0.5, darker_s = 10.0; ///< tau where L is above A, and below
    bool operator==(const ExposureAdaptation&) const = default;
};

struct DisplaySettings {
    std::optional<DisplayProfile> profile; ///< nullopt: sRGB, each channel clipped, encoded where it is drawn
    std::filesystem::path profile_file;
    std::optional<Windscreen> windscreen;
    std::optional<EyeVeil> veil;
    bool night_colours = false, night_sharpness = false;
    std::optional<ExposureAdaptation> adaptation;

    /// Whether pictures are made of coloured light after drawing, and not by the drawing itself.
    bool after_drawing() const { return profile || windscreen || veil || night_colours || night_sharpness || adaptation; }
    bool operator==(const DisplaySettings&) const = default;
};

} // namespace fernlicht
