#include "runner/play/drawn_by.h"

#include "renderer/technique.h"
#include "runner/play/shown_picture.h"
#include "scenarios/drives/drive.h"

#include <fmt/format.h>

namespace fernlicht {

std::string shadows_instead(const Drive& drive) {
    const Technique& technique = technique_named(drive.technique, drive.file);
    const ShadowMethod method = drive.shadows.method;
    const bool ours = technique.kind == TechniqueKind::ours;
    if (method == ShadowMethod::none || (ours && (technique.name != "photometric-naive" || method == ShadowMethod::map)))
        return "";
    return ours ? "its shadows are those of a map for each lamp" : "it draws no shadows of lamps";
}

DrawnBy drawn_by(const Drive& drive) { return {drive.shadows, shadows_instead(drive), drive.tone_mapper, drive.display}; }

DisplayProfile display_of(const DrawnBy& drawn) {
    if (drawn.display.profile)
        return *drawn.display.profile;
    DisplayProfile srgb = srgb_display();
    srgb.name = "srgb";
    srgb.gamut = is_shown_after_drawing(drawn.display, drawn.tone_mapper) ? GamutRule::keep_luminance : GamutRule::clip;
    return srgb;
}

double shown_cdm2(const DrawnBy& drawn, double seen_cdm2) {
    const DisplayProfile display = display_of(drawn);
    return display.black_cdm2 + toned(drawn.tone_mapper, seen_cdm2) * display.white_cdm2();
}

std::vector<std::string> display_stages(const DrawnBy& drawn) {
    const DisplaySettings& display = drawn.display;
    std::vector<std::string> stages;
    if (display.windscreen)
        stages.push_back(
            fmt::format("windscreen, transmittance {:g}, haze {:g}", display.windscreen->transmittance, display.windscreen->haze));
    if (display.veil)
        stages.push_back(
            fmt::format("veil in an eye of {:g} years, pigmentation {:g}", display.veil->age_years, display.veil->pigmentation));
    if (display.night_colours)
        stages.emplace_back("colours at night");
    if (display.night_sharpness)
        stages.emplace_back("sharpness at night");
    if (display.adaptation)
        stages.push_back(
            fmt::format("adaptation: white follows the driver's picture, in {:g} s towards brighter and {:g} s towards darker light",
                        display.adaptation->brighter_s, display.adaptation->darker_s));
    return stages;
}

} // namespace fernlicht
