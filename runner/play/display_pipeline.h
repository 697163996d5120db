// From a picture's coloured light to the codes of a display, stage by stage: windscreen, eye, tone mapper, display. Stages that a drive
// does not ask for are not computed.
// What a display's profile makes of pictures that nobody would want, and is no mistake of the file.
#pragma once

#include "scenarios/display/display_profile.h"
#include "scenarios/display/tone_mapper.h"
#include "scenarios/drives/play/frame.h"
#include "scenarios/drives/shadow_settings.h"
#include "scenarios/values/image.h"

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht {

struct Drive;

struct ShownPicture {
    Image<glm::u16vec3> codes; ///< of `bits` bits
    int bits = 8;
    std::vector<std::pair<std::string, double>> stage_s; ///< what each stage took, in order
};

/// `light`: perspective, square pixels, linear in sRGB's primaries, Y in cd/m2. The mapper is closed (ToneMapper::is_open). Without a
/// profile: sRGB. `seed`: of a camera's noise.
ShownPicture show(const Image<glm::vec3>& light, double vertical_fov_rad, const DisplaySettings& display, const ToneMapper& mapper,
                  std::uint64_t seed = 0);

/// A frame of a drive that was drawn with coloured light: `show`, with the night's sky behind it. `moment`: the frame's; with a sky alone
/// it is looked at. `picture`: PNG that the frame is stored as (frame_stem); by its name and `drive_seed` each has noise of its own.
ShownPicture show_frame(const Frame& frame, const std::optional<Moment>& moment, const View& view, const DisplaySettings& display,
                        const ToneMapper& mapper, std::uint64_t drive_seed, const std::filesystem::path& picture);

/// Whether pictures are made of coloured light by `show`, and not by the drawing itself, which clips each channel and has no curves.
bool is_shown_after_drawing(const DisplaySettings& display, const ToneMapper& mapper);

/// What pictures were shown by, in one line: "rational s=20 white=100 cd/m2; display srgb" as drawn, "...; display srgb, luminance kept"
/// where they are shown after drawing without a profile, whose own rule is part of its hash. Pictures with different lines have no common
/// scale.
std::string shown_by(const DisplaySettings& display, const ToneMapper& mapper);

/// One sentence each: a peak below 3 times the black, the least contrast that ISO 9241-3 and ANSI/HFES 100-1988 recommend for text; PQ in 8
/// bits, where ITU-R BT.2100 has 10 or 12.
std::vector<std::string> display_warnings(const DisplayProfile& profile);

/// By which shadow method, tone mapper and display a drive's pictures are made.
struct RenderingSettings {
    ShadowSettings shadows;
    std::string substitute_shadows; ///< what the technique draws where it does not use the method, as a clause; "": it does
    ToneMapper tone_mapper;
    DisplaySettings display;

    /// Whether nothing of tone mapper and display is set in the drive.
    bool shown_as_usual() const {
        DisplaySettings usual;
        usual.white = display.white; // each drive has its own
        return tone_mapper == ToneMapper{} && display == usual;
    }
};

/// Of a drive as it is played: method and tone mapper are no longer open.
RenderingSettings rendering_settings(const Drive& drive);

/// What a technique draws where it does not use the drive's shadow method: "it draws no shadows of lamps"; "" where it does.
std::string substitute_shadows(const Drive& drive);

/// The display that pictures are for: sRGB's reference display of 80 cd/m2 where the drive names no profile, with the gamut rule that its
/// pictures follow (docs/display.md).
DisplayProfile display_of(const RenderingSettings& drawn);

/// What an even area is shown as that is seen with this luminance (behind windscreen and eye), cd/m2, before codes are rounded: black +
/// share (peak - black), at the white that stands in the tone mapper.
double shown_cdm2(const RenderingSettings& drawn, double seen_cdm2);

/// Windscreen, eye and adaptation, as far as they are on, in order: "veil in an eye of 60 years, pigmentation 0.5".
std::vector<std::string> display_stages(const RenderingSettings& drawn);

} // namespace fernlicht
