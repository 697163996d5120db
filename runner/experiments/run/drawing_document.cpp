#include "metrics/display/night_vision.h"
#include "runner/experiments/run/run_document.h"
#include "runner/files/clean_text.h"
#include "runner/findings/figures.h"
#include "runner/play/display_pipeline.h"
#include "runner/play/shadows/choose_shadows.h"
#include "scenarios/display/tone_mapper.h"
#include "scenarios/drives/keys/shadow_keys.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

std::string shadows_words(const RenderingSettings& drawn, const std::string& technique) {
    std::string settings;
    for (const auto& [key, text] : used_shadow_keys(drawn.shadows))
        if (key != "redraw_texels" || drawn.shadows.redraw_texels > 0.0)
            settings += fmt::format("{}{} {}", settings.empty() ? " (" : ", ", key, text);
    settings += settings.empty() ? "" : ")";
    if (!drawn.substitute_shadows.empty())
        return fmt::format("The drive has `{}`{}, and technique `{}` does not use it: {}.", name(drawn.shadows.method), settings, technique,
                           drawn.substitute_shadows);
    return fmt::format("Shadows by `{}`{}.{}", name(drawn.shadows.method), settings,
                       drawn.shadows.objects_cast ? "" : " `shadows: false`: nothing casts any, for the reference either.");
}

Table tried_table(const ComparedDrive& drive, const ShadowChoice& choice) {
    Table table{drive.name + "-shadows-tried",
                fmt::format("Methods in the order of what they cost, up to the one taken. Wrong: share of what would get 0.05 lx or more "
                            "without shadows in a view that is wrongly lit or wrongly dark; the drive asks for at most {} %, and a method "
                            "is out with the first picture that is beyond",
                            figure(100.0 * choice.bound, 2)),
                columns_of("method<|wrong at worst [%]|after [s]|view<|lamp<|pictures"),
                {}};
    for (const TriedShadows& tried : choice.tried) {
        std::vector<Cell>& row = table.rows.emplace_back(std::vector<Cell>{std::string(name(tried.method))});
        if (tried.error)
            row.insert(row.end(), {{figure(100.0 * *tried.error, 2), 100.0 * *tried.error},
                                   {figure(tried.worst_s, 2), tried.worst_s},
                                   short_text(tried.worst_view, 40),
                                   short_text(tried.worst_set, 40),
                                   fmt::format("{}", tried.pictures)});
        else
            row.emplace_back("refuses: " + tried.refused);
    }
    return table;
}

void add_shadows(const ComparedDrive& drive, Sections& sections) {
    const PlayedCell& played = *drive.lamp_sets.front();
    if (played.rendering_settings)
        sections.push_back({"How shadows are rendered", {shadows_words(*played.rendering_settings, played.technique)}, 4});
    const ShadowChoice* const choice = played.shadows.get();
    if (!choice)
        return;
    Section& section = played.rendering_settings ? sections.back() : sections.emplace_back(Section{"", {}, 4});
    section.blocks.emplace_back(fmt::format(
        "`shadows: auto` chose `{}`: {}. Something stands in a beam in {} of {} moments of all lamp sets; {} of them, evenly spread, are "
        "held against a ray from each pixel to each lamp in every view; between them a method may err by more.",
        name(choice->chosen), choice->why, choice->ticks_shadowed, choice->ticks, choice->compared));
    if (!choice->tried.empty())
        section.blocks.emplace_back(tried_table(drive, *choice));
}

