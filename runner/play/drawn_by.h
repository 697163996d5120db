// What a drive's shadows are drawn by and its pictures shown by, for report.json and its page.
#pragma once

#include "scenarios/display/display_profile.h"
#include "scenarios/display/tone_mapper.h"
#include "scenarios/drives/shadow_settings.h"

#include <string>
#include <vector>

namespace fernlicht {

struct Drive;

struct DrawnBy {
    ShadowSettings shadows;
    std::string shadows_instead; ///< what the technique draws where it does not use the method, as a clause; "": it does
    ToneMapper tone_mapper;
    DisplaySettings display;

    /// Whether nothing of tone mapper and display is set in the drive.
    bool shown_as_usual() const { return tone_mapper == ToneMapper{} && display == DisplaySettings{}; }
};

/// Of a drive as it is played: method and tone mapper are no longer open.
DrawnBy drawn_by(const Drive& drive);

/// What a technique draws where it does not use the drive's shadow method: "it draws no shadows of lamps"; "" where it does.
std::string shadows_instead(const Drive& drive);

/// The display that pictures are for: sRGB's reference display of 80 cd/m2 where the drive names no profile, with the gamut rule that its
/// pictures follow (docs/display.md).
DisplayProfile display_of(const DrawnBy& drawn);

/// What an even area is shown as that is seen with this luminance (behind windscreen and eye), cd/m2, before codes are rounded: black +
/// share (peak - black), at the white that stands in the tone mapper.
double shown_cdm2(const DrawnBy& drawn, double seen_cdm2);

/// Windscreen, eye and adaptation, as far as they are on, in order: "veil in an eye of 60 years, pigmentation 0.5".
std::vector<std::string> display_stages(const DrawnBy& drawn);

} // namespace fernlicht
