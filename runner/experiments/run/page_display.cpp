#include "metrics/display/seen_display.h"
#include "runner/experiments/run/page_parts.h"
#include "runner/files/clean_text.h"
#include "runner/play/drawn_by.h"
#include "runner/play/shown_picture.h"
#include "scenarios/display/tone_mapper.h"

#include <fmt/format.h>

namespace fernlicht {

namespace {

/// "1.57", "0.00012", "54.8": three digits.
std::string three_digits(double value) { return fmt::format("{:.3g}", value); }

kainjow::mustache::data shown_by_part(const DrawnBy& drawn) {
    using kainjow::mustache::data;
    const DisplayProfile display = display_of(drawn);
    const ToneMapper& mapper = drawn.tone_mapper;
    const bool has_s = mapper.kind == ToneMapperKind::rational || mapper.kind == ToneMapperKind::logarithmic;
    data part, stages{data::type::list};
    part.set("shown_by", clean_text(shown_by(drawn.display, mapper)));
    part.set("as_usual", drawn.shown_as_usual());
    part.set("mapper", std::string(name(mapper.kind)));
    part.set("s", has_s ? ", s = " + three_digits(mapper.s) : "");
    part.set("white", fmt::format("{:.4g}", mapper.l_max_cdm2));
    part.set("display", drawn.display.profile ? short_text(display.name, 60) : "sRGB, no profile");
    part.set("title", drawn.display.profile && !display.title.empty() ? " (" + short_text(display.title, 80) + ")" : "");
    part.set("peak", fmt::format("{:.4g}", display.peak_cdm2()));
    part.set("black", three_digits(display.black_cdm2));
    part.set("bits", fmt::format("{}", display.bits));
    part.set("gamut", display.gamut == GamutRule::clip ? "are clipped in each channel" : "keep their luminance and become paler");
    for (const std::string& stage : display_stages(drawn))
        stages.push_back(stage);
    part.set("has_stages", stages.is_non_empty_list());
    part.set("stages", stages);
    part.set("adapts", drawn.display.adaptation.has_value());
    part.set("seen_first", drawn.display.windscreen || drawn.display.veil || drawn.display.night_colours || drawn.display.night_sharpness);
    part.set("low", three_digits(shown_cdm2(drawn, 0.1)));
    part.set("middle", three_digits(shown_cdm2(drawn, 1.0)));
    part.set("high", three_digits(shown_cdm2(drawn, 10.0)));
    return part;
}

} // namespace

kainjow::mustache::data display_part(const ComparedDrive& drive) {
    using kainjow::mustache::data;
    data part, rows{data::type::list};
    if (const DrawnBy* const drawn = drive.variants.front()->drawn_by.get())
        part.set("shown", shown_by_part(*drawn));
    const SeenDisplay* const first = drive.variants.front()->display.get();
    part.set("was_seen", first != nullptr);
    if (first == nullptr)
        return part;
    part.set("profile", short_text(first->profile, 60));
    part.set("distance", fmt::format("{:g}", first->viewing_distance_m));
    part.set("pitch", fmt::format("{:g}", first->pixel_pitch_mm));
    const auto finer = [](bool is) { return is ? "yes" : "no"; };
    for (std::size_t i = 0; i < drive.variants.size(); ++i)
        if (const SeenDisplay* const seen = drive.variants[i]->display.get())
            for (const SeenView& view : seen->views) {
                data row;
                row.set("lamp", short_text(drive.variants[i]->variant, 40));
                row.set("colour", variant_colour(i));
                row.set("view", clean_text(view.view));
                row.set("scene", figure(view.size.scene_pixel_arcmin, 2));
                row.set("display", figure(view.size.display_pixel_arcmin, 2));
                row.set("magnification", figure(view.size.magnification(), 3));
                row.set("life_size", figure(view.size.life_size_m, 2));
                row.set("finer_by_day", finer(view.finer_by_day()));
                row.set("shown", view.mean_cdm2.has_value());
                if (view.mean_cdm2) {
                    row.set("mean", fmt::format("{:.3g}", *view.mean_cdm2));
                    row.set("resolved", figure(*view.resolved(), 2));
                    row.set("finer", finer(view.size.display_pixel_arcmin <= *view.resolved()));
                }
                rows.push_back(row);
            }
    part.set("rows", rows);
    return part;
}

} // namespace fernlicht
