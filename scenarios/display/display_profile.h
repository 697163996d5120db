// A display: what light comes out of it for the numbers that go in, and from where it is looked at.
// The way from a drive's light to its pictures: windscreen, eye, display. All of it is off unless a drive asks for it.
#pragma once

#include "scenarios/display/night_sky.h"
#include "scenarios/display/white_adaptation.h"
#include "scenarios/values/files.h"

#include <filesystem>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

namespace fernlicht {

/// From a code, 0..1, to the share of a channel's full light, 0..1.
enum class TransferKind {
    linear,
    gamma, ///< code^gamma
    srgb,  ///< IEC 61966-2-1
    pq     ///< SMPTE ST 2084: codes mean luminances up to 10 000 cd/m2, whatever the display's peak; the display stops at its peak
};

/// How a colour that the display cannot show is changed.
enum class GamutRule {
    keep_luminance, ///< moved towards the grey of its luminance until all channels are within 0..1
    clip            ///< each channel by itself: keeps the hue of none and the luminance of none
};

struct DisplayProfile {
    std::string name, title;
    /// XYZ in cd/m2 of linear red, green, blue, 0..1 each; columns. Y of (1, 1, 1) is the luminance that white adds to black.
    glm::dmat3 xyz_from_rgb{1.0};
    double black_cdm2 = 0.0; ///< of (0, 0, 0): stray light and what the panel lets through; white's chromaticity; 0 <= black < peak
    TransferKind transfer = TransferKind::srgb;
    double gamma = 2.2; ///< TransferKind::gamma alone; 0.1 to 10
    GamutRule gamut = GamutRule::keep_luminance;
    int bits = 8;                                                       ///< of a channel: 8 or 16 in files
    std::optional<double> viewing_distance_m = {}, pixel_pitch_mm = {}; ///< nullopt: not known; else above 0

    double white_cdm2() const; ///< what (1, 1, 1) adds to black
    double peak_cdm2() const { return black_cdm2 + white_cdm2(); }
    /// What one pixel in the middle spans for the beholder, degrees: 2 atan(pitch / (2 distance)). nullopt where either is not known.
    std::optional<double> pixel_deg() const;

    bool operator==(const DisplayProfile&) const = default;
};

/// XYZ of linear light in sRGB's primaries as IEC 61966-2-1 rounds it; pictures of fernlicht hold such light, Y in cd/m2.
glm::dmat3 xyz_from_light();

/// sRGB at 80 cd/m2 (IEC 61966-2-1's reference display): the profile of a drive that names none.
DisplayProfile srgb_display();

/// Whether its codes mean what sRGB's do, whatever its luminances: what a PNG says without an ICC profile.
bool is_srgb(const DisplayProfile& profile);

/// The columns of xyz_from_rgb for primaries and white given by chromaticities x, y, with Y of white = `white_cdm2`. Throws
/// std::invalid_argument where they make no colour space: y = 0, primaries on a line, a white outside their triangle.
glm::dmat3 xyz_from_primaries(const glm::dvec2& red, const glm::dvec2& green, const glm::dvec2& blue, const glm::dvec2& white,
                              double white_cdm2);

/// A profile in YAML (scenarios/library/displays has some; docs/display.md explains the keys). `text` a path, or the name of a shipped
/// profile. Throws InputError with file, line, column, key.
DisplayProfile read_display_profile(const std::filesystem::path& path, FilesRead& opened);
/// YAML that is read back to the same.
std::string write_display_profile(const DisplayProfile& profile);

/// Codes to shares of light and back; both rise, and are inverse to each other within 1e-12. For pq relative to `white_cdm2`.
double decoded(const DisplayProfile& profile, double code);
double encoded(const DisplayProfile& profile, double share);

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

/// A camera in the eye's place, for whoever holds pictures against footage. Its sensor has the channels that are shown, each pixel all of
/// them.
struct CameraSettings {
    TransferKind tone = TransferKind::srgb; ///< from the share of saturation to the code; not pq
    double gamma = 2.2;                     ///< TransferKind::gamma alone
    double exposure_s = 0.02;               ///< > 0
    double f_number = 1.8;                  ///< > 0
    double iso = 800.0;                     ///< saturation-based speed (ISO 12232), > 0
    double saturation_e = 4000.0;           ///< electrons of a channel at saturation, at this speed; 0: no noise at all
    double read_noise_e = 3.0;              ///< standard deviation
    double bloom = 0.01;                    ///< share of the light that the lens turns by more than 2.5 degrees, 0 to 0.3

    /// What saturates it: H = 78 / S lx s (ISO 12232) by H = 0.65 L t / N^2, a lens of 0.9 transmittance 10 degrees off its axis: L = 120
    /// N^2 / (S t).
    double saturation_cdm2() const { return 78.0 / iso * f_number * f_number / (0.65 * exposure_s); }
    bool operator==(const CameraSettings&) const = default;
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
    std::optional<NightSky> sky; ///< behind what is seen; nullopt: the drive's even one
    std::optional<Windscreen> windscreen;
    std::optional<EyeVeil> veil;
    bool night_colours = false, night_sharpness = false;
    WhiteAdaptation white;                ///< of pictures drawn and shown alike
    std::optional<CameraSettings> camera; ///< in place of eye, tone mapper and profile
    std::optional<ExposureAdaptation> adaptation;

    /// Whether pictures are made of coloured light after drawing, and not by the drawing itself.
    bool after_drawing() const { return profile || sky || windscreen || veil || night_colours || night_sharpness || camera || adaptation; }
    bool operator==(const DisplaySettings&) const = default;
};

} // namespace fernlicht