void add_shown_by(const RenderingSettings& drawn, Sections& sections) {
    const DisplayProfile display = display_of(drawn);
    const ToneMapper& mapper = drawn.tone_mapper;
    const bool has_s = mapper.kind == ToneMapperKind::rational || mapper.kind == ToneMapperKind::logarithmic;
    const bool adapts = drawn.display.adaptation.has_value();
    const std::string by = shown_by(drawn.display, mapper);
    const std::string gamut = display.gamut == GamutRule::clip ? "are clipped in each channel" : "keep their luminance and become paler";
    const std::string levels =
        fmt::format("{:.3g}, {:.3g} and {:.3g} cd/m²", shown_cdm2(drawn, 0.1), shown_cdm2(drawn, 1.0), shown_cdm2(drawn, 10.0));
    Section& section = sections.emplace_back(Section{"How the pictures are shown", {}, 4});
    if (drawn.shown_as_usual()) {
        section.blocks.emplace_back(
            fmt::format("By `{}`: 0.1, 1 and 10 cd/m² as {} where white is {:.4g} cd/m²; colours that sRGB does not hold {}.", by, levels,
                        display.peak_cdm2(), gamut));
        return;
    }
    const bool seen_first = drawn.display.windscreen || drawn.display.veil || drawn.display.night_colours || drawn.display.night_sharpness;
    const char* const at_first = adapts ? " at first" : "";
    Listing stages(display_stages(drawn));
    if (!drawn.display.camera)
        stages.items.push_back(fmt::format("Tone mapper `{}`{}, white at {:.4g} cd/m²{}", name(mapper.kind),
                                           has_s ? fmt::format(", s = {:.3g}", mapper.s) : "", mapper.l_max_cdm2, at_first));
    stages.items.push_back(fmt::format("Display `{}`{}: peak {:.4g} cd/m², black {:.3g} cd/m², {} bits; colours that it does not hold {}",
                                       drawn.display.profile ? short_text(display.name, 60) : "sRGB, no profile",
                                       drawn.display.profile && !display.title.empty() ? " (" + short_text(display.title, 80) + ")" : "",
                                       display.peak_cdm2(), display.black_cdm2, display.bits, gamut));
    stages.items.push_back(fmt::format("An even area that {} 0.1, 1 and 10 cd/m² is shown with {}{}",
                                       drawn.display.camera ? "comes to the camera with"
                                       : seen_first         ? "the eye sees with"
                                                            : "has",
                                       levels, at_first));
    section.blocks = {std::move(stages), "In the PNGs: `" + by + "`."};
}

void add_seen(const ComparedDrive& drive, const SeenDisplay& first, Sections& sections) {
    Table table{
        drive.name + "-seen",
        "",
        columns_of("lamp<|view<|pixel in the scene [arcmin]|pixel on the display [arcmin]|magnification|life-size from [m]|finer than the "
                   "eye [by day]<|mean on the display [cd/m²]|the eye resolves there [arcmin]|finer than the eye [there]<"),
        {}};
    const auto finer = [](bool is) { return is ? "yes" : "no"; };
    const auto number = [](double value, int decimals) { return Cell(figure(value, decimals), value); };
    for (std::size_t i = 0; i < drive.lamp_sets.size(); ++i)
        if (const SeenDisplay* const seen = drive.lamp_sets[i]->display.get())
            for (const SeenView& view : seen->views) {
                std::vector<Cell>& row = table.rows.emplace_back();
                row = {lamp_cell(drive, i),
                       view.view,
                       number(view.size.scene_pixel_arcmin, 2),
                       number(view.size.display_pixel_arcmin, 2),
                       number(view.size.magnification(), 3),
                       number(view.size.life_size_m, 2),
                       finer(view.finer_by_day())};
                if (view.mean_cdm2)
                    row.insert(row.end(), {{fmt::format("{:.3g}", *view.mean_cdm2), *view.mean_cdm2},
                                           number(*view.resolved(), 2),
                                           finer(view.size.display_pixel_arcmin <= *view.resolved())});
                else
                    row.emplace_back("not measured: no picture of this view was shown by the profile");
            }
    sections.push_back(
        {"How the pictures are seen on the display",
         {fmt::format("Display `{}`, pixels of {:g} mm, looked at from {:g} m. A pixel is that in the middle of the picture. "
                      "Magnification: the angle on the display over that in the scene; 1 is life-size. Pixels are finer than the eye "
                      "where they are no larger than what it resolves: by day 1′, and at the mean luminance of what the display shows "
                      "the figure beside it.",
                      short_text(first.profile, 60), first.pixel_pitch_mm, first.viewing_distance_m),
          std::move(table)},
         4});
}

} // namespace

void add_drawing(const ComparedDrive& drive, Sections& sections) {
    add_shadows(drive, sections);
    if (const RenderingSettings* const drawn = drive.lamp_sets.front()->rendering_settings.get())
        add_shown_by(*drawn, sections);
    if (const SeenDisplay* const seen = drive.lamp_sets.front()->display.get())
        add_seen(drive, *seen, sections);
}

} // namespace fernlicht
