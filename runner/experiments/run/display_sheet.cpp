#include "runner/experiments/run/display_sheet.h"

#include "metrics/display/display_colour.h"
#include "runner/files/clean_text.h"
#include "runner/play/display_pipeline.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/trigonometric.hpp>

namespace fernlicht {
namespace {

View tile_view(const View& driver) {
    View view = driver;
    view.height_px = std::max(1, static_cast<int>(std::lround(double{tile_px} * view.height_px / view.width_px)));
    view.width_px = tile_px;
    return view;
}

Image<Rgb8> shown_tile(const Image<glm::vec3>& light, const View& view, const DisplaySettings& display, const ToneMapper& mapper) {
    const ShownPicture shown = show(light, view.vertical_fov_rad, display, mapper);
    Image<Rgb8> picture(light.width(), light.height());
    std::ranges::transform(shown.codes.pixels(), picture.data(), [](const glm::u16vec3& code) {
        return Rgb8{static_cast<std::uint8_t>(code.r), static_cast<std::uint8_t>(code.g), static_cast<std::uint8_t>(code.b)};
    });
    return picture;
}

/// "white 103 cd/m2, s 20; keeps 98, 84, 34 %"
std::string mapper_words(const ToneMapper& mapper) {
    std::string words = fmt::format("white {:.4g} cd/m2", mapper.l_max_cdm2);
    if (mapper.kind == ToneMapperKind::rational || mapper.kind == ToneMapperKind::logarithmic)
        words += fmt::format(", s {:.4g}", mapper.s);
    return words + fmt::format("; keeps {:.0f}, {:.0f}, {:.0f} %", 100.0 * contrast_kept(mapper, 0.1), 100.0 * contrast_kept(mapper, 1.0),
                               100.0 * contrast_kept(mapper, 10.0));
}

} // namespace

DisplaySheet display_sheet(const Stage& stage, const LampSet& lamp_set, const Moment& moment, Device& device,
                           const RendererSettings& settings) {
    DisplaySheet sheet{stage.drive.name, stage.drive.title, lamp_set.name, moment.time_s, moment.distance_m, {}, {}};
    const View view = tile_view(*driver_view(stage.drive));
    const Frame frame = Renderer(device, stage.scene, settings).draw(moment, view, {.luminance = true, .light = true});
    if (frame.light.empty())
        return sheet;
    RendererSettings surfaces_alone = settings;
    surfaces_alone.sources = false;
    LuminanceHistogram all, surfaces;
    all.add(frame.luminance_cdm2);
    surfaces.add(Renderer(device, stage.scene, surfaces_alone).draw(moment, view, {.luminance = true}).luminance_cdm2);
    const double brightest = std::max(all.max_cdm2(), 1.0e-6), brightest_surface = std::max(surfaces.max_cdm2(), 1.0e-6);
    DisplaySettings plain;
    plain.white = stage.drive.display.white;
    const auto add = [&](const char* name, const ToneMapper& mapper) {
        sheet.mappers.push_back({name, mapper_words(mapper), shown_tile(frame.light, view, plain, mapper)});
    };
    const auto mapper = [](ToneMapperKind kind, double s, double l_max_cdm2) {
        ToneMapper made;
        made.kind = kind;
        made.s = s;
        made.l_max_cdm2 = l_max_cdm2;
        return made;
    };
    add("linear", mapper(ToneMapperKind::linear, 1.0, brightest));
    add("linear, light sources clipped", mapper(ToneMapperKind::linear, 1.0, brightest_surface));
    add("logarithmic", mapper(ToneMapperKind::logarithmic, 1000.0, brightest));
    add("histogram adjustment", histogram_mapper(all, brightest, 1.0e-3));
    add("rational", mapper(ToneMapperKind::rational, 20.0, 100.0));
    add("rational, fitted", mapper(ToneMapperKind::rational, fitted_s(all.log_mean_cdm2(), brightest_surface, 0.18), brightest_surface));
    const auto add_eye = [&](const char* name, const std::string& words, const DisplaySettings& display) {
        sheet.eyes.push_back({name, words, shown_tile(frame.light, view, display, stage.drive.tone_mapper)});
    };
    const double pixel_arcmin = 60.0 * glm::degrees(2.0 * std::atan(std::tan(0.5 * view.vertical_fov_rad) / view.height_px));
    DisplaySettings windscreen = plain, young = plain, old = plain, colours = plain, sharpness = plain;
    windscreen.windscreen = Windscreen{0.75, 0.03};
    young.veil = EyeVeil{25.0, 0.5};
    old.veil = EyeVeil{75.0, 0.5};
    colours.night_colours = sharpness.night_sharpness = true;
    add_eye("as it is", "the drive's own tone mapper, as in all of these", plain);
    add_eye("windscreen", "transmittance 0.75, haze 3 %: a worn one", windscreen);
    add_eye("veil, 25 years", "the CIE's general glare equation", young);
    add_eye("veil, 75 years", "the same eye later", old);
    add_eye("colours at night", "CIE 191: what cones leave to rods is grey", colours);
    add_eye("sharpness at night", fmt::format("what the eye resolves; a pixel here spans {:.1f}′", pixel_arcmin), sharpness);
    return sheet;
}

TileSheet tiles_of(const DisplaySheet& sheet) {
    const std::string where = fmt::format(
        "{}, {}: after {:.2f} s, {:.1f} m along the route; keeps: of a small contrast at 0.1, 1 and 10 cd/m2; colours that "
        "sRGB does not hold keep their luminance, here and below",
        short_text(sheet.title.empty() ? sheet.drive : sheet.title, 60), short_text(sheet.lamp_set, 40), sheet.time_s, sheet.distance_m);
    return {
        "Contact sheet of tone mappers and eyes",
        {{"One moment through every tone mapper", where, sheet.mappers}, {"Through windscreen and eye", "each stage alone", sheet.eyes}}};
}

} // namespace fernlicht
